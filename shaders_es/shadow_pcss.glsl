// Percentage-closer soft shadows (Fernando 2005): the mean depth of the blockers between the light
// and the receiver gives the width of the penumbra, over which comparisons are averaged.
uniform vec2 disc_points[64]; // of the unit disc
uniform int disc_count;
// Half-width of the penumbra, window x or y, for a blocker in front by 1 of window depth. It is in
// proportion: R (r - b) / b at distance r is R (1/b - 1/r) at distance 1, and 1/z is linear in
// window depth; for a directional light R (r - b) is.
uniform float disc_scale;

const float TAU = 6.283185307;

// An angle of its own for each pixel: interleaved gradient noise (Jimenez 2014).
float noise_angle()
{
	return TAU * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
}

// Turns the disc's points, and has the disc face the receiver: from the light's axis on, it looks
// the longer on the screen.
mat2 disc_axes(vec3 p)
{
	float angle = noise_angle();
	float c = cos(angle), s = sin(angle);
	vec2 aside = screen_w.x * p.xy / max(p.z, screen_w.z);
	mat2 stretch = mat2(1.0) + outerProduct(aside, aside) / (1.0 + sqrt(1.0 + dot(aside, aside)));
	return stretch * mat2(c, s, -s, c);
}

float shadow_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	vec2 slope = receiver_slope(s);
	float depth = receiver_depth(s, slope, lookup_reach);
	mat2 axes = disc_axes(p);
	// No blocker is before the near plane, and none beside the screen, which taps would miss if
	// that plane is very near.
	mat2 region = axes * min(disc_scale * clamp(s.z, 0.0, 1.0), 0.5);
	float blockers = 0.0, sum = 0.0;
	for (int i = 0; i < disc_count; i++) {
		vec2 tap = region * disc_points[i];
		float b = plain_depth(textureLod(depth_map, s.xy + tap, 0.0));
		float front = min(depth + dot(slope, tap), 1.0);
		float blocks = b < front - plain_step(front) ? 1.0 : 0.0;
		blockers += blocks;
		sum += blocks * b;
	}
	// No wider than was searched: a blocker at the near plane would spread taps beside the screen.
	mat2 penumbra = axes * min(disc_scale * max(s.z - sum / max(blockers, 1.0), 0.0), 0.5);
	float lit = 0.0;
	// Without a blocker all is lit: the paper's early out, as a loop that drivers can leave.
	int taps = blockers > 0.0 ? disc_count : 0;
	for (int i = 0; i < taps; i++) {
		vec2 tap = penumbra * disc_points[i];
		lit += compare(s.xy + tap, depth + dot(slope, tap));
	}
	return blockers > 0.0 ? lit / float(disc_count) : 1.0;
}
