/* SPDX-License-Identifier: MIT */
#ifndef TECHNIQUE_SMOOTHIE_STATE_H
#define TECHNIQUE_SMOOTHIE_STATE_H

#include "technique/depth_map.h"
#include "technique/fin_stream.h"

/** Chan & Durand 2003. The smoothie buffer holds linear depth and alpha'. Minimum is what both are
 *  reduced by, nearest depth and darkest alpha, so that one MIN-blended pass fills it; with
 *  options.passes = 2, or where the driver leaves no other way, it is filled as in the paper, by a
 *  depth-tested pass and another for alpha'. Where look-ups are slow it holds words that have the
 *  shadow map in them as well (shaders_es/smoothie_word.glsl). */
struct smoothie {
	struct depth_map casters;
	struct depth_map receivers; /* of objects that only receive: made when there are any */
	struct target buffer;
	GLuint words;        /* what is in the buffer as integers; 0: it is read as it is */
	struct target depth; /* with two passes; the buffer then has alpha' alone */
	GLuint falloff;      /* table of the sinusoid */
	struct fin_stream fins;
	struct fin_shape shape;
	int way; /* enum smoothie_way */
	bool two_passes;
	uint64_t fin_flags, surface_flags; /* of all programs of that kind */
	uint64_t alpha_flags;              /* of the fins that alpha' is of */
};

/** For a zeroed one. fin_flags: of PROGRAM_FIN, beside those that options ask for. */
bool smoothie_init(struct smoothie *smoothie, struct gpu *gpu,
	const struct sm_shadow_options *options, const struct fin_shape *shape, uint64_t fin_flags,
	struct sm_error *error);

/* The functions of a technique whose state is a struct smoothie. */
void smoothie_finish(void *state, struct gpu *gpu);
bool smoothie_prepare(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error);
uint64_t smoothie_surface_flags(const void *state);
const struct screen_grid *smoothie_soft_grid(const void *state);
const struct screen_depths *smoothie_soft_depths(const void *state);
const struct fin_set *smoothie_fins(const void *state);
struct object_watch *smoothie_casters(void *state, const struct light_frame *frame, float *reach);
void smoothie_list_memory(const void *state, const struct memory_list *list);
void smoothie_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program);

#endif
