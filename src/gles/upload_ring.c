/* SPDX-License-Identifier: MIT */
#include "gles/upload_ring.h"

void upload_ring_finish(struct upload_ring *ring, struct gl *gl)
{
	for (size_t i = 0; i < UPLOAD_RING_SIZE; i++) {
		gl_delete_buffer(gl, &ring->slots[i].buffer);
		gl_delete_fence(gl, &ring->slots[i].drawn);
	}
	*ring = (struct upload_ring){0};
}

/* Forgets its fence where that has been reached. */
static bool is_free(struct upload_slot *slot, struct gl *gl)
{
	if (slot->drawn == NULL)
		return true;
	GLenum reached = gl->ClientWaitSync(slot->drawn, 0, 0);
	bool is = reached == GL_ALREADY_SIGNALED || reached == GL_CONDITION_SATISFIED;
	gl_delete_fence(gl, &slot->drawn);
	return is;
}

GLuint upload_ring_turn(struct upload_ring *ring, struct gl *gl, enum storage_owner owner,
	GLenum target, size_t bytes)
{
	struct upload_slot *before = &ring->slots[ring->current];
	if (before->buffer != 0 && before->drawn == NULL)
		before->drawn = gl_create_fence(gl);
	ring->current = (ring->current + 1) % UPLOAD_RING_SIZE;
	struct upload_slot *slot = &ring->slots[ring->current];
	if (slot->buffer == 0)
		slot->buffer = gl_create_buffer(gl, owner);
	bool keep = is_free(slot, gl) && bytes <= slot->capacity;
	if (slot->capacity < bytes)
		slot->capacity = bytes;
	if (keep)
		gl->BindBuffer(target, slot->buffer);
	else
		gl_fill_buffer(gl, target, slot->buffer, slot->capacity, NULL, GL_STREAM_DRAW);
	return slot->buffer;
}

GLuint upload_ring_buffer(const struct upload_ring *ring)
{
	return ring->slots[ring->current].buffer;
}
