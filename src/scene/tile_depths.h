/* SPDX-License-Identifier: MIT */
#ifndef SCENE_TILE_DEPTHS_H
#define SCENE_TILE_DEPTHS_H

#include "geom/clusters.h"
#include "geom/screen_box.h"
#include "scene/edge_chains.h"

/** Boxes of a mesh's triangles; each may be NULL until it is needed. */
struct mesh_clusters {
	struct cluster *drawn;                   /* of the mesh's triangles, owned */
	struct cluster *casting;                 /* of the caster's, owned */
	uint64_t drawn_version, casting_version; /* of the mesh they are of */
};

/** Tiles of a light's screen, [tiles * tiles], with one value each. */
struct tile_values {
	float *of; /* owned */
	size_t capacity;
};

/**
 * How deep what receives and what casts lies at most, per tile of a light's screen: coarse, never
 * less. Zero is empty; memory is kept from one search to the next, and so are the boxes of a
 * scene's meshes.
 */
struct tile_depths {
	uint32_t tiles;        /* a side */
	const float *deepest;  /* of receivers: [tiles * tiles], up to 1; -1: none; not owned */
	const float *farthest; /* of casters, 0: none; not owned */
	/* Working memory; owned */
	struct tile_values received, cast;               /* on most tiles */
	struct tile_values received_halved, cast_halved; /* on fewer */
	struct tile_vertex *vertices; /* of a mesh */
	struct mesh_clusters *meshes;
	size_t mesh_count; /* with an entry there, of the scene of this id */
	uint64_t scene_id;
	size_t cluster_count; /* of all meshes */
	size_t vertex_capacity, mesh_capacity;
};

/** Makes room for so many tiles a side, and any scene. Where their number is as before the values
 *  are, too; else they are for clearing. False: out of memory. */
bool tile_depths_reserve(struct tile_depths *depths, const struct sm_scene *scene, uint32_t tiles);

/** Has nothing receive on those tiles that an object in a part of the screen may have a value in;
 *  returns the part that whatever has one there touches, and is to be added again. */
struct screen_box tile_depths_clear_receivers(
	struct tile_depths *depths, const struct screen_box *part);

/** The same for casters that are added with such a margin. */
struct screen_box tile_depths_clear_casters(
	struct tile_depths *depths, const struct screen_box *part, float margin);

/** An object that receives. False: out of memory. */
bool tile_depths_add_receiver(struct tile_depths *depths, const struct sm_scene *scene,
	const struct object *object, const struct light_frame *frame);

/** The sheets of an object that casts, also `margin` tiles beyond where they are. False: out of
 *  memory. */
bool tile_depths_add_caster(struct tile_depths *depths, const struct sm_scene *scene,
	const struct object *object, const struct caster_view *view, float margin);

/** To half as many tiles a side, until they are reserved again: each has the most of the four it is
 *  made of. False: out of memory. */
bool tile_depths_halve(struct tile_depths *depths);

void tile_depths_finish(struct tile_depths *depths);

/** Of memory. */
size_t tile_depths_bytes(const struct tile_depths *depths);

#endif
