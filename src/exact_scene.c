/* SPDX-License-Identifier: MIT */
#include "exact_scene.h"
#include "base/array.h"
#include "fixed/setup.h"
#include <stdlib.h>

void exact_scene_finish(struct exact_scene *exact)
{
	fixed_scene_finish(&exact->fixed);
	fin_set_finish(&exact->fins);
	free(exact->clip);
	free(exact->light);
	*exact = (struct exact_scene){0};
}

void exact_scene_list_memory(const struct exact_scene *exact, const struct memory_list *list)
{
	const struct fixed_scene *fixed = &exact->fixed;
	size_t blockers = fixed->casters.capacity + fixed->receivers_only.capacity;
	fin_set_list_memory(&exact->fins, list);
	memory_list_processor(list, "integers: corners",
		(exact->clip_capacity + exact->light_capacity) * sizeof(*exact->clip));
	memory_list_processor(list, "integers: primitives",
		blockers * sizeof(*fixed->casters.items) +
			fixed->fins.capacity * sizeof(*fixed->fins.items) +
			fixed->receivers.capacity * sizeof(*fixed->receivers.items));
}

/* to_clip * transform * p in double, in one order everywhere. */
static void transform_positions(mat4 to_clip, const struct object *object,
	const float (*positions)[3], size_t count, double (*clip)[4])
{
	double matrix[4][4];
	for (int column = 0; column < 4; column++)
		for (int row = 0; row < 4; row++) {
			matrix[column][row] = 0.0;
			for (int i = 0; i < 4; i++)
				matrix[column][row] += (double)to_clip[i][row] *
						       (double)object->transform[column][i];
		}
	for (size_t v = 0; v < count; v++)
		for (int row = 0; row < 4; row++) {
			double sum = matrix[3][row];
			for (int i = 0; i < 3; i++)
				sum += matrix[i][row] * (double)positions[v][i];
			clip[v][row] = sum;
		}
}

static bool reserve_vertices(struct exact_scene *exact, size_t count)
{
	return array_reserve(
		       (void **)&exact->clip, &exact->clip_capacity, count, sizeof(*exact->clip)) &&
	       array_reserve((void **)&exact->light, &exact->light_capacity, count,
		       sizeof(*exact->light));
}

static void take_corners(const double (*from)[4], const uint32_t indices[3], double corners[3][4])
{
	for (int i = 0; i < 3; i++)
		for (int c = 0; c < 4; c++)
			corners[i][c] = from[indices[i]][c];
}

/* What gpu_set_faces() leaves of an object. */
static enum fixed_side drawn_side(const struct sm_scene *scene, const struct object *object,
	mat4 world_to_clip, bool single_sided)
{
	mat4 to_clip;
	glm_mat4_mul(world_to_clip, (vec4 *)object->transform, to_clip);
	if (!single_sided && !mesh_hides_back(&scene->meshes[object->mesh], to_clip))
		return FIXED_BOTH_SIDES;
	bool mirrored = glm_mat4_det((vec4 *)object->transform) < 0.0f;
	return mirrored ? FIXED_CLOCKWISE : FIXED_COUNTER_CLOCKWISE;
}

static bool add_blockers(struct exact_scene *exact, struct fixed_blockers *blockers,
	const struct sm_scene *scene, const struct object *object, const struct light_frame *frame)
{
	const struct caster *caster = &scene->meshes[object->mesh].caster;
	const struct fixed_screen screen = {exact->fixed.map_size, exact->fixed.map_size, 1};
	vec4 *to_clip = (vec4 *)frame->world_to_clip;
	enum fixed_side side = drawn_side(scene, object, to_clip, false);
	if (!reserve_vertices(exact, caster->vertex_count))
		return false;
	transform_positions(to_clip, object, caster->positions, caster->vertex_count, exact->light);
	for (size_t t = 0; t < caster->triangle_count; t++) {
		double clip[3][4];
		take_corners(exact->light, &caster->indices[3 * t], clip);
		if (!fixed_add_blocker(blockers, &screen, clip, side))
			return false;
	}
	return true;
}

static bool add_all_blockers(
	struct exact_scene *exact, const struct sm_scene *scene, const struct light_frame *frame)
{
	struct fixed_scene *fixed = &exact->fixed;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		bool receives_only = object->receives && !object->casts;
		/* Smoothies alone take the depth of what only receives. */
		if (!object->casts && !(receives_only && fixed->fins.count > 0))
			continue;
		if (!add_blockers(exact, object->casts ? &fixed->casters : &fixed->receivers_only,
			    scene, object, frame))
			return false;
	}
	return true;
}

static bool add_fin(struct exact_scene *exact, const struct fixed_screen *screen,
	const struct fin_vertex quad[4])
{
	struct fixed_fin_corner corners[4];
	for (size_t i = 0; i < 4; i++)
		corners[i] = (struct fixed_fin_corner){
			.position = {quad[i].position[0], quad[i].position[1], quad[i].position[2]},
			.offset = {quad[i].offset[0], quad[i].offset[1]},
			.width = quad[i].width,
		};
	return fixed_add_fin(&exact->fixed.fins, screen, corners);
}

static bool add_fins(
	struct exact_scene *exact, const struct sm_scene *scene, const struct exact_view *view)
{
	const struct fixed_screen screen = {exact->fixed.map_size, exact->fixed.map_size, 1};
	const struct fin_shape shape = {.width = view->fin_width, .share = SMOOTHIE_WIDTH_SHARE};
	if (!fin_set_find(&exact->fins, scene, view->frame, &shape, view->map_size, false))
		return false;
	struct fin_vertex vertices[FIN_VERTICES_MAX];
	for (size_t fin = 0; fin < exact->fins.count; fin++) {
		size_t count = fin_set_expand(&exact->fins, fin, vertices);
		for (const struct fin_vertex *quad = vertices; quad < vertices + count; quad += 4)
			if (!add_fin(exact, &screen, quad))
				return false;
	}
	return true;
}

static bool add_receiver(struct exact_scene *exact, const struct sm_scene *scene,
	const struct object *object, const struct exact_view *view, const struct fixed_bias *bias)
{
	const struct mesh *mesh = &scene->meshes[object->mesh];
	const struct fixed_screen screen = {exact->fixed.width, exact->fixed.height, 0};
	vec4 *to_clip = (vec4 *)view->world_to_clip;
	struct fixed_surface surface = {.receives = object->receives,
		.side = drawn_side(scene, object, to_clip, object->single_sided)};
	if (!reserve_vertices(exact, mesh->vertex_count))
		return false;
	transform_positions(to_clip, object, mesh->positions, mesh->vertex_count, exact->clip);
	transform_positions((vec4 *)view->frame->world_to_clip, object, mesh->positions,
		mesh->vertex_count, exact->light);
	for (size_t i = 0; i < mesh->index_count; i += 3) {
		take_corners(exact->clip, &mesh->indices[i], surface.clip);
		take_corners(exact->light, &mesh->indices[i], surface.light);
		if (!fixed_add_receiver(&exact->fixed.receivers, &screen, &surface, bias))
			return false;
	}
	return true;
}

static bool add_all_receivers(
	struct exact_scene *exact, const struct sm_scene *scene, const struct exact_view *view)
{
	float limit[2], size = (float)view->map_size;
	light_frame_bias_limit(view->frame, size, limit);
	const struct fixed_bias bias = {.reach = (double)LOOKUP_REACH_LINEAR / (double)size,
		.limit = {(double)limit[0] * (double)size, (double)limit[1] * (double)size}};
	for (size_t i = 0; i < scene->object_count; i++)
		if (!add_receiver(exact, scene, &scene->objects[i], view, &bias))
			return false;
	return true;
}

static void start(struct fixed_scene *fixed, const struct exact_view *view)
{
	double pole = (double)view->frame->pole * (1 << FIXED_DEPTH_BITS);
	fixed->map_size = (int32_t)view->map_size;
	fixed->width = (int32_t)view->width;
	fixed->height = (int32_t)view->height;
	fixed->sinusoid = view->sinusoid;
	/* near <= far / 2 makes it 2 at most. */
	fixed->pole = (uint32_t)fmin(floor(pole + 0.5), (2 << FIXED_DEPTH_BITS) - 1);
	fixed->casters.count = 0;
	fixed->receivers_only.count = 0;
	fixed->fins.count = 0;
	fixed->receivers.count = 0;
}

bool exact_scene_find(
	struct exact_scene *exact, const struct sm_scene *scene, const struct exact_view *view)
{
	start(&exact->fixed, view);
	return add_fins(exact, scene, view) && add_all_blockers(exact, scene, view->frame) &&
	       add_all_receivers(exact, scene, view);
}
