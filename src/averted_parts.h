/* SPDX-License-Identifier: MIT */
#ifndef AVERTED_PARTS_H
#define AVERTED_PARTS_H

#include "gles/gpu.h"
#include "need.h"
#include "scene/light.h"

/** What of an object takes the technique, apart from what does not since no light arrives there
 *  (src/geom/averted.h): lists of indices. Zero is empty; memory is kept. */
struct averted_parts {
	bool split;               /* the object has such lists */
	size_t first[NEED_COUNT]; /* indices: in the buffer */
	size_t count[NEED_COUNT]; /* NEED_AMBIENT: where no light arrives */
	GLuint buffer;
	uint8_t *averted;  /* of the mesh's vertices, owned */
	uint32_t *indices; /* owned */
	size_t averted_capacity, index_capacity;
};

void averted_parts_finish(struct averted_parts *parts, struct gl *gl);

/** Sets averted: [mesh->vertex_count], of each vertex whether light arrives nowhere around it.
 * False, and nothing is set, where the transform leaves too little to tell by. */
bool averted_find_vertices(const struct mesh *mesh, const struct gpu_mesh *gpu_mesh, mat4 transform,
	const struct light_frame *frame, uint8_t *averted);

/** Splits what of an object's clusters needs the technique, in parts->split if there is any to be
 *  left out. needs: enum need of each cluster. Fails (MACHINE) for want of memory. */
bool averted_parts_find(struct averted_parts *parts, struct gpu *gpu, const struct mesh *mesh,
	const struct gpu_mesh *gpu_mesh, mat4 transform, const struct light_frame *frame,
	const uint8_t *needs, struct sm_error *error);

/** Draws those that have this need, if there are any, with the program in use. */
void averted_parts_draw(const struct averted_parts *parts, struct gpu *gpu,
	const struct gpu_mesh *mesh, enum need need);

/** Of the processor's memory. */
size_t averted_parts_bytes(const struct averted_parts *parts);

#endif
