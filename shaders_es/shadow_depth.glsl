#ifdef FLAT_INPUTS
#define lookup_reach flat_depth.w
#endif

// The depth to compare at texels up to `reach` (window x or y) from s: in front of all that the
// receiver's own plane may have left there. One depth for all of them: following the plane from
// texel to texel would be nearer to a flat receiver, but takes the next facet of a curved one for a
// blocker. Given the slope, it is not clamped: the plane may be followed from there.
float receiver_depth(vec3 s, vec2 slope, float reach)
{
	return s.z - DEPTH_STEP - (abs(slope.x) + abs(slope.y)) * reach;
}

float receiver_depth(vec3 s, float reach)
{
	return clamp(s.z - DEPTH_STEP - receiver_rise(s) * reach, 0.0, 1.0);
}

float receiver_depth(vec3 s)
{
	return receiver_depth(s, lookup_reach);
}
