// A sheet of the casters, as the light sees it: its depth, and how that grows over a texel. With
// PEEL the first one behind the front layer's.
layout(location = 0) out uvec2 sheet;

#ifdef PEEL
uniform usampler2D front_layer;
#endif

void main()
{
	float depth = gl_FragCoord.z;
#ifdef COARSE
	depth += dot(to_middle(), vec2(dFdx(depth), dFdy(depth)));
	gl_FragDepth = depth;
#endif
	// Half floats: a sheet as steep as the depth range over a texel is as good as unseen.
	vec2 slope = clamp(vec2(dFdx(depth), dFdy(depth)), -1.0, 1.0);
#ifdef PEEL
	vec2 size = vec2(textureSize(front_layer, 0));
	uint front = textureLod(front_layer, gl_FragCoord.xy / size, 0.0).x;
	if (depth <= uintBitsToFloat(front) + DEPTH_STEP)
		discard;
#endif
	sheet = uvec2(floatBitsToUint(depth), packHalf2x16(slope * SLOPE_SCALE));
}
