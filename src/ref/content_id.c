/* SPDX-License-Identifier: MIT */
#include "ref/content_id.h"
#include "scene/scene.h"

/* Counts up whenever the same request would be traced to other values. */
#define VERSION 1

struct hash {
	unsigned __int128 value;
};

static unsigned __int128 join(uint64_t high, uint64_t low)
{
	return (unsigned __int128)high << 64 | low;
}

static struct hash hash_start(void)
{
	return (struct hash){join(UINT64_C(0x6c62272e07bb0142), UINT64_C(0x62b821756295c58d))};
}

static void hash_add(struct hash *hash, const void *bytes, size_t size)
{
	const unsigned __int128 prime = join(1 << 24, 0x13b);
	const uint8_t *byte = bytes;
	for (size_t i = 0; i < size; i++)
		hash->value = (hash->value ^ byte[i]) * prime;
}

static void hash_add_number(struct hash *hash, uint64_t number)
{
	hash_add(hash, &number, sizeof(number));
}

/* -0 counts as 0. */
static void hash_add_floats(struct hash *hash, const float *values, size_t count)
{
	for (size_t i = 0; i < count; i++) {
		float value = values[i] + 0.0f;
		hash_add(hash, &value, sizeof(value));
	}
}

static struct content_id hash_id(const struct hash *hash)
{
	return (struct content_id){{(uint64_t)(hash->value >> 64), (uint64_t)hash->value}};
}

static void add_mesh(struct hash *hash, const struct mesh *mesh)
{
	hash_add_number(hash, mesh->vertex_count);
	hash_add_floats(hash, mesh->positions[0], 3 * mesh->vertex_count);
	hash_add_number(hash, mesh->index_count);
	hash_add(hash, mesh->indices, mesh->index_count * sizeof(*mesh->indices));
}

static void add_scene(struct hash *hash, const struct sm_scene *scene)
{
	hash_add_number(hash, scene->mesh_count);
	for (size_t i = 0; i < scene->mesh_count; i++)
		add_mesh(hash, &scene->meshes[i]);
	hash_add_number(hash, scene->object_count);
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		hash_add_number(hash, object->mesh);
		hash_add_floats(hash, object->transform[0], 16);
		hash_add_number(hash, (uint64_t)object->casts | (uint64_t)object->receives << 1 |
					      (uint64_t)object->single_sided << 2);
	}
}

static void add_light(struct hash *hash, const struct sm_light_desc *light)
{
	hash_add_number(hash, light->type);
	hash_add_floats(hash, light->position, 3);
	hash_add_floats(hash, light->target, 3);
	hash_add_floats(hash, &light->radius, 1);
	hash_add_floats(hash, &light->angle, 1);
}

static void add_camera(struct hash *hash, const struct sm_camera *camera)
{
	hash_add_floats(hash, camera->eye, 3);
	hash_add_floats(hash, camera->target, 3);
	hash_add_floats(hash, camera->up, 3);
	hash_add_floats(hash, (float[]){camera->fov, camera->near, camera->far}, 3);
}

struct content_id content_id_of_bytes(const void *bytes, size_t size)
{
	struct hash hash = hash_start();
	hash_add(&hash, bytes, size);
	return hash_id(&hash);
}

struct content_id content_id_of_request(const struct reference_request *request)
{
	struct hash hash = hash_start();
	hash_add_number(&hash, VERSION);
	add_scene(&hash, request->scene);
	add_light(&hash, &request->scene->lights[request->light].desc);
	add_camera(&hash, &request->camera);
	hash_add_number(&hash, request->width);
	hash_add_number(&hash, request->height);
	hash_add_number(&hash, request->samples);
	return hash_id(&hash);
}
