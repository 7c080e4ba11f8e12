// One value, for probes of what becomes of it.
uniform vec4 probe_value;

#ifdef FETCH
layout(location = 0) inout vec4 value;
#elif !defined(ALPHA_DEPTH)
layout(location = 0) out vec4 value;
#endif

void main()
{
#ifdef ALPHA_DEPTH
	gl_FragDepth = probe_value.x;
#elif defined(FETCH)
	value = min(value, probe_value);
#else
	value = probe_value;
#endif
}
