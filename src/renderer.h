/* SPDX-License-Identifier: MIT */
#ifndef RENDERER_H
#define RENDERER_H

#include "gles/picture.h"
#include "local_scene.h"
#include "scene/draw_order.h"
#include "shadow_set.h"

/** A light of the frame. */
struct shadowed_light {
	struct light_frame frame;
	void *shadow;  /* state of the technique, in the shadow set */
	bool sparse;   /* whether its visibility is first drawn at points of the view */
	uint32_t idle; /* frames in which it was not */
	/* Of these (sparse_pass.h); made when there are some. */
	struct picture cells;
};

struct sm_renderer {
	struct gpu gpu;
	struct shadow_set shadows;
	/* Where several lights are added up when the caller's framebuffer cannot do that in linear
	 * light: sRGB-encoded. */
	struct picture accumulator;
	struct picture points; /* of one light after the other; likewise */
	/* Working memory, kept so that a frame like the last one allocates nothing. */
	struct local_scene local;
	struct draw_order order;
	struct shadowed_light *lights; /* owned */
	uint8_t *needs;                /* enum need of a mesh's clusters; owned */
	size_t light_capacity, need_capacity;
	bool whole; /* draw every surface with all that the technique does, for comparison */
};

/** What one frame does, in order. */
bool frame_draw(struct sm_renderer *renderer, const struct sm_scene *scene,
	const struct sm_view *view, struct sm_error *error);

/** sm_renderer_copy_to_screen() without the check for GL's errors. */
bool screen_draw(struct gpu *gpu, const struct sm_screen *screen, struct sm_error *error);

#endif
