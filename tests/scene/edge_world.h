/* SPDX-License-Identifier: MIT */
#ifndef TESTS_SCENE_EDGE_WORLD_H
#define TESTS_SCENE_EDGE_WORLD_H

#include "load/stage.h"
#include "models.h"
#include "scene/edge_grid.h"

#define MAP_SIZE 512
#define SUBPIXEL_BITS 8
#define SCREEN (MAP_SIZE << SUBPIXEL_BITS)
/* For lists of any length. */
#define ROOM                           \
	{                              \
		131071, 131071, 131071 \
	}

/** A scene with a light, and its grid. */
struct world {
	struct stage stage; /* owns the scene */
	struct light_frame frame;
	struct edge_grid grid;
};

extern const struct sm_light_desc world_lamp;

/** What cannot be done fails the test. */
void world_init(struct world *world);
/** With the scene's first light. */
void world_load(struct world *world, const char *source, const char *const *settings, size_t count);
void world_add_object(
	struct world *world, const struct model *model, const float transform[16], bool casts);
void world_aim(struct world *world, const struct sm_light_desc *light);
void world_find(struct world *world, const struct edge_grid_options *options);
void world_finish(struct world *world);

/** From an object's space to the light's clip space. */
void world_to_clip_of(const struct world *world, const struct object *object, mat4 to_clip);
void world_project(const mat4 to_clip, const float p[3], double clip[4]);

/** The winding number of each tile is the number of sheets over its centre: of triangles that face
 *  the light, and for parts that are not closed of those that do not. */
void assert_winding_counts_sheets(const struct world *world, const char *what);

/** Each list is of runs of edges, the nearest first, that say where they are. */
void assert_lists_are_in_order(const struct world *world, const char *what);

/** Random receivers find in their tiles' lists every edge that concerns them. */
void assert_receivers_find_their_edges(const struct world *world, const char *what);

/** All of this, nothing dropped, and no sheet behind its tile's farthest. */
void assert_grid(const struct world *world, const char *what);

#endif
