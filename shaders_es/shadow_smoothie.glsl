// Smoothies (Chan & Durand 2003, section 4): at each of the four nearest texels the receiver is
// behind the shadow map (0), else behind a smoothie (its alpha'), else lit; then bilinear weights.
#if defined(FUSED)
uniform isampler2D smoothie_words; // see smoothie_word.glsl
#elif defined(WORDS)
uniform isampler2D smoothie_words; // halves: linear depth, and above it alpha'
#else
uniform sampler2D smoothie_map; // linear depth, alpha'; with ALPHA_DEPTH alpha' alone
#endif
#ifdef SEPARATE_DEPTH
uniform sampler2D smoothie_depth;
#endif

// One step of 10 bits; two of a half just below depth 1.
const float SMOOTHIE_STEP = 1.0 / 1024.0;

#ifdef FUSED
// What of the light a receiver at this window depth sees at the four texels.
vec4 seen_at(vec2 corner, float depth)
{
	const float ONE = ALPHA_STEPS * ALPHA_STEPS;
	float linear = linear_depth(depth);
	int map = int(MAP_STEPS * linear) << ALPHA_BITS;
	int fin = int(ceil(FIN_STEPS * max(linear - SMOOTHIE_STEP, 0.0))) << FIN_SHIFT;
	ivec4 word = textureGather(smoothie_words, gather_place(corner));
	bvec4 has_fin = lessThan(word, ivec4(0));
	bvec4 dark = lessThan(mix(word, word & MAP_MASK, has_fin),
		mix(ivec4(floatBitsToInt(depth)), ivec4(map), has_fin));
	vec4 root = vec4(word & ALPHA_MASK);
	vec4 seen = mix(vec4(ONE), root * root, lessThan(word, ivec4(FIN_WORD | fin)));
	return mix(seen, vec4(0.0), dark) * (1.0 / ONE);
}
#else
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

vec4 seen_at(vec2 corner, float depth)
{
	vec4 lit = fetch_lit(corner, depth);
	return shade(corner, linear_depth(depth) - SMOOTHIE_STEP, lit);
}
#endif

float shadow_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	taps t = gathered_taps_at(s.xy);
	return blend(t, seen_at(t.corner, receiver_depth(s)));
}
