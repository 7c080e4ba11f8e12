/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_LISTS_H
#define SCENE_EDGE_LISTS_H

#include "scene/edge_cover.h"

/** A vertex of a chain of silhouette edges in the list of a tile; as a texture holds it, RGBA32F.
 */
struct chain_vertex {
	float x, y;  /* window coordinates of the light's screen, on the raster grid */
	float depth; /* window depth */
	float start; /* 0: an edge leads here from the vertex before, its sheet on the left as the
			light sees it (x right, y up). Else a chain starts here: 1 + a depth that
			nothing from here to the list's end is before (rounded down): receivers not
			behind that are done */
};

/** Edges by the tiles they concern. Zero is empty; memory is kept from one search to the next. */
struct edge_lists {
	struct chain_vertex *vertices; /* [vertex_count]: tile after tile; owned */
	uint32_t *first;               /* [tiles * tiles + 1]: of a tile's vertices; owned */
	size_t vertex_count;
	size_t edge_count; /* in all lists together */
	size_t dropped;    /* that there was no room for */
	/* Working memory; owned */
	uint16_t *entries;     /* tiles of one edge after the other */
	uint32_t *entry_ends;  /* of edges, by their first points */
	struct list_end *ends; /* [tiles * tiles] */
	struct chain_vertex *sorted;
	struct chain_run *order;
	size_t entry_count;
	size_t vertex_capacity, first_capacity, entry_capacity, entry_end_capacity, end_capacity,
		sorted_capacity, order_capacity;
};

/** Whether the lists fit. */
enum edge_lists_result { EDGE_LISTS_FULL, EDGE_LISTS_MADE, EDGE_LISTS_NO_MEMORY };

/**
 * Lists the edges of all chains. Within a list chains are in the order of their nearest points. If
 * all lists would have more than vertices_max vertices: FULL, or with `drop` lists of the edges
 * that are nearest to the light. step: of the raster grid, window coordinates.
 */
enum edge_lists_result edge_lists_make(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, float step, size_t vertices_max, bool drop);

void edge_lists_finish(struct edge_lists *lists);

/** Of memory. */
size_t edge_lists_bytes(const struct edge_lists *lists);

#endif
