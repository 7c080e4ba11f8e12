/* SPDX-License-Identifier: MIT */
#include "geom/silhouette.h"
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

/* Tests count triangles, 64 at most, from the first: a bit for each that surely faces the light;
 * and whether any is unsure, with the sums that tell which. */
static inline uint64_t test_planes(const struct face_planes *planes, size_t first, int count,
	const struct plane_test *test, int16_t sums[EDGE_BLOCK], bool *unsure)
{
	const int16_t *nx = &planes->nx[first], *ny = &planes->ny[first];
	const int16_t *nz = &planes->nz[first], *d = &planes->d[first];
	uint8_t above[EDGE_BLOCK] = {0};
	int16_t near = 0;
	/* Loops apart, each over values of one width. */
	for (int i = 0; i < count; i++)
		sums[i] = (int16_t)(upper_half(nx[i], test->x[i]) + upper_half(ny[i], test->y[i]) +
				    upper_half(nz[i], test->z[i]) + upper_half(d[i], test->d[i]));
	for (int i = 0; i < count; i++)
		near |= (int16_t)(sums[i] < SURELY_FACES && sums[i] > SURELY_NOT);
	for (int i = 0; i < count; i++)
		above[i] = sums[i] >= SURELY_FACES;
	*unsure = near != 0;
	return pack_bytes(above);
}

static int block_size(const struct caster *caster, size_t b)
{
	size_t left = caster->triangle_count - b * EDGE_BLOCK;
	return left < EDGE_BLOCK ? (int)left : EDGE_BLOCK;
}

static inline uint64_t facing_word(
	const struct caster *caster, size_t b, const struct plane_test *test, const float light[4])
{
	size_t first = b * EDGE_BLOCK;
	int count = block_size(caster, b);
	int16_t sums[EDGE_BLOCK];
	bool unsure;
	/* The constant count is what lets a compiler unroll it into vectors. */
	uint64_t word =
		count == EDGE_BLOCK
			? test_planes(&caster->planes, first, EDGE_BLOCK, test, sums, &unsure)
			: test_planes(&caster->planes, first, count, test, sums, &unsure);
	if (!unsure)
		return word;
	for (int i = 0; i < count; i++)
		if (sums[i] < SURELY_FACES && sums[i] > SURELY_NOT)
			word |= (uint64_t)faces(caster, first + (size_t)i, light) << i;
	return word;
}

static uint64_t word_of_side(const struct caster *caster, size_t b, uint8_t side)
{
	return side == CONE_FACES ? UINT64_MAX >> (EDGE_BLOCK - block_size(caster, b)) : 0;
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
			facing[b] = side != CONE_MIXED ? word_of_side(caster, b, side)
						       : facing_word(caster, b, &test, light);
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

#define LINKS_MAX (3 * EDGE_BLOCK)

/* Records whose outcomes fit one word. */
#define RECORDS_AT_ONCE 64

/* The facing of a block's triangles, one byte for each of their corners. */
struct corner_facing {
	uint8_t bytes[3 * EDGE_BLOCK];
};

static inline void spread_bits(uint64_t word, struct corner_facing *facing)
{
	uint8_t *bytes = facing->bytes;
	for (int i = 0; i < EDGE_BLOCK; i += 8) {
		/* Bit j of the eight is kept in byte j alone, and then carried to its top. */
		uint64_t eight = (word >> i & 0xff) * UINT64_C(0x0101010101010101);
		eight &= UINT64_C(0x8040201008040201);
		eight = (eight + UINT64_C(0x7f7f7f7f7f7f7f7f)) >> 7 & UINT64_C(0x0101010101010101);
		for (int k = 0; k < 3; k++)
			for (int j = 0; j < 8; j++)
				bytes[k * EDGE_BLOCK + i + j] = (uint8_t)(eight >> 8 * j);
	}
}

/* Which of some records have triangles that differ: the first one's bit is the highest. There is no
 * branch on each, which no processor could predict. count: 1 to RECORDS_AT_ONCE */
static inline uint64_t differ_near(const struct corner_facing *facing,
	const uint8_t *restrict corners, const uint8_t *restrict places, size_t count)
{
	uint64_t differ = 0;
	for (size_t i = 0; i < count; i++)
		differ = 2 * differ + (facing->bytes[corners[i]] ^ facing->bytes[places[i]]);
	return differ << (RECORDS_AT_ONCE - count);
}

/* across: the facing of the blocks that the records lead to. */
static inline uint64_t differ_far(const struct corner_facing *facing, const uint64_t *across,
	const struct edge_table *table, size_t first, size_t count)
{
	const uint8_t *restrict corners = &table->far_corners[first];
	const uint8_t *restrict places = &table->far_places[first];
	const uint8_t *restrict links = &table->far_links[first];
	uint64_t differ = 0;
	for (size_t i = 0; i < count; i++)
		differ = 2 * differ +
			 ((facing->bytes[corners[i]] ^ across[links[i]] >> places[i]) & 1);
	return differ << (RECORDS_AT_ONCE - count);
}

/* Which way round depends on the facing without a branch, which no processor could predict. */
static inline struct silhouette_edge edge_at(
	const uint32_t *indices, uint64_t facing, uint8_t corner)
{
	unsigned t = corner % EDGE_BLOCK, k = corner / EDGE_BLOCK;
	const uint32_t *corners = &indices[3 * t];
	uint32_t from = corners[k], to = corners[(0x9u >> 2 * k) % 4];
	uint32_t swap = (from ^ to) & ((uint32_t)(facing >> t & 1) - 1);
	return (struct silhouette_edge){from ^ swap, to ^ swap};
}

/* Fills across with the facing of the blocks that far records lead to, and of none. Returns a word
 * with a bit set if one of them is not `own` throughout. */
static inline uint64_t look_across(const uint64_t *facing, struct edge_block block,
	const uint32_t *links, uint64_t own, uint64_t across[LINKS_MAX + 1])
{
	uint64_t differs = block.open ? own : 0;
	for (unsigned i = 0; i < block.link_count; i++) {
		across[i] = facing[links[i]];
		differs |= across[i] ^ own;
	}
	across[block.link_count] = 0;
	return differs;
}

/* Where edges go. */
struct edge_output {
	struct silhouette_edge *edges;
	size_t count, capacity;
};

/* A block that is searched. */
struct block_search {
	const uint32_t *indices;
	uint64_t facing;
	struct edge_output *output;
};

static inline void write_edge(const struct block_search *search, uint8_t corner)
{
	struct edge_output *output = search->output;
	if (output->count < output->capacity)
		output->edges[output->count] = edge_at(search->indices, search->facing, corner);
	output->count++;
}

static inline void write_next(const struct block_search *search, const struct edge_block *block)
{
	uint64_t facing = search->facing, differ = (facing ^ facing >> 1) & block->next;
	for (; differ != 0; differ &= differ - 1)
		write_edge(search, edge_block_corner(block, (unsigned)__builtin_ctzll(differ)));
}

static inline void write_records(
	const struct block_search *search, const uint8_t *corners, uint64_t differ)
{
	while (differ != 0) {
		int i = __builtin_clzll(differ);
		differ ^= UINT64_C(1) << (RECORDS_AT_ONCE - 1 - i);
		write_edge(search, corners[i]);
	}
}

static inline size_t at_once(size_t count)
{
	return count < RECORDS_AT_ONCE ? count : RECORDS_AT_ONCE;
}

/* skips: records are passed over where their block's facing and its links' say enough. */
static inline void find_in_block(const struct caster *caster, const uint64_t *facing, size_t b,
	struct edge_reader at, bool skips, struct edge_output *output)
{
	const struct edge_table *table = &caster->edges;
	const struct edge_block *block = &table->blocks[b];
	struct block_search search = {&caster->indices[3 * b * EDGE_BLOCK], facing[b], output};
	struct corner_facing bytes;
	uint64_t own = facing[b], across[LINKS_MAX + 1];
	bool uniform = skips && (own == 0 || own == UINT64_MAX);
	uint64_t differs = look_across(facing, *block, &table->links[at.link], own, across);
	if (uniform && differs == 0)
		return;
	spread_bits(own, &bytes);
	write_next(&search, block);
	for (size_t i = 0, n; !uniform && i < block->near_count; i += n) {
		const uint8_t *corners = &table->near_corners[at.near + i];
		n = at_once(block->near_count - i);
		write_records(&search, corners,
			differ_near(&bytes, corners, &table->near_places[at.near + i], n));
	}
	for (size_t i = 0, n; i < block->far_count; i += n) {
		n = at_once(block->far_count - i);
		write_records(&search, &table->far_corners[at.far + i],
			differ_far(&bytes, across, table, at.far + i, n));
	}
}

static inline size_t find_edges(const struct caster *caster, const uint64_t *facing, bool skips,
	struct silhouette_edge *edges, size_t capacity)
{
	struct edge_output output = {edges, 0, capacity};
	struct edge_reader at = {0};
	size_t blocks = edge_table_blocks(&caster->edges);
	for (size_t b = 0; b < blocks; b++) {
		find_in_block(caster, facing, b, at, skips, &output);
		edge_reader_skip(&at, caster->edges.blocks[b]);
	}
	return output.count;
}

size_t silhouette_find(const struct caster *caster, const uint64_t *facing,
	struct silhouette_edge *edges, size_t capacity)
{
	return find_edges(caster, facing, true, edges, capacity);
}

size_t silhouette_find_all(const struct caster *caster, const uint64_t *facing,
	struct silhouette_edge *edges, size_t capacity)
{
	return find_edges(caster, facing, false, edges, capacity);
}
