/* SPDX-License-Identifier: MIT */
#include "geom/fin.h"
#include <math.h>
#include <string.h>

/*
 * Along a silhouette edge p0 -> p1 with outward normal n and widths w0, w1 lies the quad p0, p1,
 * p1 + n w1, p0 + n w0. Its offsets are 0, 0, n w1, n w0 and its widths w0, w1, w1, w0. Both are
 * affine over the whole trapezoid (offset is n times the distance from the edge; width changes
 * along it alone), so that its two triangles interpolate the same functions. As w = 1 everywhere,
 * interpolation is linear on the screen; so are the laws of width, since 1 / w and z of a straight
 * line are linear after projection.
 *
 * Around a corner at p, offset is the vertex minus p and width is constant: alpha is the distance
 * from p, whatever the quad. It has to cover the sector of radius w between two normals; beyond
 * that alpha is at least 1, and where fins overlap the lowest alpha wins and is right.
 */

/* What the sector around a corner is wider than the gap on each side, radians: more than normals
 * are off by in 16 bits, so that no crack opens beside the fins along edges. */
#define OVERLAP 1e-4f

/* Of a law: so that no width, drawn anywhere, is infinite. */
#define LARGEST 1e30

static float tame(double width)
{
	return (float)fmin(fmax(width, 0.0), LARGEST);
}

struct fin_law fin_law_constant(float width)
{
	return (struct fin_law){.width_far = tame(width), .drawn_far = tame(width)};
}

struct fin_law fin_law_perspective(float scale, float near, float far)
{
	/* With K the pole of struct light_frame and d = (z + 1) / 2, 1 / w is (K - d) / (K near),
	 * and 1 - b/r of a receiver at d = 1 is (1 - d) / (K - d): the product has the same slope.
	 */
	double at_near = (double)scale / near, at_far = (double)scale / far;
	return (struct fin_law){
		.width_far = tame(at_far),
		.slope = tame((at_near - at_far) / 2.0),
	};
}

struct fin_law fin_law_parallel(float scale)
{
	return (struct fin_law){.slope = tame(scale / 2.0)};
}

void fin_law_add_apron(struct fin_law *law, float apron)
{
	law->drawn_far = tame((double)law->drawn_far + apron);
}

static float law_at(float far, float slope, float z)
{
	float width = far + slope * (1.0f - z);
	return width < FIN_NDC_LIMIT ? width : FIN_NDC_LIMIT;
}

float fin_law_drawn(const struct fin_law *law, float z)
{
	return law_at(law->drawn_far, law->slope, z);
}

/* In steps of 1/32767. A unit vector that is turned by so little goes a small part of a step
 * beyond. */
static uint32_t pack(float unit)
{
	return (uint32_t)(int32_t)(unit * 32767.0f + (unit < 0.0f ? -0.5f : 0.5f)) & 0xffffu;
}

/* A unit vector turned clockwise by a small angle. */
static uint32_t pack_turned(const float v[2], float angle)
{
	return pack(v[0] + angle * v[1]) | pack(v[1] - angle * v[0]) << 16;
}

static void unpack(uint32_t packed, float v[2])
{
	v[0] = (float)(int16_t)(packed & 0xffffu) * (1.0f / 32767.0f);
	v[1] = (float)(int16_t)(packed >> 16) * (1.0f / 32767.0f);
}

static uint32_t bits_of(float value)
{
	uint32_t bits;
	memcpy(&bits, &value, sizeof(bits));
	return bits;
}

static float float_of(uint32_t bits)
{
	float value;
	memcpy(&value, &bits, sizeof(value));
	return value;
}

struct fin fin_along(const float start[3], const float end[3])
{
	return (struct fin){
		.start = {start[0], start[1]},
		.start_z = bits_of(start[2]),
		.end = {end[0], end[1]},
		.end_z = bits_of(end[2]),
	};
}

void fin_add_corner(struct fin *fin, const float from[2], const float to[2], enum fin_side side)
{
	fin->from = pack_turned(from, OVERLAP);
	fin->to = pack_turned(to, -OVERLAP);
	fin->start_z |= side & FIN_OUTSIDE ? FIN_SIDE_BIT : 0;
	fin->end_z |= side & FIN_INSIDE ? FIN_SIDE_BIT : 0;
}

bool fin_has_edge(const struct fin *fin)
{
	return fin->start[0] != fin->end[0] || fin->start[1] != fin->end[1];
}

size_t fin_quads(const struct fin *fin, bool both_sides)
{
	size_t edge = fin_has_edge(fin) ? both_sides + 1 : 0;
	return edge + ((fin->start_z & FIN_SIDE_BIT) != 0) + ((fin->end_z & FIN_SIDE_BIT) != 0);
}

/* In widths as drawn, from the position, outside. */
static void corner_offsets(const struct fin *fin, float offsets[4][2])
{
	float from[2], to[2];
	unpack(fin->from, from);
	unpack(fin->to, to);
	float x = from[0] + to[0], y = from[1] + to[1];
	if (from[0] * to[0] + from[1] * to[1] >= 0.0f) {
		/* A kite along the tangents; up to a right angle, the divisor is about 2 at least.
		 */
		float reach = 2.0f / (x * x + y * y);
		offsets[0][0] = offsets[0][1] = 0.0f;
		for (int c = 0; c < 2; c++) {
			offsets[1][c] = from[c];
			offsets[3][c] = to[c];
		}
		offsets[2][0] = x * reach;
		offsets[2][1] = y * reach;
		return;
	}
	/* Half the square around the disc. Halfway between, also when they are opposite. */
	float outer[2] = {to[1] - from[1], from[0] - to[0]};
	float length = sqrtf(outer[0] * outer[0] + outer[1] * outer[1]);
	x = outer[0] / length;
	y = outer[1] / length;
	const float half[4][2] = {{-y, x}, {-y + x, x + y}, {y + x, -x + y}, {y, -x}};
	for (int i = 0; i < 4; i++)
		for (int c = 0; c < 2; c++)
			offsets[i][c] = half[i][c];
}

/* offsets: in widths as drawn, outside. */
static void write_quad(const struct fin_law *law, const float *const positions[4],
	const float offsets[4][2], float side, struct fin_vertex out[4])
{
	for (int i = 0; i < 4; i++) {
		const float *p = positions[i];
		float drawn = side * fin_law_drawn(law, p[2]);
		float x = drawn * offsets[i][0], y = drawn * offsets[i][1];
		out[i] = (struct fin_vertex){
			.position = {p[0] + x, p[1] + y, p[2]},
			.offset = {x, y},
			.width = side * law_at(law->width_far, law->slope, p[2]),
		};
	}
}

/* The same on each side that it is on. */
static size_t write_sides(const struct fin_law *law, const float *const positions[4],
	const float offsets[4][2], unsigned int sides, struct fin_vertex *out)
{
	size_t count = 0;
	if (sides & FIN_OUTSIDE) {
		write_quad(law, positions, offsets, 1.0f, out);
		count += 4;
	}
	if (sides & FIN_INSIDE) {
		write_quad(law, positions, offsets, -1.0f, out + count);
		count += 4;
	}
	return count;
}

static unsigned int corner_sides(const struct fin *fin)
{
	return (fin->start_z & FIN_SIDE_BIT ? FIN_OUTSIDE : 0) |
	       (fin->end_z & FIN_SIDE_BIT ? FIN_INSIDE : 0);
}

size_t fin_expand(const struct fin *fin, const struct fin_law *law, bool both_sides,
	struct fin_vertex out[FIN_VERTICES_MAX])
{
	const float a[3] = {fin->start[0], fin->start[1], float_of(fin->start_z & ~FIN_SIDE_BIT)};
	const float b[3] = {fin->end[0], fin->end[1], float_of(fin->end_z & ~FIN_SIDE_BIT)};
	size_t count = 0;
	if (fin_has_edge(fin)) {
		float dx = b[0] - a[0], dy = b[1] - a[1], length = sqrtf(dx * dx + dy * dy);
		float x = dy / length, y = -dx / length;
		count = write_sides(law, (const float *const[]){a, b, b, a},
			(const float[4][2]){{0}, {0}, {x, y}, {x, y}},
			both_sides ? FIN_BOTH : FIN_OUTSIDE, out);
	}
	unsigned int sides = corner_sides(fin);
	if (sides == 0)
		return count;
	float offsets[4][2];
	corner_offsets(fin, offsets);
	return count + write_sides(law, (const float *const[]){a, a, a, a},
			       (const float(*)[2])offsets, sides, out + count);
}
