/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_KEEP_H
#define SCENE_EDGE_KEEP_H

#include "scene/edge_chains.h"
#include "scene/object_watch.h"
#include "scene/tile_depths.h"

/** How finely a light's screen is searched. */
struct edge_raster {
	uint32_t tiles;  /* a side */
	uint32_t screen; /* steps of the edges' grid a side */
	uint32_t step;   /* of the rasteriser's grid, in those */
	float margin;    /* tiles that casters are deep beyond where they are */
};

/** What one object gave. */
struct edge_part {
	size_t first, count; /* points of the chains */
	size_t edge_count;
	size_t first_hollow, hollow_count;
	struct screen_box reach; /* where tiles may have depths of it */
};

/** What objects have given to a light's chains and tile depths, so that the next search goes
 *  through those alone that have changed, and through what shares tiles with them. Zero is of
 *  nothing. */
struct edge_keep {
	struct screen_box changed; /* where casters show otherwise than in the search before */
	size_t caster_count, kept_count; /* casters, and those whose chains were kept */
	struct edge_raster raster;
	struct object_watch watch;           /* on casters */
	struct edge_part *parts;             /* of each object, owned */
	struct chain_point *before;          /* what the chains were, where some are kept; owned */
	struct chain_hollow *hollows_before; /* and the hollows; owned */
	size_t part_capacity, before_capacity, hollow_capacity;
	size_t known; /* objects that parts are kept of */
	bool looked;  /* since the last search */
};

void edge_keep_finish(struct edge_keep *keep);

/** Has the next search keep nothing. */
void edge_keep_forget(struct edge_keep *keep);

/** Finds what has changed, keep->changed, before the search. False: out of memory, and nothing is
 *  kept. */
bool edge_keep_look(struct edge_keep *keep, const struct sm_scene *scene,
	const struct light_frame *frame, const struct edge_raster *raster);

/** Has the chains be those of all casters, object after object, and the depths those of all objects
 *  that cast or receive: as if all were found anew. What has changed of the same scene and frame
 * has been looked for since the last search. Neither is changed by others in between, and both are
 * empty before the first search. False: out of memory, and nothing is kept. */
bool edge_keep_find(struct edge_keep *keep, struct edge_chains *chains, struct tile_depths *depths,
	const struct sm_scene *scene, const struct light_frame *frame);

/** Of memory. */
size_t edge_keep_bytes(const struct edge_keep *keep);

#endif
