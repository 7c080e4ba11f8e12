/* SPDX-License-Identifier: MIT */
#ifndef GEOM_LIT_TRIANGLES_H
#define GEOM_LIT_TRIANGLES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** Cells a side of the screen that shapes are found by, at most. */
#define LIT_CELLS_MAX 256

/** Of shapes, each as often as it is in a cell, and more often where it takes a closer look: some
 *  nanoseconds each. */
#define LIT_VISITS_MAX 131072

/** How a technique looks up what is on a light's screen, and what a map of that does to depths. */
struct lit_rule {
	double around; /* NDC, x or y: how far from a surface what is looked up for it may lie */
	/* NDC, x or y: what the surface's own slope is followed over towards the light before
	 * depths are compared, beyond that to where they are; below 0: it is not, so far. */
	double bias;
	double limit[2];    /* slope up to which it is: limit[0] + limit[1] d at window depth d */
	double near_to_far; /* of the light's frame: how window depth is linear depth */
};

/** What casts on a light's screen: casters and fins, in clip space. Zero is empty; memory is kept
 *  from one search to the next. */
struct lit_search {
	double (*vertices)[4];
	struct lit_shape *shapes;  /* triangles */
	struct lit_place *members; /* of each cell, row after row */
	uint32_t *starts;          /* of the cells' members; and where the last end */
	bool *sorted;              /* a cell's members, the nearest first: once they are needed */
	size_t vertex_count, vertex_capacity, shape_count, shape_capacity;
	size_t member_capacity, start_capacity, sorted_capacity;
	int shift; /* LIT_CELLS_MAX >> shift cells a side: fewer where shapes are large */
};

void lit_search_finish(struct lit_search *search);
size_t lit_search_bytes(const struct lit_search *search);

void lit_search_clear(struct lit_search *search);

/** Adds the triangles of a caster. object: any number that no other has. positions:
 *  [vertex_count][3]; indices: [index_count]. to_clip: column-major. False: out of memory. */
bool lit_search_add(struct lit_search *search, uint32_t object, const float (*positions)[3],
	size_t vertex_count, const uint32_t *indices, size_t index_count,
	const float to_clip[4][4]);

/** Adds a quad of a fin, NDC. False: out of memory. */
bool lit_search_add_fin(struct lit_search *search, const float corners[4][3]);

/** To be called once all is added. False: out of memory. */
bool lit_search_sort(struct lit_search *search);

/**
 * Whether nothing that has been added is in front of a triangle of one of the casters, as far as
 * what is looked up for it tells: neither on it nor, around it, where its bias does not make up for
 * that. Conservative. Also false of one that another triangle of the same caster touches, or
 * nearly: where two surfaces are at one depth, which of them is drawn first shows.
 *
 * triangle: three vertices, with the transform that the caster was added with. averted: no light
 * arrives at it, so that nothing matters but what touches it. visits: counted up by what it takes,
 * about LIT_VISITS_MAX at most: where that is not enough it is false.
 */
bool lit_search_is_lit(struct lit_search *search, uint32_t object, const float triangle[3][3],
	bool averted, const float to_clip[4][4], const struct lit_rule *rule, size_t *visits);

#endif
