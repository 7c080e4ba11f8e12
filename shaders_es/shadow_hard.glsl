// An ordinary shadow map, compared at the nearest texel, or at the four nearest and blended.
float shadow_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	return compare(s.xy, receiver_depth(s));
}
