/* SPDX-License-Identifier: MIT */
#include "geom/averted.h"
#include <string.h>

static float dot(const float a[3], const float b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void averted_rises(const float (*positions)[3], const float (*normals)[3], size_t vertex_count,
	const uint32_t *indices, size_t triangle_count, float *rises)
{
	memset(rises, 0, vertex_count * sizeof(*rises));
	for (size_t i = 0; i < 3 * triangle_count; i++) {
		const uint32_t *triangle = &indices[i - i % 3];
		const float *p = positions[indices[i]], *n = normals[indices[i]];
		float *rise = &rises[indices[i]];
		for (int corner = 0; corner < 3; corner++) {
			const float *q = positions[triangle[corner]];
			const float way[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
			float above = dot(n, way);
			*rise = above > *rise ? above : *rise;
		}
	}
}

void averted_vertices(const float (*positions)[3], const float (*normals)[3], const float *rises,
	size_t count, const float light[4], float slack, uint8_t *averted)
{
	for (size_t i = 0; i < count; i++) {
		const float *p = positions[i];
		const float path[3] = {light[0] - light[3] * p[0], light[1] - light[3] * p[1],
			light[2] - light[3] * p[2]};
		float most = dot(normals[i], path) + light[3] * rises[i];
		averted[i] = most < 0.0f && most * most > slack * slack * dot(path, path);
	}
}

size_t averted_split(const uint32_t *indices, size_t index_count, const uint8_t *averted,
	uint32_t *away, uint32_t *rest)
{
	size_t turned = 0;
	for (size_t i = 0; i < index_count; i += 3) {
		const uint32_t *triangle = &indices[i];
		/* Both lists are written, and one of them goes on. */
		memcpy(&away[turned], triangle, 3 * sizeof(*away));
		memcpy(&rest[i - turned], triangle, 3 * sizeof(*rest));
		turned +=
			averted[triangle[0]] & averted[triangle[1]] & averted[triangle[2]] ? 3 : 0;
	}
	return turned;
}
