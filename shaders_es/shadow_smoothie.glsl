// Smoothies (Chan & Durand 2003, section 4): at each of the four nearest texels the receiver is
// behind the shadow map (0), else behind a smoothie (its alpha'), else lit; then bilinear weights.
#ifdef WORDS
uniform isampler2D smoothie_words; // halves: linear depth, and above it alpha'
#else
uniform sampler2D smoothie_map; // linear depth, alpha'; with ALPHA_DEPTH alpha' alone
#endif
#ifdef SEPARATE_DEPTH
uniform sampler2D smoothie_depth;
#endif

// One step of 10 bits; two of a half just below depth 1.
const float SMOOTHIE_STEP = 1.0 / 1024.0;

#ifdef WORDS
// Of a half that is not negative, above which halves are as their bits are: the least that is no less
// than x. Below its least normal number it is a multiple of 2^-24.
int half_above(float x)
{
	return x < 6.103515625e-5 ? int(ceil(max(x, 0.0) * 16777216.0))
				  : (floatBitsToInt(x) - (112 << 23) + 0x1fff) >> 13;
}

// What of the light a receiver at this linear depth is left by smoothies at the four texels, where it
// is lit by the shadow map. The bits of a half within those of a float are it times 2^-112: exactly,
// but that what is below 6.2e-5 may be 0.
vec4 shade(vec2 corner, float depth, vec4 lit)
{
	const int ONE = 0x3c00 << 13;
	const float SCALE = 5.192296858534828e33; // 2^112
	ivec4 word = textureGather(smoothie_words, gather_place(corner));
	bvec4 behind = lessThan(word & 0xffff, ivec4(half_above(depth)));
	ivec4 alpha = mix(ivec4(ONE), (word >> 16) << 13, behind);
	return lit * SCALE * intBitsToFloat(alpha);
}
#else
vec4 shade(vec2 corner, float depth, vec4 lit)
{
#ifdef ALPHA_DEPTH
	vec4 alpha = FETCH(smoothie_map, 0, corner);
#else
	vec4 alpha = FETCH(smoothie_map, 1, corner);
#endif
#ifdef SEPARATE_DEPTH
	vec4 b = linear_depth(FETCH(smoothie_depth, 0, corner));
#else
	vec4 b = FETCH(smoothie_map, 0, corner);
#endif
	return lit * mix(vec4(1.0), alpha, lessThan(b, vec4(depth)));
}
#endif

float shadow_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	float depth = receiver_depth(s);
	taps t = gathered_taps_at(s.xy);
	vec4 lit = fetch_lit(t.corner, depth);
	return blend(t, shade(t.corner, linear_depth(depth) - SMOOTHIE_STEP, lit));
}
