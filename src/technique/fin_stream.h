/* SPDX-License-Identifier: MIT */
#ifndef TECHNIQUE_FIN_STREAM_H
#define TECHNIQUE_FIN_STREAM_H

#include "geom/fins.h"
#include "geom/screen_grid.h"
#include "technique/technique.h"

/** The fins of one light: found on the processor each frame, and drawn from one buffer. */
struct fin_stream {
	GLuint array, buffer;
	uint64_t *facing;
	struct silhouette_edge *edges;
	struct fin_vertex *vertices;
	struct fin_scratch scratch;
	size_t facing_capacity, edge_capacity, vertex_capacity;
	size_t vertex_count;
	struct screen_grid grid; /* where surfaces that look them up may be */
};

void fin_stream_init(struct fin_stream *stream, struct gpu *gpu);
/** Fine on a zeroed one. */
void fin_stream_finish(struct fin_stream *stream, struct gpu *gpu);

/** Of the processor's memory. */
size_t fin_stream_bytes(const struct fin_stream *stream);

/** Finds the silhouettes of all casters, builds their fins and uploads them. width: t as a share
 *  of the light's screen, or 0 for the light's radius. map_size: texels a side that they are drawn
 *  over. */
bool fin_stream_update(struct fin_stream *stream, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, float width, GLsizei map_size, struct sm_error *error);

/** Draws the fins with the program in use; nothing when there are none. */
bool fin_stream_draw(struct fin_stream *stream, struct gpu *gpu, struct sm_error *error);

#endif
