// Variance shadow maps (Donnelly & Lauritzen 2006): no more of the depths around a texel can lie
// behind a receiver than Chebyshev's inequality lets.
uniform sampler2D moment_map; // mean of depth, and of its square, from the middle of the range
uniform float min_variance;   // what rounding may take

// Shares below this count as none, and the others are stretched to the whole range: the light that
// the bound lets through where blockers overlap (Lauritzen, GPU Gems 3, chapter 8).
const float BLEEDING = 0.1;

#ifdef FOUR_FETCHES
vec4 moments_at(int x, int y)
{
	// A map of one texel has its corner beside the map.
	return texelFetch(moment_map, max(ivec2(x, y), 0), 0);
}

vec2 filtered_moments(vec2 at)
{
	vec2 texel = clamp(at * map_size.x - 0.5, vec2(0.0), vec2(map_size.x - 1.0));
	vec2 corner = min(floor(texel), vec2(map_size.x - 2.0));
	vec2 f = texel - corner;
	ivec2 low = ivec2(corner), high = low + 1;
	vec4 lower = mix(moments_at(low.x, low.y), moments_at(high.x, low.y), f.x);
	vec4 upper = mix(moments_at(low.x, high.y), moments_at(high.x, high.y), f.x);
	return from_moments(mix(lower, upper, f.y));
}
#else
vec2 filtered_moments(vec2 at)
{
	return from_moments(textureLod(moment_map, at, 0.0));
}
#endif

float shadow_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	vec2 moments = filtered_moments(s.xy);
	float behind = linear_depth(receiver_depth(s)) - 0.5 - moments.x;
	float variance = max(moments.y - moments.x * moments.x, min_variance);
	float share = variance / (variance + behind * behind);
	return behind > 0.0 ? clamp((share - BLEEDING) / (1.0 - BLEEDING), 0.0, 1.0) : 1.0;
}
