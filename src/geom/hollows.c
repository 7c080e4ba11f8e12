/* SPDX-License-Identifier: MIT */
#include "geom/hollows.h"
#include "base/array.h"
#include "geom/face.h"
#include <math.h>
#include <stdlib.h>

/* Of an angle: what is less hollow hides little from what lies in it. */
#define HOLLOW_SINE 0.05

struct search {
	const float (*positions)[3]; /* NULL: all may rise */
	const uint32_t *indices;
	size_t closed_count;
	const struct edge_record *records; /* [count] */
	size_t count;
};

static uint32_t vertex_after(const uint32_t *indices, size_t corner)
{
	return indices[corner % 3 == 2 ? corner - 2 : corner + 1];
}

bool hollow_rises(const struct hollow *hollow, const float (*positions)[3], const uint32_t *indices)
{
	const uint32_t *of = &indices[3 * (size_t)hollow->triangle];
	const uint32_t *beside = &indices[hollow->corner - hollow->corner % 3];
	const float *from = positions[vertex_after(indices, hollow->corner)];
	const float *far = positions[beside[(hollow->corner + 2) % 3]];
	double normal[3], height = 0.0, area = 0.0, length = 0.0;
	face_normal(positions[of[0]], positions[of[1]], positions[of[2]], normal);
	for (int i = 0; i < 3; i++) {
		double along = (double)far[i] - from[i];
		height += normal[i] * along;
		area += normal[i] * normal[i];
		length += along * along;
	}
	return height > HOLLOW_SINE * sqrt(area * length);
}

/* The corner of a triangle from which its edge runs back along that of another's corner; 3: none.
 */
static uint32_t corner_beside(const struct search *search, size_t corner, uint32_t triangle)
{
	uint32_t from = search->indices[corner], to = vertex_after(search->indices, corner);
	for (uint32_t k = 0; k < 3; k++)
		if (search->indices[3 * triangle + k] == to &&
			vertex_after(search->indices, 3 * (size_t)triangle + k) == from)
			return k;
	return 3;
}

/* Both triangles of a record, each with the other beside it, but for those that do not rise;
 * returns how many. */
static int hollows_of(const struct search *search, size_t record, struct hollow pair[2])
{
	size_t corner = search->records[record].corner;
	uint32_t owner = (uint32_t)(corner / 3), neighbour = search->records[record].neighbour;
	if (neighbour >= search->closed_count || owner >= search->closed_count)
		return 0;
	uint32_t k = corner_beside(search, corner, neighbour);
	if (k == 3)
		return 0;
	const struct hollow both[2] = {{owner, 3 * neighbour + k}, {neighbour, (uint32_t)corner}};
	int count = 0;
	for (int side = 0; side < 2; side++)
		if (search->positions == NULL ||
			hollow_rises(&both[side], search->positions, search->indices))
			pair[count++] = both[side];
	return count;
}

/* Writes them in the order of their triangles, whose counts become where theirs begin, and end. */
static void sort(struct hollows *hollows, const struct search *search, uint32_t *places)
{
	struct hollow pair[2];
	uint32_t sum = 0;
	for (size_t t = 0; t < search->closed_count; t++) {
		uint32_t of_triangle = places[t];
		places[t] = sum;
		sum += of_triangle;
		hollows->ends[t / EDGE_BLOCK] = sum;
	}
	for (size_t i = 0; i < search->count; i++)
		for (int side = hollows_of(search, i, pair); side-- > 0;)
			hollows->of[places[pair[side].triangle]++] = pair[side];
}

/* Counts those of each triangle. */
static size_t count_all(const struct search *search, uint32_t *counts)
{
	struct hollow pair[2];
	size_t sum = 0;
	for (size_t i = 0; i < search->count; i++)
		for (int side = hollows_of(search, i, pair); side-- > 0; sum++)
			counts[pair[side].triangle]++;
	return sum;
}

bool hollows_init(struct hollows *hollows, const float (*positions)[3], const uint32_t *indices,
	const struct edge_table *edges, size_t closed_count)
{
	size_t count = edge_table_records(edges);
	struct edge_record *records = array_alloc(count, sizeof(*records));
	uint32_t *places = array_zalloc(closed_count, sizeof(*places));
	struct search search = {positions, indices, closed_count, records, count};
	*hollows = (struct hollows){.moving = positions == NULL};
	bool made = records != NULL && places != NULL;
	if (made) {
		edge_table_decode(edges, records);
		hollows->count = count_all(&search, places);
		hollows->of = array_alloc(hollows->count, sizeof(*hollows->of));
		hollows->block_count = (closed_count + EDGE_BLOCK - 1) / EDGE_BLOCK;
		hollows->ends = array_alloc(hollows->block_count, sizeof(*hollows->ends));
		made = hollows->of != NULL && hollows->ends != NULL;
	}
	if (made)
		sort(hollows, &search, places);
	free(records);
	free(places);
	return made;
}

void hollows_finish(struct hollows *hollows)
{
	free(hollows->of);
	free(hollows->ends);
	*hollows = (struct hollows){0};
}

size_t hollows_bytes(const struct hollows *hollows)
{
	return hollows->count * sizeof(*hollows->of) +
	       hollows->block_count * sizeof(*hollows->ends);
}
