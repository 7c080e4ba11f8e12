/* SPDX-License-Identifier: MIT */
#include "geom/silhouette.h"
#include <math.h>
#include <string.h>

size_t facing_words(const struct caster *caster)
{
	return edge_table_blocks(&caster->edges);
}

/* A light as the quantised planes see it; all zero when they cannot. */
struct plane_test {
	int16_t x, y, z, d;
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
static struct plane_test plane_test_of(const struct face_planes *planes, const float light[4])
{
	double w = light[3];
	double m[3];
	for (int i = 0; i < 3; i++)
		m[i] = light[i] - w * planes->center[i];
	double length = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]) + fabs(w) * planes->radius;
	/* No length: neither light nor mesh has an extent, so that nothing faces. */
	if ((w != 0.0 && fabs(w) != 1.0) || length == 0.0)
		return (struct plane_test){0};
	double scale = FACE_PLANE_ONE / length;
	return (struct plane_test){
		.x = (int16_t)lrint(m[0] * scale),
		.y = (int16_t)lrint(m[1] * scale),
		.z = (int16_t)lrint(m[2] * scale),
		.d = (int16_t)lrint(-w * planes->radius * scale),
	};
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
	struct plane_test test, int16_t sums[EDGE_BLOCK], bool *unsure)
{
	const int16_t *nx = &planes->nx[first], *ny = &planes->ny[first];
	const int16_t *nz = &planes->nz[first], *d = &planes->d[first];
	uint8_t above[EDGE_BLOCK] = {0};
	uint8_t near = 0;
	for (int i = 0; i < count; i++) {
		int16_t sum = (int16_t)(upper_half(nx[i], test.x) + upper_half(ny[i], test.y) +
					upper_half(nz[i], test.z) + upper_half(d[i], test.d));
		sums[i] = sum;
		above[i] = sum >= SURELY_FACES;
		near |= (uint8_t)((sum < SURELY_FACES) & (sum > SURELY_NOT));
	}
	*unsure = near != 0;
	return pack_bytes(above);
}

/* A light, in all ways that it is looked at. */
struct facing_test {
	const float *light;
	struct plane_test planes;
	struct cone_light cones;
};

static int block_size(const struct caster *caster, size_t b)
{
	size_t left = caster->triangle_count - b * EDGE_BLOCK;
	return left < EDGE_BLOCK ? (int)left : EDGE_BLOCK;
}

static uint64_t facing_word(const struct caster *caster, size_t b, const struct facing_test *test)
{
	size_t first = b * EDGE_BLOCK;
	int count = block_size(caster, b);
	int16_t sums[EDGE_BLOCK];
	bool unsure;
	/* The constant count is what lets a compiler unroll it into vectors. */
	uint64_t word = count == EDGE_BLOCK ? test_planes(&caster->planes, first, EDGE_BLOCK,
						      test->planes, sums, &unsure)
					    : test_planes(&caster->planes, first, count,
						      test->planes, sums, &unsure);
	if (!unsure)
		return word;
	for (int i = 0; i < count; i++)
		if (sums[i] < SURELY_FACES && sums[i] > SURELY_NOT)
			word |= (uint64_t)faces(caster, first + (size_t)i, test->light) << i;
	return word;
}

/* False, and facing cleared, for a light that is not finite. */
static bool facing_test_init(struct facing_test *test, const struct caster *caster,
	const float light[4], uint64_t *facing)
{
	if (!isfinite(light[0]) || !isfinite(light[1]) || !isfinite(light[2]) ||
		!isfinite(light[3])) {
		memset(facing, 0, facing_words(caster) * sizeof(*facing));
		return false;
	}
	*test = (struct facing_test){
		.light = light, .planes = plane_test_of(&caster->planes, light)};
	return true;
}

static void find_all(const struct caster *caster, const struct facing_test *test, uint64_t *facing)
{
	for (size_t b = 0; b < facing_words(caster); b++)
		facing[b] = facing_word(caster, b, test);
}

void facing_find_all(const struct caster *caster, const float light[4], uint64_t *facing)
{
	struct facing_test test;
	if (facing_test_init(&test, caster, light, facing))
		find_all(caster, &test, facing);
}

void facing_find(const struct caster *caster, const float light[4], uint64_t *facing)
{
	struct facing_test test;
	if (!facing_test_init(&test, caster, light, facing))
		return;
	if (!cone_light_of(&caster->planes, light, &test.cones) || caster->cones.count == 0) {
		find_all(caster, &test, facing);
		return;
	}
	size_t blocks = facing_words(caster);
	for (size_t first = 0; first < blocks; first += CONE_BATCH) {
		uint8_t sides[CONE_BATCH];
		face_cones_test(&caster->cones, first, &test.cones, sides);
		for (size_t b = first; b < blocks && b < first + CONE_BATCH; b++)
			facing[b] = sides[b - first] == CONE_AVERTS ? 0
				    : sides[b - first] == CONE_FACES
					    ? UINT64_MAX >> (EDGE_BLOCK - block_size(caster, b))
					    : facing_word(caster, b, &test);
	}
}

/* Room for all records of a block, and for one that is written before it is known to count. */
#define HITS_MAX (3 * EDGE_BLOCK + 1)
#define LINKS_MAX (3 * EDGE_BLOCK)

/* One byte per bit, 1 where it is set. */
static inline void spread_bits(uint64_t word, uint8_t bytes[EDGE_BLOCK])
{
	for (int i = 0; i < EDGE_BLOCK; i += 8) {
		/* Bit j of the eight is kept in byte j alone, and then carried to its top. */
		uint64_t eight = (word >> i & 0xff) * UINT64_C(0x0101010101010101);
		eight &= UINT64_C(0x8040201008040201);
		eight = (eight + UINT64_C(0x7f7f7f7f7f7f7f7f)) >> 7 & UINT64_C(0x0101010101010101);
		for (int j = 0; j < 8; j++)
			bytes[i + j] = (uint8_t)(eight >> 8 * j);
	}
}

/* Lists the owners' corners of records whose triangles differ, without a branch on whether they do,
 * which no processor can predict. Returns how many. */
static inline unsigned find_near(const uint8_t facing[EDGE_BLOCK], const uint16_t *restrict near,
	unsigned count, uint8_t *restrict hits)
{
	unsigned found = 0;
	for (unsigned i = 0; i < count; i++) {
		unsigned record = near[i];
		hits[found] = (uint8_t)record;
		found += facing[record % EDGE_BLOCK] ^ facing[record / 256];
	}
	return found;
}

/* across: the facing of the blocks that the records lead to. */
static inline unsigned find_far(const uint8_t facing[EDGE_BLOCK], const uint64_t *across,
	const uint8_t *restrict corners, const uint16_t *restrict ends, unsigned count,
	uint8_t *restrict hits)
{
	unsigned found = 0;
	for (unsigned i = 0; i < count; i++) {
		unsigned corner = corners[i], end = ends[i];
		hits[found] = (uint8_t)corner;
		found += facing[corner % EDGE_BLOCK] ^
			 (unsigned)(across[end / 256] >> end % EDGE_BLOCK & 1);
	}
	return found;
}

static inline struct silhouette_edge edge_at(
	const uint32_t *indices, uint64_t facing, uint32_t first, uint8_t corner)
{
	unsigned t = corner % EDGE_BLOCK, k = corner / EDGE_BLOCK;
	unsigned next = k == 2 ? 0 : k + 1;
	bool own = facing >> t & 1;
	const uint32_t *corners = &indices[3 * ((size_t)first + t)];
	return (struct silhouette_edge){corners[own ? k : next], corners[own ? next : k]};
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

/* Reads the records of one block after the other. */
struct edge_reader {
	const uint16_t *near;
	const uint8_t *corners;
	const uint16_t *ends;
	const uint32_t *links;
};

static struct edge_reader edge_reader_of(const struct edge_table *table)
{
	return (struct edge_reader){table->near, table->far_corners, table->far_ends, table->links};
}

static inline void skip_block(struct edge_reader *reader, struct edge_block block)
{
	reader->near += block.near_count;
	reader->corners += block.far_count;
	reader->ends += block.far_count;
	reader->links += block.link_count;
}

/* The corners of all records of block b whose triangles differ. */
static inline unsigned find_in_block(const struct edge_table *table, const uint64_t *facing,
	size_t b, const struct edge_reader *reader, bool skips, uint8_t hits[HITS_MAX])
{
	struct edge_block block = table->blocks[b];
	uint64_t own = facing[b], across[LINKS_MAX + 1];
	bool uniform = skips && (own == 0 || own == UINT64_MAX);
	uint64_t differs = look_across(facing, block, reader->links, own, across);
	if (uniform && differs == 0)
		return 0;
	uint8_t bytes[EDGE_BLOCK];
	spread_bits(own, bytes);
	unsigned found = uniform ? 0 : find_near(bytes, reader->near, block.near_count, hits);
	return found + find_far(bytes, across, reader->corners, reader->ends, block.far_count,
			       &hits[found]);
}

static void write_edges(const struct caster *caster, uint64_t facing, size_t b, const uint8_t *hits,
	size_t count, struct silhouette_edge *edges)
{
	for (size_t i = 0; i < count; i++)
		edges[i] = edge_at(caster->indices, facing, (uint32_t)(b * EDGE_BLOCK), hits[i]);
}

static inline size_t find_edges(const struct caster *caster, const uint64_t *facing, bool skips,
	struct silhouette_edge *edges, size_t capacity)
{
	const struct edge_table *table = &caster->edges;
	struct edge_reader reader = edge_reader_of(table);
	size_t count = 0;
	for (size_t b = 0; b < edge_table_blocks(table); b++) {
		uint8_t hits[HITS_MAX];
		size_t found = find_in_block(table, facing, b, &reader, skips, hits);
		size_t room = count < capacity ? capacity - count : 0;
		write_edges(caster, facing[b], b, hits, found < room ? found : room, edges + count);
		count += found;
		skip_block(&reader, table->blocks[b]);
	}
	return count;
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
