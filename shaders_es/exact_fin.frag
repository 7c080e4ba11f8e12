// One texel of a smoothie, as smoothie_fin.frag: the nearest depth with DEPTH_ONLY, else the least
// alpha', both by the depth test.
uniform usampler2D depth_map;
#ifdef RECEIVER_MAP
uniform usampler2D receiver_map;
#endif
#ifdef SINUSOID
uniform usampler2D falloff;
#endif
uniform uint pole_depth;

layout(location = 0) out uint smoothie;

const int FIN_FRACTION = 8;

// Number bits are 16.
const float BITS_STEP = 1.0 / 65536.0;

// One more binary digit of a root, y, and what is left, x.
uvec2 root_digit(uvec2 r, uint bit)
{
	uint with_bit = r.y + bit;
	r.y >>= 1;
	return r.x >= with_bit ? uvec2(r.x - with_bit, r.y + bit) : r;
}

uvec2 root_4_digits(uvec2 r, uint bit)
{
	r = root_digit(root_digit(r, bit), bit >> 2);
	return root_digit(root_digit(r, bit >> 4), bit >> 6);
}

// The greatest integer whose square is no more than n.
uint root(uint n)
{
	uvec2 r = root_4_digits(root_4_digits(uvec2(n, 0u), 1u << 30), 1u << 22);
	return root_4_digits(root_4_digits(r, 1u << 14), 1u << 6).y;
}

void main()
{
	ivec2 pixel = ivec2(gl_FragCoord.xy);
	if (!covers(pixel))
		discard;
	ivec4 values = planes_at(primitive[3], primitive[4], primitive[5], pixel);
	uint b = window_depth(values.x);
	uint r = texelFetch(depth_map, pixel, 0).r;
#ifdef RECEIVER_MAP
	r = min(r, texelFetch(receiver_map, pixel, 0).r);
#endif
	r = min(r, DEPTH_ONE); // where nothing was drawn
	// Behind a blocker, or at contact.
	if (r <= b)
		discard;
	uvec2 offset = uvec2(values.yz >> FIN_FRACTION); // squared modulo 2^32, whatever the sign
	int width = values.w >> FIN_FRACTION;
	uint from_silhouette = root(offset.x * offset.x + offset.y * offset.y);
	if (int(from_silhouette) >= width)
		discard;
	uint share = num_ratio(r - b, pole_depth - b); // 1 - b/r
	uint alpha = num_div(num_ratio(from_silhouette, uint(width)), share);
	if (alpha >= NUM_ONE)
		discard;
#ifdef DEPTH_ONLY
	smoothie = b;
	gl_FragDepth = float(b) * DEPTH_STEP;
#else
#ifdef SINUSOID
	alpha = texelFetch(falloff, ivec2(num_index(alpha), 0), 0).r;
#endif
	smoothie = alpha;
	gl_FragDepth = float(alpha) * BITS_STEP;
#endif
}
