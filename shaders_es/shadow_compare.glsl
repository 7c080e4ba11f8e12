// The comparisons at the four texels around a place, blended: by the sampler if it does that.
float compare(vec2 at, float depth)
{
#if defined(GATHER) || defined(FOUR_FETCHES)
	taps t = taps_at(at);
	return blend(t, fetch_lit(t.corner, depth));
#else
	return textureLod(depth_compare, vec3(at, depth), 0.0);
#endif
}
