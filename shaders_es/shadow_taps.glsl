// The four texels around a surface on the light's screen, at corner + (0,1), (1,1), (1,0), (0,0), the
// order of textureGather().
uniform sampler2D depth_map; // of plain depths

struct taps {
	vec2 corner; // texel, lower left
	vec2 f;      // where the surface is between their centres, [0, 1]
};

// Beside the map all four are a border texel.
taps taps_at(vec2 s)
{
	vec2 texel = clamp(s * map_size.x - 0.5, vec2(0.0), vec2(map_size.x - 1.0));
	vec2 corner = min(floor(texel), vec2(map_size.x - 2.0));
	return taps(corner, texel - corner);
}

#ifdef GATHER
// The same where they are gathered alone, which leads to border texels by itself.
taps gathered_taps_at(vec2 s)
{
	vec2 texel = s * map_size.x - 0.5;
	vec2 corner = floor(texel);
	return taps(corner, texel - corner);
}

// llvmpipe divides in less time than it reads a further uniform.
vec2 gather_place(vec2 corner)
{
	return (corner + 1.0) * (1.0 / map_size.x);
}

// Whether the four at a corner, which may lie beside the map, are lit at a depth.
vec4 fetch_lit(vec2 corner, float depth)
{
	return textureGather(depth_compare, gather_place(corner), depth);
}

#define FETCH(map, channel, corner) textureGather(map, gather_place(corner), channel)
#else
#define gathered_taps_at taps_at
// A map of one texel has its corner beside the map.
#define FETCH_AT(map, channel, x, y) texelFetch(map, max(ivec2(x, y), 0), 0)[channel]
#define FETCH(map, channel, corner)                                                                \
	vec4(FETCH_AT(map, channel, corner.x, corner.y + 1.0),                                     \
		FETCH_AT(map, channel, corner.x + 1.0, corner.y + 1.0),                            \
		FETCH_AT(map, channel, corner.x + 1.0, corner.y),                                  \
		FETCH_AT(map, channel, corner.x, corner.y))

float depth_at(int x, int y)
{
	ivec2 texel = clamp(ivec2(x, y), ivec2(0), ivec2(map_size.x) - 1);
	return plain_depth(texelFetch(depth_map, texel, 0));
}

vec4 fetch_lit(vec2 corner, float depth)
{
	ivec2 low = ivec2(corner), high = low + 1;
	vec4 found = vec4(depth_at(low.x, high.y), depth_at(high.x, high.y),
		depth_at(high.x, low.y), depth_at(low.x, low.y));
	return vec4(greaterThanEqual(found + plain_step(depth), vec4(min(depth, 1.0))));
}
#endif

// Weights are there before what is looked up is: drivers' mix() takes two steps more after that. Four
// times 1 gives 1, exactly.
float blend(taps t, vec4 v)
{
	vec2 rest = 1.0 - t.f;
	vec2 row = v.wz * rest.y + v.xy * t.f.y;
	return row.x * rest.x + row.y * t.f.x;
}
