// The visibility of each pixel's receiver. See src/deferred_pass.h.
uniform usampler2D point_map; // receivers, as surface.frag draws them

layout(location = 0) out uint found; // steps of 1/65535

void main()
{
	uvec4 texel = texelFetch(point_map, ivec2(gl_FragCoord.xy), 0);
	vec2 slope = unpackHalf2x16(texel.w & ~0x10001u) * (map_size.x / SLOPE_SCALE);
	casts = (texel.w & 1u) != 0u;
	light_arrives = (texel.w & 0x10000u) == 0u;
	float v = gathered_visibility(receiver_of(uintBitsToFloat(texel.xyz), slope, 0.0));
	// Dark by itself, as is what surfaces have beside it in the same pixel.
	found = light_arrives ? uint(clamp(v, 0.0, 1.0) * 65535.0 + 0.5) : 0u;
}
