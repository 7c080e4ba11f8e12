/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_CHAINS_H
#define SCENE_EDGE_CHAINS_H

#include "geom/sheets.h"
#include "scene/edge_clip.h"
#include "scene/light.h"

/** Sheets that an edge is the boundary of at most. */
#define EDGE_SHEETS_MAX 2

/** On a light's screen, in steps of a grid from the lower left. */
struct chain_point {
	int32_t x, y;    /* within CHAIN_LIMIT */
	float depth;     /* window depth, in [0, CHAIN_DEPTH_MAX] */
	uint32_t sheets; /* on the left of the edge that leads to the point after, which it is the
			    boundary of; 0: the chain ends. Or CHAIN_GRAZING + k: the edge leads
			    from corner k of a grazing triangle */
};

/** Of edges of triangles whose planes cut the light's disc, which show one side to its centre and
 *  the other to a part of it. Each is a chain of three edges: what is missing, as a sheet on their
 *  left, where a receiver is on the same side of its plane as the centre is. */
#define CHAIN_GRAZING 4u

static inline bool chain_is_grazing(const struct chain_point *edge)
{
	return edge->sheets >= CHAIN_GRAZING;
}

/** A triangle that faces the light's centre and shows a part of the disc its back, where receivers
 *  beside it are before its plane: it counts for them as a sheet on its left. */
struct chain_hollow {
	struct chain_point corners[3]; /* sheets: CHAIN_GRAZING */
	uint32_t triangle;
	float min[2], max[2]; /* around those that it hides a part of the disc from */
	float far;            /* and how deep these are */
};

/** What is farther off is moved there, which changes nothing on the screen. */
#define CHAIN_LIMIT (1 << 24)
/** Behind everything on the screen. */
#define CHAIN_DEPTH_MAX 1e6f

/** A caster as a light sees it. */
struct caster_view {
	const struct caster *caster;
	vec4 light; /* as facing_find() takes it */
	mat4 to_clip, to_light;
	bool parallel;
	float disc; /* radius of the light, as struct light_frame has it */
	struct sheet_rule rule;
	bool cut; /* by the near plane, perhaps; then all triangles count on both sides */
	const uint64_t *facing; /* of its triangles */
};

/**
 * The boundaries of the sheets of all casters as one light sees them, in chains. As many sheets
 * begin as end along all edges that meet at a point. An edge that two sheets have in common, as a
 * fold of an open part, is there once. Where the near plane cuts a sheet its boundary runs along
 * the cut. Zero is empty; memory is kept from one search to the next.
 */
struct edge_chains {
	struct chain_point *points; /* [count], owned */
	size_t count;
	size_t edge_count;
	struct chain_hollow *hollows; /* [hollow_count], owned */
	size_t hollow_count;
	bool tests_all; /* set by the owner: no triangle and no edge is passed over */
	/* Blocks of triangles, since the last clear, and those that were tested one by one. */
	size_t block_count, tested_count;
	/* Working memory; owned */
	uint64_t *facing, *back;
	struct silhouette_edge *edges;
	uint32_t *edge_from;  /* first edge of a vertex */
	uint32_t *edge_after; /* next edge from the same vertex */
	struct edge_clip clip;
	uint32_t raster_step; /* of the caster that is being added */
	size_t point_capacity, facing_capacity, back_capacity, edge_capacity, from_capacity,
		after_capacity, hollow_capacity;
};

void edge_chains_clear(struct edge_chains *chains);

/** Sets view up for an object that casts, until the next call. False: out of memory. */
bool edge_chains_see(struct edge_chains *chains, const struct sm_scene *scene,
	const struct object *object, const struct light_frame *frame, struct caster_view *view);

/** Appends the chains of a caster that edge_chains_see() set up. screen: steps of the grid a side;
 *  raster_step: of the rasteriser's grid, a power of two of those. What is nearest to a point on
 *  that is so once it is moved to the finer one. False: out of memory. */
bool edge_chains_add(struct edge_chains *chains, const struct caster_view *view, uint32_t screen,
	uint32_t raster_step);

/** Appends hollows that were found before. False: out of memory. */
bool edge_chains_keep_hollows(
	struct edge_chains *chains, const struct chain_hollow *hollows, size_t count);

/** Appends chains that were found before, of so many edges. False: out of memory. */
bool edge_chains_keep(struct edge_chains *chains, const struct chain_point *points, size_t count,
	size_t edge_count);

void edge_chains_finish(struct edge_chains *chains);

/** Of memory. */
size_t edge_chains_bytes(const struct edge_chains *chains);

#endif
