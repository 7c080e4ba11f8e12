/* SPDX-License-Identifier: MIT */
#include "geom/face.h"
#include "base/array.h"
#include <math.h>
#include <stdlib.h>

void face_normal(const float p0[3], const float p1[3], const float p2[3], double normal[3])
{
	double u[3], v[3];
	for (int i = 0; i < 3; i++) {
		u[i] = (double)p1[i] - p0[i];
		v[i] = (double)p2[i] - p0[i];
	}
	normal[0] = u[1] * v[2] - u[2] * v[1];
	normal[1] = u[2] * v[0] - u[0] * v[2];
	normal[2] = u[0] * v[1] - u[1] * v[0];
}

double face_volume(const float p0[3], const float p1[3], const float p2[3], const float origin[3])
{
	const float *corners[3] = {p0, p1, p2};
	double p[3][3];
	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++)
			p[k][i] = (double)corners[k][i] - origin[i];
	return p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
	       p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
	       p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
}

static double length(const double v[3])
{
	return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void find_sphere(
	struct face_planes *planes, const float (*positions)[3], size_t vertex_count)
{
	double min[3] = {INFINITY, INFINITY, INFINITY};
	double max[3] = {-INFINITY, -INFINITY, -INFINITY};
	for (size_t v = 0; v < vertex_count; v++) {
		for (int i = 0; i < 3; i++) {
			if (positions[v][i] < min[i])
				min[i] = positions[v][i];
			if (positions[v][i] > max[i])
				max[i] = positions[v][i];
		}
	}
	for (int i = 0; i < 3; i++)
		planes->center[i] = (min[i] + max[i]) / 2.0;
	planes->radius = 0.0;
	for (size_t v = 0; v < vertex_count; v++) {
		double arm[3];
		for (int i = 0; i < 3; i++)
			arm[i] = positions[v][i] - planes->center[i];
		double distance = length(arm);
		if (distance > planes->radius)
			planes->radius = distance;
	}
}

static void store(struct face_planes *planes, size_t t, const double values[FACE_VALUES])
{
	size_t b = t / EDGE_BLOCK, size = face_block_size(planes, b);
	int16_t *block = face_block_values(planes, b);
	for (size_t i = 0; i < FACE_VALUES; i++)
		block[i * size + t % EDGE_BLOCK] = (int16_t)lrint(values[i]);
}

static void quantise(
	struct face_planes *planes, size_t t, const float p0[3], const double normal[3])
{
	/* Neither divisor is zero: the triangle has an area, so that its corners differ. */
	double scale = FACE_PLANE_ONE / length(normal);
	double unit[3] = {normal[0] * scale, normal[1] * scale, normal[2] * scale};
	double d = 0.0;
	for (int i = 0; i < 3; i++)
		d += unit[i] * ((p0[i] - planes->center[i]) / planes->radius);
	double values[FACE_VALUES] = {unit[0], unit[1], unit[2], d};
	store(planes, t, values);
}

bool face_planes_init(struct face_planes *planes, const float (*positions)[3], size_t vertex_count,
	const uint32_t *indices, size_t triangle_count)
{
	*planes = (struct face_planes){.count = triangle_count};
	planes->values = array_alloc(triangle_count, FACE_VALUES * sizeof(*planes->values));
	if (planes->values == NULL)
		return false;
	face_planes_update(planes, positions, vertex_count, indices);
	return true;
}

void face_planes_update(struct face_planes *planes, const float (*positions)[3],
	size_t vertex_count, const uint32_t *indices)
{
	planes->degenerate = 0;
	find_sphere(planes, positions, vertex_count);
	for (size_t t = 0; t < planes->count; t++) {
		const uint32_t *corners = &indices[3 * t];
		const float *p0 = positions[corners[0]];
		double normal[3];
		face_normal(p0, positions[corners[1]], positions[corners[2]], normal);
		if (length(normal) > 0.0) {
			quantise(planes, t, p0, normal);
		} else {
			store(planes, t, (const double[FACE_VALUES]){0});
			planes->degenerate++;
		}
	}
}

void face_planes_finish(struct face_planes *planes)
{
	free(planes->values);
	*planes = (struct face_planes){0};
}

size_t face_planes_bytes(const struct face_planes *planes)
{
	return planes->count * FACE_VALUES * sizeof(*planes->values);
}
