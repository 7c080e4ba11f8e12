// The share of a light that reaches a surface, by smoothies, as shadow_smoothie.glsl; without
// VISIBILITY for surfaces whose normals say whether they face the light.
uniform usampler2D depth_map;
uniform usampler2D smoothie_map; // alpha'
uniform usampler2D smoothie_depth;
uniform int map_texels; // a side

layout(location = 0) out uint shadow; // what does not reach it, in steps of 1/65535

const int SCREEN_BITS = 20;

// The digits of a camera's depth behind the first.
const int CAMERA_BITS = 17;

// enum fixed_receiver_kind
const int AWAY = 0;
const int LIT = 1;

// Counted from the centre of the first texel, in 1/1024, from n/w of the light's screen.
int texels(int n, int w)
{
	uint share = divide(uint(n), uint(w), SCREEN_BITS).x;
	return int(share * uint(map_texels) >> (SCREEN_BITS - 10)) - 512;
}

uint depth_of(int z, int w)
{
	if (z <= 0)
		return 0u;
	return z >= w ? DEPTH_ONE : divide(uint(z), uint(w), 21).x;
}

uint light_at(ivec2 texel, uint depth)
{
	texel = clamp(texel, ivec2(0), ivec2(map_texels - 1));
	if (texelFetch(depth_map, texel, 0).r < depth)
		return 0u;
	return texelFetch(smoothie_depth, texel, 0).r < depth
		       ? texelFetch(smoothie_map, texel, 0).r
		       : NUM_ONE;
}

uint received(ivec2 pixel)
{
	int w = plane_at(primitive[6].xyz, pixel);
	ivec3 p = planes_at(primitive[3], primitive[4], primitive[5], pixel).yzw;
	if (w <= 0 || min(p.x, p.y) < 0 || max(p.x, p.y) >= w)
		return NUM_ONE; // beside the light's screen
	int bias = primitive[6].w;
	uint depth = uint(max(int(depth_of(p.z, w)) - bias, 0));
	ivec2 place = ivec2(texels(p.x, w), texels(p.y, w));
	ivec2 corner = place >> 10, f = place & 1023;
	uint along_x = num_weight(uint(f.x)), along_y = num_weight(uint(f.y));
	uint lower = num_lerp(light_at(corner, depth), light_at(corner + ivec2(1, 0), depth), along_x);
	uint upper = num_lerp(light_at(corner + ivec2(0, 1), depth),
		light_at(corner + ivec2(1, 1), depth), along_x);
	return num_lerp(lower, upper, along_y);
}

// fixed_camera_depth_of() (src/fixed/span.h): what is left to the far plane as a float of 18 bits.
uint camera_depth(int plane)
{
	uint left = (1u << 30) - 1u - depth_range(plane);
	int shift = left >> (CAMERA_BITS + 8) != 0u ? 8 : 0;
	shift += left >> (CAMERA_BITS + shift + 4) != 0u ? 4 : 0;
	shift += left >> (CAMERA_BITS + shift + 2) != 0u ? 2 : 0;
	shift += left >> (CAMERA_BITS + shift + 1) != 0u ? 1 : 0;
	return DEPTH_ONE - 1u - ((uint(shift) << CAMERA_BITS) + (left >> shift));
}

void main()
{
	ivec2 pixel = ivec2(gl_FragCoord.xy);
	if (!covers(pixel))
		discard;
	int kind = primitive[7].x;
	uint visibility = num_bytes(kind == LIT ? NUM_ONE : received(pixel));
#ifdef VISIBILITY
	if (kind == AWAY)
		visibility = 0u;
#endif
	shadow = 65535u - visibility;
	gl_FragDepth = float(camera_depth(plane_at(primitive[3].xyz, pixel))) * DEPTH_STEP;
}
