/* SPDX-License-Identifier: MIT */
#ifndef NEED_H
#define NEED_H

#include "geom/screen_cover.h"
#include "geom/screen_depths.h"
#include "geom/screen_grid.h"
#include "gles/gpu_scene.h"
#include "scene/light.h"

/** What it takes to shade a part of a surface as the technique would, least first. */
enum need {
	NEED_AMBIENT,   /* beside the light's cone */
	NEED_LIGHT,     /* no caster can be in front of it: no look-up at all */
	NEED_MAP,       /* an ordinary shadow map */
	NEED_BEHIND,    /* the technique, behind all casters */
	NEED_TECHNIQUE, /* all that the technique does */
	NEED_COUNT,
};

/** The needs for one light, over its screen. Conservative: what needs more than its part says is
 *  not there. */
struct need_map {
	struct screen_cover casters; /* beside them a map has nothing in it; none, where no map
					is asked for */
	bool by_cells; /* the technique is needed in `cells` alone; else where a map is */
	struct screen_grid cells;
	/* Of those cells that need the technique, where surfaces do that are farther than a
	 * depth, window; NULL: all do. For the caller to set, and not owned. */
	const struct screen_depths *soft;
	/* The window depth that no caster over a cell is behind, [SCREEN_GRID_SIZE *
	 * SCREEN_GRID_SIZE]; for the caller to set, not owned. NULL, at first: nothing is behind.
	 */
	const float *farthest;
	float cone; /* half the width of the light's cone, NDC: beside it there is no light. For the
		       caller to set; INFINITY at first. */
};

/**
 * gpu: has the scene's meshes. soft: cells that need the technique; NULL: those of the casters do.
 * soft_is_all: elsewhere no map is needed either. reach: of the technique, NDC. map_size: texels a
 * side of the shadow map.
 */
void need_map_find(struct need_map *map, const struct gpu_scene *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct screen_grid *soft, bool soft_is_all,
	float reach, uint32_t map_size);

/** Of surfaces in a box of the light's NDC. */
enum need need_of_space(const struct need_map *map, const float min[3], const float max[3]);

/** Of surfaces inside a box; to_light_clip: from the box's space to the light's clip space. */
enum need need_of_box(const struct need_map *map, mat4 to_light_clip, const struct cluster *box);

/** The extent in NDC that a box has; false if it reaches behind the eye. */
bool box_on_screen(mat4 to_clip, const struct cluster *box, float min[3], float max[3]);

/** Marks the cells that a box may be over, and all within `slack` cells of it. */
void mark_box(struct screen_grid *cells, mat4 to_clip, const struct cluster *box, float slack);

#endif
