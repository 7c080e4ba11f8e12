/* SPDX-License-Identifier: MIT */
#include "scene/fin_set.h"
#include "base/array.h"
#include "scene/light_reach.h"
#include <stdlib.h>
#include <string.h>

bool fin_shape_has_width(const struct fin_shape *shape, const struct light_frame *frame)
{
	return shape->width != 0.0f || frame->disc != 0.0f;
}

/* What a search is for. */
struct fin_search {
	const struct sm_scene *scene;
	const struct light_frame *frame;
	const struct fin_shape *shape;
	uint32_t map_size;
	bool on_screen;
};

static struct fin_law fin_law_of(
	const struct light_frame *frame, const struct fin_shape *shape, uint32_t map_size)
{
	struct fin_law law;
	float scale = shape->share * frame->disc / frame->half_extent;
	if (shape->width > 0.0f)
		law = fin_law_constant(2.0f * shape->width); /* the screen is two units wide */
	else if (frame->parallel)
		law = fin_law_parallel(scale * (frame->far - frame->near));
	else
		law = fin_law_perspective(scale, frame->near, frame->far);
	fin_law_add_apron(&law, shape->apron * 2.0f / (float)map_size);
	return law;
}

static struct fin_params fin_params_of(
	const struct fin_set *set, const struct fin_search *search, const struct object *object)
{
	struct fin_params params = {
		.law = set->law,
		.finest = set->both_sides ? 0.0f : 1.0f / (float)search->map_size,
		.both_sides = set->both_sides,
		.mirrored = glm_mat4_det((vec4 *)object->transform) < 0.0f,
	};
	mat4 to_clip;
	glm_mat4_mul((vec4 *)search->frame->world_to_clip, (vec4 *)object->transform, to_clip);
	memcpy(params.object_to_clip, to_clip, sizeof(params.object_to_clip));
	return params;
}

static bool reserve_tracks(struct fin_set *set, size_t count)
{
	size_t had = set->track_count;
	if (!array_reserve((void **)&set->tracks, &set->track_count, count, sizeof(*set->tracks)))
		return false;
	if (set->track_count > had)
		memset(&set->tracks[had], 0, (set->track_count - had) * sizeof(*set->tracks));
	return true;
}

static bool append_fins(struct fin_set *set, const struct caster *caster,
	const struct silhouette_track *track, const struct fin_params *params)
{
	size_t most = set->count + fins_max(track->edge_count);
	if (!fin_scratch_reserve(&set->scratch, caster, track->edge_count) ||
		!array_reserve((void **)&set->fins, &set->capacity, most, sizeof(*set->fins)))
		return false;
	set->count += fins_build(caster, track->edges, track->edge_count, params, &set->scratch,
		set->fins + set->count, set->capacity - set->count);
	set->left_out_count += set->scratch.left_out_count;
	return true;
}

void fin_set_finish(struct fin_set *set)
{
	fin_scratch_finish(&set->scratch);
	free(set->parts);
	free(set->before);
	for (size_t i = 0; i < set->track_count; i++)
		silhouette_track_finish(&set->tracks[i]);
	free(set->tracks);
	free(set->fins);
	*set = (struct fin_set){0};
}

void fin_set_list_memory(const struct fin_set *set, const struct memory_list *list)
{
	size_t tracks = set->track_count * sizeof(*set->tracks);
	for (size_t i = 0; i < set->track_count; i++)
		tracks += silhouette_track_bytes(&set->tracks[i]);
	memory_list_processor(list, "silhouettes: tracks", tracks);
	memory_list_processor(list, "fins: corners", fin_scratch_bytes(&set->scratch));
	memory_list_processor(
		list, "fins: list", (set->capacity + set->before_capacity) * sizeof(*set->fins));
	memory_list_processor(list, "fins: objects", set->part_capacity * sizeof(*set->parts));
}

/* A bound on how far a fin goes from its silhouette, NDC: at a corner it is longer than wide. What
 * is nearer than the near plane has none. */
static float fin_reach(const struct fin_law *law)
{
	return 1.5f * fin_law_drawn(law, -1.0f);
}

float fin_slack(int cells, uint32_t map_size)
{
	return 1.5f * (float)cells / (float)map_size;
}

static void mark_hull(struct fin_part *part, const struct fin_vertex *const around[4], float slack)
{
	static const uint8_t edges[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
	struct screen_point corners[4];
	for (int i = 0; i < 4; i++) {
		const float *position = around[i]->position;
		corners[i] = (struct screen_point){position[0], position[1]};
		screen_box_add_point(&part->box, position[0], position[1]);
	}
	screen_grid_add(&part->grid, corners, edges, 4, slack);
}

static void mark_fins(const struct fin_set *set, struct fin_part *part, uint32_t map_size)
{
	float slack = fin_slack(SCREEN_GRID_SIZE, map_size);
	struct fin_vertex v[FIN_VERTICES_MAX];
	for (size_t i = part->first; i < part->first + part->count; i++) {
		size_t count = fin_set_expand(set, i, v);
		size_t first = 0;
		part->groups[count / 4 - 1]++;
		if (set->both_sides && fin_has_edge(&set->fins[i])) {
			/* Along an edge, both sides are one quad about it. */
			mark_hull(part, (const struct fin_vertex *[]){&v[3], &v[2], &v[6], &v[7]},
				slack);
			first = 8;
		}
		for (const struct fin_vertex *quad = v + first; quad < v + count; quad += 4)
			mark_hull(part,
				(const struct fin_vertex *[]){quad, quad + 1, quad + 2, quad + 3},
				slack);
	}
}

float fin_shape_reach(
	const struct fin_shape *shape, const struct light_frame *frame, uint32_t map_size)
{
	const struct fin_law law = fin_law_of(frame, shape, map_size);
	return fin_reach(&law);
}

/* Appends the fins of one caster. */
static bool add_caster(struct fin_set *set, const struct fin_search *search,
	const struct object *object, struct silhouette_track *track, struct fin_part *part)
{
	const struct caster *caster = &search->scene->meshes[object->mesh].caster;
	struct fin_params params = fin_params_of(set, search, object);
	mat4 to_object;
	vec4 light;
	glm_mat4_inv((vec4 *)object->transform, to_object);
	glm_mat4_mulv(to_object, (float *)search->frame->origin, light);
	bool found = set->tests_all ? silhouette_track_all(track, caster, light)
				    : silhouette_track(track, caster, light, set->workers);
	if (!found || !append_fins(set, caster, track, &params))
		return false;
	set->block_count += facing_words(caster);
	set->tested_count += track->tested;
	part->edge_count = track->edge_count;
	part->count = set->count - part->first;
	mark_fins(set, part, search->map_size);
	set->edge_count += part->edge_count;
	return true;
}

static bool make_part(
	struct fin_set *set, const struct fin_search *search, size_t index, bool left_out)
{
	const struct object *object = &search->scene->objects[index];
	struct fin_part *part = &set->parts[index];
	const struct light_frame *frame = search->frame;
	const struct mesh *mesh = &search->scene->meshes[object->mesh];
	*part = (struct fin_part){.first = set->count,
		.casts = object->casts && !left_out,
		.fresh = true,
		.box = screen_box_none()};
	if (!part->casts)
		return true;
	part->missing = search->on_screen &&
			mesh_misses_screen(mesh, (vec4 *)object->transform,
				(vec4 *)frame->world_to_clip, fin_reach(&set->law), false);
	return part->missing || add_caster(set, search, object, &set->tracks[index], part);
}

/* Appends what the search before found. */
static bool keep_part(struct fin_set *set, struct fin_part *part)
{
	if (!array_reserve((void **)&set->fins, &set->capacity, set->count + part->count,
		    sizeof(*set->fins)))
		return false;
	if (part->count > 0)
		memcpy(set->fins + set->count, set->before + part->first,
			part->count * sizeof(*set->fins));
	part->first = set->count;
	part->fresh = false;
	set->count += part->count;
	return true;
}

/* Has the fins that some are kept of out of the way. */
static void set_aside(struct fin_set *set)
{
	struct fin *fins = set->fins;
	size_t capacity = set->capacity;
	set->fins = set->before;
	set->capacity = set->before_capacity;
	set->before = fins;
	set->before_capacity = capacity;
}

static bool keeps_any(const struct object_watch *watch, size_t known)
{
	for (size_t i = 0; i < known && i < watch->count; i++)
		if (!watch->objects[i].changed)
			return true;
	return false;
}

static bool find_part(struct fin_set *set, const struct fin_search *search, size_t index,
	const struct object_watch *watch, struct screen_box *changed)
{
	struct fin_part *part = &set->parts[index];
	bool known = index < set->part_count;
	if (known && watch != NULL && !watch->objects[index].changed)
		return keep_part(set, part);
	if (known)
		screen_box_add(changed, &part->box);
	if (!make_part(set, search, index, watch != NULL && watch->objects[index].left_out))
		return false;
	screen_box_add(changed, &part->box);
	set->caster_count += part->casts;
	set->missing_count += part->missing;
	return true;
}

size_t fin_set_expand(
	const struct fin_set *set, size_t index, struct fin_vertex out[FIN_VERTICES_MAX])
{
	return fin_expand(&set->fins[index], &set->law, set->both_sides, out);
}

size_t fin_set_quads(const struct fin_set *set)
{
	size_t quads = 0;
	for (size_t i = 0; i < set->part_count; i++)
		for (size_t n = 1; n <= FIN_QUADS_MAX; n++)
			quads += n * set->parts[i].groups[n - 1];
	return quads;
}

void fin_set_clear(struct fin_set *set)
{
	set->count = set->part_count = 0;
	set->edge_count = set->caster_count = set->missing_count = set->left_out_count = 0;
	set->block_count = set->tested_count = 0;
}

bool fin_set_update(struct fin_set *set, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, uint32_t map_size,
	bool on_screen, const struct object_watch *watch, struct screen_box *changed)
{
	const struct fin_search search = {scene, frame, shape, map_size, on_screen};
	size_t known = watch != NULL ? set->part_count : 0;
	fin_set_clear(set);
	if (!fin_shape_has_width(shape, frame))
		return true;
	set->law = fin_law_of(frame, shape, map_size);
	set->both_sides = shape->both_sides;
	if (!reserve_tracks(set, scene->object_count) ||
		!array_reserve((void **)&set->parts, &set->part_capacity, scene->object_count,
			sizeof(*set->parts)))
		return false;
	if (keeps_any(watch, known)) {
		set_aside(set);
	} else {
		free(set->before);
		set->before = NULL;
		set->before_capacity = 0;
	}
	set->part_count = known;
	for (size_t i = 0; i < scene->object_count; i++)
		if (!find_part(set, &search, i, watch, changed)) {
			fin_set_clear(set);
			return false;
		}
	set->part_count = scene->object_count;
	return true;
}

bool fin_set_find(struct fin_set *set, const struct sm_scene *scene,
	const struct light_frame *frame, const struct fin_shape *shape, uint32_t map_size,
	bool on_screen)
{
	struct screen_box unused = screen_box_none();
	return fin_set_update(set, scene, frame, shape, map_size, on_screen, NULL, &unused);
}
