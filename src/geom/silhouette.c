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

/* Half-edges on the silhouette, of a set of blocks: the corner within its block, and the block
 * within the set times 256. They are gathered first and then written in one go, because triangles
 * are far apart in memory: a processor waits for many of them at once only where there is nothing
 * to mispredict between. */
struct corner_list {
	size_t count;
	uint16_t corners[1024 + 3 * EDGE_BLOCK];
};

#define CORNERS_FULL 1024

static inline void list_next(
	struct corner_list *list, const struct edge_block *block, uint64_t facing, uint16_t tag)
{
	uint64_t differ = (facing ^ facing >> 1) & block->next;
	for (; differ != 0; differ &= differ - 1)
		list->corners[list->count++] =
			tag | edge_block_corner(block, (unsigned)__builtin_ctzll(differ));
}

/* Each corner is written, and kept if it counts: there is no branch, which no processor could
 * predict. */
static inline void list_near(struct corner_list *list, const struct edge_table *table,
	const struct edge_block *block, uint64_t facing, uint16_t tag)
{
	const uint8_t *corners = &table->near_corners[block->near];
	const uint8_t *places = &table->near_places[block->near];
	uint16_t *restrict end = &list->corners[list->count];
	for (size_t i = 0; i < block->near_count; i++) {
		*end = tag | corners[i];
		end += (facing >> corners[i] % EDGE_BLOCK ^ facing >> places[i]) & 1;
	}
	list->count = (size_t)(end - list->corners);
}

static inline void list_far(struct corner_list *list, const struct edge_table *table,
	const struct edge_block *block, const uint64_t *facing, uint64_t own, uint16_t tag)
{
	const uint8_t *corners = &table->far_corners[block->far];
	const uint8_t *places = &table->far_places[block->far];
	const uint8_t *links = &table->far_links[block->far];
	uint16_t *restrict end = &list->corners[list->count];
	uint64_t across[LINKS_MAX + 1];
	for (unsigned i = 0; i < block->link_count; i++)
		across[i] = facing[table->links[block->link + i]];
	across[block->link_count] = 0;
	for (size_t i = 0; i < block->far_count; i++) {
		*end = tag | corners[i];
		end += (own >> corners[i] % EDGE_BLOCK ^ across[links[i]] >> places[i]) & 1;
	}
	list->count = (size_t)(end - list->corners);
}

static inline bool is_uniform(uint64_t facing)
{
	return facing + 1 <= 1;
}

/* A set of blocks that is searched. */
struct set_search {
	const struct caster *caster;
	const uint64_t *facing;
	size_t first; /* block */
};

/* Where edges go. */
struct edge_output {
	struct silhouette_edge *edges;
	size_t count, capacity;
};

/* skips: records within a block on one side of the light are passed over. */
static inline void list_block(
	const struct set_search *search, unsigned b, bool skips, struct corner_list *list)
{
	const struct edge_table *table = &search->caster->edges;
	const struct edge_block *block = &table->blocks[search->first + b];
	uint64_t own = search->facing[search->first + b];
	uint16_t tag = (uint16_t)(b << 8);
	if (!skips || !is_uniform(own)) {
		list_next(list, block, own, tag);
		list_near(list, table, block, own, tag);
	}
	list_far(list, table, block, search->facing, own, tag);
}

/* Which way round depends on the facing without a branch. */
static inline struct silhouette_edge edge_at(const struct set_search *search, uint16_t corner)
{
	unsigned t = corner % EDGE_BLOCK, k = corner / EDGE_BLOCK % 4;
	size_t b = search->first + corner / 256;
	const uint32_t *corners = &search->caster->indices[3 * (b * EDGE_BLOCK + t)];
	uint32_t from = corners[k], to = corners[(0x9u >> 2 * k) % 4];
	uint32_t swap = (from ^ to) & ((uint32_t)(search->facing[b] >> t & 1) - 1);
	return (struct silhouette_edge){from ^ swap, to ^ swap};
}

static size_t smaller(size_t a, size_t b)
{
	return a < b ? a : b;
}

static void write_edges(
	const struct set_search *search, struct corner_list *list, struct edge_output *output)
{
	size_t left = output->capacity - smaller(output->count, output->capacity);
	size_t written = smaller(list->count, left);
	for (size_t i = 0; i < written; i++)
		output->edges[output->count + i] = edge_at(search, list->corners[i]);
	output->count += list->count;
	list->count = 0;
}

/* blocks: a bit for each of the set that is searched. */
static inline void find_in_set(
	const struct set_search *search, uint64_t blocks, bool skips, struct edge_output *output)
{
	struct corner_list list;
	list.count = 0;
	for (; blocks != 0; blocks &= blocks - 1) {
		list_block(search, (unsigned)__builtin_ctzll(blocks), skips, &list);
		if (list.count >= CORNERS_FULL)
			write_edges(search, &list, output);
	}
	write_edges(search, &list, output);
}

/* A bit for each block of a set. */
static uint64_t set_of_blocks(const struct edge_table *table, size_t set)
{
	size_t left = edge_table_blocks(table) - set * EDGE_BLOCK_SET;
	return UINT64_MAX >> (EDGE_BLOCK_SET - smaller(left, EDGE_BLOCK_SET));
}

/* Those that may have edges: those that are not on one side of the light, and those of which a link
 * is not on theirs. */
static inline uint64_t blocks_to_search(
	const struct edge_table *table, const uint64_t *facing, size_t set)
{
	size_t first = set * EDGE_BLOCK_SET;
	size_t count = smaller(edge_table_blocks(table) - first, EDGE_BLOCK_SET);
	const struct edge_block *last = &table->blocks[first + count - 1];
	uint64_t mixed = 0, lit = 0;
	for (size_t i = 0; i < count; i++) {
		mixed |= (uint64_t)!is_uniform(facing[first + i]) << i;
		lit |= (facing[first + i] & 1) << i;
	}
	uint64_t search = mixed | (lit & table->open[set]);
	for (size_t i = table->blocks[first].link; i < last->link + last->link_count; i++) {
		uint8_t owner = table->link_owners[i];
		search |= (uint64_t)(facing[first + owner] != facing[table->links[i]]) << owner;
	}
	return search;
}

size_t silhouette_find(const struct caster *caster, const uint64_t *facing,
	struct silhouette_edge *edges, size_t capacity)
{
	struct edge_output output = {edges, 0, capacity};
	for (size_t set = 0; set < edge_table_sets(&caster->edges); set++) {
		struct set_search search = {caster, facing, set * EDGE_BLOCK_SET};
		find_in_set(&search, blocks_to_search(&caster->edges, facing, set), true, &output);
	}
	return output.count;
}

size_t silhouette_find_all(const struct caster *caster, const uint64_t *facing,
	struct silhouette_edge *edges, size_t capacity)
{
	struct edge_output output = {edges, 0, capacity};
	for (size_t set = 0; set < edge_table_sets(&caster->edges); set++) {
		struct set_search search = {caster, facing, set * EDGE_BLOCK_SET};
		find_in_set(&search, set_of_blocks(&caster->edges, set), false, &output);
	}
	return output.count;
}
