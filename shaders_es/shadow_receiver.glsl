// Where a receiver lies on the light's screen, and how its own plane slopes there.
uniform sampler2DShadow depth_compare;

// Whether it makes a difference how much of the light is seen: a technique need not find it else.
bool light_arrives = true;

// Window coordinates on the light's screen. Beside it they lead to the map's border texels, which
// hold no caster; long before the near plane, and behind a spot, w stays at its least, where depth
// is below all there is and everything finite: either way to light.
vec3 on_screen(vec3 p)
{
	float inverse = 1.0 / max(screen_w.x * p.z + screen_w.y, screen_w.z);
	float depth = screen_depth.x + screen_depth.y * inverse + screen_depth.z * p.z;
	return vec3(p.xy * (screen_scale * inverse) + 0.5, depth);
}

// How window depth grows along window x and y on the receiver's own plane, through this pixel and
// its neighbours (receiver plane depth bias, Isidoro 2006). A plane that the light sees edge on has
// no area on its screen: what counts is the limit, for the sum of both.
vec2 receiver_slope(vec3 s)
{
	vec3 dx = dFdx(s);
	vec3 dy = dFdy(s);
	float area = dx.x * dy.y - dx.y * dy.x;
	vec2 slope = vec2(dy.y * dx.z - dx.y * dy.z, dx.x * dy.z - dy.x * dx.z);
	slope = area < 0.0 ? -slope : slope;
	float limit = (bias_limit.x + bias_limit.y * s.z) * map_size.x;
	float rise = abs(slope.x) + abs(slope.y);
	return slope * min(1.0 / max(abs(area), 1e-30), limit / max(rise, 1e-30));
}
