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

// The normal of the receiver's own plane on the light's screen, window x, y and depth, through this
// pixel and its neighbours; of any length.
vec3 receiver_normal(vec3 s)
{
	return cross(dFdx(s), dFdy(s));
}

// A plane that the light sees edge on has no area on its screen: what counts is this limit, for how
// depth grows along x and y together.
float rise_limit(float depth)
{
	return (bias_limit.x + bias_limit.y * depth) * map_size.x;
}

// How window depth grows along window x and y on the receiver's plane (receiver plane depth bias,
// Isidoro 2006).
vec2 receiver_slope(vec3 s)
{
	vec3 n = receiver_normal(s);
	vec2 slope = n.z < 0.0 ? n.xy : -n.xy;
	float rise = abs(n.x) + abs(n.y);
	return slope * min(1.0 / max(abs(n.z), 1e-30), rise_limit(s.z) / max(rise, 1e-30));
}

// How it grows along both together, whichever way.
float receiver_rise(vec3 s)
{
	vec3 n = abs(receiver_normal(s));
	return min((n.x + n.y) / max(n.z, 1e-30), rise_limit(s.z));
}
