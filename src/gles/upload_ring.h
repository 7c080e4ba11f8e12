/* SPDX-License-Identifier: MIT */
#ifndef GLES_UPLOAD_RING_H
#define GLES_UPLOAD_RING_H

#include "gles/gl.h"

/** Frames that may be on their way through the driver before one gets new memory: two, beside the
 *  one that is being made. */
#define UPLOAD_RING_SIZE 3

/** Buffers that take turns, so that none is written to which the driver may still draw from. No
 *  call waits. Zero is empty; buffers are made when it is first their turn. */
struct upload_ring {
	struct upload_slot {
		GLuint buffer;
		GLsync drawn; /* after what was drawn from it; NULL: nothing */
		size_t capacity;
	} slots[UPLOAD_RING_SIZE];
	size_t current;
};

/** Fine on a zeroed one. */
void upload_ring_finish(struct upload_ring *ring, struct gl *gl);

/**
 * Has the next buffer take its turn, bound, with room for that many bytes, of any content. Where
 * the driver is not done with it, which it tells by a fence, its memory is given up for other. What
 * is drawn from the one before has been submitted.
 *
 * Returns it; 0: out of memory.
 */
GLuint upload_ring_turn(struct upload_ring *ring, struct gl *gl, enum storage_owner owner,
	GLenum target, size_t bytes);

/** That whose turn it is; 0 before the first. */
GLuint upload_ring_buffer(const struct upload_ring *ring);

#endif
