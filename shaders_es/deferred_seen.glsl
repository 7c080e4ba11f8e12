// What deferred_find.frag drew, and the camera's depth of its receivers.
uniform usampler2D visibility_map;

// In steps of 1/65535. As in gather_textures.glsl texelFetch() would be dearer.
uint seen_visibility(vec2 middle)
{
	return textureLod(visibility_map, middle / vec2(textureSize(visibility_map, 0)), 0.0).r;
}

#ifdef SAMPLES
uniform sampler2D visibility_depth;

uint seen_visibility(ivec2 pixel)
{
	return seen_visibility(vec2(pixel) + 0.5);
}

float seen_depth(ivec2 pixel)
{
	vec2 middle = vec2(pixel) + 0.5;
	return textureLod(visibility_depth, middle / vec2(textureSize(visibility_map, 0)), 0.0).r;
}

// Of a depth map of 24 bits.
float seen_rounding(float depth)
{
	return 1.0 / 16777216.0;
}
#else
// Of this very pixel, which has the receiver alone.
float shadow_visibility(vec3 p)
{
	return float(seen_visibility(gl_FragCoord.xy)) / 65535.0;
}
#endif
