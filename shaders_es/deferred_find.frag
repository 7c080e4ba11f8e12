// The visibility of each pixel's receiver, or of one of four by four. See src/deferred_pass.h.
#ifdef POINTS
layout(location = 0) out uvec2 point; // see sparse_cells.frag
#else
layout(location = 0) out uint found; // steps of 1/65535
#endif

float visibility_of(uvec4 texel, float spacing)
{
	vec2 slope = slope_of(texel.w & ~0x10001u);
	bool casts_too = (texel.w & 1u) != 0u;
	vec3 s = uintBitsToFloat(texel.xyz);
	return gathered_visibility(receiver_of(s, slope, casts_too, spacing));
}

#ifdef POINTS
// How far apart, on the light's screen, points are along one axis of the picture: the pixel beside
// this one tells that is nearer, for the other may be of another surface. At the rim one is the same.
float spacing_along(vec2 middle, vec2 s, vec2 axis)
{
	float a = distance(s, uintBitsToFloat(receiver_at(middle - axis).xy));
	float b = distance(s, uintBitsToFloat(receiver_at(middle + axis).xy));
	return POINT_SPACING * min(a > 0.0 ? a : b, b > 0.0 ? b : a);
}

void main()
{
	vec2 middle = (floor(gl_FragCoord.xy) - 1.0) * POINT_SPACING + 0.5;
	vec2 inside = clamp(middle, vec2(0.5), vec2(textureSize(point_map, 0)) - 0.5);
	uvec4 texel = receiver_at(inside);
	vec2 s = uintBitsToFloat(texel.xy);
	float x = spacing_along(inside, s, vec2(1.0, 0.0));
	float y = spacing_along(inside, s, vec2(0.0, 1.0));
	float v = visibility_of(texel, max(x, y));
	// Beside the picture there is none.
	uint wide = !narrow_penumbra && middle == inside ? 0x10000u : 0u;
	point = uvec2(floatBitsToUint(depth_at(inside)), steps_of(v) | wide);
}
#else
void main()
{
	uvec4 texel = receiver_at(gl_FragCoord.xy);
	light_arrives = receives(texel);
	float v = visibility_of(texel, 0.0);
	found = light_arrives ? steps_of(v) : 0u;
}
#endif
