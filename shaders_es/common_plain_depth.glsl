// Window depths of the light's screen in a texture that is read without comparing: as they are, in a
// depth texture or 32-bit floats; the bits of such a float as four bytes (DEPTH_PACKED); or as
// linear depth around the middle of its range, in [-1, 1], where a 16-bit float has a bit more
// (DEPTH_HALF).
#if defined(DEPTH_HALF)
vec4 to_plain(float d)
{
	return vec4(2.0 * linear_depth(d) - 1.0, 0.0, 0.0, 1.0);
}

float plain_depth(vec4 texel)
{
	float l = 0.5 * texel.r + 0.5;
	return l / mix(near_to_far, 1.0, l); // 1 for 1, as cleared maps have it
}

// What rounding may take of a depth d, down or up: a step of the format.
float plain_step(float d)
{
	float rest = 1.0 - clamp(d, 0.0, 1.0) * (1.0 - near_to_far);
	return rest * rest / (4096.0 * near_to_far);
}
#else
#if defined(DEPTH_PACKED)
vec4 to_plain(float d)
{
	uint bits = floatBitsToUint(d);
	return vec4(uvec4(bits, bits >> 8, bits >> 16, bits >> 24) & 255u) / 255.0;
}

float plain_depth(vec4 texel)
{
	uvec4 byte = uvec4(255.0 * texel + 0.5);
	return uintBitsToFloat(byte.x | byte.y << 8 | byte.z << 16 | byte.w << 24);
}
#else
vec4 to_plain(float d)
{
	return vec4(d, 0.0, 0.0, 1.0);
}

float plain_depth(vec4 texel)
{
	return texel.r;
}
#endif

float plain_step(float d)
{
	return 0.0;
}
#endif
