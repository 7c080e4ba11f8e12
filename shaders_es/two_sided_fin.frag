// One texel of a two-sided fin: the way from the silhouette, in texels; the silhouette's window
// depth, negative inside; and that of the surface beside the silhouette, which its shadow is on. The
// depth test keeps the edge that is nearest as a share of its penumbra there: unlike blending it
// keeps together what belongs to one edge.
in vec2 fin_offset;
in float fin_width; // below 0: inside

uniform sampler2D depth_map;
#ifdef RECEIVER_MAP
uniform sampler2D receiver_map; // what receives and does not cast
#endif
uniform float spread; // half-width of a penumbra, texels, over the difference in window depth
uniform float apron;  // texels that are drawn beyond it

layout(location = 0) out uvec4 fin;

// A surface beside the silhouette is looked for this many texels off it: beyond the texels that the
// blocker may have in part.
const float BESIDE = 0.75;

// The largest 16-bit float.
const float MOST_HALF = 65504.0;

// Beside the map, as its nearest texel. Looked up, since drivers that draw on the processor take half
// as long for that as to fetch.
float surface_depth(ivec2 texel)
{
	vec2 place = (vec2(texel) + 0.5) / vec2(textureSize(depth_map, 0));
	float depth = plain_depth(textureLod(depth_map, place, 0.0));
#ifdef RECEIVER_MAP
	depth = min(depth, plain_depth(textureLod(receiver_map, place, 0.0)));
#endif
	return depth;
}

// Of the four texels around, the one farthest from the light.
float farthest_depth(vec2 place)
{
	ivec2 corner = ivec2(floor(place - 0.5));
	return max(max(surface_depth(corner), surface_depth(corner + ivec2(1, 0))),
		max(surface_depth(corner + ivec2(0, 1)), surface_depth(corner + ivec2(1, 1))));
}

void main()
{
	bool inside = fin_width < 0.0;
	float b = gl_FragCoord.z;
	vec2 offset = fin_offset * (0.5 * float(textureSize(depth_map, 0).x));
	float from = length(offset);
	vec2 outward = (inside ? -offset : offset) / max(from, 1e-6);
	// The surface that the edge throws its shadow on, next to it. Before the edge: it is hidden
	// from the light, and is no silhouette.
	float r = farthest_depth(gl_FragCoord.xy - offset + BESIDE * outward);
	if (r < b - DEPTH_STEP - plain_step(b))
		discard;
	if (!inside)
		r = surface_depth(ivec2(gl_FragCoord.xy));
	float full = spread * max(r - b, 0.0) + apron; // > 0
	if (from >= full || (!inside && r <= b))
		discard;
	fin = uvec4(packHalf2x16(clamp(offset, -MOST_HALF, MOST_HALF)),
		floatBitsToUint(inside ? -b : b), floatBitsToUint(r), 0u);
	gl_FragDepth = from / full;
}
