/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "bench/stress_base.h"
#include "bench/stress_shape.h"
#include "bench/stress_sweep.h"
#include "load/model.h"
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

static bool make_scaled(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	stress_scene_scale(scene, value);
	return true;
}

static bool make_moved(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	stress_scene_move(scene, (double[]){value, -.75 * value, value});
	return true;
}

/* As make_moved(), with the way in the vertices, which are rounded. */
static bool make_moved_meshes(struct stress_scene *scene, double value, struct sm_error *error)
{
	const double offset[3] = {value, -.75 * value, value};
	for (size_t i = 0; i < scene->object_count; i++) {
		struct stress_object *object = &scene->objects[i];
		mat4 world;
		model_transform(object->position, object->rotation, object->scale, *world);
		for (size_t j = 0; j < object->mesh.vertex_count; j++) {
			vec3 moved;
			glm_mat4_mulv3(world, object->mesh.positions[j], 1, moved);
			for (int axis = 0; axis < 3; axis++)
				object->mesh.positions[j][axis] =
					(float)(moved[axis] + offset[axis]);
		}
		memset(object->position, 0, sizeof(object->position));
		memset(object->rotation, 0, sizeof(object->rotation));
		glm_vec3_one(object->scale);
	}
	if (!make_moved(scene, value, error))
		return false;
	for (size_t i = 0; i < scene->object_count; i++)
		memset(scene->objects[i].position, 0, sizeof(scene->objects[i].position));
	return true;
}

/* A cube near the light, of the same size on its screen at any distance; a point light. */
static bool make_near_caster(struct stress_scene *scene, double value, struct sm_error *error)
{
	struct sm_light_desc *light = &scene->lights[0];
	struct stress_mesh cube;
	double far = 4.5; /* about how far the floor is */
	if (!stress_shape_cube(&cube, error))
		return false;
	struct stress_object *object = stress_scene_add(scene, cube);
	light->radius = 0;
	for (int axis = 0; axis < 3; axis++) {
		static const double aside[3] = {-.75, .5, .25};
		double along = light->target[axis] - light->position[axis];
		object->scale[axis] = (float)(.1 * far / value);
		object->position[axis] =
			(float)(light->position[axis] + (along + aside[axis]) / value * 1.1);
	}
	return true;
}

static bool make_camera_range(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	scene->camera.far = 12;
	scene->camera.near = (float)(12 / value);
	return true;
}

static bool make_radius(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	scene->lights[0].radius = (float)value;
	return true;
}

/* A light so far from its target that looks as large from there, and lights as much. */
static bool make_distance(struct stress_scene *scene, double value, struct sm_error *error)
{
	struct sm_light_desc *light = &scene->lights[0];
	double before = glm_vec3_distance(light->target, light->position);
	double half = tan(light->angle * M_PI / 360) * before / value;
	(void)error;
	for (int axis = 0; axis < 3; axis++)
		light->position[axis] =
			(float)(light->target[axis] +
				(light->position[axis] - light->target[axis]) * value / before);
	light->radius = (float)(light->radius * value / before);
	light->angle = (float)(atan(half) * 360 / M_PI);
	return true;
}

/* 0 is a light without a radius, whose fins have no width. */
static bool make_width(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	scene->shadow.width = (float)value;
	scene->lights[0].radius = 0;
	return true;
}

static bool make_gap(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	scene->objects[STRESS_BLOCK].position[1] = (float)(.5 + value);
	return true;
}

/* A square that lies on the floor, or so far above; there is nothing else. */
static bool make_layer(struct stress_scene *scene, double value, struct sm_error *error)
{
	struct stress_object *layer = &scene->objects[STRESS_BLOCK];
	stress_mesh_finish(&layer->mesh);
	stress_mesh_finish(&scene->objects[--scene->object_count].mesh);
	layer->position[1] = (float)value;
	scene->objects[STRESS_FLOOR].casts = true;
	return stress_shape_square(&layer->mesh, error);
}

static bool make_slivers(struct stress_scene *scene, double value, struct sm_error *error)
{
	for (int i = STRESS_FLOOR; i <= STRESS_BLOCK; i++) {
		stress_mesh_finish(&scene->objects[i].mesh);
		if (!stress_shape_slivers(&scene->objects[i].mesh, value, error))
			return false;
	}
	return true;
}

static bool make_degenerate(struct stress_scene *scene, double value, struct sm_error *error)
{
	static const uint32_t corners[] = {0, 1, 1, 2, 2, 2, 3, 0, 3, 4, 4, 1};
	for (int i = STRESS_BLOCK; i <= STRESS_BALL; i++)
		for (int j = 0; j < value; j++)
			if (!stress_shape_extend(&scene->objects[i].mesh, corners,
				    sizeof(corners) / sizeof(corners[0]), error))
				return false;
	return true;
}

static bool make_duplicates(struct stress_scene *scene, double value, struct sm_error *error)
{
	for (int i = STRESS_BLOCK; i <= STRESS_BALL; i++) {
		struct stress_mesh *mesh = &scene->objects[i].mesh, once = *mesh;
		if (!stress_mesh_init(mesh, once.vertex_count, 0, error)) {
			stress_mesh_finish(&once);
			return false;
		}
		memcpy(mesh->positions, once.positions,
			once.vertex_count * sizeof(*once.positions));
		bool ok = true;
		for (int j = 0; j < value && ok; j++)
			ok = stress_shape_extend(mesh, once.indices, once.index_count, error);
		stress_mesh_finish(&once);
		if (!ok)
			return false;
	}
	return true;
}

/* Both windings of each triangle. */
static bool make_two_faced(struct stress_scene *scene, double value, struct sm_error *error)
{
	struct stress_mesh *mesh = &scene->objects[STRESS_BALL].mesh;
	size_t count = mesh->index_count;
	bool ok = true;
	for (size_t i = 0; i < count && value > 0 && ok; i += 3) {
		const uint32_t *corner = &mesh->indices[i];
		const uint32_t back[] = {corner[1], corner[0], corner[2]};
		ok = stress_shape_extend(mesh, back, 3, error);
	}
	return ok;
}

/* Between the block and the eye. */
static void look_at_floor(struct stress_scene *scene)
{
	memcpy(scene->camera.target, (float[3]){-.5f, 0, 1}, sizeof(scene->camera.target));
	scene->camera.fov = 10;
}

static bool make_light_place(struct stress_scene *scene, double value, struct sm_error *error)
{
	static const float places[][2][3] = {
		{{.5f, 1.75f, .5f}, {0, 0, 0}},  /* at the block's corner */
		{{0, 1.75f, 0}, {0, 0, 0}},      /* in its upper face */
		{{3, 1.75f, 0}, {0, 1.75f, 0}},  /* in the plane of that face, edge on */
		{{0, .75f, 0}, {0, 0, 0}},       /* in its lower face */
		{{1.25f, .5f, -1}, {0, .5f, 0}}, /* in the middle of the ball */
		{{1.25f, 1, -1}, {0, 0, 0}},     /* at its pole, where many triangles meet */
		{{4, 0, 0}, {0, 0, 0}},          /* in the floor's plane, beside it */
		{{2, 0, 0}, {0, 0, 0}},          /* in the floor */
		{{0, -2, 0}, {0, 0, 0}},         /* below */
		{{0, 4, 0}, {0, 8, 0}},          /* it looks away */
		{{2, -.0625f, 0}, {0, 0, 0}},    /* just below the floor */
	};
	/* Those below the floor again, with it alone in sight: all is dark. */
	static const int dark[] = {8, 10};
	const int count = sizeof(places) / sizeof(places[0]);
	int place = value < count ? (int)value : dark[(int)value - count];
	(void)error;
	struct sm_light_desc *light = &scene->lights[0];
	scene->objects[STRESS_BLOCK].rotation[1] = 0;
	memcpy(light->position, places[place][0], sizeof(light->position));
	memcpy(light->target, places[place][1], sizeof(light->target));
	if (value >= count)
		look_at_floor(scene);
	return true;
}

/* A light in the block, so far from its middle to its side; seen from where all is dark. */
static bool make_enclosed(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	struct sm_light_desc *light = &scene->lights[0];
	scene->objects[STRESS_BLOCK].rotation[1] = 0;
	light->position[0] = (float)(.5 * value);
	light->position[1] = 1.25f;
	light->position[2] = 0;
	light->angle = 120;
	/* The disc is inside, too. */
	light->radius = .0625f;
	look_at_floor(scene);
	return true;
}

/* A pillar beside the light, so far off, that begins above it. There the disc is far wider than the
 * light's screen, on which PCSS then takes most of its taps beside the map: it may lose the pillar.
 */
static bool make_crossing(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	struct stress_object *block = &scene->objects[STRESS_BLOCK];
	struct sm_light_desc *light = &scene->lights[0];
	block->rotation[1] = 0;
	block->scale[1] = 3;
	block->position[0] = (float)(light->position[0] - .5 - value);
	block->position[1] = 3;
	block->position[2] = light->position[2];
	return true;
}

/* A floor alone, under light that comes in at so many degrees from its normal. */
static bool make_grazing(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	struct sm_light_desc *light = &scene->lights[0];
	while (scene->object_count > 1)
		stress_mesh_finish(&scene->objects[--scene->object_count].mesh);
	scene->objects[STRESS_FLOOR].casts = true;
	light->position[0] = (float)(4 * sin(value * M_PI / 180));
	light->position[1] = (float)(4 * cos(value * M_PI / 180));
	light->position[2] = 0;
	/* So small that the angle is nearly the same all over, and from all of the light. */
	light->radius = 1e-3f;
	scene->objects[STRESS_FLOOR].scale[0] = scene->objects[STRESS_FLOOR].scale[2] = .25f;
	memcpy(scene->camera.eye, (float[3]){0, .75f, 0}, sizeof(scene->camera.eye));
	memcpy(scene->camera.target, (float[3]){0, 0, 0}, sizeof(scene->camera.target));
	memcpy(scene->camera.up, (float[3]){0, 0, 1}, sizeof(scene->camera.up));
	return true;
}

/* A ball of about so many triangles, or one triangle. */
static bool make_mesh_size(struct stress_scene *scene, double value, struct sm_error *error)
{
	struct stress_mesh *mesh = &scene->objects[STRESS_BALL].mesh;
	stress_mesh_finish(mesh);
	return value == 1 ? stress_shape_triangle(mesh, error)
			  : stress_shape_sphere(mesh, (uint32_t)lround(sqrt(value / 4)), error);
}

/* A floor so wide, of which the same part is seen. */
static bool make_wide_floor(struct stress_scene *scene, double value, struct sm_error *error)
{
	struct stress_object *floor = &scene->objects[STRESS_FLOOR];
	(void)error;
	floor->scale[0] = floor->scale[2] = (float)(value / 2);
	scene->camera.fov = 20;
	return true;
}

static bool make_lights(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	scene->shadow.map_size = 32;
	scene->light_count = (size_t)value;
	for (size_t i = 1; i < scene->light_count; i++) {
		scene->lights[i] = scene->lights[0];
		scene->lights[i].type = i % 2 ? SM_LIGHT_DIRECTIONAL : SM_LIGHT_SPOT;
		scene->lights[i].position[0] = 4 * cosf((float)i);
		scene->lights[i].position[2] = 4 * sinf((float)i);
		scene->lights[i].intensity = 1 / (float)value;
	}
	return true;
}

static bool make_map(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	scene->shadow.map_size = (uint32_t)value;
	return true;
}

/* The floor alone can be dark by itself, where it does not face the light. */
static bool make_lit_map(struct stress_scene *scene, double value, struct sm_error *error)
{
	scene->objects[STRESS_BLOCK].receives = scene->objects[STRESS_BALL].receives = false;
	memcpy(scene->camera.eye, (float[3]){-2, 1, 2}, sizeof(scene->camera.eye));
	memcpy(scene->camera.target, (float[3]){-1.5f, 0, .5f}, sizeof(scene->camera.target));
	return make_map(scene, value, error);
}

static bool make_picture(struct stress_scene *scene, double value, struct sm_error *error)
{
	(void)error;
	scene->width = (uint32_t)value;
	scene->height = (uint32_t)(value > 2 ? value / 2 : value);
	return true;
}

static const struct stress_sweep sweeps[] = {
	{"scale", "the scene's scale", 11, 4,
		{1e-4, 1e6, 1e-2, 1e5, 1e-3, .1, 1, 10, 100, 1e3, 1e4}, make_scaled, .base = 1,
		.constant = 1e-3, .to = INFINITY},
	{"moved", "units by which transforms move the scene from the origin", 7, 3,
		{1e6, 1e4, 1e3, 1, 10, 100, 1e5}, make_moved, .constant = 1e-3, .to = INFINITY},
	{"moved meshes", "units by which vertices are moved from the origin", 7, 3,
		{1e6, 1e4, 1e3, 1, 10, 100, 1e5}, make_moved_meshes, .constant = 1e-3,
		.slope = 4 * 0x1p-23, .to = INFINITY},
	{"near caster", "the light's far plane : its nearest caster", 6, 6,
		{10, 100, 600, 1e4, 1e5, 1e6}, make_near_caster, .base = 10, .constant = 5e-3,
		.to = 600, .spot_only = true},
	{"camera range", "the camera's far : near", 6, 6, {10, 100, 1e3, 1e4, 1e5, 1e6},
		make_camera_range, .base = 10, .constant = 5e-3, .to = 1e5},
	{"radius", "the light's radius", 10, 5, {1e-6, 1e-3, .1, 10, 1e6, 0, 1e-4, .01, 1, 1e3},
		make_radius, .constant = 5e-3, .slope = .05, .to = .1},
	{"distance", "of the light from its target", 6, 6, {100, 300, 1e3, 1e4, 1e5, 1e6},
		make_distance, .base = 100, .constant = 5e-3, .to = 300},
	{"width", "the fins' width (alpha -> 0)", 7, 7, {1e-9, 1e-6, 1e-4, 1e-3, .01, .1, 1},
		make_width, .constant = 2e-3, .slope = 2, .to = .1, .is_optional = true},
	{"gap", "of a block above the floor", 8, 5, {0, 1e-7, 1e-5, 1e-3, .1, 1e-6, 1e-4, 1e-2},
		make_gap, .constant = 5e-3, .slope = 1, .to = .1},
	{"layer", "height of a thin layer above the floor", 8, 5,
		{0, 1e-7, 1e-5, 1e-3, .1, 1e-6, 1e-4, 1e-2}, make_layer, .truth = STRESS_LIT,
		.constant = 2e-3, .slope = 1, .to = .1},
	{"slivers", "length : width of triangles", 7, 7, {2, 10, 100, 1e3, 1e4, 1e5, 1e6},
		make_slivers, .base = 2, .constant = 1e-3, .to = INFINITY},
	{"degenerate", "triangles without area, in fours", 3, 3, {1, 10, 100}, make_degenerate,
		.to = INFINITY, .constant = 1e-6},
	{"duplicates", "times that each triangle is there", 3, 3, {2, 3, 8}, make_duplicates,
		.base = 1, .constant = 1e-3, .to = INFINITY},
	{"two-faced", "a ball with both windings of its triangles", 1, 1, {1}, make_two_faced,
		.constant = 1e-3, .to = INFINITY},
	{"light place", "odd places of the light; from 11 on below a floor seen from above", 13, 13,
		{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, make_light_place, .truth = STRESS_DARK,
		.constant = 1e-6, .from = 11, .to = INFINITY},
	{"enclosed", "a light inside a block, from its middle to its side", 5, 5,
		{0, .25, .5, .8, .999}, make_enclosed, .truth = STRESS_DARK, .constant = 1e-3,
		.to = .8, .spot_only = true},
	{"crossing", "distance of a pillar that passes the light", 6, 6,
		{1, .1, .01, 1e-3, 1e-4, 0}, make_crossing, .base = 1e-3, .constant = 1e-2,
		.to = 1e-3, .unbound = "pcss"},
	{"grazing", "degrees between the floor's normal and the light", 8, 8,
		{80, 85, 88, 88.8, 89, 89.5, 89.9, 89.99}, make_grazing, .truth = STRESS_LIT,
		.constant = 1e-3, .to = 88.8},
	{"mesh size", "triangles of a mesh", 6, 4, {1, 64, 16384, 40000, 262144, 2e6},
		make_mesh_size, .base = 16384, .constant = 5e-3, .from = 16384, .to = INFINITY},
	{"wide floor", "width of the floor", 6, 6, {12, 120, 1e3, 1e4, 1e5, 1e6}, make_wide_floor,
		.base = 12, .constant = 5e-3, .to = 1e5},
	{"lights", "their number", 5, 3, {0, 1, 64, 2, 16}, make_lights, .base = 1,
		.constant = 1e-6, .to = INFINITY},
	{"map", "texels a side of the shadow map", 10, 9,
		{1, 2, 3, 4, 16, 17, 255, 1000, 1024, 4096}, make_map, .base = 1024,
		.constant = 2e-2, .from = 1000, .to = INFINITY, .of_map = true},
	{"empty map", "texels a side of a shadow map without an inside", 2, 2, {1, 2}, make_lit_map,
		.truth = STRESS_LIT, .constant = 1e-6, .to = INFINITY, .unbound = "gather",
		.of_map = true},
	{"largest map", "texels a side of the shadow map: the driver's limit", 1, 0, {1 << 30},
		make_map, .base = 1024, .constant = 2e-2, .to = INFINITY, .spot_only = true,
		.is_large = true, .of_map = true},
	{"picture", "pixels a side of the picture", 6, 6, {1, 2, 3, 7, 100, 301}, make_picture,
		.base = 1, .from = INFINITY},
};

const struct stress_sweep *stress_sweep_at(size_t index)
{
	return index < sizeof(sweeps) / sizeof(sweeps[0]) ? &sweeps[index] : NULL;
}
