/* SPDX-License-Identifier: MIT */
#ifndef MODEL_DEPTH_MAP_H
#define MODEL_DEPTH_MAP_H

#include "model/light.h"

/** What a light sees: window depths of 24 bits, rows from the lower one. */
struct model_map {
	int size;
	float *depths; /* owned */
};

/** Which objects a map holds. Where there are none, and in the outermost texels, it is 1; or 0
 * where it holds the farthest. */
enum model_content {
	MODEL_CASTERS,
	MODEL_RECEIVERS_ONLY,
	MODEL_FARTHEST_RECEIVERS, /* of those that do not cast */
};

/** Draws triangles first .. end - 1 of a caster. False: out of memory. */
bool model_draw_caster(const struct caster *caster, size_t first, size_t end, mat4 to_clip,
	const struct raster_area *area, raster_fragment keep, void *data);

/** Nearest steps of a depth buffer of 24 bits. */
float model_round_depth(double depth);

/** Draws the map, of a zeroed one. */
bool model_map_init(struct model_map *map, const struct model_light *light,
	enum model_content content, struct sm_error *error);
/** The same as seen by another frame than the light's own. */
bool model_map_init_from(struct model_map *map, const struct model_light *light,
	const struct light_frame *frame, enum model_content content, struct sm_error *error);
/** Fine on a zeroed one. */
void model_map_finish(struct model_map *map);

/** The depth at a texel; beside the map, at the nearest one. */
double model_map_at(const struct model_map *map, int x, int y);

#endif
