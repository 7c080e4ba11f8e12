/* SPDX-License-Identifier: MIT */
#include "geom/orientation.h"
#include "base/array.h"
#include "geom/face.h"
#include "geom/repeats.h"
#include <stdlib.h>
#include <string.h>

/* How a triangle continues over a side: the other triangle's number, and above it whether both run
 * through their edge the same way. Triangles are below 2^31 - 1, so that none looks like NONE. */
#define NONE UINT32_MAX
#define SAME_WAY (UINT32_C(1) << 31)

struct part {
	size_t first, count; /* in parts.order */
	bool orientable;
	bool open;
};

/* Working memory. */
struct parts {
	size_t triangle_count;
	struct sides sides;
	uint32_t *across;  /* [3 * triangle_count]: per corner, as above, or NONE */
	uint32_t *order;   /* [triangle_count]: triangles, part by part */
	uint32_t *part_of; /* [triangle_count] */
	bool *turned;      /* [triangle_count] */
	size_t part_count;
	struct part *parts; /* [triangle_count] */
	int32_t *balance;   /* [triangle_count], of each part: zero between uses */
};

static bool parts_init(struct parts *parts, size_t triangle_count)
{
	parts->triangle_count = triangle_count;
	parts->across = array_alloc(triangle_count, 3 * sizeof(*parts->across));
	parts->order = array_alloc(triangle_count, sizeof(*parts->order));
	parts->part_of = array_alloc(triangle_count, sizeof(*parts->part_of));
	parts->turned = array_zalloc(triangle_count, sizeof(*parts->turned));
	parts->parts = array_alloc(triangle_count, sizeof(*parts->parts));
	parts->balance = array_zalloc(triangle_count, sizeof(*parts->balance));
	return parts->across != NULL && parts->order != NULL && parts->part_of != NULL &&
	       parts->turned != NULL && parts->parts != NULL && parts->balance != NULL;
}

static void parts_finish(struct parts *parts)
{
	sides_finish(&parts->sides);
	free(parts->across);
	free(parts->order);
	free(parts->part_of);
	free(parts->turned);
	free(parts->parts);
	free(parts->balance);
}

/* Fills parts->sides: those of what is left. */
static bool drop_repeated(struct parts *parts, struct orientation *found, size_t vertex_count,
	uint32_t *indices, size_t *triangle_count)
{
	size_t all = *triangle_count;
	if (!sides_init(&parts->sides, indices, all, vertex_count))
		return false;
	found->edges = sides_count_edges(&parts->sides);
	if (!repeats_drop(&parts->sides, vertex_count, indices, triangle_count))
		return false;
	found->repeated = all - *triangle_count;
	if (found->repeated == 0)
		return true;
	sides_finish(&parts->sides);
	return sides_init(&parts->sides, indices, *triangle_count, vertex_count);
}

static void join_neighbours(struct parts *parts)
{
	const struct sides *sides = &parts->sides;
	for (size_t c = 0; c < 3 * parts->triangle_count; c++)
		parts->across[c] = NONE;
	for (size_t begin = 0, count; begin < sides->count; begin += count) {
		const struct side *side = &sides->items[begin];
		count = sides_at_edge(sides, begin);
		if (count != 2)
			continue;
		uint32_t same = side[0].reversed == side[1].reversed ? SAME_WAY : 0;
		parts->across[side_corner(&side[0])] = side[1].triangle | same;
		parts->across[side_corner(&side[1])] = side[0].triangle | same;
	}
}

/* Appends what continues the triangle to the part, oriented as the triangle is. */
static void spread(struct parts *parts, struct part *part, uint32_t triangle)
{
	for (size_t k = 0; k < 3; k++) {
		uint32_t link = parts->across[3 * (size_t)triangle + k];
		if (link == NONE)
			continue;
		uint32_t other = link & ~SAME_WAY;
		bool turned = parts->turned[triangle] != ((link & SAME_WAY) != 0);
		if (parts->part_of[other] == NONE) {
			parts->part_of[other] = parts->part_of[triangle];
			parts->turned[other] = turned;
			parts->order[part->first + part->count++] = other;
		} else if (parts->turned[other] != turned) {
			part->orientable = false;
		}
	}
}

static void gather_part(struct parts *parts, size_t first, uint32_t seed)
{
	struct part *part = &parts->parts[parts->part_count];
	*part = (struct part){.first = first, .count = 1, .orientable = true};
	parts->part_of[seed] = (uint32_t)parts->part_count++;
	parts->order[first] = seed;
	for (size_t i = 0; i < part->count; i++)
		spread(parts, part, parts->order[first + i]);
	if (part->orientable)
		return;
	for (size_t i = 0; i < part->count; i++)
		parts->turned[parts->order[first + i]] = false;
}

static void gather_parts(struct parts *parts)
{
	size_t placed = 0;
	for (size_t t = 0; t < parts->triangle_count; t++)
		parts->part_of[t] = NONE;
	for (size_t t = 0; t < parts->triangle_count; t++) {
		if (parts->part_of[t] != NONE)
			continue;
		gather_part(parts, placed, (uint32_t)t);
		placed += parts->parts[parts->part_count - 1].count;
	}
}

static void find_open(struct parts *parts)
{
	const struct sides *sides = &parts->sides;
	for (size_t begin = 0, count; begin < sides->count; begin += count) {
		const struct side *side = &sides->items[begin];
		count = sides_at_edge(sides, begin);
		for (size_t i = 0; i < count; i++) {
			uint32_t t = side[i].triangle;
			bool forwards = parts->turned[t] == (side[i].reversed != 0);
			parts->balance[parts->part_of[t]] += forwards ? 1 : -1;
		}
		for (size_t i = 0; i < count; i++) {
			uint32_t p = parts->part_of[side[i].triangle];
			parts->parts[p].open |= parts->balance[p] != 0;
		}
		for (size_t i = 0; i < count; i++)
			parts->balance[parts->part_of[side[i].triangle]] = 0;
	}
}

/* Six times what the part encloses, measured from a vertex of its own so that a mesh far from its
 * origin keeps its digits. */
static double volume_of(const struct parts *parts, const struct part *part,
	const float (*positions)[3], const uint32_t *indices)
{
	const float *origin = positions[indices[3 * (size_t)parts->order[part->first]]];
	double volume = 0.0;
	for (size_t i = part->first; i < part->first + part->count; i++) {
		size_t t = parts->order[i];
		const uint32_t *v = &indices[3 * t];
		double under =
			face_volume(positions[v[0]], positions[v[1]], positions[v[2]], origin);
		volume += parts->turned[t] ? -under : under;
	}
	return volume;
}

/* Which of its two orientations a part takes. */
static void choose_outside(struct parts *parts, const struct part *part,
	const float (*positions)[3], const uint32_t *indices)
{
	if (!part->orientable)
		return;
	size_t turned = 0;
	for (size_t i = part->first; i < part->first + part->count; i++)
		turned += parts->turned[parts->order[i]];
	double volume = part->open ? 0.0 : volume_of(parts, part, positions, indices);
	bool other = volume != 0.0 ? volume < 0.0 : turned > part->count - turned;
	if (!other)
		return;
	for (size_t i = part->first; i < part->first + part->count; i++)
		parts->turned[parts->order[i]] ^= true;
}

static bool has_sides(const uint32_t v[3])
{
	return v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
}

static void count_part(
	struct orientation *found, const struct parts *parts, const struct part *part)
{
	if (part->open)
		found->open_parts++;
	else
		found->closed_parts++;
	found->non_orientable_parts += !part->orientable;
	for (size_t i = part->first; i < part->first + part->count; i++)
		found->turned += parts->turned[parts->order[i]];
}

static void turn_triangles(const struct parts *parts, uint32_t *indices)
{
	for (size_t t = 0; t < parts->triangle_count; t++) {
		uint32_t *v = &indices[3 * t];
		if (parts->turned[t])
			memcpy(&v[1], (uint32_t[2]){v[2], v[1]}, 2 * sizeof(*v));
	}
}

/* Returns how many are before the open ones. across: room for all indices, no longer needed. */
static size_t move_open_last(const struct parts *parts, uint32_t *indices)
{
	size_t closed = 0, open = 0;
	for (size_t t = 0; t < parts->triangle_count; t++) {
		const uint32_t *v = &indices[3 * t];
		if (parts->parts[parts->part_of[t]].open)
			memcpy(&parts->across[3 * open++], v, 3 * sizeof(*v));
		else
			memmove(&indices[3 * closed++], v, 3 * sizeof(*v));
	}
	memcpy(&indices[3 * closed], parts->across, 3 * open * sizeof(*indices));
	return closed;
}

/* Leaves found->closed_count to the caller. */
static void orient_parts(struct parts *parts, struct orientation *found,
	const float (*positions)[3], const uint32_t *indices)
{
	join_neighbours(parts);
	gather_parts(parts);
	find_open(parts);
	for (size_t p = 0; p < parts->part_count; p++) {
		const struct part *part = &parts->parts[p];
		if (!has_sides(&indices[3 * (size_t)parts->order[part->first]]))
			continue;
		choose_outside(parts, part, positions, indices);
		count_part(found, parts, part);
	}
}

bool orientation_repair(struct orientation *found, const float (*positions)[3], size_t vertex_count,
	uint32_t *indices, size_t *triangle_count)
{
	struct parts parts = {0};
	*found = (struct orientation){0};
	bool ok = drop_repeated(&parts, found, vertex_count, indices, triangle_count) &&
		  parts_init(&parts, *triangle_count);
	if (ok) {
		orient_parts(&parts, found, positions, indices);
		turn_triangles(&parts, indices);
		found->closed_count = move_open_last(&parts, indices);
	}
	parts_finish(&parts);
	return ok;
}
