/* SPDX-License-Identifier: MIT */
#include "geom/hollows.h"
#include "base/array.h"
#include "geom/face.h"
#include <math.h>
#include <stdlib.h>

/* Of an angle: what is less hollow hides little from what lies in it. */
#define HOLLOW_SINE 0.05

struct search {
	const float (*positions)[3];
	const uint32_t *indices;
	size_t closed_count;
};

static uint32_t vertex_after(const uint32_t *indices, size_t corner)
{
	return indices[corner % 3 == 2 ? corner - 2 : corner + 1];
}

/* Whether vertex `far` is before the plane of the triangle that a corner is of. */
static bool rises(const struct search *search, size_t corner, uint32_t far)
{
	const uint32_t *of = &search->indices[corner - corner % 3];
	const float *from = search->positions[search->indices[corner]];
	double normal[3], height = 0.0, area = 0.0, length = 0.0;
	face_normal(search->positions[of[0]], search->positions[of[1]], search->positions[of[2]],
		normal);
	for (int i = 0; i < 3; i++) {
		double along = (double)search->positions[far][i] - from[i];
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

/* Whether the edge of a record is hollow, as both its triangles are seen: pair[0] from the owner.
 */
static bool is_hollow(
	const struct search *search, const struct edge_record *record, struct hollow pair[2])
{
	size_t owner = record->corner / 3;
	if (record->neighbour >= search->closed_count || owner >= search->closed_count)
		return false;
	uint32_t k = corner_beside(search, record->corner, record->neighbour);
	if (k == 3)
		return false;
	uint32_t beside = 3 * record->neighbour + k;
	pair[0] = (struct hollow){(uint32_t)owner, beside};
	pair[1] = (struct hollow){record->neighbour, (uint32_t)record->corner};
	uint32_t far = search->indices[3 * record->neighbour + (k + 2) % 3];
	return rises(search, record->corner, far);
}

/* Writes them in the order of their triangles, whose counts become where theirs begin, and end. */
static void sort(struct hollows *hollows, const struct search *search, uint32_t *places,
	const struct edge_record *records, size_t count)
{
	struct hollow pair[2];
	uint32_t sum = 0;
	for (size_t t = 0; t < search->closed_count; t++) {
		uint32_t of_triangle = places[t];
		places[t] = sum;
		sum += of_triangle;
		hollows->ends[t / EDGE_BLOCK] = sum;
	}
	for (size_t i = 0; i < count; i++)
		for (int side = 0; is_hollow(search, &records[i], pair) && side < 2; side++)
			hollows->of[places[pair[side].triangle]++] = pair[side];
}

/* Counts those of each triangle. */
static size_t count_all(const struct search *search, uint32_t *counts,
	const struct edge_record *records, size_t count)
{
	struct hollow pair[2];
	size_t sum = 0;
	for (size_t i = 0; i < count; i++)
		for (int side = 0; is_hollow(search, &records[i], pair) && side < 2; side++) {
			counts[pair[side].triangle]++;
			sum++;
		}
	return sum;
}

bool hollows_init(struct hollows *hollows, const float (*positions)[3], const uint32_t *indices,
	const struct edge_table *edges, size_t closed_count)
{
	struct search search = {positions, indices, closed_count};
	size_t count = edge_table_records(edges);
	struct edge_record *records = array_alloc(count, sizeof(*records));
	uint32_t *places = array_zalloc(closed_count, sizeof(*places));
	*hollows = (struct hollows){0};
	bool made = records != NULL && places != NULL;
	if (made) {
		edge_table_decode(edges, records);
		hollows->count = count_all(&search, places, records, count);
		hollows->of = array_alloc(hollows->count, sizeof(*hollows->of));
		hollows->block_count = (closed_count + EDGE_BLOCK - 1) / EDGE_BLOCK;
		hollows->ends = array_alloc(hollows->block_count, sizeof(*hollows->ends));
		made = hollows->of != NULL && hollows->ends != NULL;
	}
	if (made)
		sort(hollows, &search, places, records, count);
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
