/* SPDX-License-Identifier: MIT */
#ifndef TECHNIQUE_FIN_STREAM_H
#define TECHNIQUE_FIN_STREAM_H

#include "geom/screen_grid.h"
#include "gles/target.h"
#include "scene/fin_set.h"
#include "technique/technique.h"

/** The fins of one light: found on the processor each frame, and drawn from one buffer. */
struct fin_stream {
	GLuint array, buffer;
	struct fin_set set;
	struct screen_grid grid; /* where surfaces that look them up may be */
};

void fin_stream_init(struct fin_stream *stream, struct gpu *gpu);
/** Fine on a zeroed one. */
void fin_stream_finish(struct fin_stream *stream, struct gpu *gpu);

/** Finds the silhouettes of all casters, builds their fins and uploads them. map_size: texels a
 *  side that they are drawn over. */
bool fin_stream_update(struct fin_stream *stream, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, GLsizei map_size,
	struct sm_error *error);

/** Texels of the cells that fins are in. */
struct target_area fin_stream_area(const struct fin_stream *stream, GLsizei map_size);

/** Half the width of a penumbra, in texels, over the difference of blocker and receiver in window
 *  depth: for a spot R (1/b - 1/r) is proportional to that as well. */
float fin_stream_spread(const struct light_frame *frame, GLsizei map_size);

/** Draws the fins with the program in use; nothing when there are none. */
bool fin_stream_draw(struct fin_stream *stream, struct gpu *gpu, struct sm_error *error);

#endif
