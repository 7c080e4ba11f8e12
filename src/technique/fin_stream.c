/* SPDX-License-Identifier: MIT */
#include "technique/fin_stream.h"
#include "base/processor_time.h"
#include "technique/disc.h"

void fin_stream_init(struct fin_stream *stream, struct gpu *gpu)
{
	struct gl *gl = &gpu->gl;
	stream->array = gl_create_vertex_array(gl);
	stream->buffer = gl_create_buffer(gl, STORAGE_FINS);
	gl->BindVertexArray(stream->array);
	gl->BindBuffer(GL_ARRAY_BUFFER, stream->buffer);
	static const struct {
		enum attribute attribute;
		GLint size;
		size_t offset;
	} layout[] = {
		{ATTRIBUTE_POSITION, 3, offsetof(struct fin_vertex, position)},
		{ATTRIBUTE_OFFSET, 2, offsetof(struct fin_vertex, offset)},
		{ATTRIBUTE_WIDTH, 1, offsetof(struct fin_vertex, width)},
	};
	for (size_t i = 0; i < sizeof(layout) / sizeof(layout[0]); i++) {
		gl->EnableVertexAttribArray(layout[i].attribute);
		gl->VertexAttribPointer(layout[i].attribute, layout[i].size, GL_FLOAT, GL_FALSE,
			sizeof(struct fin_vertex), (const void *)layout[i].offset);
	}
	gl->BindVertexArray(0);
}

void fin_stream_finish(struct fin_stream *stream, struct gpu *gpu)
{
	gl_delete_vertex_array(&gpu->gl, &stream->array);
	gl_delete_buffer(&gpu->gl, &stream->buffer);
	fin_set_finish(&stream->set);
}

static void mark_fins(struct fin_stream *stream, GLsizei map_size)
{
	static const uint8_t edges[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
	/* A surface looks up texels whose centres lie up to one texel off; half a texel more for
	 * what the rasteriser snaps. */
	float slack = 1.5f * SCREEN_GRID_SIZE / (float)map_size;
	for (size_t quad = 0; quad < stream->set.vertex_count; quad += 4) {
		struct screen_point corners[4];
		for (int i = 0; i < 4; i++)
			corners[i] = (struct screen_point){
				stream->set.vertices[quad + (size_t)i].position[0],
				stream->set.vertices[quad + (size_t)i].position[1]};
		screen_grid_add(&stream->grid, corners, edges, 4, slack);
	}
}

static void upload(struct fin_stream *stream, struct gpu *gpu)
{
	size_t bytes = stream->set.vertex_count * sizeof(*stream->set.vertices);
	gl_fill_buffer(&gpu->gl, GL_ARRAY_BUFFER, stream->buffer, bytes, stream->set.vertices,
		GL_STREAM_DRAW);
	gpu->stats.fin_vertices += stream->set.vertex_count;
	gpu->stats.uploaded_bytes += bytes;
}

bool fin_stream_update(struct fin_stream *stream, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, GLsizei map_size,
	struct sm_error *error)
{
	stream->set.vertex_count = 0;
	screen_grid_clear(&stream->grid);
	if (!fin_shape_has_width(shape, frame))
		return true;
	gl_push_group(&gpu->gl, "silhouettes");
	double start = processor_ms();
	bool built = fin_set_find(&stream->set, scene, frame, shape, (uint32_t)map_size,
		!gpu->skips.off[SKIP_CASTER]);
	if (built) {
		skip_count(&gpu->skips, SKIP_CASTER, stream->set.caster_count,
			stream->set.missing_count);
		mark_fins(stream, map_size);
		gpu->stats.silhouette_edges += stream->set.edge_count;
		gpu->stats.silhouette_ms += processor_ms() - start;
		upload(stream, gpu);
	}
	gl_pop_group(&gpu->gl);
	return built || error_no_memory(error);
}

struct target_area fin_stream_area(const struct fin_stream *stream, GLsizei map_size)
{
	int min[2], max[2];
	if (!screen_grid_bounds(&stream->grid, min, max))
		return (struct target_area){0};
	GLint x = min[0] * map_size / SCREEN_GRID_SIZE, y = min[1] * map_size / SCREEN_GRID_SIZE;
	/* Up to the texel that the last cell ends in. */
	GLint right = (max[0] * map_size + SCREEN_GRID_SIZE - 1) / SCREEN_GRID_SIZE;
	GLint top = (max[1] * map_size + SCREEN_GRID_SIZE - 1) / SCREEN_GRID_SIZE;
	return (struct target_area){x, y, right - x, top - y};
}

float fin_stream_spread(const struct light_frame *frame, GLsizei map_size)
{
	return (float)map_size * disc_scale(frame);
}

bool fin_stream_draw(struct fin_stream *stream, struct gpu *gpu, struct sm_error *error)
{
	if (stream->set.vertex_count == 0)
		return true;
	gpu->gl.BindVertexArray(stream->array);
	return gpu_draw_quads(gpu, stream->set.vertex_count / 4, error);
}
