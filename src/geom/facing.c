/* SPDX-License-Identifier: MIT */
#include "geom/facing.h"
#include "geom/word.h"
#include <float.h>
#include <math.h>
#include <string.h>

size_t facing_words(const struct caster *caster)
{
	return edge_table_blocks(&caster->edges);
}

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
static void plane_light_init(
	struct plane_light *seen, const struct face_planes *planes, const float light[4])
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
		seen->x[i] = (int16_t)lrint(m[0] * scale);
		seen->y[i] = (int16_t)lrint(m[1] * scale);
		seen->z[i] = (int16_t)lrint(m[2] * scale);
		seen->d[i] = (int16_t)lrint(-w * planes->radius * scale);
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

static inline int16_t upper_half(int16_t a, int16_t b)
{
	return (int16_t)(a * b >> 16);
}

/* A sum's distance to the middle of those that are unsure; where it is that or less, they are. */
#define UNSURE_MIDDLE ((SURELY_FACES + SURELY_NOT) / 2)
#define UNSURE_HALF ((SURELY_FACES - SURELY_NOT) / 2)

/* Tests a block of count triangles: a bit for each that surely faces the light,
 * with the sums that tell which, and the least distance of one to UNSURE_MIDDLE. */
static inline uint64_t test_planes(const int16_t *values, int count, const struct plane_light *test,
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
	return word_of_bytes(above);
}

/* least: as test_planes() has it, of the block. */
static inline uint64_t facing_word(const struct caster *caster, size_t b,
	const struct plane_light *test, const float light[4], int *least)
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

size_t facing_padded(const struct caster *caster)
{
	return edge_table_sets(&caster->edges) * EDGE_BLOCK_SET;
}

/* What lengths are shares of, in tracks; of a mesh without extent no triangle ever turns. */
static double track_unit(const struct face_planes *planes)
{
	return planes->radius > 0.0 ? planes->radius : 1.0;
}

/* The light's scale in what planes and cones are tested by. */
static double scale_of(const struct face_planes *planes, const float light[4])
{
	double square = 0.0;
	for (int i = 0; i < 3; i++) {
		double m = light[i] - (double)light[3] * planes->center[i];
		square += m * m;
	}
	return (sqrt(square) + fabs((double)light[3]) * planes->radius) / track_unit(planes);
}

/* Below any float by more than a double, or a product in float, rounds it. */
#define BELOW (1.0f - 0x1p-20f)

static bool is_finite(const float light[4])
{
	return isfinite(light[0]) && isfinite(light[1]) && isfinite(light[2]) && isfinite(light[3]);
}

void facing_test_init(struct facing_test *test, const struct caster *caster, const float light[4])
{
	*test = (struct facing_test){.caster = caster, .light = light, .finite = is_finite(light)};
	if (!test->finite)
		return;
	test->scale = (float)fmin(scale_of(&caster->planes, light), FLT_MAX) * BELOW;
	test->cones = caster->cones.count > 0 && cone_light_of(&caster->planes, light, &test->seen);
	plane_light_init(&test->planes, &caster->planes, light);
}

/* Without cones, or a light that they can tell about, each triangle is tested. */
static size_t find_batch(const struct facing_test *test, size_t first, uint64_t *facing)
{
	size_t tested = 0;
	size_t blocks = facing_words(test->caster);
	uint8_t sides[CONE_BATCH] = {CONE_MIXED};
	if (test->cones)
		face_cones_test(&test->caster->cones, first, &test->seen, sides);
	for (size_t b = first; b < blocks && b < first + CONE_BATCH; b++) {
		uint8_t side = sides[b - first];
		int least;
		tested += side == CONE_MIXED;
		facing[b] = side != CONE_MIXED ? word_of_side(test->caster, b, side)
					       : facing_word(test->caster, b, &test->planes,
							 test->light, &least);
	}
	return tested;
}

/* The block behind the last set. */
static size_t sets_end(const struct caster *caster, size_t end)
{
	size_t blocks = facing_words(caster);
	return end * EDGE_BLOCK_SET < blocks ? end * EDGE_BLOCK_SET : blocks;
}

size_t facing_find_sets(const struct facing_test *test, size_t first, size_t end, uint64_t *facing)
{
	size_t begin = first * EDGE_BLOCK_SET, behind = sets_end(test->caster, end), tested = 0;
	if (!test->finite) {
		memset(&facing[begin], 0, (behind - begin) * sizeof(*facing));
		return 0;
	}
	for (size_t b = begin; b < behind; b += CONE_BATCH)
		tested += find_batch(test, b, facing);
	return tested;
}

static size_t find_by(const struct facing_test *test, uint64_t *facing)
{
	return facing_find_sets(test, 0, edge_table_sets(&test->caster->edges), facing);
}

size_t facing_find(const struct caster *caster, const float light[4], uint64_t *facing)
{
	struct facing_test test;
	facing_test_init(&test, caster, light);
	return find_by(&test, facing);
}

size_t facing_find_all(const struct caster *caster, const float light[4], uint64_t *facing)
{
	struct facing_test test;
	facing_test_init(&test, caster, light);
	test.cones = false;
	return find_by(&test, facing);
}

/*
 * Tests a block, whose word is that of before; returns how far the light may go from here, its w as
 * it is, without any triangle turning, as a share of its scale. What a triangle is tested by, n .
 * (light.xyz - w p0) with the unit normal n, changes by no more than the light goes.
 *
 * By sums: where the distance to the middle is s, the value is at least (s - 3.12) / 2^14 of the
 * scale. It stays above .88 / 2^14 of it within what is returned, and the scale grows to twice
 * itself at most, so that the exact test still tells the same: see plane_light_init().
 *
 * tested: counted up where its triangles are.
 */
static float test_block(const struct facing_test *test, size_t b, uint64_t *word, size_t *tested)
{
	int least;
	float slack;
	/* What was on both sides mostly still is. */
	if (test->cones && *word + 1 <= 1) {
		enum cone_side side = face_cones_side(&test->caster->cones, b, &test->seen, &slack);
		*word = word_of_side(test->caster, b, side);
		if (side != CONE_MIXED)
			return slack;
	}
	*word = facing_word(test->caster, b, &test->planes, test->light, &least);
	*tested += 1;
	return (float)(least - UNSURE_HALF) / 16384.0f;
}

static inline void turn(struct facing_track *track, size_t b, uint64_t word)
{
	track->turned[b] = word ^ track->facing[b];
	track->changed[b / EDGE_BLOCK_SET] |= (uint64_t)(word != track->facing[b])
					      << b % EDGE_BLOCK_SET;
	track->facing[b] = word;
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

/* Rounded up, also where it is too small for the precision of floats. */
float facing_track_move(
	struct facing_track *track, const struct caster *caster, const float light[4])
{
	double way = facing_way(track, light) / track_unit(&caster->planes);
	memcpy(track->light, light, sizeof(track->light));
	return (float)fmin(way * (1.0 + 0x1p-20) + FLT_MIN, FLT_MAX);
}

/* Takes a way from what is safe of a set's blocks; a bit for each that this leaves nothing. */
static uint64_t expire(float safe[EDGE_BLOCK_SET], float way)
{
	uint8_t expired[EDGE_BLOCK_SET];
	for (int i = 0; i < EDGE_BLOCK_SET; i++) {
		safe[i] = safe[i] * BELOW - way;
		expired[i] = safe[i] <= 0.0f;
	}
	return word_of_bytes(expired);
}

/* Returns of how many blocks the triangles are tested. */
static size_t renew_set(
	const struct facing_test *test, float way, size_t set, struct facing_track *track)
{
	size_t first = set * EDGE_BLOCK_SET, count = sets_end(test->caster, set + 1) - first;
	uint64_t expired =
		expire(&track->safe[first], way) & UINT64_MAX >> (EDGE_BLOCK_SET - count);
	size_t tested = 0;
	track->changed[set] = 0;
	for (uint64_t left = expired; left != 0; left &= left - 1) {
		size_t b = first + (size_t)__builtin_ctzll(left);
		uint64_t word = track->facing[b];
		float share = test_block(test, b, &word, &tested);
		share = share < 1.0f ? share : 1.0f;
		track->safe[b] = share > 0.0f ? share * test->scale * BELOW : 0.0f;
		turn(track, b, word);
	}
	return tested;
}

/* Nothing faces a light that is not finite. */
static void turn_away(const struct facing_test *test, size_t set, struct facing_track *track)
{
	track->changed[set] = 0;
	for (size_t b = set * EDGE_BLOCK_SET; b < sets_end(test->caster, set + 1); b++) {
		turn(track, b, 0);
		track->safe[b] = 0.0f;
	}
}

size_t facing_renew_sets(const struct facing_test *test, float way, size_t first, size_t end,
	struct facing_track *track)
{
	size_t tested = 0;
	for (size_t set = first; set < end; set++)
		if (test->finite)
			tested += renew_set(test, way, set, track);
		else
			turn_away(test, set, track);
	return tested;
}
