/* SPDX-License-Identifier: MIT */
#ifndef TECHNIQUE_FIN_STREAM_H
#define TECHNIQUE_FIN_STREAM_H

#include "geom/screen_depths.h"
#include "geom/screen_grid.h"
#include "gles/upload_ring.h"
#include "scene/fin_set.h"
#include "technique/depth_map.h"

/** The fins of one light: found on the processor, where objects have changed, and drawn from a ring
 *  of buffers, the current one of which holds those that are to be drawn again. */
struct fin_stream {
	GLuint array; /* of no attributes: the vertex shader takes fins from a uniform block */
	struct upload_ring ring;
	struct fin_set set;
	struct fin *sorted; /* what is uploaded; owned */
	size_t sorted_capacity;
	struct fin_group {
		size_t first, count;
	} groups[FIN_QUADS_MAX];       /* of fins of 1, 2 ... quads in the buffer */
	struct object_watch receivers; /* of those that only receive */
	uint64_t drawn_flags;          /* of the program that they were prepared for last */
	struct screen_box held;        /* where they are */
	struct screen_grid grid;       /* where surfaces that look them up may be */
	struct screen_depths *depths;  /* of fins, window; owned; NULL until there are some */
};

void fin_stream_init(struct fin_stream *stream, struct gpu *gpu);
/** Fine on a zeroed one. */
void fin_stream_finish(struct fin_stream *stream, struct gpu *gpu);

void fin_stream_list_memory(const struct fin_stream *stream, const struct memory_list *list);

/** What fins are drawn with: of a technique's state. */
struct fin_maps {
	struct depth_map *casters;
	struct depth_map *receivers; /* of objects that only receive: made when there are any; holds
					them until another light is prepared */
};

/**
 * Draws the maps and finds the fins, where objects have changed.
 *
 * flags: of the fins' program; FLAG_RECEIVER_MAP is added where it is to look that map up. part:
 * set to where on the light's screen fins would come out otherwise than when they were drawn last.
 */
bool fin_stream_prepare(struct fin_stream *stream, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, const struct fin_maps *maps,
	uint64_t *flags, struct screen_box *part, struct sm_error *error);

/** Uploads the fins that touch a part of a target's screen. Of any two the same is drawn first,
 *  whatever the part. False: out of memory, as *error says. */
bool fin_stream_upload(struct fin_stream *stream, struct gpu *gpu, const struct target *target,
	const struct screen_box *part, struct sm_error *error);

/** How far, NDC, from a texel casters may be that what fins leave there depends on: as far as these
 *  go, and for the surface that they look up beside their silhouette two texels more. */
float fin_stream_reach(
	const struct fin_shape *shape, const struct light_frame *frame, GLsizei map_size);

/** Half the width of a penumbra, in texels, over the difference of blocker and receiver in window
 *  depth: for a spot R (1/b - 1/r) is proportional to that as well. */
float fin_stream_spread(const struct light_frame *frame, GLsizei map_size);

/** Draws the uploaded fins with a program that is in use; nothing when there are none. */
bool fin_stream_draw(struct fin_stream *stream, struct gpu *gpu, const struct program *program,
	struct sm_error *error);

#endif
