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

/* Of fins of whatever object. */
static struct fin_params fin_params_of(
	const struct light_frame *frame, const struct fin_shape *shape, uint32_t map_size)
{
	float texel = 2.0f / (float)map_size;
	struct fin_params params = {
		.pole = frame->pole,
		.finest = shape->both_sides ? 0.0f : 0.5f * texel,
		.apron = shape->apron * texel,
		.both_sides = shape->both_sides,
	};
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

static void place_object(
	struct fin_params *params, const struct light_frame *frame, const struct object *object)
{
	mat4 to_clip;
	glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform, to_clip);
	memcpy(params->object_to_clip, to_clip, sizeof(params->object_to_clip));
	params->mirrored = glm_mat4_det((vec4 *)object->transform) < 0.0f;
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
	size_t most = set->vertex_count + fins_max_vertices(track->edge_count, params->both_sides);
	if (!fin_scratch_reserve(&set->scratch, caster, track->edge_count) ||
		!array_reserve((void **)&set->vertices, &set->vertex_capacity, most,
			sizeof(*set->vertices)))
		return false;
	set->vertex_count += fins_build(caster, track->edges, track->edge_count, params,
		&set->scratch, set->vertices + set->vertex_count,
		set->vertex_capacity - set->vertex_count);
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
	free(set->vertices);
	*set = (struct fin_set){0};
}

void fin_set_list_memory(const struct fin_set *set, const struct memory_list *list)
{
	size_t tracks = set->track_count * sizeof(*set->tracks);
	for (size_t i = 0; i < set->track_count; i++)
		tracks += silhouette_track_bytes(&set->tracks[i]);
	memory_list_processor(list, "silhouettes: tracks", tracks);
	memory_list_processor(list, "fins: corners", fin_scratch_bytes(&set->scratch));
	memory_list_processor(list, "fins: vertices",
		(set->vertex_capacity + set->before_capacity) * sizeof(*set->vertices));
	memory_list_processor(list, "fins: objects", set->part_capacity * sizeof(*set->parts));
}

/* A bound on how far a fin goes from its silhouette, NDC: at a corner it is longer than wide. What
 * is nearer than the near plane has none. */
static float fin_reach(const struct fin_params *params, const struct light_frame *frame)
{
	float widest = params->width == FIN_WIDTH_PERSPECTIVE ? params->scale / frame->near
							      : params->scale;
	return 1.5f * (widest + params->apron);
}

float fin_shape_reach(
	const struct fin_shape *shape, const struct light_frame *frame, uint32_t map_size)
{
	const struct fin_params params = fin_params_of(frame, shape, map_size);
	return fin_reach(&params, frame);
}

/* Appends the fins of one caster. */
static bool add_caster(struct fin_set *set, struct silhouette_track *track,
	const struct caster *caster, const struct light_frame *frame, const struct object *object,
	const struct fin_params *params, struct fin_part *part)
{
	mat4 to_object;
	vec4 light;
	glm_mat4_inv((vec4 *)object->transform, to_object);
	glm_mat4_mulv(to_object, (float *)frame->origin, light);
	if (!silhouette_track(track, caster, light, set->workers) ||
		!append_fins(set, caster, track, params))
		return false;
	part->edge_count = track->edge_count;
	part->count = set->vertex_count - part->first;
	for (size_t i = part->first; i < set->vertex_count; i++)
		screen_box_add_point(
			&part->box, set->vertices[i].position[0], set->vertices[i].position[1]);
	set->edge_count += part->edge_count;
	return true;
}

/* What a search is for. */
struct fin_search {
	const struct sm_scene *scene;
	const struct light_frame *frame;
	const struct fin_shape *shape;
	uint32_t map_size;
	bool on_screen;
};

static bool make_part(
	struct fin_set *set, const struct fin_search *search, size_t index, bool left_out)
{
	const struct object *object = &search->scene->objects[index];
	struct fin_part *part = &set->parts[index];
	const struct light_frame *frame = search->frame;
	const struct mesh *mesh = &search->scene->meshes[object->mesh];
	*part = (struct fin_part){.first = set->vertex_count,
		.casts = object->casts && !left_out,
		.fresh = true,
		.box = screen_box_none()};
	if (!part->casts)
		return true;
	struct fin_params params = fin_params_of(frame, search->shape, search->map_size);
	place_object(&params, frame, object);
	part->missing = search->on_screen &&
			mesh_misses_screen(mesh, (vec4 *)object->transform,
				(vec4 *)frame->world_to_clip, fin_reach(&params, frame), false);
	return part->missing ||
	       add_caster(set, &set->tracks[index], &mesh->caster, frame, object, &params, part);
}

/* Appends what the search before found. */
static bool keep_part(struct fin_set *set, struct fin_part *part)
{
	if (!array_reserve((void **)&set->vertices, &set->vertex_capacity,
		    set->vertex_count + part->count, sizeof(*set->vertices)))
		return false;
	if (part->count > 0)
		memcpy(set->vertices + set->vertex_count, set->before + part->first,
			part->count * sizeof(*set->vertices));
	part->first = set->vertex_count;
	part->fresh = false;
	set->vertex_count += part->count;
	return true;
}

/* Has the vertices that some are kept of out of the way. */
static void set_aside(struct fin_set *set)
{
	struct fin_vertex *vertices = set->vertices;
	size_t capacity = set->vertex_capacity;
	set->vertices = set->before;
	set->vertex_capacity = set->before_capacity;
	set->before = vertices;
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

void fin_set_clear(struct fin_set *set)
{
	set->vertex_count = set->part_count = 0;
	set->edge_count = set->caster_count = set->missing_count = set->left_out_count = 0;
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
