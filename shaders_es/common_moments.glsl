// Moments of depth as texels have them. In 16-bit floats (SPLIT) a value takes two channels, in steps
// of 1/256 and what is left of it: filtering is linear, and the sum has 20 bits (Lauritzen, GPU Gems 3,
// section 8.4.3).
#ifdef SPLIT
vec4 to_moments(vec2 moments)
{
	vec2 high = floor(moments * 256.0 + 0.5) / 256.0;
	return vec4(high, (moments - high) * 256.0);
}

vec2 from_moments(vec4 texel)
{
	return texel.rg + texel.ba / 256.0;
}
#else
vec4 to_moments(vec2 moments)
{
	return vec4(moments, 0.0, 1.0);
}

vec2 from_moments(vec4 texel)
{
	return texel.rg;
}
#endif
