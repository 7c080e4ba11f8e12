/* SPDX-License-Identifier: MIT */
#include "surface_pass.h"
#include "base/array.h"
#include "soft_tiles.h"
#include <float.h>
#include <stdlib.h>
#include <string.h>

static void set_light(const struct surface_pass *pass, const struct program *program)
{
	struct gl *gl = &pass->renderer->gpu.gl;
	const struct sm_light_desc *light = pass->light;
	bool spot = light->type == SM_LIGHT_SPOT;
	/* The cone fades from its border, at the half angle, inwards. */
	float edge = cosf(glm_rad(light->angle) / 2.0f);
	float full = cosf(glm_rad(light->angle) / 2.0f * (1.0f - light->softness));
	/* A hard edge fades over the smallest step that a cosine near 1 has. */
	float scale = spot ? 1.0f / fmaxf(full - edge, FLT_EPSILON) : 0.0f;
	float reach =
		spot ? glm_vec3_distance2((float *)light->target, (float *)light->position) : 1.0f;
	gl->Uniform1i(program->uniform.light_is_point, spot);
	gl->Uniform3f(program->uniform.light_color, light->intensity * light->color[0],
		light->intensity * light->color[1], light->intensity * light->color[2]);
	gl->Uniform1f(program->uniform.light_reach, reach);
	gl->Uniform2f(program->uniform.light_cone, scale, spot ? -edge * scale : 1.0f);
}

static void set_ambient(const struct surface_pass *pass, const struct program *program)
{
	struct gl *gl = &pass->renderer->gpu.gl;
	const struct sm_environment *environment = &pass->scene->environment;
	float share = pass->first ? 1.0f : 0.0f;
	gl->Uniform3f(program->uniform.ambient_sky, share * environment->sky[0],
		share * environment->sky[1], share * environment->sky[2]);
	gl->Uniform3f(program->uniform.ambient_ground, share * environment->ground[0],
		share * environment->ground[1], share * environment->ground[2]);
}

/* Inverse transpose up to a positive factor, as signed cofactors, which a flattened object has as
 * well. */
static void normal_matrix(mat4 transform, mat3 normal)
{
	mat3 unit;
	float largest = 0.0f;
	for (int column = 0; column < 3; column++)
		largest = fmaxf(largest, glm_vec3_norm_inf(transform[column]));
	/* Products of two entries would leave the range of float before the entries do. */
	for (int column = 0; column < 3; column++)
		glm_vec3_scale(
			transform[column], largest > 0.0f ? 1.0f / largest : 0.0f, unit[column]);
	float sign = glm_mat3_det(unit) < 0.0f ? -1.0f : 1.0f;
	for (int column = 0; column < 3; column++) {
		glm_vec3_cross(unit[(column + 1) % 3], unit[(column + 2) % 3], normal[column]);
		glm_vec3_scale(normal[column], sign, normal[column]);
	}
}

static void set_object(
	const struct surface_pass *pass, const struct object *object, const struct program *program)
{
	struct gpu *gpu = &pass->renderer->gpu;
	struct gl *gl = &gpu->gl;
	vec4 *transform = (vec4 *)object->transform;
	mat4 to_clip, to_light = GLM_MAT4_IDENTITY_INIT;
	mat3 normal_to_light;
	if (pass->frame != NULL)
		glm_mat4_copy((vec4 *)pass->frame->world_to_light, to_light);
	gl->Uniform3f(program->uniform.up, to_light[1][0], to_light[1][1], to_light[1][2]);
	glm_mat4_mul(pass->world_to_clip, transform, to_clip);
	glm_mat4_mul(to_light, transform, to_light);
	normal_matrix(to_light, normal_to_light);
	gl->UniformMatrix4fv(program->uniform.object_to_clip, 1, GL_FALSE, to_clip[0]);
	gl->UniformMatrix4fv(program->uniform.object_to_light, 1, GL_FALSE, to_light[0]);
	gl->UniformMatrix3fv(program->uniform.normal_to_light, 1, GL_FALSE, normal_to_light[0]);
	gl->Uniform3f(program->uniform.base_color, object->base_color[0], object->base_color[1],
		object->base_color[2]);
	gpu_set_faces(gpu, &pass->scene->meshes[object->mesh], transform, to_clip);
	if (object->image != SM_NONE)
		gpu_bind_texture(gpu, UNIT_BASE, gpu->scene.images[object->image]);
}

/* Flags of the pass for one object, as the technique draws it where it does all it can. */
static uint32_t object_flags(const struct surface_pass *pass, const struct object *object)
{
	const struct technique *technique = pass->renderer->shadows.technique;
	uint32_t flags = pass->flags;
	if (object->image != SM_NONE && !(flags & FLAG_VISIBILITY))
		flags |= FLAG_TEXTURED;
	if (pass->light != NULL)
		flags |= FLAG_LIT;
	if (pass->light != NULL && object->receives)
		flags |= FLAG_SHADOWED | technique->surface_flags(pass->shadow);
	return flags;
}

/* Puts the program in use, and sets what is common to the pass unless it was used just before. */
static bool use_program(struct surface_pass *pass, uint32_t flags, struct sm_error *error)
{
	struct gpu *gpu = &pass->renderer->gpu;
	if (pass->program != NULL && pass->program->key.flags == flags)
		return true;
	struct program_key key = {.kind = PROGRAM_SURFACE, .flags = flags};
	pass->program = program_use(&gpu->programs, &gpu->gl, key, error);
	if (pass->program == NULL)
		return false;
	set_ambient(pass, pass->program);
	if (flags & FLAG_LIT)
		set_light(pass, pass->program);
	if (flags & FLAG_SHADOWED)
		pass->renderer->shadows.technique->bind(
			pass->shadow, gpu, pass->frame, pass->program);
	return true;
}

/* The rectangle of a screen (NDC) that a box takes; false if it reaches behind the eye. */
static bool box_on_screen(mat4 to_clip, const struct cluster *box, float min[2], float max[2])
{
	min[0] = min[1] = INFINITY;
	max[0] = max[1] = -INFINITY;
	for (int corner = 0; corner < 8; corner++) {
		vec4 p = {1.0f, 1.0f, 1.0f, 1.0f};
		for (int axis = 0; axis < 3; axis++)
			p[axis] = corner >> axis & 1 ? box->max[axis] : box->min[axis];
		glm_mat4_mulv(to_clip, p, p);
		/* The projection has no finite bounds at w = 0; false for NaN too. */
		if (!(p[3] > 0.0f))
			return false;
		for (int axis = 0; axis < 2; axis++) {
			min[axis] = fminf(min[axis], p[axis] / p[3]);
			max[axis] = fmaxf(max[axis], p[axis] / p[3]);
		}
	}
	return true;
}

/* Fewer clusters than these in a row are not worth a draw call of their own. */
#define PLAIN_RUN_MIN 4

/* Finds which clusters the technique may soften, into renderer->soft. */
static bool find_soft_clusters(const struct surface_pass *pass, const struct screen_grid *cells,
	const struct object *object, const struct gpu_mesh *mesh, struct sm_error *error)
{
	struct sm_renderer *renderer = pass->renderer;
	if (!array_reserve((void **)&renderer->soft, &renderer->soft_capacity, mesh->cluster_count,
		    sizeof(*renderer->soft)))
		return error_no_memory(error);
	mat4 to_clip;
	glm_mat4_mul((vec4 *)pass->frame->world_to_clip, (vec4 *)object->transform, to_clip);
	size_t plain = 0;
	for (size_t i = 0; i < mesh->cluster_count; i++) {
		float min[2], max[2];
		bool soft = !box_on_screen(to_clip, &mesh->clusters[i], min, max) ||
			    screen_grid_touches(cells, min, max);
		renderer->soft[i] = soft;
		if (soft && plain > 0 && plain < PLAIN_RUN_MIN && plain < i)
			memset(&renderer->soft[i - plain], true, plain);
		plain = soft ? 0 : plain + 1;
	}
	return true;
}

/* Draws the clusters that are soft, or those that are not. */
static void draw_clusters(const struct surface_pass *pass, const struct gpu_mesh *mesh, bool soft)
{
	const bool *is_soft = pass->renderer->soft;
	for (size_t first = 0, next; first < mesh->cluster_count; first = next) {
		next = first + 1;
		while (next < mesh->cluster_count && is_soft[next] == is_soft[first])
			next++;
		if (is_soft[first] == soft)
			gpu_draw_surface(&pass->renderer->gpu, mesh, first, next - first);
	}
}

/* Left or lower pixel of a tile. */
static GLint tile_start(uint32_t pixels, int tile)
{
	return (GLint)((uint64_t)pixels * (uint64_t)tile / SCREEN_GRID_SIZE);
}

/* Draws a mesh of few triangles over the tiles that are soft, or those that are not, a rectangle
 * at a time: rows that are alike go together. */
static void draw_tiles(const struct surface_pass *pass, const struct gpu_mesh *mesh, bool soft)
{
	struct gl *gl = &pass->renderer->gpu.gl;
	const struct screen_grid *tiles = &pass->soft_tiles;
	gl->Enable(GL_SCISSOR_TEST);
	for (int row = 0, next; row < SCREEN_GRID_SIZE; row = next) {
		next = row + 1;
		while (next < SCREEN_GRID_SIZE && tiles->rows[next] == tiles->rows[row])
			next++;
		GLint bottom = tile_start(pass->height, row), top = tile_start(pass->height, next);
		for (int x = 0, end; x < SCREEN_GRID_SIZE; x = end) {
			end = screen_grid_run_end(tiles, x, row);
			if (screen_grid_has(tiles, x, row) != soft)
				continue;
			GLint left = tile_start(pass->width, x);
			gl->Scissor(
				left, bottom, tile_start(pass->width, end) - left, top - bottom);
			gpu_draw_surface(&pass->renderer->gpu, mesh, 0, mesh->cluster_count);
		}
	}
	gl->Disable(GL_SCISSOR_TEST);
}

static bool any_of(const bool *values, size_t count, bool value)
{
	for (size_t i = 0; i < count; i++)
		if (values[i] == value)
			return true;
	return false;
}

/* Whether one cluster may take so much of the picture, in NDC units, that cutting it by tiles pays
 * for the draw calls: a quarter. */
#define LARGE_AREA 1.0f

static bool is_large(
	const struct surface_pass *pass, const struct object *object, const struct gpu_mesh *mesh)
{
	mat4 to_clip;
	float min[2], max[2];
	glm_mat4_mul(pass->world_to_clip, (vec4 *)object->transform, to_clip);
	if (!box_on_screen(to_clip, mesh->clusters, min, max))
		return true;
	for (int axis = 0; axis < 2; axis++) {
		min[axis] = fmaxf(min[axis], -1.0f);
		max[axis] = fminf(max[axis], 1.0f);
	}
	return (max[0] - min[0]) * (max[1] - min[1]) >= LARGE_AREA;
}

/* Draws an object that the technique may soften in part: that part with its own program, the rest
 * as an ordinary shadow map has it, which is the same there and costs less. */
static bool draw_in_parts(struct surface_pass *pass, const struct screen_grid *cells,
	const struct object *object, uint32_t flags, struct sm_error *error)
{
	struct sm_renderer *renderer = pass->renderer;
	const struct gpu_mesh *mesh = &renderer->gpu.scene.meshes[object->mesh];
	if (!find_soft_clusters(pass, cells, object, mesh, error))
		return false;
	bool tiled = mesh->cluster_count == 1 && renderer->soft[0] && is_large(pass, object, mesh);
	uint32_t plain =
		(flags & ~renderer->shadows.technique->surface_flags(pass->shadow)) | FLAG_HARD;
	for (int soft = 0; soft < 2; soft++) {
		if (!tiled && !any_of(renderer->soft, mesh->cluster_count, soft))
			continue;
		if (!use_program(pass, soft ? flags : plain, error))
			return false;
		set_object(pass, object, pass->program);
		if (tiled)
			draw_tiles(pass, mesh, soft);
		else
			draw_clusters(pass, mesh, soft);
	}
	return true;
}

static bool draw_object(
	struct surface_pass *pass, const struct object *object, struct sm_error *error)
{
	struct gpu *gpu = &pass->renderer->gpu;
	const struct gpu_mesh *mesh = &gpu->scene.meshes[object->mesh];
	uint32_t flags = object_flags(pass, object);
	if (flags & FLAG_SHADOWED && pass->soft_cells != NULL)
		return draw_in_parts(pass, pass->soft_cells, object, flags, error);
	if (!use_program(pass, flags, error))
		return false;
	set_object(pass, object, pass->program);
	gpu_draw_surface(gpu, mesh, 0, mesh->cluster_count);
	return true;
}

/* The order of drawing: what ends nearer to the eye first, so that the ground, which reaches
 * farther than what stands on it, is shaded only where it is seen. */
struct draw_item {
	const struct object *object;
	float farthest; /* w of clip space */
};

static int compare_items(const void *a, const void *b)
{
	const struct draw_item *x = a, *y = b;
	if (x->farthest != y->farthest)
		return x->farthest < y->farthest ? -1 : 1;
	return (x->object > y->object) - (x->object < y->object);
}

static float farthest_of(const struct object *object, mat4 world_to_clip)
{
	float farthest = -FLT_MAX;
	for (int corner = 0; corner < 8; corner++) {
		vec4 p = {1.0f, 1.0f, 1.0f, 1.0f};
		for (int axis = 0; axis < 3; axis++)
			p[axis] = corner >> axis & 1 ? object->max[axis] : object->min[axis];
		glm_mat4_mulv(world_to_clip, p, p);
		farthest = fmaxf(farthest, p[3]);
	}
	return farthest;
}

static struct draw_item *sorted_items(const struct surface_pass *pass)
{
	size_t count = pass->scene->object_count;
	struct draw_item *items = array_alloc(count, sizeof(*items));
	for (size_t i = 0; items != NULL && i < count; i++) {
		const struct object *object = &pass->scene->objects[i];
		items[i].object = object;
		items[i].farthest = farthest_of(object, pass->world_to_clip);
	}
	if (items != NULL)
		qsort(items, count, sizeof(*items), compare_items);
	return items;
}

static void find_soft_parts(struct surface_pass *pass)
{
	const struct technique *technique = pass->renderer->shadows.technique;
	pass->soft_cells = NULL;
	if (pass->light == NULL || technique->soft_grid == NULL)
		return;
	pass->soft_cells = technique->soft_grid(pass->shadow);
	soft_tiles_find(
		&pass->soft_tiles, pass->soft_cells, pass->frame, pass->scene, pass->world_to_clip);
}

bool surface_pass_draw(struct surface_pass *pass, struct sm_error *error)
{
	struct gl *gl = &pass->renderer->gpu.gl;
	struct draw_item *items = sorted_items(pass);
	if (items == NULL)
		return error_no_memory(error);
	bool drawn = true;
	find_soft_parts(pass);
	pass->program = NULL;
	gl_push_group(gl, __func__);
	for (size_t i = 0; i < pass->scene->object_count && drawn; i++)
		drawn = draw_object(pass, items[i].object, error);
	gl_pop_group(gl);
	free(items);
	return drawn;
}
