/* SPDX-License-Identifier: MIT */
#include "technique/fin_stream.h"
#include "base/error.h"
#include "base/processor_time.h"
#include "technique/disc.h"
#include <math.h>
#include <stdlib.h>

_Static_assert(sizeof(struct fin) == 32, "two vectors of four, as in smoothie_fin.vert");
/* Which uniform buffers may be bound at: multiples of 256 bytes at most. */
_Static_assert(BLOCK_FINS * sizeof(struct fin) % 256 == 0, "no block starts amid an offset");

void fin_stream_init(struct fin_stream *stream, struct gpu *gpu)
{
	stream->set.workers = &gpu->workers;
	stream->array = gl_create_vertex_array(&gpu->gl);
}

void fin_stream_finish(struct fin_stream *stream, struct gpu *gpu)
{
	gl_delete_vertex_array(&gpu->gl, &stream->array);
	upload_ring_finish(&stream->ring, &gpu->gl);
	fin_set_finish(&stream->set);
	object_watch_finish(&stream->receivers);
	free(stream->depths);
	stream->depths = NULL;
}

void fin_stream_list_memory(const struct fin_stream *stream, const struct memory_list *list)
{
	fin_set_list_memory(&stream->set, list);
	object_watch_list_memory(&stream->receivers, list);
	memory_list_processor(
		list, "fins: depths", stream->depths != NULL ? sizeof(*stream->depths) : 0);
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
		!gpu->skips.off[SKIP_CASTER], &casters->watch, changed);
	screen_grid_clear(&stream->grid);
	if (built) {
		for (size_t i = 0; i < stream->set.part_count; i++)
			screen_grid_unite(&stream->grid, &stream->set.parts[i].grid);
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
	static const uint8_t edges[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
	struct screen_point corners[4];
	float least = INFINITY;
	for (int i = 0; i < 4; i++) {
		corners[i] = (struct screen_point){quad[i].position[0], quad[i].position[1]};
		least = fminf(least, 0.5f * quad[i].position[2] + 0.5f - DEPTH_ROUNDING);
	}
	screen_depths_add(depths, corners, edges, 4, slack, least);
}

static void add_part_depths(struct screen_depths *depths, const struct fin_set *set,
	const struct fin_part *part, float slack)
{
	struct fin_vertex v[FIN_VERTICES_MAX];
	for (size_t i = part->first; i < part->first + part->count; i++) {
		size_t count = fin_set_expand(set, i, v);
		for (const struct fin_vertex *quad = v; quad < v + count; quad += 4)
			add_depths(depths, quad, slack);
	}
}

/* Where fins have changed in a part of the screen. */
static bool find_depths(struct fin_stream *stream, GLsizei map_size, const struct screen_box *part)
{
	const float cell = 2.0f / SCREEN_DEPTHS_SIZE;
	const float slack = fin_slack(SCREEN_DEPTHS_SIZE, (uint32_t)map_size);
	const struct fin_set *set = &stream->set;
	struct screen_box cleared = screen_box_widened(part, slack * cell);
	if (stream->depths == NULL && set->count == 0)
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
		if (screen_box_touches(&fins->box, &reach))
			add_part_depths(stream->depths, set, fins, slack);
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
	if (stream->set.count > 0 && depth_map_has_content(scene, DEPTH_OF_RECEIVERS_ONLY))
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

/* Along the edge and around the corner, on one side or both. */
static size_t quads_of(const struct fin_stream *stream)
{
	return stream->set.both_sides ? 4 : 2;
}

static size_t whole_blocks(size_t count)
{
	return count / BLOCK_FINS + (count % BLOCK_FINS > 0);
}

void fin_stream_upload(struct fin_stream *stream, struct gpu *gpu, const struct target *target,
	const struct screen_box *part)
{
	const struct fin_set *set = &stream->set;
	struct gl *gl = &gpu->gl;
	size_t size = sizeof(*set->fins), used = 0;
	const struct screen_box reach = target_part_reach(target, part);
	bool touches;
	upload_ring_turn(&stream->ring, gl, STORAGE_FINS, GL_UNIFORM_BUFFER,
		whole_blocks(set->count) * BLOCK_FINS * size);
	for (size_t first = 0, last; first < set->part_count; first = last + 1) {
		last = find_run(set, first, &reach, &touches);
		const struct fin_part *end = &set->parts[last];
		size_t start = set->parts[first].first, count = end->first + end->count - start;
		if (!touches || count == 0)
			continue;
		gl->BufferSubData(GL_UNIFORM_BUFFER, (GLintptr)(used * size),
			(GLsizeiptr)(count * size), set->fins + start);
		used += count;
		gpu->stats.fin_vertices += 4 * fin_set_quads(set, first, last + 1 - first);
	}
	stream->uploaded = used;
	gpu->stats.fin_bytes += used * size;
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

static bool draw_block(struct fin_stream *stream, struct gpu *gpu, size_t first, size_t quads,
	struct sm_error *error)
{
	size_t size = sizeof(*stream->set.fins);
	gpu->gl.BindBufferRange(GL_UNIFORM_BUFFER, 0, upload_ring_buffer(&stream->ring),
		(GLintptr)(first * size), (GLsizeiptr)(BLOCK_FINS * size));
	return gpu_draw_quads(gpu, quads, error);
}

bool fin_stream_draw(struct fin_stream *stream, struct gpu *gpu, const struct program *program,
	struct sm_error *error)
{
	const struct fin_law *law = &stream->set.law;
	gpu->gl.Uniform3f(program->uniform.fin_law, law->width_far, law->drawn_far, law->slope);
	gpu->gl.Uniform1i(program->uniform.both_sides, stream->set.both_sides);
	gpu->gl.BindVertexArray(stream->array);
	for (size_t first = 0; first < stream->uploaded; first += BLOCK_FINS) {
		size_t rest = stream->uploaded - first;
		size_t count = rest < BLOCK_FINS ? rest : BLOCK_FINS;
		if (!draw_block(stream, gpu, first, quads_of(stream) * count, error))
			return false;
	}
	return true;
}
