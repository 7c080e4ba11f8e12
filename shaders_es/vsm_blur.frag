// One direction of the blur of depth and its square (Donnelly & Lauritzen 2006): across,
// from the shadow map, then up. Depths count from the middle of the range, where floats are finest.
uniform sampler2D base_texture;
#ifdef RECEIVER_MAP
uniform sampler2D receiver_map; // the farthest of what receives and does not cast
#endif
uniform int blur_radius; // texels on each side

layout(location = 0) out vec4 blurred;

#ifdef FROM_DEPTH
const ivec2 DIRECTION = ivec2(1, 0);

vec2 moments_at(ivec2 texel)
{
	float d = plain_depth(texelFetch(base_texture, texel, 0));
#ifdef RECEIVER_MAP
	// What lies beside a blocker on the screen belongs to the mean, whether it casts or not.
	float receiver = plain_depth(texelFetch(receiver_map, texel, 0));
	d = d == 1.0 && receiver > 0.0 ? receiver : d;
#endif
	float depth = linear_depth(d) - 0.5;
	return vec2(depth, depth * depth);
}
#else
const ivec2 DIRECTION = ivec2(0, 1);

vec2 moments_at(ivec2 texel)
{
	return from_moments(texelFetch(base_texture, texel, 0));
}
#endif

void main()
{
	ivec2 texel = ivec2(gl_FragCoord.xy), last = textureSize(base_texture, 0) - 1;
	vec2 sum = vec2(0.0);
	for (int i = -blur_radius; i <= blur_radius; i++)
		sum += moments_at(clamp(texel + i * DIRECTION, ivec2(0), last));
	blurred = to_moments(sum / float(2 * blur_radius + 1));
}
