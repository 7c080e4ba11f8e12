// Smoothies (Chan & Durand 2003, section 4): at each of the four nearest texels the receiver is
// behind the shadow map (0), else behind a smoothie (its alpha'), else lit; then bilinear weights.
uniform sampler2D smoothie_map; // linear depth, alpha'
#ifdef SEPARATE_DEPTH
uniform sampler2D smoothie_depth;
#endif
#ifndef GATHER
uniform sampler2D depth_map;
#endif

// One step of a 16-bit float, or of 10 bits, just below depth 1.
const float SMOOTHIE_STEP = 1.0 / 1024.0;

// The texels at corner + (0,1), (1,1), (1,0), (0,0), the order of textureGather().
#ifdef GATHER
vec4 fetch_lit(vec2 corner, float depth)
{
	return textureGather(depth_compare, (corner + 1.0) * map_size.y, depth);
}

#define FETCH(map, channel, corner) textureGather(map, (corner + 1.0) * map_size.y, channel)
#else
#define FETCH(map, channel, corner)                                                                \
	vec4(texelFetch(map, ivec2(corner) + ivec2(0, 1), 0)[channel],                             \
		texelFetch(map, ivec2(corner) + ivec2(1, 1), 0)[channel],                          \
		texelFetch(map, ivec2(corner) + ivec2(1, 0), 0)[channel],                          \
		texelFetch(map, ivec2(corner), 0)[channel])

vec4 fetch_lit(vec2 corner, float depth)
{
	return vec4(greaterThanEqual(FETCH(depth_map, 0, corner), vec4(depth)));
}
#endif

float shadow_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	float depth = receiver_depth(s);
	// Beside the map all four taps are a border texel.
	vec2 texel = clamp(s.xy * map_size.x - 0.5, vec2(0.0), vec2(map_size.x - 1.0));
	vec2 corner = min(floor(texel), vec2(map_size.x - 2.0));
	vec2 f = texel - corner;
	vec4 lit = fetch_lit(corner, depth);
	vec4 alpha = FETCH(smoothie_map, 1, corner);
#ifdef SEPARATE_DEPTH
	vec4 b = linear_depth(FETCH(smoothie_depth, 0, corner));
#else
	vec4 b = FETCH(smoothie_map, 0, corner);
#endif
	bvec4 behind = lessThan(b, vec4(linear_depth(depth) - SMOOTHIE_STEP));
	vec4 v = lit * mix(vec4(1.0), alpha, behind);
	vec2 row = mix(v.wz, v.xy, f.y);
	return mix(row.x, row.y, f.x);
}
