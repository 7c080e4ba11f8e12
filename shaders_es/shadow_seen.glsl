// Visibility that was drawn before, pixel by pixel, with a coverage of its own: along edges a pixel may
// be another surface's there. Then the one of 3x3 is taken that is nearest to this surface's plane.
in vec2 surface_depth; // z and w of clip space: gl_FragCoord.z may be of a sample beside the centre

float shadow_visibility(vec3 p)
{
	ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(visibility_depth, 0) - 1;
	float depth = 0.5 * surface_depth.x / surface_depth.y + 0.5;
	vec2 slope = vec2(dFdx(depth), dFdy(depth));
	float least = abs(seen_depth(pixel) - depth);
	ivec2 nearest = pixel;
	// Rounding: of the depth that is kept, of depth as a float, and of where drivers interpolate
	// it.
	float rounding = seen_rounding(depth) + 1e-6 + 0.25 * (abs(slope.x) + abs(slope.y));
	if (least > rounding) {
		for (int i = 0; i < 9; i++) {
			ivec2 by = ivec2(i % 3 - 1, i / 3 - 1);
			ivec2 texel = clamp(pixel + by, ivec2(0), last);
			float off = abs(seen_depth(texel) - depth - dot(slope, vec2(by)));
			nearest = off < least ? texel : nearest;
			least = min(least, off);
		}
	}
	return float(seen_visibility(nearest)) / 65535.0;
}
