// A light's visibility and the depth of what is seen, as sm_view.visibility_of has them.
layout(location = 0) out vec4 color;

void main()
{
	ivec2 pixel = ivec2(gl_FragCoord.xy);
	uint v = seen_visibility(pixel);
	color = vec4(float(v >> 8), float(v & 255u), 0.0, 255.0) / 255.0;
	gl_FragDepth = seen_depth(pixel);
}
