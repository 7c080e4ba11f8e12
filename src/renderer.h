/* SPDX-License-Identifier: MIT */
#ifndef RENDERER_H
#define RENDERER_H

#include "averted_parts.h"
#include "gles/picture.h"
#include "local_scene.h"
#include "scene/draw_order.h"
#include "shadow_set.h"

/** All that a light's visibility at points of a view is made from. Zero is of nothing. */
struct points_key {
	struct light_key light;
	struct objects_age objects;
	struct view_key view;
	enum sm_sampling sampling;
	bool whole;
};

/** Frames after which what is not drawn into is given back: a light that wavers does so in less. */
#define IDLE_FRAMES_MAX 600

/** A light of the frame. */
struct shadowed_light {
	struct light_frame frame;
	float brightest;             /* of what it adds to a pixel: a bound, up to what matters */
	bool shows;                  /* that changes any, whether or not it is left out */
	bool left_out;               /* nothing of it is drawn; the rest is of an earlier frame */
	struct light_shadow *shadow; /* in the shadow set */
	enum sm_sampling sampling;   /* of the frame */
	/* What is drawn of its visibility before surfaces: cells between points of the view
	 * (sparse_pass.h), or that of each pixel (deferred_pass.h); made when there is some. */
	struct picture cells, found;
	uint32_t sparse_idle, deferred_idle; /* frames in which it was not drawn into */
	struct points_key points;            /* that they are of */
};

/** What a picture is of. Zero is of nothing. */
struct frame_key {
	uint64_t scene, version; /* of the scene */
	struct sm_view view;
};

struct sm_renderer {
	struct gpu gpu;
	struct shadow_set shadows;
	/* Where several lights are added up when the caller's framebuffer cannot do that in linear
	 * light: sRGB-encoded. */
	struct picture accumulator;
	struct picture points;      /* of one light after the other; likewise */
	struct picture receivers;   /* likewise, of every pixel */
	struct points_key received; /* that their depths are of */
	/* Working memory, kept so that a frame like the last one allocates nothing. */
	struct local_scene local;
	struct draw_order order;
	struct shadowed_light *lights; /* owned */
	uint8_t *needs;                /* enum need of a mesh's clusters; owned */
	size_t light_capacity, need_capacity;
	struct averted_parts averted; /* of the object that is drawn */
	struct frame_key current;     /* of the last frame, if it was drawn */
	bool whole; /* draw every surface with all that the technique does, whatever skips say */
};

/** What one frame does, in order. */
bool frame_draw(struct sm_renderer *renderer, const struct sm_scene *scene,
	const struct sm_view *view, struct sm_error *error);

/** sm_renderer_copy_to_screen() without the check for GL's errors. */
bool screen_draw(struct gpu *gpu, const struct sm_screen *screen, struct sm_error *error);

#endif
