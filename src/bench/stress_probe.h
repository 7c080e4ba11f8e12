/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STRESS_PROBE_H
#define BENCH_STRESS_PROBE_H

#include "base/error.h"

/** What is drawn. */
struct stress_subject {
	const struct sm_scene *scene; /* not owned */
	struct sm_camera camera;
	struct sm_shadow_options shadow;
	uint32_t width, height;
};

/** A picture of a light's visibility. Zero is empty. */
struct stress_picture {
	uint32_t width, height;
	float *values; /* owned; rows from the bottom */
};

void stress_picture_finish(struct stress_picture *picture);

/** The rules. */
enum stress_fault_kind {
	STRESS_FAULT_INVALID,    /* the scene, camera or options: no picture of them can be had */
	STRESS_FAULT_DRAWING,    /* it fails, or GL has an error */
	STRESS_FAULT_MEMORY,     /* the driver has none for the textures */
	STRESS_FAULT_FLOAT,      /* a pass writes what is not finite */
	STRESS_FAULT_PIXEL,      /* visibility not in [0, 1], or no pixel of a picture */
	STRESS_FAULT_SILHOUETTE, /* that is not closed */
	STRESS_FAULT_BOUND,      /* an error above its bound */
	STRESS_FAULT_OTHER,
};

/** What broke a rule; empty text: nothing did. */
struct stress_fault {
	enum stress_fault_kind kind;
	char text[300];
};

struct stress_framebuffer {
	uint32_t framebuffer, buffers[2], format, width, height;
};

/**
 * Draws, and reads back all that reaches a target: what passes write as floats on the way, the
 * finished pixels, and visibility as it is before shaders clamp it. At most one at a time: it
 * changes the shaders' sources on their way to GL.
 */
struct stress_probe {
	struct sm_renderer *renderer;
	bool floats; /* the driver draws to floats: otherwise visibility is seen clamped alone */
	struct stress_framebuffer visibility, picture;
	uint32_t max_texture_size; /* texels a side */
	float *values;             /* working memory */
	size_t value_capacity;
	struct stress_fault *fault; /* of the draw that is going on; not owned */
};

/** Needs a current context. Fails (MACHINE, INPUT) on a driver that cannot draw. */
bool stress_probe_init(struct stress_probe *probe, sm_get_proc get_proc,
	const struct sm_driver_options *driver, struct sm_error *error);
/** Fine on a failed one. */
void stress_probe_finish(struct stress_probe *probe);

/**
 * Draws the visibility of a light, and the picture with all of them. Returns false and says in
 * *fault what was wrong: drawing failed, a float was not finite, visibility not in [0, 1], a pixel
 * not one of a picture.
 */
bool stress_probe_visibility(struct stress_probe *probe, const struct stress_subject *subject,
	uint32_t light, struct stress_picture *picture, struct stress_fault *fault);
bool stress_probe_picture(struct stress_probe *probe, const struct stress_subject *subject,
	struct stress_fault *fault);

/** Reads what the framebuffer that is bound holds within the viewport, as is done when a pass ends:
 *  its floats, and those whose bits the passes "smoothies" (two halves in red, a float in each
 * other channel) and "layers" (a float in red, two halves in green) write to unsigned integers.
 * False: one of them is not finite, or GL has an error. */
bool stress_probe_check_targets(
	struct stress_probe *probe, const char *pass, struct stress_fault *fault);

/** Says so in *fault, unless it says something already, and returns false. */
bool stress_fault_set(struct stress_fault *fault, enum stress_fault_kind kind, const char *format,
	...) PRINTF_LIKE(3, 4);

#endif
