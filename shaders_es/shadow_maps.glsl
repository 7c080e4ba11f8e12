// A shadow map for each of many points of the light, averaged (Heckbert & Herf 1997; Agrawala et al.
// 2000). Seen from one of them, what lies on the far plane is where it is seen from the
// light's middle, and what is nearer is beside that in proportion to the difference of window depth.
uniform sampler2DArrayShadow depth_layers;
#ifdef FOUR_FETCHES
uniform sampler2DArray plain_layers; // the same, read without comparing
#endif
uniform vec2 disc_points[64]; // of the unit disc
uniform int disc_count;
uniform float disc_scale; // window x or y, at the near plane, from a point of the rim

#ifdef FOUR_FETCHES
float depth_at(int x, int y, int layer)
{
	ivec2 texel = clamp(ivec2(x, y), ivec2(0), ivec2(map_size.x) - 1);
	return plain_depth(texelFetch(plain_layers, ivec3(texel, layer), 0));
}
#endif

// As compare() of a map alone.
float compare(vec2 at, int layer, float depth)
{
#if defined(GATHER)
	taps t = taps_at(at);
	vec3 place = vec3((t.corner + 1.0) * map_size.y, float(layer));
	return blend(t, textureGather(depth_layers, place, depth));
#elif defined(FOUR_FETCHES)
	taps t = taps_at(at);
	ivec2 low = ivec2(t.corner), high = low + 1;
	vec4 found = vec4(depth_at(low.x, high.y, layer), depth_at(high.x, high.y, layer),
		depth_at(high.x, low.y, layer), depth_at(low.x, low.y, layer));
	return blend(t, vec4(greaterThanEqual(found + plain_step(depth), vec4(depth))));
#else
	return texture(depth_layers, vec4(at, float(layer), depth));
#endif
}

float shadow_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	vec2 slope = receiver_slope(s);
	float rise = (abs(slope.x) + abs(slope.y)) * lookup_reach;
	float limit = (bias_limit.x + bias_limit.y * s.z) * map_size.x * lookup_reach;
	float lit = 0.0;
	for (int i = 0; i < disc_count; i++) {
		vec2 point = disc_scale * disc_points[i];
		// How much larger the receiver's plane looks than from the light's middle.
		float facing = abs(1.0 + dot(slope, point));
		float bias = min(rise / max(facing, 1e-6), limit);
		float depth = clamp(s.z - DEPTH_STEP - bias, 0.0, 1.0);
		vec2 texel = s.xy - point * (1.0 - s.z);
		lit += compare(texel, i, depth);
	}
	return lit / float(disc_count);
}
