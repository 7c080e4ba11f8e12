// Visibility of surfaces that look up the sparse picture.
uniform float cell_scale; // cells to a pixel

bool is_between_points(out float v)
{
	return is_of_cell(gl_FragCoord.xy * cell_scale + 1.0, gl_FragCoord.z, v);
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
