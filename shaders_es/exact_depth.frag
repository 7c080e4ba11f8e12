// The nearest depth, in a shadow map of integers.
layout(location = 0) out uint depth;

void main()
{
	ivec2 pixel = ivec2(gl_FragCoord.xy);
	if (!covers(pixel))
		discard;
	depth = window_depth(plane_at(primitive[3].xyz, pixel));
	gl_FragDepth = float(depth) * DEPTH_STEP;
}
