// What deferred_find.frag drew, and the camera's depth of its receivers.
uniform usampler2D visibility_map;
uniform sampler2D visibility_depth;

// In steps of 1/65535.
uint seen_visibility(ivec2 pixel)
{
	return texelFetch(visibility_map, pixel, 0).r;
}

float seen_depth(ivec2 pixel)
{
	return texelFetch(visibility_depth, pixel, 0).r;
}

// Of a depth map of 24 bits.
float seen_rounding(float depth)
{
	return 1.0 / 16777216.0;
}
