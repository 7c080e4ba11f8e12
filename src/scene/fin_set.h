/* SPDX-License-Identifier: MIT */
#ifndef SCENE_FIN_SET_H
#define SCENE_FIN_SET_H

#include "base/memory_list.h"
#include "geom/fins.h"
#include "geom/screen_grid.h"
#include "geom/silhouette_track.h"
#include "scene/object_watch.h"

/** Width of a smoothie's fin as a share of the half-width of the penumbra it stands for,
 *  R (r - b) / (b r) on the light's screen. A fin only has the outer half, running from dark at the
 *  silhouette, where half the light is seen: as wide as the true penumbra it would darken too much.
 */
#define SMOOTHIE_WIDTH_SHARE 0.4f

/** What fins of a technique look like. */
struct fin_shape {
	float width;     /* share of the light's screen; 0: from the light's radius */
	float share;     /* then: of the half-width of the penumbra */
	float apron;     /* texels: drawn this much wider */
	bool both_sides; /* inside of the silhouette as well, and however narrow */
};

/** A point light has no penumbra, unless the shape gives it one. */
bool fin_shape_has_width(const struct fin_shape *shape, const struct light_frame *frame);

/** A bound on how far from a silhouette fins go on the light's screen, NDC. */
float fin_shape_reach(
	const struct fin_shape *shape, const struct light_frame *frame, uint32_t map_size);

/** The fins of one object. */
struct fin_part {
	size_t first, count;          /* of fins */
	size_t groups[FIN_QUADS_MAX]; /* of these, those of 1, 2 ... quads */
	size_t edge_count;
	bool casts, missing, fresh; /* fresh: not those of the search before */
	struct screen_box box;      /* around them */
	struct screen_grid grid;    /* where surfaces that look them up may be */
};

/** The fins of all casters, as one light sees them. Zero is empty; memory is kept from one search
 * to the next. */
struct fin_set {
	struct fin *fins; /* owned */
	size_t count;
	struct fin_law law; /* of all */
	bool both_sides;
	bool tests_all;         /* set by the owner: silhouette_track_all() */
	struct fin_part *parts; /* of each object; owned */
	size_t part_count;
	size_t edge_count; /* of silhouettes that were looked for and fins are on */
	size_t caster_count, missing_count; /* casters, and those that were left out */
	size_t left_out_count;              /* fins, of edges that were looked for: too fine */
	size_t block_count, tested_count;   /* of triangles of those that were looked for, and of
					       these, those whose triangles were tested */
	struct workers *workers;            /* share the search of large meshes; not owned, may
					       be NULL */
	/* Working memory; owned */
	struct fin *before;              /* what fins were, where some are kept */
	struct silhouette_track *tracks; /* of the scene's objects, as the light sees them */
	struct fin_scratch scratch;
	size_t track_count, capacity, before_capacity, part_capacity;
};

void fin_set_finish(struct fin_set *set);

/** Tells what it holds. */
void fin_set_list_memory(const struct fin_set *set, const struct memory_list *list);

/** Finds the silhouettes of all casters and builds their fins: none for a point light whose fins
 * get their width from it. map_size: texels a side that they are drawn over. on_screen: of those
 * casters alone whose fins may be on the light's screen. False: out of memory. */
bool fin_set_find(struct fin_set *set, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, uint32_t map_size,
	bool on_screen);

/** The same, but for objects that have not changed keeps the fins of the last search, which was for
 *  the same shape and size. watch: on casters, looked at once since then; those that it leaves out
 *  have none. changed: widened to where
 *  fins were, or are, that were not kept. */
bool fin_set_update(struct fin_set *set, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, uint32_t map_size,
	bool on_screen, const struct object_watch *watch, struct screen_box *changed);

/** Cells, of so many a side, by which a surface may lie beside fins that it looks up in a map:
 *  texels' centres lie up to one texel off, and half a texel more is for what rasterisers snap. */
float fin_slack(int cells, uint32_t map_size);

/** The quads of a fin, as fin_expand() has them. */
size_t fin_set_expand(
	const struct fin_set *set, size_t index, struct fin_vertex out[FIN_VERTICES_MAX]);

/** How many those of all fins are. */
size_t fin_set_quads(const struct fin_set *set);

/** Has the next search keep nothing. */
void fin_set_clear(struct fin_set *set);

#endif
