// Fins on both sides of the silhouette: each of the four nearest texels knows the edge that is
// nearest to it, as a line. The receiver's own distance from it, as a share of the half-width of
// the penumbra at the receiver's own depth, tells which part of the light's disc is seen.
uniform usampler2D fin_map; // see two_sided_fin.frag
uniform float spread;

// How far from a surface the point of an edge may lie that one of its texels knows, texels.
const float FIN_REACH = 2.0;
// An edge parts light from shadow on the first surface behind it, and on what is not farther
// behind it than by an eighth more: a receiver need not be flat.
const float SAME_SURFACE = 1.125;

// In window depth.
struct receiver {
	float depth;
	float before; // all that its plane may have within FIN_REACH
	float slope;  // most that it rises in a texel
};

// Share of a disc of radius 1 on one side of a line, at s from its centre, [-1, 1].
float disc_area(float s)
{
	return 1.0 - (acos(s) - s * sqrt(1.0 - s * s)) * (1.0 / 3.14159265);
}

// from: way from the texel's centre to the receiver; lit: of the shadow map there, 0 or 1.
float texel_visibility(ivec2 texel, vec2 from, receiver r, float lit)
{
	// A map of one texel has its corner beside the map.
	uvec3 fin = texelFetch(fin_map, max(texel, ivec2(0)), 0).xyz;
	bool inside = fin.y >> 31 != 0u;
	float b = abs(uintBitsToFloat(fin.y));
	// An edge does not darken what is in front of it. Where the map does not agree on which side
	// of the edge the texel is, something else is in between.
	if (r.before <= b || (lit > 0.5) == inside)
		return lit;
	vec2 offset = unpackHalf2x16(fin.x);
	float off = length(offset);
	// Darkened by what the edge throws its shadow on.
	float beside = uintBitsToFloat(fin.z);
	if (inside && r.depth - r.slope * (off + FIN_REACH) - b > SAME_SURFACE * (beside - b))
		return lit;
	float outward = dot(offset, offset + from) / max(off, 1e-6);
	// depth >= before > b, but a light may be as good as a point.
	float half_width = max(spread * (r.depth - b), 1e-6);
	float s = (inside ? -outward : outward) / half_width;
	return disc_area(clamp(s, -1.0, 1.0));
}

float shadow_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	taps t = taps_at(s.xy);
	ivec2 corner = ivec2(t.corner);
	vec4 lit = fetch_lit(t.corner, receiver_depth(s));
	float before = receiver_depth(s, FIN_REACH * map_size.y);
	receiver r = receiver(s.z, before, s.z - receiver_depth(s, map_size.y));
	return blend(t,
		vec4(texel_visibility(corner + ivec2(0, 1), t.f - vec2(0.0, 1.0), r, lit.x),
			texel_visibility(corner + ivec2(1, 1), t.f - vec2(1.0, 1.0), r, lit.y),
			texel_visibility(corner + ivec2(1, 0), t.f - vec2(1.0, 0.0), r, lit.z),
			texel_visibility(corner, t.f, r, lit.w)));
}
