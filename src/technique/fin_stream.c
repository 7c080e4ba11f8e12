/* SPDX-License-Identifier: MIT */
#include "technique/fin_stream.h"
#include "base/array.h"
#include "base/error.h"
#include "base/processor_time.h"
#include "technique/disc.h"
#include <stdlib.h>

void fin_stream_init(struct fin_stream *stream, struct gpu *gpu)
{
	struct gl *gl = &gpu->gl;
	stream->set.workers = &gpu->workers;
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
	object_watch_finish(&stream->receivers);
	free(stream->grids);
	free(stream->depths);
	stream->grids = NULL;
	stream->depths = NULL;
}

void fin_stream_list_memory(const struct fin_stream *stream, const struct memory_list *list)
{
	fin_set_list_memory(&stream->set, list);
	object_watch_list_memory(&stream->receivers, list);
	memory_list_processor(list, "fins: grids",
		stream->grid_capacity * sizeof(*stream->grids) +
			(stream->depths != NULL ? sizeof(*stream->depths) : 0));
}

static const uint8_t quad_edges[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};

/* Cells by which a surface may lie beside texels that it looks up, whose centres lie up to one
 * texel off; half a texel more for what the rasteriser snaps. */
static float slack_of(int cells, GLsizei map_size)
{
	return 1.5f * (float)cells / (float)map_size;
}

static void mark_part(struct screen_grid *grid, const struct fin_set *set,
	const struct fin_part *part, GLsizei map_size)
{
	float slack = slack_of(SCREEN_GRID_SIZE, map_size);
	screen_grid_clear(grid);
	for (size_t quad = part->first; quad < part->first + part->count; quad += 4) {
		struct screen_point corners[4];
		for (int i = 0; i < 4; i++)
			corners[i] =
				(struct screen_point){set->vertices[quad + (size_t)i].position[0],
					set->vertices[quad + (size_t)i].position[1]};
		screen_grid_add(grid, corners, quad_edges, 4, slack);
	}
}

static bool mark_fins(struct fin_stream *stream, GLsizei map_size)
{
	const struct fin_set *set = &stream->set;
	screen_grid_clear(&stream->grid);
	if (!array_reserve((void **)&stream->grids, &stream->grid_capacity, set->part_count,
		    sizeof(*stream->grids)))
		return false;
	for (size_t i = 0; i < set->part_count; i++) {
		if (set->parts[i].fresh)
			mark_part(&stream->grids[i], set, &set->parts[i], map_size);
		screen_grid_unite(&stream->grid, &stream->grids[i]);
	}
	return true;
}

/* Of all casters that have changed. changed: widened to where fins were or are that have. */
static bool find_fins(struct fin_stream *stream, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape,
	const struct depth_map *casters, struct screen_box *changed, struct sm_error *error)
{
	GLsizei map_size = casters->target.size;
	gl_push_group(&gpu->gl, "silhouettes");
	double start = processor_ms();
	bool built = fin_set_update(&stream->set, scene, frame, shape, (uint32_t)map_size,
			     !gpu->skips.off[SKIP_CASTER], &casters->watch, changed) &&
		     mark_fins(stream, map_size);
	if (built) {
		skip_count(&gpu->skips, SKIP_CASTER, stream->set.caster_count,
			stream->set.missing_count);
		gpu->stats.silhouette_edges += stream->set.edge_count;
		gpu->stats.fins_left_out += stream->set.left_out_count;
		gpu->stats.silhouette_ms += processor_ms() - start;
	}
	gl_pop_group(&gpu->gl);
	return built || error_no_memory(error);
}

/* To all fins of the objects of which some touch a part of a target's screen. */
static void widen(
	const struct fin_stream *stream, const struct target *target, struct screen_box *changed)
{
	const struct screen_box reach = target_part_reach(target, changed);
	for (size_t i = 0; i < stream->set.part_count; i++)
		if (screen_box_touches(&stream->set.parts[i].box, &reach))
			screen_box_add(changed, &stream->set.parts[i].box);
}

/* Narrows a part to where fins are or were. Where the map is not drawn whole, all beside those has
 * been cleared before. */
static void narrow(
	struct fin_stream *stream, const struct depth_map *casters, struct screen_box *part)
{
	struct screen_box held = screen_box_none(), either = stream->held;
	for (size_t i = 0; i < stream->set.part_count; i++)
		screen_box_add(&held, &stream->set.parts[i].box);
	screen_box_add(&either, &held);
	if (!screen_box_is_all(&casters->changed))
		depth_map_narrow(part, &either);
	stream->held = held;
}

/* The cells that fins are in. */
static struct screen_box find_bounds(const struct fin_stream *stream)
{
	const float cell = 2.0f / SCREEN_GRID_SIZE;
	int min[2], max[2];
	if (!screen_grid_bounds(&stream->grid, min, max))
		return screen_box_none();
	return (struct screen_box){
		{(float)min[0] * cell - 1.0f, (float)min[1] * cell - 1.0f},
		{(float)max[0] * cell - 1.0f, (float)max[1] * cell - 1.0f},
	};
}

/* What fins that are drawn into a part look at. */
static bool draw_receivers(struct fin_stream *stream, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, const struct fin_maps *maps,
	struct screen_box part, struct sm_error *error)
{
	const struct target *target = &maps->casters->target;
	const struct screen_box bounds = find_bounds(stream);
	if (shape->both_sides)
		widen(stream, target, &part);
	screen_box_cut(&part, &bounds);
	return depth_map_init_once(maps->receivers, gpu, target->size, error) &&
	       depth_map_draw_part(
		       maps->receivers, gpu, scene, frame, DEPTH_OF_RECEIVERS_ONLY, &part, error);
}

/* Window depth: by what rasterisers, and shaders that find where a surface is, round. */
#define DEPTH_ROUNDING 1e-5f

static void add_depths(struct screen_depths *depths, const struct fin_vertex quad[4], float slack)
{
	struct screen_point corners[4];
	float least = INFINITY;
	for (int i = 0; i < 4; i++) {
		corners[i] = (struct screen_point){quad[i].position[0], quad[i].position[1]};
		least = fminf(least, 0.5f * quad[i].position[2] + 0.5f - DEPTH_ROUNDING);
	}
	screen_depths_add(depths, corners, quad_edges, 4, slack, least);
}

/* Where fins have changed in a part of the screen. */
static bool find_depths(struct fin_stream *stream, GLsizei map_size, const struct screen_box *part)
{
	const float cell = 2.0f / SCREEN_DEPTHS_SIZE;
	const float slack = slack_of(SCREEN_DEPTHS_SIZE, map_size);
	const struct fin_set *set = &stream->set;
	struct screen_box cleared = screen_box_widened(part, slack * cell);
	if (stream->depths == NULL && set->vertex_count == 0)
		return true;
	if (stream->depths == NULL) {
		stream->depths = malloc(sizeof(*stream->depths));
		cleared = screen_box_all();
	}
	if (stream->depths == NULL)
		return false;
	screen_depths_clear(stream->depths, &cleared);
	const struct screen_box reach = screen_box_widened(&cleared, (slack + 1.0f) * cell);
	for (size_t i = 0; i < set->part_count; i++) {
		const struct fin_part *fins = &set->parts[i];
		for (size_t j = 0; screen_box_touches(&fins->box, &reach) && j < fins->count;
			j += 4)
			add_depths(stream->depths, &set->vertices[fins->first + j], slack);
	}
	return true;
}

static bool prepare(struct fin_stream *stream, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, const struct fin_maps *maps,
	uint64_t *flags, struct screen_box *part, struct sm_error *error)
{
	if (!depth_map_draw(maps->casters, gpu, scene, frame, error))
		return false;
	*part = maps->casters->changed;
	if (!find_fins(stream, gpu, scene, frame, shape, maps->casters, part, error) ||
		!depth_map_look_at_receivers(&stream->receivers, scene, frame, part, error))
		return false;
	if (stream->set.vertex_count > 0 && depth_map_has_content(scene, DEPTH_OF_RECEIVERS_ONLY))
		*flags |= FLAG_RECEIVER_MAP;
	if (*flags != stream->drawn_flags)
		*part = screen_box_all();
	stream->drawn_flags = *flags;
	/* Which look at what is beside their silhouettes. */
	if (shape->both_sides)
		widen(stream, &maps->casters->target, part);
	narrow(stream, maps->casters, part);
	if (!find_depths(stream, maps->casters->target.size, part))
		return error_no_memory(error);
	return screen_box_is_none(part) || !(*flags & FLAG_RECEIVER_MAP) ||
	       draw_receivers(stream, gpu, scene, frame, shape, maps, *part, error);
}

bool fin_stream_prepare(struct fin_stream *stream, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, const struct fin_maps *maps,
	uint64_t *flags, struct screen_box *part, struct sm_error *error)
{
	bool done = prepare(stream, gpu, scene, frame, shape, maps, flags, part, error);
	/* What has changed since is known no more. */
	if (!done)
		depth_map_forget(maps->casters);
	return done;
}

/* From a part on, the last of those that follow each other and are all uploaded, or all not. */
static size_t find_run(
	const struct fin_set *set, size_t first, const struct screen_box *reach, bool *touches)
{
	*touches = screen_box_touches(&set->parts[first].box, reach);
	size_t last = first;
	while (last + 1 < set->part_count &&
		screen_box_touches(&set->parts[last + 1].box, reach) == *touches)
		last++;
	return last;
}

void fin_stream_upload(struct fin_stream *stream, struct gpu *gpu, const struct target *target,
	const struct screen_box *part)
{
	const struct fin_set *set = &stream->set;
	size_t size = sizeof(*set->vertices), used = 0;
	const struct screen_box reach = target_part_reach(target, part);
	bool touches;
	gl_fill_buffer(&gpu->gl, GL_ARRAY_BUFFER, stream->buffer, set->vertex_count * size, NULL,
		GL_STREAM_DRAW);
	for (size_t first = 0, last; first < set->part_count; first = last + 1) {
		last = find_run(set, first, &reach, &touches);
		const struct fin_part *end = &set->parts[last];
		size_t start = set->parts[first].first, count = end->first + end->count - start;
		if (!touches || count == 0)
			continue;
		gpu->gl.BufferSubData(GL_ARRAY_BUFFER, (GLintptr)(used * size),
			(GLsizeiptr)(count * size), set->vertices + start);
		used += count;
	}
	stream->quads = used / 4;
	gpu->stats.fin_vertices += used;
	gpu->stats.uploaded_bytes += used * size;
}

float fin_stream_reach(
	const struct fin_shape *shape, const struct light_frame *frame, GLsizei map_size)
{
	return fin_shape_reach(shape, frame, (uint32_t)map_size) + 2.0f * 2.0f / (float)map_size;
}

float fin_stream_spread(const struct light_frame *frame, GLsizei map_size)
{
	return (float)map_size * disc_scale(frame);
}

bool fin_stream_draw(struct fin_stream *stream, struct gpu *gpu, struct sm_error *error)
{
	if (stream->quads == 0)
		return true;
	gpu->gl.BindVertexArray(stream->array);
	return gpu_draw_quads(gpu, stream->quads, error);
}
