/* SPDX-License-Identifier: MIT */
#include "technique/fin_stream.h"
#include "base/array.h"
#include "base/error.h"
#include "base/processor_time.h"
#include "technique/disc.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof(struct fin) == 32, "two vectors of four, as in smoothie_fin.vert");

/* Uniform buffers may be bound at multiples of 256 bytes, whatever the driver. */
#define ALIGNED_FINS (256 / sizeof(struct fin))
_Static_assert(BLOCK_FINS % ALIGNED_FINS == 0, "no block starts amid an offset");

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
	free(stream->sorted);
	free(stream->depths);
	stream->sorted = NULL;
	stream->depths = NULL;
}

void fin_stream_list_memory(const struct fin_stream *stream, const struct memory_list *list)
{
	fin_set_list_memory(&stream->set, list);
	object_watch_list_memory(&stream->receivers, list);
	memory_list_processor(
		list, "fins: sorted", stream->sorted_capacity * sizeof(*stream->sorted));
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
	stream->set.tests_all = gpu->skips.off[SKIP_TRIANGLE];
	bool built = fin_set_update(&stream->set, scene, frame, shape, (uint32_t)map_size,
		!gpu->skips.off[SKIP_CASTER], &casters->watch, changed);
	screen_grid_clear(&stream->grid);
	if (built) {
		for (size_t i = 0; i < stream->set.part_count; i++)
			screen_grid_unite(&stream->grid, &stream->set.parts[i].grid);
		skip_count(&gpu->skips, SKIP_CASTER, stream->set.caster_count,
			stream->set.missing_count);
		skip_count(&gpu->skips, SKIP_TRIANGLE, stream->set.block_count,
			stream->set.block_count - stream->set.tested_count);
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

/* The larger ones first, each where a buffer may be bound. Returns where the last one ends. */
static size_t find_groups(struct fin_stream *stream, const struct screen_box *reach)
{
	const struct fin_set *set = &stream->set;
	size_t end = 0;
	for (size_t n = FIN_QUADS_MAX; n-- > 0;) {
		struct fin_group *group = &stream->groups[n];
		group->first = (end + ALIGNED_FINS - 1) / ALIGNED_FINS * ALIGNED_FINS;
		group->count = 0;
		for (size_t i = 0; i < set->part_count; i++)
			if (screen_box_touches(&set->parts[i].box, reach))
				group->count += set->parts[i].groups[n];
		if (group->count > 0)
			end = group->first + group->count;
	}
	return end;
}

/* Into their groups, in the order of objects. */
static void sort_fins(struct fin_stream *stream, const struct screen_box *reach)
{
	const struct fin_set *set = &stream->set;
	size_t next[FIN_QUADS_MAX];
	for (size_t n = 0; n < FIN_QUADS_MAX; n++)
		next[n] = stream->groups[n].first;
	for (size_t i = 0; i < set->part_count; i++) {
		const struct fin_part *part = &set->parts[i];
		if (!screen_box_touches(&part->box, reach))
			continue;
		const struct fin *fins = set->fins + part->first;
		for (size_t f = 0; f < part->count; f++)
			stream->sorted[next[fin_quads(&fins[f], set->both_sides) - 1]++] = fins[f];
	}
}

static size_t whole_blocks(size_t count)
{
	return count / BLOCK_FINS + (count % BLOCK_FINS > 0);
}

bool fin_stream_upload(struct fin_stream *stream, struct gpu *gpu, const struct target *target,
	const struct screen_box *part, struct sm_error *error)
{
	const struct screen_box reach = target_part_reach(target, part);
	const size_t size = sizeof(*stream->sorted), end = find_groups(stream, &reach);
	if (!array_reserve((void **)&stream->sorted, &stream->sorted_capacity, end, size))
		return error_no_memory(error);
	if (end == 0)
		return true;
	memset(stream->sorted, 0, end * size); /* also between groups */
	sort_fins(stream, &reach);
	/* The last block of a group may reach beyond all. */
	upload_ring_turn(&stream->ring, &gpu->gl, STORAGE_FINS, GL_UNIFORM_BUFFER,
		(whole_blocks(end) + 1) * BLOCK_FINS * size);
	gpu->gl.BufferSubData(GL_UNIFORM_BUFFER, 0, (GLsizeiptr)(end * size), stream->sorted);
	for (size_t n = 1; n <= FIN_QUADS_MAX; n++)
		gpu->stats.fin_vertices += 4 * n * stream->groups[n - 1].count;
	gpu->stats.fin_bytes += end * size;
	gpu->stats.uploaded_bytes += end * size;
	return true;
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
	size_t size = sizeof(*stream->sorted);
	gpu->gl.BindBufferRange(GL_UNIFORM_BUFFER, 0, upload_ring_buffer(&stream->ring),
		(GLintptr)(first * size), (GLsizeiptr)(BLOCK_FINS * size));
	return gpu_draw_quads(gpu, quads, error);
}

/* Of fins of so many quads. */
static bool draw_group(struct fin_stream *stream, struct gpu *gpu, const struct program *program,
	size_t quads, struct sm_error *error)
{
	const struct fin_group *group = &stream->groups[quads - 1];
	gpu->gl.Uniform1i(program->uniform.fin_quads, (GLint)quads);
	for (size_t done = 0; done < group->count; done += BLOCK_FINS) {
		size_t rest = group->count - done, count = rest < BLOCK_FINS ? rest : BLOCK_FINS;
		if (!draw_block(stream, gpu, group->first + done, quads * count, error))
			return false;
	}
	return true;
}

bool fin_stream_draw(struct fin_stream *stream, struct gpu *gpu, const struct program *program,
	struct sm_error *error)
{
	const struct fin_law *law = &stream->set.law;
	gpu->gl.Uniform3f(program->uniform.fin_law, law->width_far, law->drawn_far, law->slope);
	gpu->gl.Uniform1i(program->uniform.both_sides, stream->set.both_sides);
	gpu->gl.BindVertexArray(stream->array);
	for (size_t quads = FIN_QUADS_MAX; quads > 0; quads--)
		if (stream->groups[quads - 1].count > 0 &&
			!draw_group(stream, gpu, program, quads, error))
			return false;
	return true;
}
