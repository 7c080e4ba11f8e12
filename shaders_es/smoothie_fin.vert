// A quad of a fin, of struct fin (src/geom/fin.h), as fin_expand() makes it. Fins are fetched from a
// uniform block rather than as attributes of instances, which of so few vertices each take drivers longer.
layout(std140) uniform fins {
	uvec4 fin_words[BLOCK_FINS * 2];
};
uniform int fin_quads; // of each of them
uniform vec3 fin_law; // of struct fin_law: width_far, drawn_far, slope
uniform int both_sides; // 1; else 0: outside alone

out vec2 fin_offset; // from the silhouette, NDC
out float fin_width; // of the fin here, likewise; below 0: inside

// In widths as drawn, of the corners of a kite along the tangents, or of half the square around the
// disc. Unit vectors up to a right angle apart have a sum of length 1.4 at least, others such a
// difference.
vec2 corner_offset(int corner, vec2 from, vec2 to)
{
	vec2 sum = from + to;
	if (dot(from, to) >= 0.0)
		return corner == 0 ? vec2(0.0) : corner == 1 ? from : corner == 2 ? sum * (2.0 / dot(sum, sum)) : to;
	vec2 outer = normalize(vec2(to.y - from.y, from.x - to.x));
	vec2 along = vec2(-outer.y, outer.x);
	return (corner < 2 ? along : -along) + (corner == 1 || corner == 2 ? outer : vec2(0.0));
}

vec3 end_of(uvec4 words)
{
	return uintBitsToFloat(uvec3(words.xy, words.z & ~FIN_SIDE_BIT));
}

void main()
{
	int corner = gl_VertexID & 3, quad = gl_VertexID >> 2;
	int index = int((float(quad) + 0.5) / float(fin_quads)), rest = quad - index * fin_quads;
	uvec4 first = fin_words[2 * index], second = fin_words[2 * index + 1];
	vec3 place = end_of(first), end = end_of(second);
	bool outer = (first.z & FIN_SIDE_BIT) != 0u, inner = (second.z & FIN_SIDE_BIT) != 0u;
	int around = place.xy != end.xy ? rest - 1 - both_sides : rest; // below 0: along the edge
	bool inside = around < 0 ? rest == 1 : inner && (!outer || around == 1);
	vec2 offset;
	if (around < 0) {
		vec2 along = normalize(end.xy - place.xy);
		offset = corner < 2 ? vec2(0.0) : vec2(along.y, -along.x);
		place = corner == 1 || corner == 2 ? end : place;
	} else {
		offset = corner_offset(corner, unpackSnorm2x16(first.w), unpackSnorm2x16(second.w));
	}
	float side = inside ? -1.0 : 1.0, shade = fin_law.z * (1.0 - place.z);
	fin_offset = side * min(fin_law.y + shade, FIN_NDC_LIMIT) * offset;
	fin_width = side * min(fin_law.x + shade, FIN_NDC_LIMIT);
	gl_Position = vec4(place.xy + fin_offset, place.z, 1.0);
}
