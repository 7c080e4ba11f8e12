// One texel of a smoothie (Chan & Durand 2003, section 4): its depth, and its alpha remapped by
// the distances of blocker and receiver, alpha' = clamp(alpha / (1 - b/r), 0, 1).
// With CONE, of a cone or sheet that widens from the silhouette towards the receiver (Wyman & Hansen
// 2003): how far on the way there it is.
in vec2 fin_offset;
in float fin_width;

uniform sampler2D depth_map;
#ifdef RECEIVER_MAP
uniform sampler2D receiver_map; // what receives and does not cast
#endif
#if defined(SINUSOID) && !defined(CONE)
uniform sampler2D falloff;
#endif
uniform float pole;

// Linear depth and alpha', of which the least is kept: by blending, by this shader itself (FETCH; with
// FUSED in words that have the shadow map's depth as well), or of alpha' alone by the depth test
// (ALPHA_DEPTH).
#if defined(FUSED)
layout(location = 0) inout ivec4 smoothie;
#elif defined(FETCH)
layout(location = 0) inout vec4 smoothie;
#elif !defined(DEPTH_ONLY) && !defined(ALPHA_DEPTH)
layout(location = 0) out vec4 smoothie;
#endif

#ifdef FUSED
int least_word(int word, float b, float map, float alpha)
{
	// Rounding may have depth 1 a little above.
	vec2 depths = min(linear_depth(vec4(b, map, 0.0, 0.0)).xy, 1.0);
	int fin = int(FIN_STEPS * depths.x + 0.5);
	int behind = int(ceil(MAP_STEPS * depths.y)); // no nearer than it is
	int root = int(min(ALPHA_STEPS * sqrt(max(alpha, 0.0)) + 0.5, ALPHA_STEPS - 1.0));
	if (word < 0) {
		fin = min(fin, word >> FIN_SHIFT & FIN_MASK);
		root = min(root, word & ALPHA_MASK);
	}
	return FIN_WORD | fin << FIN_SHIFT | behind << ALPHA_BITS | root;
}
#endif

void main()
{
	ivec2 texel = ivec2(gl_FragCoord.xy);
	float b = gl_FragCoord.z;
	float map = plain_depth(texelFetch(depth_map, texel, 0)), r = map;
#ifdef RECEIVER_MAP
	r = min(r, plain_depth(texelFetch(receiver_map, texel, 0)));
#endif
	// Behind a blocker, or at contact, where 1 - b/r is 0. Else b < r <= 1 <= pole: the divisor
	// is above 0.
	if (r <= b)
		discard;
	float share = (r - b) / (pole - b); // 1 - b/r
	float alpha = length(fin_offset);
	// alpha / width / share >= 1, without dividing by what may be 0: nothing is darkened.
	float full = fin_width * share;
	if (alpha >= full)
		discard;
#ifndef DEPTH_ONLY
	alpha /= full;
#ifdef CONE
	// Here the cone's window depth is b + alpha (r - b); of the distances that go with the three,
	// the share. The divisor is near_to_far at least.
	float curve = 1.0 - near_to_far;
	alpha *= (1.0 - curve * r) / (1.0 - curve * (b + alpha * (r - b)));
#ifdef SINUSOID
	alpha *= alpha * (3.0 - 2.0 * alpha);
#endif
#elif defined(SINUSOID)
	// From the middle of the first entry to that of the last.
	float entries = float(textureSize(falloff, 0).x);
	alpha = textureLod(falloff, vec2((alpha * (entries - 1.0) + 0.5) / entries, 0.5), 0.0).r;
#endif
#if defined(ALPHA_DEPTH)
	gl_FragDepth = alpha;
#elif defined(FUSED)
	smoothie = ivec4(least_word(smoothie.x, b, map, alpha));
#elif defined(FETCH)
	smoothie = min(smoothie, vec4(linear_depth(b), alpha, 1.0, 1.0));
#else
	smoothie = vec4(linear_depth(b), alpha, 1.0, 1.0);
#endif
#endif
}
