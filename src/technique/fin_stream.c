/* SPDX-License-Identifier: MIT */
#include "technique/fin_stream.h"
#include "base/array.h"
#include "technique/disc.h"
#include <stdlib.h>
#include <string.h>
#include <time.h>

void fin_stream_init(struct fin_stream *stream, struct gpu *gpu)
{
	struct gl *gl = &gpu->gl;
	fin_scratch_init(&stream->scratch);
	stream->array = gl_create_vertex_array(gl);
	stream->buffer = gl_create_buffer(gl);
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
	fin_scratch_finish(&stream->scratch);
	free(stream->facing);
	free(stream->edges);
	free(stream->vertices);
}

static struct fin_params fin_params_of(const struct light_frame *frame, const struct object *object,
	const struct fin_shape *shape, GLsizei map_size)
{
	float texel = 2.0f / (float)map_size;
	struct fin_params params = {
		.pole = frame->pole,
		.finest = shape->both_sides ? 0.0f : 0.5f * texel,
		.apron = shape->apron * texel,
		.both_sides = shape->both_sides,
		.mirrored = glm_mat4_det((vec4 *)object->transform) < 0.0f,
	};
	mat4 to_clip;
	glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform, to_clip);
	memcpy(params.object_to_clip, to_clip, sizeof(params.object_to_clip));
	if (shape->width > 0.0f) {
		params.width = FIN_WIDTH_CONSTANT;
		params.scale = 2.0f * shape->width; /* the screen is two units of NDC wide */
		return params;
	}
	params.width = frame->parallel ? FIN_WIDTH_PARALLEL : FIN_WIDTH_PERSPECTIVE;
	params.scale = shape->share * frame->disc / frame->half_extent;
	if (frame->parallel)
		params.scale *= frame->far - frame->near;
	return params;
}

/* Fills stream->edges; returns false when out of memory. */
static bool find_silhouettes(
	struct fin_stream *stream, const struct caster *caster, const float light[4], size_t *count)
{
	if (!array_reserve((void **)&stream->facing, &stream->facing_capacity, facing_words(caster),
		    sizeof(*stream->facing)))
		return false;
	facing_find(caster, light, stream->facing);
	*count = silhouette_find(caster, stream->facing, stream->edges, stream->edge_capacity);
	if (*count <= stream->edge_capacity)
		return true;
	if (!array_reserve((void **)&stream->edges, &stream->edge_capacity, *count,
		    sizeof(*stream->edges)))
		return false;
	silhouette_find(caster, stream->facing, stream->edges, stream->edge_capacity);
	return true;
}

static bool append_fins(struct fin_stream *stream, const struct caster *caster, size_t edge_count,
	const struct fin_params *params)
{
	size_t most = stream->vertex_count + fins_max_vertices(edge_count, params->both_sides);
	if (!fin_scratch_reserve(&stream->scratch, caster, edge_count) ||
		!array_reserve((void **)&stream->vertices, &stream->vertex_capacity, most,
			sizeof(*stream->vertices)))
		return false;
	stream->vertex_count += fins_build(caster, stream->edges, edge_count, params,
		&stream->scratch, stream->vertices + stream->vertex_count,
		stream->vertex_capacity - stream->vertex_count);
	return true;
}

static double processor_ms(void)
{
	struct timespec now;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
	return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

static bool build(struct fin_stream *stream, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, GLsizei map_size)
{
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		if (!object->casts)
			continue;
		const struct caster *caster = &scene->meshes[object->mesh].caster;
		mat4 to_object;
		vec4 light;
		size_t edge_count;
		glm_mat4_inv((vec4 *)object->transform, to_object);
		glm_mat4_mulv(to_object, (float *)frame->origin, light);
		struct fin_params params = fin_params_of(frame, object, shape, map_size);
		if (!find_silhouettes(stream, caster, light, &edge_count) ||
			!append_fins(stream, caster, edge_count, &params))
			return false;
		gpu->stats.silhouette_edges += edge_count;
	}
	return true;
}

static void mark_fins(struct fin_stream *stream, GLsizei map_size)
{
	static const uint8_t edges[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
	/* A surface looks up texels whose centres lie up to one texel off; half a texel more for
	 * what the rasteriser snaps. */
	float slack = 1.5f * SCREEN_GRID_SIZE / (float)map_size;
	for (size_t quad = 0; quad < stream->vertex_count; quad += 4) {
		struct screen_point corners[4];
		for (int i = 0; i < 4; i++)
			corners[i] = (struct screen_point){
				stream->vertices[quad + (size_t)i].position[0],
				stream->vertices[quad + (size_t)i].position[1]};
		screen_grid_add(&stream->grid, corners, edges, 4, slack);
	}
}

static void upload(struct fin_stream *stream, struct gpu *gpu)
{
	size_t bytes = stream->vertex_count * sizeof(*stream->vertices);
	gpu->gl.BindBuffer(GL_ARRAY_BUFFER, stream->buffer);
	gpu->gl.BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)bytes, stream->vertices, GL_STREAM_DRAW);
	gpu->stats.fin_vertices += stream->vertex_count;
	gpu->stats.uploaded_bytes += bytes;
}

bool fin_stream_update(struct fin_stream *stream, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, GLsizei map_size,
	struct sm_error *error)
{
	stream->vertex_count = 0;
	screen_grid_clear(&stream->grid);
	/* A point light has no penumbra. */
	if (shape->width == 0.0f && frame->disc == 0.0f)
		return true;
	gl_push_group(&gpu->gl, "silhouettes");
	double start = processor_ms();
	bool built = build(stream, gpu, scene, frame, shape, map_size);
	if (built) {
		mark_fins(stream, map_size);
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

size_t fin_stream_bytes(const struct fin_stream *stream)
{
	return stream->facing_capacity * sizeof(*stream->facing) +
	       stream->edge_capacity * sizeof(*stream->edges) +
	       stream->vertex_capacity * sizeof(*stream->vertices) +
	       fin_scratch_bytes(&stream->scratch);
}

bool fin_stream_draw(struct fin_stream *stream, struct gpu *gpu, struct sm_error *error)
{
	if (stream->vertex_count == 0)
		return true;
	gpu->gl.BindVertexArray(stream->array);
	return gpu_draw_quads(gpu, stream->vertex_count / 4, error);
}
