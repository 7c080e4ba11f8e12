// A shadow map for each of many points of the light, averaged (Heckbert & Herf 1997; Agrawala et al.
// 2000). Seen from one of them, what lies on the far plane is where it is seen from the
// light's middle, and what is nearer is beside that in proportion to the difference of window depth.
uniform sampler2DArrayShadow depth_layers;
uniform vec2 disc_points[64]; // of the unit disc
uniform int disc_count;
uniform float disc_scale; // window x or y, at the near plane, from a point of the rim

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
		lit += texture(depth_layers, vec4(texel, float(i), depth));
	}
	return lit / float(disc_count);
}
