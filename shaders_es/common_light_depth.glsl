// Window depth of the light's screen: hyperbolic for a spot, linear for a directional light.
#ifdef FLAT_INPUTS
#define near_to_far flat_map.w
#else
uniform float near_to_far; // 1 for a directional light
#endif

// (z - near) / (far - near) from window depth in [0, 1]; the divisor is near_to_far at least.
vec4 linear_depth(vec4 d)
{
	return d * near_to_far / (1.0 - d * (1.0 - near_to_far));
}

float linear_depth(float d)
{
	return linear_depth(vec4(d)).x;
}
