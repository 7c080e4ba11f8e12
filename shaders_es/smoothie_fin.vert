// A quad of a fin, of struct fin (src/geom/fin.h), as fin_expand() makes it: four vertices each, or on
// both sides eight. It is fetched from a uniform block rather than as attributes of instances, which of
// four vertices each take drivers longer.
const int BLOCK_FINS = 672; // as in src/technique/fin_stream.c

layout(std140) uniform fins {
	uvec4 fin_words[BLOCK_FINS / 2 * 3]; // two fins in three
};
uniform vec3 fin_law; // of struct fin_law: width_far, drawn_far, slope
uniform int both_sides; // 1; else 0: outside alone

out vec2 fin_offset; // from the silhouette, NDC
out float fin_width; // of the fin here, likewise; below 0: inside

const float NDC_LIMIT = 1024.0; // FIN_NDC_LIMIT

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

void main()
{
	int corner = gl_VertexID & 3, quad = gl_VertexID >> 2, index = quad >> both_sides;
	float side = (quad & both_sides) == 0 ? 1.0 : -1.0;
	int word = (index >> 1) * 3;
	uvec4 middle = fin_words[word + 1];
	uvec3 first, second;
	if ((index & 1) == 0) {
		uvec4 words = fin_words[word];
		first = words.xyz;
		second = uvec3(words.w, middle.xy);
	} else {
		uvec4 words = fin_words[word + 2];
		first = uvec3(middle.zw, words.x);
		second = words.yzw;
	}
	vec3 place = uintBitsToFloat(first), end = uintBitsToFloat(second);
	vec2 offset;
	if (abs(end.z) > 1.0) {
		// FIN_OUTSIDE, FIN_INSIDE, FIN_BOTH
		offset = end.z == side * 2.0 || end.z == 3.0 ? corner_offset(corner, unpackSnorm2x16(second.x),
			unpackSnorm2x16(second.y)) : vec2(0.0);
	} else {
		vec2 along = normalize(end.xy - place.xy); // no fin has ends that coincide
		offset = corner < 2 ? vec2(0.0) : vec2(along.y, -along.x);
		place = corner == 1 || corner == 2 ? end : place;
	}
	float shade = fin_law.z * (1.0 - place.z);
	fin_offset = side * min(fin_law.y + shade, NDC_LIMIT) * offset;
	fin_width = side * min(fin_law.x + shade, NDC_LIMIT);
	gl_Position = vec4(place.xy + fin_offset, place.z, 1.0);
}
