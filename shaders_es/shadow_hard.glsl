// An ordinary shadow map, compared by the sampler: at the nearest texel, or blended
// from the four nearest.
float shadow_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	return textureLod(depth_compare, vec3(s.xy, receiver_depth(s)), 0.0);
}
