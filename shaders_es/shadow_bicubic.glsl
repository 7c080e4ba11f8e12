// Percentage-closer filtering by a bicubic kernel, as the paper's Figure 7 compares with: the 4x4
// nearest texels, each compared for itself, under the weights of a cubic B-spline.
// Weights of the texels at -1, 0, 1 and 2 from the one that is f before the point.
vec4 spline_weights(float f)
{
	float g = 1.0 - f;
	vec4 w = vec4(g * g * g, 3.0 * f * f * (f - 2.0) + 4.0, 3.0 * g * g * (g - 2.0) + 4.0,
		f * f * f);
	return w / 6.0;
}

// Of the 2x2 texels at a corner, compared at the receiver's plane amid them.
float dark_share(vec2 corner, vec2 texel, vec3 plane, vec2 x, vec2 y)
{
	float depth = plane.z + dot(plane.xy, corner + 0.5 - texel);
	return dot(1.0 - fetch_lit(corner, depth), vec4(x.x, x.y, x.y, x.x) * vec4(y.y, y.y, y.x, y.x));
}

float shadow_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	vec2 slope = receiver_slope(s);
	vec3 plane = vec3(slope * map_size.y, receiver_depth(s, slope, lookup_reach));
	// Beside the map all taps are border texels.
	vec2 texel = clamp(s.xy * map_size.x - 0.5, vec2(-2.0), vec2(map_size.x + 1.0));
	vec2 base = floor(texel);
	vec4 x = spline_weights(texel.x - base.x);
	vec4 y = spline_weights(texel.y - base.y);
	// Where all is lit this is 1 exactly, which the weights' sum is not.
	float dark = dark_share(base - 1.0, texel, plane, x.xy, y.xy) +
		     dark_share(base + vec2(1.0, -1.0), texel, plane, x.zw, y.xy) +
		     dark_share(base + vec2(-1.0, 1.0), texel, plane, x.xy, y.zw) +
		     dark_share(base + 1.0, texel, plane, x.zw, y.zw);
	return max(1.0 - dark, 0.0);
}
