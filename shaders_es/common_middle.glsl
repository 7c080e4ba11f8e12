// Where the raster grid is coarse, corners are moved by a part of a pixel that shows, and all that is
// between them with them: what a pixel gets belongs to a place beside its middle.
in vec3 clip_place;      // x, y and w
uniform vec2 pixel_size; // NDC

// From that place to the middle, pixels as derivatives have them. A sliver, whose corners the grid has
// turned about, has none.
vec2 to_middle()
{
	vec2 at = clip_place.xy / clip_place.z;
	vec2 off = gl_FragCoord.xy * pixel_size - 1.0 - at;
	vec2 dx = dFdx(at), dy = dFdy(at);
	vec2 pixels = vec2(off.x * dy.y - off.y * dy.x, dx.x * off.y - dx.y * off.x) /
		(dx.x * dy.y - dx.y * dy.x);
	return all(lessThan(abs(pixels), vec2(1.0))) ? pixels : vec2(0.0);
}
