/* SPDX-License-Identifier: MIT */
#include "lit_parts.h"
#include "averted_parts.h"
#include "base/array.h"
#include "scene/fin_set.h"
#include <stdlib.h>
#include <string.h>

/* Of casters: what sorting takes is one frame's alone. */
#define CASTER_TRIANGLES_MAX 65536

/* Each takes about half a millisecond, which a frame doesn't show. */
#define VISITS_A_FRAME ((size_t)LIT_VISITS_MAX)
#define GATHERED_A_FRAME 16384 /* triangles of casters; a caster at least */
#define FINS_A_FRAME 1024

/* For each of an object's triangles, and at its start for so many: it is left as it is where more
 * is looked at, as for wide filters of a large mesh. */
#define VISITS_A_TRIANGLE 16384
#define TRIANGLES_AHEAD 2048

/* Of triangles that need look-ups, as far as clusters tell: where fewer than one in this many does
 * not, the draw calls take longer. */
#define SHARE_MIN 16

/* Texels: for vertices that the rasteriser snapped to its grid, either way. */
#define SNAPPED 0.05f

static void finish_search(struct lit_parts *parts)
{
	lit_search_finish(&parts->search);
	free(parts->needs);
	free(parts->averted);
	free(parts->indices);
	parts->needs = parts->averted = NULL;
	parts->indices = NULL;
	parts->need_capacity = parts->averted_capacity = parts->index_capacity = 0;
}

void lit_parts_finish(struct lit_parts *parts, struct gl *gl)
{
	for (size_t i = 0; i < parts->list_count; i++)
		gl_delete_buffer(gl, &parts->lists[i].buffer);
	free(parts->lists);
	finish_search(parts);
	*parts = (struct lit_parts){0};
}

size_t lit_parts_bytes(const struct lit_parts *parts)
{
	return lit_search_bytes(&parts->search) + parts->list_capacity * sizeof(*parts->lists) +
	       parts->need_capacity + parts->averted_capacity +
	       parts->index_capacity * sizeof(*parts->indices);
}

void lit_parts_forget(struct lit_parts *parts)
{
	parts->state = LIT_UNSEEN;
	for (size_t i = 0; i < parts->list_count; i++)
		parts->lists[i].drawable = false;
}

static size_t count_casters(const struct sm_scene *scene)
{
	size_t count = 0;
	for (size_t i = 0; i < scene->object_count; i++)
		if (scene->objects[i].casts)
			count += scene->meshes[scene->objects[i].mesh].index_count / 3;
	return count;
}

/* As it is drawn, with repeated triangles. */
static bool add_caster(struct lit_search *search, const struct lit_request *request, size_t object)
{
	const struct object *caster = &request->scene->objects[object];
	const struct mesh *mesh = &request->scene->meshes[caster->mesh];
	mat4 to_clip;
	glm_mat4_mul((vec4 *)request->frame->world_to_clip, (vec4 *)caster->transform, to_clip);
	return lit_search_add(search, (uint32_t)object, (const float(*)[3])mesh->positions,
		mesh->vertex_count, mesh->indices, mesh->index_count, (const float(*)[4])to_clip);
}

static bool add_fin(struct lit_search *search, const struct fin_set *fins, size_t fin)
{
	struct fin_vertex v[FIN_VERTICES_MAX];
	size_t count = fin_set_expand(fins, fin, v);
	for (size_t first = 0; first < count; first += 4) {
		float corners[4][3];
		for (size_t corner = 0; corner < 4; corner++)
			memcpy(corners[corner], v[first + corner].position,
				sizeof(corners[corner]));
		if (!lit_search_add_fin(search, (const float(*)[3])corners))
			return false;
	}
	return true;
}

static bool reserve_lists(struct lit_parts *parts, size_t count)
{
	if (!array_reserve(
		    (void **)&parts->lists, &parts->list_capacity, count, sizeof(*parts->lists)))
		return false;
	for (; parts->list_count < count; parts->list_count++)
		parts->lists[parts->list_count] = (struct lit_list){0};
	return true;
}

static bool start_search(struct lit_parts *parts, const struct lit_request *request)
{
	lit_search_clear(&parts->search);
	parts->object = parts->fin = 0;
	return reserve_lists(parts, request->scene->object_count);
}

/* Adds some of the casters to what the search is made of. */
static bool gather_casters(struct lit_parts *parts, const struct lit_request *request)
{
	const struct sm_scene *scene = request->scene;
	size_t gathered = 0;
	for (; parts->object < scene->object_count && gathered < GATHERED_A_FRAME;
		parts->object++) {
		const struct object *object = &scene->objects[parts->object];
		if (!object->casts)
			continue;
		if (!add_caster(&parts->search, request, parts->object))
			return false;
		gathered += scene->meshes[object->mesh].index_count / 3;
	}
	return true;
}

static bool gather_fins(struct lit_parts *parts, const struct fin_set *fins)
{
	size_t rest = fins->count - parts->fin;
	size_t end = parts->fin + (rest < FINS_A_FRAME ? rest : FINS_A_FRAME);
	for (; parts->fin < end; parts->fin++)
		if (!add_fin(&parts->search, fins, parts->fin))
			return false;
	return true;
}

/* Goes on with what the search is made of, and then makes it. */
static bool gather(struct lit_parts *parts, const struct lit_request *request)
{
	const struct technique *technique = request->technique;
	const struct fin_set *fins =
		technique->fins != NULL ? technique->fins(request->state) : NULL;
	if (parts->object < request->scene->object_count)
		return gather_casters(parts, request);
	if (fins != NULL && parts->fin < fins->count)
		return gather_fins(parts, fins);
	parts->object = parts->triangle = 0;
	parts->state = LIT_SEARCHED;
	return lit_search_sort(&parts->search);
}

static struct lit_rule find_rule(const struct lit_request *request)
{
	const struct technique *technique = request->technique;
	const struct light_frame *frame = request->frame;
	float size = (float)request->map_size, texel = 2.0f / size, limit[2];
	float reach = technique->reach != NULL ? technique->reach(request->state, frame) : 0.0f;
	light_frame_bias_limit(frame, size, limit);
	return (struct lit_rule){
		.around = (technique->texels_around + SNAPPED) * texel + reach,
		.bias = (technique->texels_around - SNAPPED) * texel - reach,
		.limit = {size * limit[0], size * limit[1]},
		.near_to_far = frame->near_to_far,
	};
}

/* The object that is searched. */
struct item {
	const struct object *object;
	const struct mesh *mesh;
	const struct gpu_mesh *gpu_mesh;
	size_t count; /* triangles */
	mat4 to_clip; /* of the light */
};

static struct item item_at(const struct gpu *gpu, const struct lit_request *request, size_t index)
{
	struct item item = {.object = &request->scene->objects[index]};
	item.mesh = &request->scene->meshes[item.object->mesh];
	item.gpu_mesh = &gpu->scene.meshes[item.object->mesh];
	item.count = item.mesh->index_count / 3;
	glm_mat4_mul((vec4 *)request->frame->world_to_clip, (vec4 *)item.object->transform,
		item.to_clip);
	return item;
}

/* What clusters need, and room for the triangles' needs. */
static bool start(
	struct lit_parts *parts, const struct item *item, const struct lit_request *request)
{
	size_t vertex_count = item->mesh->vertex_count;
	if (!array_reserve((void **)&parts->needs, &parts->need_capacity, item->count,
		    sizeof(*parts->needs)) ||
		!array_reserve((void **)&parts->averted, &parts->averted_capacity, vertex_count,
			sizeof(*parts->averted)))
		return false;
	for (size_t i = 0; i < item->gpu_mesh->cluster_count; i++) {
		size_t first = i * CLUSTER_TRIANGLES, rest = item->count - first;
		memset(parts->needs + first,
			need_of_box(request->needs, (vec4 *)item->to_clip,
				&item->gpu_mesh->clusters[i]),
			rest < CLUSTER_TRIANGLES ? rest : CLUSTER_TRIANGLES);
	}
	if (!averted_find_vertices(item->mesh, item->gpu_mesh, (vec4 *)item->object->transform,
		    request->frame, parts->averted))
		memset(parts->averted, 0, vertex_count);
	parts->needy = parts->found = parts->visits = 0;
	return true;
}

static bool is_averted(const struct lit_parts *parts, const uint32_t triangle[3])
{
	return parts->averted[triangle[0]] && parts->averted[triangle[1]] &&
	       parts->averted[triangle[2]];
}

/* One that needs more than light, as far as its cluster tells. */
static void look_at(struct lit_parts *parts, const struct item *item, const struct lit_rule *rule,
	size_t *visits)
{
	const uint32_t *indices = item->mesh->indices + 3 * parts->triangle;
	float triangle[3][3];
	parts->needy++;
	for (int i = 0; i < 3; i++)
		memcpy(triangle[i], item->mesh->positions[indices[i]], sizeof(triangle[i]));
	bool averted = is_averted(parts, indices);
	if (!lit_search_is_lit(&parts->search, (uint32_t)parts->object, (const float(*)[3])triangle,
		    averted, (const float(*)[4])item->to_clip, rule, visits))
		return;
	parts->needs[parts->triangle] = NEED_LIGHT;
	parts->found++;
}

/* Sorts the object's triangles by need. */
static bool make_list(struct lit_parts *parts, struct gpu *gpu, const struct item *item)
{
	struct lit_list *list = &parts->lists[parts->object];
	size_t end = 0;
	if (!array_reserve((void **)&parts->indices, &parts->index_capacity, 3 * item->count,
		    sizeof(*parts->indices)))
		return false;
	for (enum need need = 0; need < NEED_COUNT; need++) {
		list->first[need] = end;
		for (size_t i = 0; i < item->count; i++) {
			if (parts->needs[i] != need)
				continue;
			memcpy(parts->indices + end, item->mesh->indices + 3 * i,
				3 * sizeof(*parts->indices));
			end += 3;
		}
		list->count[need] = end - list->first[need];
	}
	if (list->buffer == 0)
		list->buffer = gl_create_buffer(&gpu->gl, STORAGE_SURFACES);
	gpu->gl.BindVertexArray(item->gpu_mesh->surface);
	gl_fill_buffer(&gpu->gl, GL_ELEMENT_ARRAY_BUFFER, list->buffer,
		end * sizeof(*parts->indices), parts->indices, GL_STATIC_DRAW);
	gpu->gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, item->gpu_mesh->surface_indices);
	gpu->stats.uploaded_bytes += end * sizeof(*parts->indices);
	list->drawable = true;
	return true;
}

/* Looks at the object's triangles until that is enough for a frame, and makes its list once all are
 * done. Returns false without memory. */
static bool look_at_object(struct lit_parts *parts, struct gpu *gpu,
	const struct lit_request *request, const struct lit_rule *rule, size_t *visits)
{
	const struct item item = item_at(gpu, request, parts->object);
	if (parts->triangle == 0 && !start(parts, &item, request))
		return false;
	size_t before = *visits;
	for (; parts->triangle < item.count && *visits < VISITS_A_FRAME; parts->triangle++)
		if (parts->needs[parts->triangle] > NEED_LIGHT)
			look_at(parts, &item, rule, visits);
	parts->visits += *visits - before;
	bool costs = parts->visits > VISITS_A_TRIANGLE * (parts->needy + TRIANGLES_AHEAD);
	if (parts->triangle < item.count && !costs)
		return true;
	bool pays = !costs && parts->found > 0 && parts->found >= parts->needy / SHARE_MIN;
	if (pays && !make_list(parts, gpu, &item))
		return false;
	parts->object++;
	parts->triangle = 0;
	return true;
}

/* Of what does not cast it is not known what touches it. */
static bool is_searched(const struct object *object)
{
	return object->casts && object->receives;
}

static bool look_at_objects(
	struct lit_parts *parts, struct gpu *gpu, const struct lit_request *request)
{
	const struct lit_rule rule = find_rule(request);
	size_t visits = 0;
	while (parts->object < request->scene->object_count && visits < VISITS_A_FRAME) {
		if (!is_searched(&request->scene->objects[parts->object]))
			parts->object++;
		else if (!look_at_object(parts, gpu, request, &rule, &visits))
			return false;
	}
	if (parts->object == request->scene->object_count) {
		parts->state = LIT_DONE;
		finish_search(parts);
	}
	return true;
}

bool lit_parts_find_more(struct lit_parts *parts, struct gpu *gpu,
	const struct lit_request *request, struct sm_error *error)
{
	bool found = true;
	switch (parts->state) {
	case LIT_UNSEEN:
		/* What changes in each frame is not searched at all. */
		parts->state = LIT_SEEN;
		break;
	case LIT_SEEN:
		parts->state = LIT_DONE;
		if (count_casters(request->scene) <= CASTER_TRIANGLES_MAX) {
			found = start_search(parts, request);
			parts->state = LIT_GATHERED;
		}
		break;
	case LIT_GATHERED:
		found = gather(parts, request);
		break;
	case LIT_SEARCHED:
		found = look_at_objects(parts, gpu, request);
		break;
	case LIT_DONE:
		break;
	}
	if (found)
		return true;
	lit_parts_forget(parts);
	return error_no_memory(error);
}

const struct lit_list *lit_parts_list(const struct lit_parts *parts, size_t object)
{
	bool drawable = object < parts->list_count && parts->lists[object].drawable;
	return drawable ? &parts->lists[object] : NULL;
}
