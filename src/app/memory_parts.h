/* SPDX-License-Identifier: MIT */
#ifndef APP_MEMORY_PARTS_H
#define APP_MEMORY_PARTS_H

#include "app/facts.h"
#include <smoothie.h>
#include <stddef.h>

/** What a renderer and a scene have in memory, each owner's once a light. Zero is empty. */
struct memory_parts {
	struct sm_memory_part *items; /**< owned */
	size_t count, capacity;
	bool failed; /**< out of memory */
};

/** Fails (MACHINE) when out of memory; finish() is called anyway. */
bool memory_parts_find(struct memory_parts *parts, const struct sm_renderer *renderer,
	const struct sm_scene *scene, struct sm_error *error);
void memory_parts_finish(struct memory_parts *parts);

/** Writes "GL: shadow maps=BYTES;..." with all lights together. Fails (MACHINE) where it does not
 * fit into size bytes. */
bool memory_parts_format(
	const struct memory_parts *parts, char *text, size_t size, struct sm_error *error);

/** Adds "GL: shadow maps: light 0" and the like, with bytes, and sums. */
void memory_parts_describe(const struct memory_parts *parts, struct facts *facts);

#endif
