// What probes have drawn and can read, as the bits of floats: pixel i has the bytes of value i, since
// not every driver reads floats back. All maps are of 2x2 texels.
uniform sampler2D base_texture;        // two channels
uniform sampler2D smoothie_map;        // the same, never fetched by index
#ifdef GATHER
uniform isampler2D smoothie_words;     // the same, of halves, as an integer
#endif
uniform sampler2D moment_map;          // 32-bit floats
uniform sampler2D depth_map;           // 24 bits
uniform sampler2DShadow depth_compare; // the same

layout(location = 0) out vec4 bytes;

const vec2 BETWEEN = vec2(0.625, 0.25); // a quarter of the left texel of the lower row

// The values are those of enum reading in probe.c.
float read_value(int i)
{
	if (i < 4)
		return texelFetch(base_texture, ivec2(i >> 1, 0), 0)[i & 1];
	if (i == 4)
		return textureLod(smoothie_map, BETWEEN, 0.0).g;
	if (i < 7)
		return texelFetch(depth_map, ivec2(i - 5, 0), 0).r;
	if (i == 7)
		return textureLod(depth_compare, vec3(BETWEEN, 0.5), 0.0);
	if (i == 8)
		return texelFetch(moment_map, ivec2(0), 0).r;
#ifdef GATHER
	if (i < 13)
		return textureGather(moment_map, vec2(0.5))[i - 9];
	if (i < 17)
		return textureGather(depth_compare, vec2(0.5), 0.5)[i - 13];
	if (i < 21) {
		ivec2 words = textureGather(smoothie_words, vec2(0.5)).wz;
		return unpackHalf2x16(uint(words[i - 17 >> 1]))[i - 17 & 1];
	}
#endif
	return 0.0;
}

void main()
{
	uint bits = floatBitsToUint(read_value(int(gl_FragCoord.x)));
	uvec4 byte = uvec4(bits, bits >> 8, bits >> 16, bits >> 24) & 255u;
	bytes = vec4(byte) / 255.0;
}
