#if defined(DEPTH_FLOAT) || defined(DEPTH_HALF) || defined(DEPTH_PACKED)
layout(location = 0) out vec4 plain;
#endif

void main()
{
#if defined(DEPTH_FLOAT) || defined(DEPTH_HALF) || defined(DEPTH_PACKED)
	plain = to_plain(gl_FragCoord.z);
#endif
}
