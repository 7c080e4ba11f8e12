// What exact_surface.frag drew.
uniform usampler2D visibility_map;
uniform sampler2D visibility_depth;

// In steps of 1/65535.
uint seen_visibility(ivec2 pixel)
{
	return 65535u - texelFetch(visibility_map, pixel, 0).r;
}

// Of 18 bits of what is left to the far plane.
float seen_rounding(float depth)
{
	return (1.0 - depth) / 131072.0;
}

// Window depth, from the camera's depth of fixed_camera_depth_of() (src/fixed/span.h): what is left to
// the far plane in 2^-30, as a float of 18 bits.
float seen_depth(ivec2 pixel)
{
	const int BITS = 17;
	float steps = floor(texelFetch(visibility_depth, pixel, 0).r * 2097152.0 + 0.5);
	int left = max(2097151 - int(steps), 0);
	int shift = max((left >> BITS) - 1, 0);
	return 1.0 - float(left - (shift << BITS) << shift) / 1073741824.0;
}
