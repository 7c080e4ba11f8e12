/* SPDX-License-Identifier: MIT */
#include "geom/facing.h"
#include <math.h>
#include <string.h>

size_t facing_words(const struct caster *caster)
{
	return edge_table_blocks(&caster->edges);
}

/* A light as the quantised planes see it; all zero when they cannot. Once for each triangle of a
 * block: what is the same in each round of a loop, Clang widens before it, and then finds no
 * instruction for the upper half of a product. */
struct plane_test {
	int16_t x[EDGE_BLOCK], y[EDGE_BLOCK], z[EDGE_BLOCK], d[EDGE_BLOCK];
};

/* The sum over nx x, ny y, nz z, d d of the products' upper halves. Above or below these, it has
 * the sign of the exact value. */
#define SURELY_FACES 2
#define SURELY_NOT (-6)

/*
 * With N the normal in double, m = light.xyz - w c and r the radius, the exact value is
 *	|N| (n . m - w r d),   n = N / |N|,   d = n . (p0 - c) / r.
 * Let x be (m, -w r) divided by |m| + |w| r, Q = 32767, and V = n . x.xyz + d x.w, so that
 * |V| <= 1. n, d and x are rounded to 1 / Q. Q^2 V is thereby changed by at most
 *	Q / 2 (|n|_1 + |d| + |x|_1) + 4 / 4 <= Q / 2 (sqrt 3 + 1 + sqrt 3) + 1 < 1.12 * 2^16,
 * and taking the upper halves of four products loses less than 4 more: the sum is within
 * (-5.12, 1.12] of Q^2 V / 2^16. What double rounds here, in the planes and in the exact value is
 * below 2^-30 of the same scale, at any scale of light and mesh; with a w other than 0, 1 or -1,
 * light.xyz - w p0 could round by more. The sum and its parts stay within 16 bits.
 */
static void plane_test_init(
	struct plane_test *test, const struct face_planes *planes, const float light[4])
{
	double w = light[3];
	double m[3];
	for (int i = 0; i < 3; i++)
		m[i] = light[i] - w * planes->center[i];
	double length = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]) + fabs(w) * planes->radius;
	/* No length: neither light nor mesh has an extent, so that nothing faces. */
	bool tells = (w == 0.0 || fabs(w) == 1.0) && length > 0.0;
	double scale = tells ? FACE_PLANE_ONE / length : 0.0;
	for (int i = 0; i < EDGE_BLOCK; i++) {
		test->x[i] = (int16_t)lrint(m[0] * scale);
		test->y[i] = (int16_t)lrint(m[1] * scale);
		test->z[i] = (int16_t)lrint(m[2] * scale);
		test->d[i] = (int16_t)lrint(-w * planes->radius * scale);
	}
}

static bool faces(const struct caster *caster, size_t t, const float light[4])
{
	const uint32_t *corners = &caster->indices[3 * t];
	const float *p0 = caster->positions[corners[0]];
	double normal[3];
	face_normal(p0, caster->positions[corners[1]], caster->positions[corners[2]], normal);
	double value = 0.0;
	for (int i = 0; i < 3; i++)
		value += normal[i] * (light[i] - (double)light[3] * p0[i]);
	return value > 0.0;
}

/* One bit per byte that is 1 rather than 0. */
static uint64_t pack_bytes(const uint8_t bytes[EDGE_BLOCK])
{
	uint64_t word = 0;
	for (int i = 0; i < EDGE_BLOCK; i += 8) {
		uint64_t eight = 0;
		for (int j = 0; j < 8; j++)
			eight |= (uint64_t)bytes[i + j] << 8 * j;
		/* Moves bit 8 j to bit 56 + j; no two products meet. */
		word |= (eight * UINT64_C(0x0102040810204080) >> 56) << i;
	}
	return word;
}

static inline int16_t upper_half(int16_t a, int16_t b)
{
	return (int16_t)(a * b >> 16);
}

/* A sum's distance to the middle of those that are unsure; where it is that or less, they are. */
#define UNSURE_MIDDLE ((SURELY_FACES + SURELY_NOT) / 2)
#define UNSURE_HALF ((SURELY_FACES - SURELY_NOT) / 2)

/* Tests a block of count triangles: a bit for each that surely faces the light,
 * with the sums that tell which, and the least distance of one to UNSURE_MIDDLE. */
static inline uint64_t test_planes(const int16_t *values, int count, const struct plane_test *test,
	int16_t sums[EDGE_BLOCK], int *least)
{
	const int16_t *nx = values, *ny = nx + count, *nz = ny + count, *d = nz + count;
	uint8_t above[EDGE_BLOCK] = {0};
	int16_t nearest = INT16_MAX;
	/* Loops apart, each over values of one width. */
	for (int i = 0; i < count; i++)
		sums[i] = (int16_t)(upper_half(nx[i], test->x[i]) + upper_half(ny[i], test->y[i]) +
				    upper_half(nz[i], test->z[i]) + upper_half(d[i], test->d[i]));
	for (int i = 0; i < count; i++) {
		int16_t off = (int16_t)(sums[i] - UNSURE_MIDDLE), back = (int16_t)-off;
		int16_t distance = off > back ? off : back;
		nearest = distance < nearest ? distance : nearest;
	}
	for (int i = 0; i < count; i++)
		above[i] = sums[i] >= SURELY_FACES;
	*least = nearest;
	return pack_bytes(above);
}

/* least: as test_planes() has it, of the block. */
static inline uint64_t facing_word(const struct caster *caster, size_t b,
	const struct plane_test *test, const float light[4], int *least)
{
	size_t first = b * EDGE_BLOCK;
	const int16_t *values = face_block_values(&caster->planes, b);
	int count = (int)face_block_size(&caster->planes, b);
	int16_t sums[EDGE_BLOCK];
	/* The constant count is what lets a compiler unroll it into vectors. */
	uint64_t word = count == EDGE_BLOCK ? test_planes(values, EDGE_BLOCK, test, sums, least)
					    : test_planes(values, count, test, sums, least);
	if (*least >= UNSURE_HALF)
		return word;
	for (int i = 0; i < count; i++)
		if (sums[i] < SURELY_FACES && sums[i] > SURELY_NOT)
			word |= (uint64_t)faces(caster, first + (size_t)i, light) << i;
	return word;
}

static uint64_t word_of_side(const struct caster *caster, size_t b, uint8_t side)
{
	size_t size = face_block_size(&caster->planes, b);
	return side == CONE_FACES ? UINT64_MAX >> (EDGE_BLOCK - size) : 0;
}

/* Without cones, or a light that they can tell about, each triangle is tested. */
static void find_blocks(const struct caster *caster, const float light[4],
	const struct cone_light *seen, uint64_t *facing)
{
	size_t blocks = facing_words(caster);
	struct plane_test test;
	plane_test_init(&test, &caster->planes, light);
	for (size_t first = 0; first < blocks; first += CONE_BATCH) {
		uint8_t sides[CONE_BATCH] = {CONE_MIXED};
		if (seen != NULL)
			face_cones_test(&caster->cones, first, seen, sides);
		for (size_t b = first; b < blocks && b < first + CONE_BATCH; b++) {
			uint8_t side = sides[b - first];
			int least;
			facing[b] = side != CONE_MIXED
					    ? word_of_side(caster, b, side)
					    : facing_word(caster, b, &test, light, &least);
		}
	}
}

static bool is_finite(const float light[4])
{
	return isfinite(light[0]) && isfinite(light[1]) && isfinite(light[2]) && isfinite(light[3]);
}

static void find_none(const struct caster *caster, uint64_t *facing)
{
	memset(facing, 0, facing_words(caster) * sizeof(*facing));
}

void facing_find_all(const struct caster *caster, const float light[4], uint64_t *facing)
{
	if (is_finite(light))
		find_blocks(caster, light, NULL, facing);
	else
		find_none(caster, facing);
}

void facing_find(const struct caster *caster, const float light[4], uint64_t *facing)
{
	struct cone_light seen;
	bool cones = caster->cones.count > 0 && cone_light_of(&caster->planes, light, &seen);
	if (is_finite(light))
		find_blocks(caster, light, cones ? &seen : NULL, facing);
	else
		find_none(caster, facing);
}

/* The light's scale in what planes and cones are tested by. */
static double scale_of(const struct face_planes *planes, const float light[4])
{
	double square = 0.0;
	for (int i = 0; i < 3; i++) {
		double m = light[i] - (double)light[3] * planes->center[i];
		square += m * m;
	}
	return sqrt(square) + fabs((double)light[3]) * planes->radius;
}

/* A test of blocks, for a light that is finite. */
struct block_test {
	const struct caster *caster;
	const float *light;
	double scale;
	struct cone_light seen;
	struct plane_test planes;
};

/*
 * Tests a block; returns how far the light may go from here, its w as it is, without any triangle
 * turning. What a triangle is tested by, n . (light.xyz - w p0) with the unit normal n, changes by
 * no more than the light goes.
 *
 * By sums: where the distance to the middle is s, the value is at least (s - 3.12) / 2^14 of the
 * scale. It stays above .88 / 2^14 of it within what is returned, and the scale grows to twice
 * itself at most, so that the exact test still tells the same: see plane_test_init().
 */
static double test_block(const struct block_test *test, size_t b, uint8_t side, uint64_t *word)
{
	int least;
	double slack;
	if (side != CONE_MIXED) {
		*word = word_of_side(test->caster, b, side);
		slack = face_cones_slack(&test->caster->cones, b, &test->seen, side);
	} else {
		*word = facing_word(test->caster, b, &test->planes, test->light, &least);
		slack = (least - UNSURE_HALF) / 16384.0;
	}
	return test->scale * fmax(0.0, fmin(slack, 1.0)) * (1.0 - 0x1p-20);
}

static void renew_batch(
	const struct block_test *test, size_t first, bool cones, struct facing_track *track)
{
	size_t blocks = facing_words(test->caster);
	uint8_t sides[CONE_BATCH] = {CONE_MIXED};
	if (cones)
		face_cones_test(&test->caster->cones, first, &test->seen, sides);
	for (size_t b = first; b < blocks && b < first + CONE_BATCH; b++) {
		uint64_t word;
		if (track->travel < track->safe[b])
			continue;
		double slack = test_block(test, b, sides[b - first], &word);
		track->safe[b] = nextafter(track->travel + slack, 0.0);
		track->turned[b] = word ^ track->facing[b];
		track->facing[b] = word;
		track->tested++;
	}
}

static bool has_expired(const struct facing_track *track, size_t first, size_t blocks)
{
	size_t end = first + CONE_BATCH < blocks ? first + CONE_BATCH : blocks;
	int expired = 0;
	for (size_t b = first; b < end; b++)
		expired |= !(track->travel < track->safe[b]);
	return expired != 0;
}

double facing_way(const struct facing_track *track, const float light[4])
{
	double square = 0.0;
	for (int i = 0; i < 3; i++) {
		double way = (double)light[i] - track->light[i];
		square += way * way;
	}
	return light[3] == track->light[3] && isfinite(square) ? sqrt(square) : INFINITY;
}

/* Moves the track on to a light. */
static void travel_to(struct facing_track *track, size_t blocks, const float light[4])
{
	double way = facing_way(track, light);
	/* Rounded up, each time. */
	track->travel = nextafter(track->travel + way * (1.0 + 0x1p-40), INFINITY);
	if (way == INFINITY) {
		memset(track->safe, 0, blocks * sizeof(*track->safe));
		track->travel = 0.0;
	}
	memcpy(track->light, light, sizeof(track->light));
}

void facing_renew(const struct caster *caster, const float light[4], struct facing_track *track)
{
	size_t blocks = facing_words(caster);
	struct block_test test = {caster, light, scale_of(&caster->planes, light), {0}, {{0}}};
	bool cones = caster->cones.count > 0 && cone_light_of(&caster->planes, light, &test.seen);
	travel_to(track, blocks, light);
	track->tested = 0;
	if (!is_finite(light)) {
		memcpy(track->turned, track->facing, blocks * sizeof(*track->facing));
		find_none(caster, track->facing);
		return;
	}
	memset(track->turned, 0, blocks * sizeof(*track->turned));
	plane_test_init(&test.planes, &caster->planes, light);
	for (size_t first = 0; first < blocks; first += CONE_BATCH)
		if (has_expired(track, first, blocks))
			renew_batch(&test, first, cones, track);
}
