// One value, for probes of what becomes of it.
uniform vec4 probe_value;

#if defined(FUSED)
layout(location = 0) inout ivec4 value; // of halves
#elif defined(FETCH)
layout(location = 0) inout vec4 value;
#elif !defined(ALPHA_DEPTH)
layout(location = 0) out vec4 value;
#endif

void main()
{
#ifdef ALPHA_DEPTH
	gl_FragDepth = probe_value.x;
#elif defined(FUSED)
	vec2 least = min(unpackHalf2x16(uint(value.x)), probe_value.xy);
	value = ivec4(packHalf2x16(least));
#elif defined(FETCH)
	value = min(value, probe_value);
#else
	value = probe_value;
#endif
}
