/* SPDX-License-Identifier: MIT */
/* Which memory is whose: GL's as gl.h counts it, the processor's as its owners tell. */
#include "base/memory_list.h"
#include "gles/target.h"
#include "renderer.h"
#include <string.h>

static size_t text_bytes(const char *text)
{
	return text != NULL ? strlen(text) + 1 : 0;
}

static void list_casters(const struct memory_list *list, const struct sm_scene *scene)
{
	size_t positions = 0, indices = 0, edges = 0, planes = 0, cones = 0, hollows = 0;
	for (size_t i = 0; i < scene->mesh_count; i++) {
		const struct caster *caster = &scene->meshes[i].caster;
		positions += caster->vertex_count *
			     (sizeof(*caster->positions) + sizeof(*caster->sources));
		indices += 3 * caster->triangle_count * sizeof(*caster->indices);
		edges += edge_table_bytes(&caster->edges);
		planes += face_planes_bytes(&caster->planes);
		cones += face_cones_bytes(&caster->cones);
		hollows += hollows_bytes(&caster->hollows);
	}
	memory_list_processor(list, "casters: positions", positions);
	memory_list_processor(list, "casters: indices", indices);
	memory_list_processor(list, "casters: edges", edges);
	memory_list_processor(list, "casters: planes", planes);
	memory_list_processor(list, "casters: cones", cones);
	memory_list_processor(list, "casters: hollows", hollows);
}

static void list_surfaces(const struct memory_list *list, const struct sm_scene *scene)
{
	size_t vertices = 0, indices = 0, images = 0;
	for (size_t i = 0; i < scene->mesh_count; i++) {
		const struct mesh *mesh = &scene->meshes[i];
		vertices +=
			mesh->vertex_count * (sizeof(*mesh->positions) + sizeof(*mesh->normals) +
						     sizeof(*mesh->uvs) + sizeof(*mesh->sources));
		indices += mesh->index_count * sizeof(*mesh->indices);
	}
	for (size_t i = 0; i < scene->image_count; i++)
		images += (size_t)scene->images[i].width * scene->images[i].height * 4;
	memory_list_processor(list, "meshes: vertices", vertices);
	memory_list_processor(list, "meshes: indices", indices);
	memory_list_processor(list, "images", images);
}

static void list_scene(const struct memory_list *list, const struct sm_scene *scene)
{
	size_t bytes = sizeof(*scene) + scene->mesh_capacity * sizeof(*scene->meshes) +
		       scene->image_capacity * sizeof(*scene->images) +
		       scene->object_capacity * sizeof(*scene->objects) +
		       scene->light_capacity * sizeof(*scene->lights);
	for (size_t i = 0; i < scene->mesh_count; i++)
		bytes += text_bytes(scene->meshes[i].name);
	for (size_t i = 0; i < scene->object_count; i++)
		bytes += text_bytes(scene->objects[i].name);
	for (size_t i = 0; i < scene->light_count; i++)
		bytes += text_bytes(scene->lights[i].name);
	list_surfaces(list, scene);
	memory_list_processor(list, "objects, lights and names", bytes);
}

static void list_gpu(const struct memory_list *list, const struct gpu *gpu)
{
	const struct gpu_scene *scene = &gpu->scene;
	const struct program_cache *programs = &gpu->programs;
	size_t clusters = 0;
	for (size_t i = 0; i < scene->mesh_count; i++)
		clusters += scene->meshes[i].cluster_count * sizeof(*scene->meshes[i].clusters) +
			    scene->meshes[i].vertex_count * sizeof(*scene->meshes[i].rises);
	memory_list_processor(list, "meshes: clusters", clusters);
	memory_list_processor(list, "meshes: vertices on their way",
		scene->vertex_capacity * sizeof(*scene->vertices));
	memory_list_processor(list, "names of GL",
		targets_shared_bytes(&gpu->gl) + scene->mesh_capacity * sizeof(*scene->meshes) +
			scene->image_capacity * sizeof(*scene->images) +
			gpu->gl.storages.capacity * sizeof(*gpu->gl.storages.slots));
	memory_list_processor(list, "programs",
		programs->count * sizeof(**programs->programs) +
			programs->capacity * sizeof(*programs->programs));
}

static void list_frame(const struct memory_list *list, const struct sm_renderer *renderer)
{
	const struct sm_scene *moved = &renderer->local.moved;
	memory_list_processor(list, "renderer",
		sizeof(*renderer) + renderer->light_capacity * sizeof(*renderer->lights) +
			renderer->need_capacity * sizeof(*renderer->needs) +
			averted_parts_bytes(&renderer->averted) +
			renderer->order.capacity * sizeof(*renderer->order.items));
	memory_list_processor(list, "scene near the camera",
		moved->object_capacity * sizeof(*moved->objects) +
			moved->light_capacity * sizeof(*moved->lights));
}

/* Lights that textures and buffers are told apart by, and SM_NONE. */
static void list_storages(
	const struct memory_list *list, const struct sm_renderer *renderer, uint32_t light)
{
	struct memory_list of_light = {list->sink, list->data, light};
	for (enum storage_owner owner = 0; owner < STORAGE_OWNERS; owner++)
		memory_list_add(&of_light, SM_MEMORY_GL, storage_owner_name(owner),
			storages_bytes(&renderer->gpu.gl.storages, owner, light));
}

void sm_renderer_list_memory(const struct sm_renderer *renderer, const struct sm_scene *scene,
	sm_memory_sink sink, void *data)
{
	const struct memory_list list = {sink, data, SM_NONE};
	list_storages(&list, renderer, SM_NONE);
	for (size_t i = 0; i < renderer->light_capacity; i++)
		list_storages(&list, renderer, (uint32_t)i);
	list_casters(&list, scene);
	list_scene(&list, scene);
	list_gpu(&list, &renderer->gpu);
	list_frame(&list, renderer);
	shadow_set_list_memory(&renderer->shadows, &list);
}

static void add_up(void *data, const struct sm_memory_part *part)
{
	struct sm_memory *memory = data;
	*(part->kind == SM_MEMORY_GL ? &memory->gl : &memory->processor) += part->bytes;
}

static void add_geometry(void *data, const struct sm_memory_part *part)
{
	struct sm_memory *memory = data;
	memory->geometry += part->bytes;
}

void sm_renderer_get_memory(
	const struct sm_renderer *renderer, const struct sm_scene *scene, struct sm_memory *memory)
{
	const struct memory_list geometry = {add_geometry, memory, SM_NONE};
	*memory = (struct sm_memory){.targets = storages_targets(&renderer->gpu.gl.storages)};
	sm_renderer_list_memory(renderer, scene, add_up, memory);
	list_casters(&geometry, scene);
	shadow_set_list_memory(&renderer->shadows, &geometry);
}
