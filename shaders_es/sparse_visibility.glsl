// Visibility between the points of the sparse picture.
uniform usampler2D cell_map;
uniform float cell_scale; // cells to a pixel
uniform vec2 cell_depth;  // see sparse_cells.frag

// Whether the pixel is of its cell's surface; v is the visibility then.
bool is_between_points(out float v)
{
	vec2 at = gl_FragCoord.xy * cell_scale + 1.0, f = fract(at);
	vec2 middle = (floor(at) + 0.5) / vec2(textureSize(cell_map, 0));
	cell c = unpack_cell(textureLod(cell_map, middle, 0.0));
	float depth = c.depth + c.depth_x * f.x + c.depth_y * f.y;
	vec2 row = mix(c.v.xz, c.v.yw, f.x);
	v = clamp(mix(row.x, row.y, f.y) - 0.5 * dot(c.bend, f * (1.0 - f)), 0.0, 1.0);
	return abs(gl_FragCoord.z - depth) < cell_depth.x + cell_depth.y * depth;
}

#ifdef EDGES
float shadow_visibility(vec3 p)
{
	float v;
	bool known = is_between_points(v);
	light_arrives = light_arrives && !known;
	float found = gathered_visibility(p);
	return known ? v : found;
}
#else
bool light_arrives;

// Leaves the rest to a pass that finds it.
float shadow_visibility(vec3 p)
{
	float v;
	if (!is_between_points(v))
		discard;
	return v;
}
#endif
