/* SPDX-License-Identifier: MIT */
#ifndef FIXED_SCENE_H
#define FIXED_SCENE_H

#include "fixed/primitive.h"
#include <stdbool.h>

/** All that the exact passes draw for one light. Zero is empty. */
struct fixed_scene {
	int32_t map_size;      /* texels a side; the outermost ring stays clear */
	int32_t width, height; /* of the picture */
	uint32_t pole;         /* K of struct light_frame, in steps of depth: [2^21, 2^22) */
	bool sinusoid;         /* the falloff; else linear */
	struct fixed_blockers casters;
	struct fixed_blockers receivers_only; /* that do not cast; none where there are no fins */
	struct fixed_fins fins;
	struct fixed_receivers receivers; /* in the order in which the first wins */
};

void fixed_scene_finish(struct fixed_scene *scene);

#endif
