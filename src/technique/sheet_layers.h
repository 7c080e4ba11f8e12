/* SPDX-License-Identifier: MIT */
#ifndef TECHNIQUE_SHEET_LAYERS_H
#define TECHNIQUE_SHEET_LAYERS_H

#include "technique/depth_map.h"
#include "technique/gather.h"

/** Depth and slope of the casters' sheets on the light's screen, one layer behind the other. They
 *  are kept from frame to frame, and drawn anew where casters have changed. */
struct sheet_layers {
	struct target of[GATHER_LAYERS]; /* the later ones made when there are any */
	struct target depth;             /* what they are drawn with */
	bool coarse;                     /* drawn on a coarse raster grid: depths are corrected */
	int count;                       /* that show the casters; 0: none can be kept */
};

/** size: texels a side. On failure (MACHINE) finish() is still to be called. */
bool sheet_layers_init(
	struct sheet_layers *layers, struct gpu *gpu, GLsizei size, struct sm_error *error);
void sheet_layers_finish(struct sheet_layers *layers, struct gpu *gpu);

/** Has the next draw start with nothing. */
void sheet_layers_forget(struct sheet_layers *layers);

/** Has the first `count` layers show the casters, up to GATHER_LAYERS. changed: where these show
 *  otherwise than at the last draw, of the objects that `watch` has been looked at for. */
bool sheet_layers_draw(struct sheet_layers *layers, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, int count, const struct object_watch *watch,
	const struct screen_box *changed, struct sm_error *error);

#endif
