uniform sampler2D base_texture; // the picture, sRGB
uniform int quarter_turns;      // clockwise, 0 to 3
uniform vec3 screen_max;        // greatest value of each channel of the screen

layout(location = 0) out vec4 color;

// The texel that is seen at a pixel of the screen, both from the lower left.
ivec2 texel_at(ivec2 pixel, ivec2 size)
{
	ivec2 texel = (quarter_turns & 1) != 0 ? pixel.yx : pixel;
	if (quarter_turns == 1 || quarter_turns == 2)
		texel.x = size.x - 1 - texel.x;
	if (quarter_turns >= 2)
		texel.y = size.y - 1 - texel.y;
	return texel;
}

#ifdef STORED
// The picture's value as it is stored, in [0, 1]: sampled with EXT_texture_sRGB_decode off, which
// fetches by index do not heed. The coordinate is the middle of the texel.
vec3 value_of(ivec2 texel, ivec2 size)
{
	return textureLod(base_texture, (vec2(texel) + 0.5) / vec2(size), 0.0).rgb;
}
#else
// The same by encoding anew what was decoded. The whole curve (IEC 61966-2-1), not the fit that
// shading makes do with: its error is far below half a step.
vec3 value_of(ivec2 texel, ivec2 size)
{
	vec3 c = texelFetch(base_texture, texel, 0).rgb;
	vec3 curve = 1.055 * pow(max(c, 0.0031308), vec3(1.0 / 2.4)) - 0.055;
	return mix(12.92 * c, curve, step(0.0031308, c));
}
#endif

#ifdef DITHER
// Which of 64 steps the pixel, from the top left, rounds up from: the 8x8 ordered matrix of Bayer,
// "An optimum method for two-level rendition of continuous-tone pictures", 1973.
int threshold_at(ivec2 pixel)
{
	int a = pixel.x ^ pixel.y, y = pixel.y;
	return (a & 1) << 5 | (y & 1) << 4 | (a & 2) << 2 | (y & 2) << 1 | (a & 4) >> 1 |
	       (y & 4) >> 2;
}
#endif

void main()
{
	ivec2 size = textureSize(base_texture, 0), pixel = ivec2(gl_FragCoord.xy);
	vec3 value = value_of(texel_at(pixel, size), size);
#if defined(DITHER) || defined(WIDEN)
	ivec3 byte = ivec3(255.0 * value + 0.5), most = ivec3(screen_max);
#ifdef DITHER
	int height = (quarter_turns & 1) != 0 ? size.x : size.y;
	int threshold = threshold_at(ivec2(pixel.x, height - 1 - pixel.y));
	value = vec3((byte * most * 64 + 255 * threshold + 127) / (255 * 64)) / screen_max;
#else
	value = vec3((2 * byte * most + 255) / (2 * 255)) / screen_max;
#endif
#endif
	color = vec4(value, 1.0);
}
