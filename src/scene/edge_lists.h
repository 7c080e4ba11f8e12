/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_LISTS_H
#define SCENE_EDGE_LISTS_H

#include "scene/edge_cover.h"
#include "scene/edge_texel.h"

/** A point of a chain of silhouette edges. */
struct edge_vertex {
	float x, y;   /* window coordinates of the light's screen, on the raster grid */
	float depth;  /* window depth */
	float sheets; /* that end at the edge which leads here from the vertex before; 0: it is of
			 a grazing triangle, one sheet, but none that ways count */
};

/** Most edges of a run. */
#define EDGE_RUN_MAX 16

/** Steps of the screen's height and width that boxes are in. */
#define EDGE_BOX_STEPS 65536

/** Edges of a chain that follow each other, in the list of a tile; RGBA32UI. The sheet of each is
 * on its left as the light sees it (x right, y up). */
struct edge_run {
	uint32_t first_count; /* its first vertex, or texel, (24 bits) + edges << 24 */
	float start;          /* depth that nothing from here to the list's end is before */
	uint16_t min[2];      /* around the part on the screen, x and y: from min to max + 1 */
	uint16_t max[2];
};

static inline uint32_t edge_run_first(const struct edge_run *run)
{
	return run->first_count & 0xffffff;
}

static inline uint32_t edge_run_count(const struct edge_run *run)
{
	return run->first_count >> 24;
}

/** What becomes of a list. */
struct list_end {
	uint32_t last_edge;   /* 1 + the one that was listed last */
	uint32_t runs, edges; /* how many; once it is written, where it ends among those of all */
	float nearest;        /* depth of its edges */
};

/** Silhouette edges by the tiles they concern. Zero is empty; memory is kept from one search to the
 *  next. */
struct edge_lists {
	bool whole;                   /* each list has edges of its own */
	struct edge_texel *copies;    /* [copy_count]: of whole lists, tile after tile; owned */
	struct edge_vertex *vertices; /* [vertex_count]: of all edges that are listed; owned */
	struct edge_texel *texels;    /* [vertex_count]: from each of them to the next, if there is
					 an edge; owned */
	struct edge_run *runs;        /* [run_count]: tile after tile; owned */
	uint32_t *first;              /* [tiles * tiles + 1]: of a tile's runs; owned */
	size_t vertex_count, copy_count, run_count;
	size_t edge_count; /* in all lists together */
	size_t dropped;    /* that there was no room for */
	/* Working memory; owned */
	uint16_t *entries;       /* tiles of one edge after the other */
	uint32_t *entry_ends;    /* of edges, by their first points */
	struct list_end *ends;   /* [tiles * tiles] */
	struct keyed_edge *keys; /* of the edges that are listed, twice */
	uint32_t tiles, screen;  /* a side, that the lists are for */
	size_t entry_count;
	size_t vertex_capacity, texel_capacity, copy_capacity, run_capacity, first_capacity,
		entry_capacity, entry_end_capacity, end_capacity, key_capacity;
};

/** What lists may have in all, each below 2^17: runs and the vertices of those, and if they are
 * whole edges of their own. */
struct edge_room {
	size_t runs, vertices, copies;
};

/** Whether the lists fit. */
enum edge_lists_result { EDGE_LISTS_FULL, EDGE_LISTS_MADE, EDGE_LISTS_NO_MEMORY };

/**
 * Lists the edges of all chains, in runs, or whole: as lists are if most are short, where boxes
 * tell little. Within a list they are in the order of their nearest points. If there is too little
 * room: FULL, or with `drop` lists of the edges that are nearest to the light. screen: steps of the
 * raster grid a side.
 */
enum edge_lists_result edge_lists_make(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, uint32_t screen, struct edge_room room, bool drop);

/** Makes the runs of whole lists as well, of the chains that these are of. False: out of memory. */
bool edge_lists_make_runs(struct edge_lists *lists, const struct edge_chains *chains);

/** Where the list of a tile is, among runs, or copies if it is whole. */
struct edge_list {
	uint32_t first, count;
	float nearest; /* depth that none of its edges is before, if it has any */
};

static inline struct edge_list edge_lists_of(const struct edge_lists *lists, size_t t)
{
	const struct list_end *end = &lists->ends[t];
	uint32_t first = t == 0 ? 0 : lists->whole ? end[-1].edges : end[-1].runs;
	uint32_t behind = lists->whole ? end->edges : end->runs;
	return (struct edge_list){first, behind - first, end->nearest};
}

void edge_lists_finish(struct edge_lists *lists);

/** Of memory. */
size_t edge_lists_bytes(const struct edge_lists *lists);

#endif
