/* SPDX-License-Identifier: MIT */
#ifndef SHADOW_SET_H
#define SHADOW_SET_H

#include "light_key.h"
#include "lit_parts.h"

/** What one light throws. */
struct light_shadow {
	void *state; /* of the technique; owned */
	bool drawn;  /* what the key says is in it */
	struct light_key key;
	bool mapped; /* the needs are those of what is drawn */
	struct need_map needs;
	struct lit_parts lit; /* by these needs */
};

/** One technique's states, a light each, made when first needed. */
struct shadow_set {
	const struct technique *technique;
	uint64_t map_flags; /* of PROGRAM_SURFACE, where the shadow map alone will do */
	struct sm_shadow_options options; /* complete; .technique is not used */
	struct light_shadow **shadows;    /* each and all owned; NULL: not needed so far */
	size_t count, capacity;
};

/** The defaults of every field, for the technique named, or the default one. Fails (INPUT) on a
 *  name that is none, a value out of range, or one the technique does not use. */
bool shadow_set_init(struct shadow_set *set, const struct sm_shadow_options *options,
	const struct caps *caps, struct sm_error *error);
void shadow_set_finish(struct shadow_set *set, struct gpu *gpu);

/** Each light is to be drawn anew. */
void shadow_set_forget(struct shadow_set *set);

/** Tells what the lights' states hold of the processor's memory, and are. */
void shadow_set_list_memory(const struct shadow_set *set, const struct memory_list *list);

/** A light as a view is drawn with it. */
struct shadow_request {
	const struct local_scene *local;
	size_t index; /* of its state */
	const struct light_frame *frame;
	const struct technique_view *view;
};

/** Draws what a light sees, unless it did so before and nothing of that has changed, and returns
 *  its shadow, owned by the set; NULL on failure. */
struct light_shadow *shadow_set_prepare(struct shadow_set *set, struct gpu *gpu,
	const struct shadow_request *request, struct sm_error *error);

/** Has what a light's choices depend on of frames before forgotten. */
void shadow_set_leave(struct shadow_set *set, size_t index);

#endif
