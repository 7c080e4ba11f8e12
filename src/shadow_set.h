/* SPDX-License-Identifier: MIT */
#ifndef SHADOW_SET_H
#define SHADOW_SET_H

#include "technique/technique.h"

/** One technique's states, a light each, made when first needed. */
struct shadow_set {
	const struct technique *technique;
	uint64_t map_flags; /* of PROGRAM_SURFACE, where the shadow map alone will do */
	struct sm_shadow_options options; /* complete; .technique is not used */
	void **states;                    /* owned */
	size_t count, capacity;
};

/** The defaults of every field, for the technique named, or the default one. Fails (INPUT) on a
 *  name that is none, a value out of range, or one the technique does not use. */
bool shadow_set_init(struct shadow_set *set, const struct sm_shadow_options *options,
	const struct caps *caps, struct sm_error *error);
void shadow_set_finish(struct shadow_set *set, struct gpu *gpu);

/** Of the processor's memory, what the lights' states hold of geometry. */
size_t shadow_set_geometry_bytes(const struct shadow_set *set);

/** Draws what light number `index` sees, and returns its state, owned by the set; NULL on
 *  failure. */
void *shadow_set_prepare(struct shadow_set *set, struct gpu *gpu, const struct sm_scene *scene,
	size_t index, const struct light_frame *frame, const struct technique_view *view,
	struct sm_error *error);

#endif
