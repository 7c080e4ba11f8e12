/* SPDX-License-Identifier: MIT */
#include "geom/cones.h"
#include "base/array.h"
#include "geom/edges.h"
#include <math.h>
#include <stdlib.h>

#define CONE_ARRAYS 9

/*
 * A light is in a cone only where it is by CONE_MARGIN deeper along the axis, in units of the
 * light's own scale, which makes what double decides for each triangle certain. In these units the
 * float arithmetic of the test is off by less than 2^-18 (positions and the light's are at most 2
 * in size, distances to tips at most 2 / LIKENESS_MIN, sums have up to four terms rounded by 2^-24
 * of 16), and so is what storing a cone in float moves its tips. Each triangle's plane is then at
 * least LIKENESS_MIN * (CONE_MARGIN - 2^-17) > 2^-20 from the light, and the exact test decides by
 * its sign whatever is more than 2^-30 (silhouette.c).
 */
#define CONE_MARGIN 0x1p-16f
/* Above what rounding takes from the squared distance to the axis. */
#define ASIDE_MARGIN 0x1p-17f
/* As much more than the squared tangent as no rounding takes away. */
#define SPREAD_MARGIN (1.0 + 0x1p-18)
#define SLACK_MARGIN 0x1p-16f

/* The least cosine of a normal's angle to the axis: beyond it cones are narrow, and far off. */
#define LIKENESS_MIN 0.125

/* The least share of blocks that cones decide from around the mesh, on average, to be worth a test:
 * it takes a twelfth of the time of a block's triangles. */
#define DECIDED_MIN 0.2

void face_cones_finish(struct face_cones *cones)
{
	free(cones->axis_x);
	*cones = (struct face_cones){0};
}

size_t face_cones_bytes(const struct face_cones *cones)
{
	return cones->count * CONE_ARRAYS * sizeof(*cones->axis_x);
}

static bool reserve(struct face_cones *cones, size_t blocks)
{
	size_t count = (blocks + CONE_BATCH - 1) / CONE_BATCH * CONE_BATCH;
	float *memory = array_zalloc(count, CONE_ARRAYS * sizeof(*memory));
	float **arrays[CONE_ARRAYS] = {&cones->axis_x, &cones->axis_y, &cones->axis_z, &cones->x,
		&cones->y, &cones->z, &cones->faces_from, &cones->averts_from, &cones->spread};
	if (memory == NULL)
		return false;
	cones->count = count;
	for (int i = 0; i < CONE_ARRAYS; i++)
		*arrays[i] = memory + (size_t)i * count;
	for (size_t b = 0; b < count; b++)
		cones->spread[b] = INFINITY;
	return true;
}

/* The planes of a block's triangles: unit normals and a point each, relative to the centre. */
struct block_planes {
	size_t count;
	double normals[EDGE_BLOCK][3], points[EDGE_BLOCK][3];
};

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* False when a triangle has no area: it never faces, from whichever side. */
static bool read_block(struct block_planes *block, const struct face_planes *planes,
	const float (*positions)[3], const uint32_t *indices, size_t first)
{
	for (size_t i = 0; i < block->count; i++) {
		const uint32_t *v = &indices[3 * (first + i)];
		const float *p = positions[v[0]];
		double *n = block->normals[i];
		face_normal(p, positions[v[1]], positions[v[2]], n);
		double length = sqrt(dot(n, n));
		if (!(length > 0.0))
			return false;
		for (int axis = 0; axis < 3; axis++) {
			n[axis] /= length;
			block->points[i][axis] = (p[axis] - planes->center[axis]) / planes->radius;
		}
	}
	return true;
}

/* The mean of the normals, rounded to float, and of the points; false when there is none. */
static bool find_axis(const struct block_planes *block, double axis[3], double middle[3])
{
	double sum[3] = {0}, points[3] = {0};
	for (size_t i = 0; i < block->count; i++) {
		for (int c = 0; c < 3; c++) {
			sum[c] += block->normals[i][c];
			points[c] += block->points[i][c];
		}
	}
	double length = sqrt(dot(sum, sum));
	for (int c = 0; c < 3; c++) {
		axis[c] = (float)(sum[c] / length);
		middle[c] = (float)(points[c] / (double)block->count);
	}
	return length > 0.0;
}

static void fit(struct face_cones *cones, size_t b, const struct block_planes *block)
{
	double axis[3], middle[3], likeness = 1.0;
	if (!find_axis(block, axis, middle))
		return;
	double faces = -INFINITY, averts = -INFINITY;
	for (size_t i = 0; i < block->count; i++) {
		const double *n = block->normals[i], *p = block->points[i];
		double along = dot(n, axis);
		double height =
			dot(n, (double[3]){p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]});
		if (along < LIKENESS_MIN)
			return;
		likeness = fmin(likeness, along);
		faces = fmax(faces, height / along);
		averts = fmax(averts, -height / along);
	}
	cones->axis_x[b] = (float)axis[0];
	cones->axis_y[b] = (float)axis[1];
	cones->axis_z[b] = (float)axis[2];
	cones->x[b] = (float)middle[0];
	cones->y[b] = (float)middle[1];
	cones->z[b] = (float)middle[2];
	cones->faces_from[b] = (float)faces;
	cones->averts_from[b] = (float)averts;
	/* The axis is a unit vector but for rounding. */
	likeness /= sqrt(dot(axis, axis));
	cones->spread[b] = (float)((1.0 / (likeness * likeness) - 1.0) * SPREAD_MARGIN + 0x1p-40);
}

bool cone_light_of(const struct face_planes *planes, const float light[4], struct cone_light *seen)
{
	double w = light[3], m[3];
	for (int i = 0; i < 3; i++)
		m[i] = light[i] - w * planes->center[i];
	double scale = sqrt(dot(m, m)) + fabs(w) * planes->radius;
	if ((w != 0.0 && fabs(w) != 1.0) || !(scale > 0.0))
		return false;
	*seen = (struct cone_light){(float)(m[0] / scale), (float)(m[1] / scale),
		(float)(m[2] / scale), (float)(w * planes->radius / scale)};
	return true;
}

/* Whether what is `along` deep in a cone, from its tip, is inside it. */
static inline uint8_t is_inside(float along, float aside_times_spread)
{
	float depth = along - CONE_MARGIN;
	return depth * fabsf(depth) > aside_times_spread;
}

void face_cones_test(const struct face_cones *cones, size_t first, const struct cone_light *light,
	uint8_t sides[CONE_BATCH])
{
	/* A point's opposite: the point is tested, and what it decides is turned around. */
	float sign = light->w < 0.0f ? -1.0f : 1.0f;
	struct cone_light at = {sign * light->x, sign * light->y, sign * light->z, sign * light->w};
	uint8_t faces_bit = sign > 0.0f ? CONE_FACES : CONE_AVERTS;
	uint8_t averts_bit = CONE_FACES + CONE_AVERTS - faces_bit;
	const float *axis_x = &cones->axis_x[first], *axis_y = &cones->axis_y[first];
	const float *axis_z = &cones->axis_z[first];
	const float *x = &cones->x[first], *y = &cones->y[first], *z = &cones->z[first];
	const float *faces_from = &cones->faces_from[first];
	const float *averts_from = &cones->averts_from[first], *spread = &cones->spread[first];
	for (int i = 0; i < CONE_BATCH; i++) {
		float dx = at.x - at.w * x[i], dy = at.y - at.w * y[i], dz = at.z - at.w * z[i];
		float along = dx * axis_x[i] + dy * axis_y[i] + dz * axis_z[i];
		float aside = dx * dx + dy * dy + dz * dz - along * along + ASIDE_MARGIN;
		float limit = aside * spread[i];
		uint8_t faces = is_inside(along - at.w * faces_from[i], limit);
		uint8_t averts = is_inside(-along - at.w * averts_from[i], limit);
		sides[i] = (uint8_t)(faces * faces_bit | averts * averts_bit);
	}
}

/* By the distance to the surface of the nearer cone: it is the one that the light is in, as the two
 * are on opposite sides of a block. The depth is off by less than 2^-18 as in the test, and root
 * and quotient, of less than 16, are by less than 2^-19 more: together by less than SLACK_MARGIN.
 */
enum cone_side face_cones_side(
	const struct face_cones *cones, size_t b, const struct cone_light *light, float *slack)
{
	float sign = light->w < 0.0f ? -1.0f : 1.0f, w = sign * light->w;
	float dx = sign * light->x - w * cones->x[b], dy = sign * light->y - w * cones->y[b];
	float dz = sign * light->z - w * cones->z[b], spread = cones->spread[b];
	float along = dx * cones->axis_x[b] + dy * cones->axis_y[b] + dz * cones->axis_z[b];
	float aside = dx * dx + dy * dy + dz * dz - along * along + ASIDE_MARGIN;
	float faces = along - w * cones->faces_from[b], averts = -along - w * cones->averts_from[b];
	float depth = (faces > averts ? faces : averts) - CONE_MARGIN;
	*slack = (depth - sqrtf(aside * spread)) / sqrtf(1.0f + spread) - SLACK_MARGIN;
	if (!(*slack > 0.0f))
		return CONE_MIXED;
	return (faces > averts) == (sign > 0.0f) ? CONE_FACES : CONE_AVERTS;
}

/* How many blocks are decided, on average over directions to the corners, edges and faces of a
 * cube. */
static double count_decided(const struct face_cones *cones)
{
	size_t decided = 0;
	for (int d = 0; d < 27; d++) {
		struct cone_light light = {(float)(d % 3 - 1) / 2.0f, (float)(d / 3 % 3 - 1) / 2.0f,
			(float)(d / 9 - 1) / 2.0f, 0.0f};
		for (size_t b = 0; d != 13 && b < cones->count; b += CONE_BATCH) {
			uint8_t sides[CONE_BATCH];
			face_cones_test(cones, b, &light, sides);
			for (int i = 0; i < CONE_BATCH; i++)
				decided += sides[i] != CONE_MIXED;
		}
	}
	return (double)decided / 26.0;
}

bool face_cones_init(struct face_cones *cones, const struct face_planes *planes,
	const float (*positions)[3], const uint32_t *indices, size_t triangle_count)
{
	*cones = (struct face_cones){0};
	size_t blocks = (triangle_count + EDGE_BLOCK - 1) / EDGE_BLOCK;
	if (!reserve(cones, blocks))
		return false;
	for (size_t b = 0; b < blocks; b++) {
		struct block_planes block = {.count = triangle_count - b * EDGE_BLOCK};
		if (block.count > EDGE_BLOCK)
			block.count = EDGE_BLOCK;
		if (read_block(&block, planes, positions, indices, b * EDGE_BLOCK))
			fit(cones, b, &block);
	}
	if (count_decided(cones) < DECIDED_MIN * (double)blocks)
		face_cones_finish(cones);
	return true;
}
