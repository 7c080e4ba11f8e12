// What surface.frag draws of every pixel's receiver, and its camera's depth.
uniform usampler2D point_map;
uniform sampler2D visibility_depth;

// Of the pixel with its middle there; beyond the picture, of its rim. As in gather_textures.glsl
// texelFetch() would be dearer.
uvec4 receiver_at(vec2 middle)
{
	return textureLod(point_map, middle / vec2(textureSize(point_map, 0)), 0.0);
}

float depth_at(vec2 middle)
{
	return textureLod(visibility_depth, middle / vec2(textureSize(point_map, 0)), 0.0).r;
}

// Facing away it is dark by itself, as is what surfaces have beside it in the same pixel.
bool receives(uvec4 texel)
{
	return (texel.w & 0x10000u) == 0u;
}

// Pixels from one point to the next: SPARSE_SPACING of sparse_pass.h.
const float POINT_SPACING = 4.0;

uint steps_of(float v)
{
	return uint(clamp(v, 0.0, 1.0) * 65535.0 + 0.5);
}
