// Smoothies (Chan & Durand 2003, section 4): at each of the four nearest texels the receiver is
// behind the shadow map (0), else behind a smoothie (its alpha'), else lit; then bilinear weights.
uniform sampler2D smoothie_map; // linear depth, alpha'; with ALPHA_DEPTH alpha' alone
#ifdef SEPARATE_DEPTH
uniform sampler2D smoothie_depth;
#endif

// One step of 10 bits; two of a half just below depth 1.
const float SMOOTHIE_STEP = 1.0 / 1024.0;

float shadow_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	float depth = receiver_depth(s);
	taps t = taps_at(s.xy);
	vec4 lit = fetch_lit(t.corner, depth);
#ifdef ALPHA_DEPTH
	vec4 alpha = FETCH(smoothie_map, 0, t.corner);
#else
	vec4 alpha = FETCH(smoothie_map, 1, t.corner);
#endif
#ifdef SEPARATE_DEPTH
	vec4 b = linear_depth(FETCH(smoothie_depth, 0, t.corner));
#else
	vec4 b = FETCH(smoothie_map, 0, t.corner);
#endif
	bvec4 behind = lessThan(b, vec4(linear_depth(depth) - SMOOTHIE_STEP));
	return blend(t, lit * mix(vec4(1.0), alpha, behind));
}
