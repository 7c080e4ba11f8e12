/* SPDX-License-Identifier: MIT */
#include "surface_pass.h"
#include "deferred_pass.h"
#include "sparse_pass.h"
#include "surface_parts.h"
#include <float.h>
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
	gl->Uniform1i(program->uniform.casts, object->casts);
	gpu_set_faces(
		gpu, &pass->scene->meshes[object->mesh], transform, to_clip, object->single_sided);
	if (object->image != SM_NONE)
		gpu_bind_texture(gpu, UNIT_BASE, gpu->scene.images[object->image]);
}

/* Flags of the pass for one object, as the technique draws it where it does all it can. */
static uint64_t object_flags(const struct surface_pass *pass, const struct object *object)
{
	const struct technique *technique = pass->renderer->shadows.technique;
	uint64_t flags = pass->flags;
	if (object->image != SM_NONE && !(flags & (FLAG_VISIBILITY | FLAG_RECEIVERS)))
		flags |= FLAG_TEXTURED;
	if (pass->light != NULL)
		flags |= FLAG_LIT;
	if (pass->light != NULL && object->receives)
		flags |= FLAG_SHADOWED;
	if (flags & FLAG_SHADOWED) {
		uint64_t way = technique->surface_flags(pass->shadow->state);
		flags |= flags & FLAG_RECEIVERS ? way & FLAG_COARSE
			 : pass->found != NULL
				 ? FLAG_FOUND | (pass->multisampled ? FLAG_SAMPLES : 0)
				 : way;
	}
	return flags;
}

/* Puts the program in use, and sets what is common to the pass unless it was used just before. */
static bool use_program(struct surface_pass *pass, uint64_t flags, struct sm_error *error)
{
	struct gpu *gpu = &pass->renderer->gpu;
	if (gpu->flat_inputs)
		flags |= FLAG_FLAT_INPUTS;
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
			pass->shadow->state, gpu, pass->frame, pass->program);
	if (flags & FLAG_COARSE)
		gpu->gl.Uniform2f(pass->program->uniform.pixel_size, 2.0f / (float)pass->width,
			2.0f / (float)pass->height);
	if (flags & FLAG_CELLS)
		sparse_pass_bind(pass, pass->program);
	if (flags & FLAG_FOUND)
		deferred_pass_bind(pass);
	return true;
}

bool surface_pass_begin_object(struct surface_pass *pass, const struct object *object,
	uint64_t flags, struct sm_error *error)
{
	if (!use_program(pass, flags, error))
		return false;
	set_object(pass, object, pass->program);
	return true;
}

/* Whether a shadowed surface takes less in some parts than in others: what was looked up before
 * takes as little everywhere. Of a pixel with several samples the middle is shaded, which may lie
 * beside the surface, in a shadow that no part of it is in: parts are right there, not the whole.
 */
static bool has_parts(const struct surface_pass *pass)
{
	const struct sm_renderer *renderer = pass->renderer;
	const struct technique *technique = renderer->shadows.technique;
	bool needs_parts = technique->needs_parts || pass->multisampled;
	return technique->prepare != NULL && !renderer->whole &&
	       (needs_parts || !renderer->gpu.skips.off[SKIP_RECEIVER]);
}

/* Whether any of an object may be where the pass is wanted. */
static bool is_wanted(const struct surface_pass *pass, const struct object *object)
{
	const struct gpu_mesh *mesh = &pass->renderer->gpu.scene.meshes[object->mesh];
	bool wanted = false;
	mat4 to_clip;
	if (pass->wanted == NULL)
		return true;
	glm_mat4_mul(pass->world_to_clip, (vec4 *)object->transform, to_clip);
	for (size_t i = 0; i < mesh->cluster_count && !wanted; i++) {
		float min[3], max[3];
		wanted = !box_on_screen(to_clip, &mesh->clusters[i], min, max) ||
			 screen_grid_touches(pass->wanted, min, max);
	}
	return wanted;
}

/* Whether single triangles are told apart, too: as shading has them, not visibility. */
static bool has_lit_parts(const struct surface_pass *pass)
{
	const struct sm_renderer *renderer = pass->renderer;
	return pass->light != NULL && has_parts(pass) && !pass->multisampled &&
	       !(pass->flags & FLAG_VISIBILITY) &&
	       renderer->shadows.technique->texels_around > 0.0f;
}

/* The object's triangles by need. NULL: its clusters tell. */
static const struct lit_list *find_list(
	const struct surface_pass *pass, const struct object *object)
{
	const struct mesh *mesh = &pass->scene->meshes[object->mesh];
	const struct lit_list *list = NULL;
	mat4 to_clip;
	if (has_lit_parts(pass))
		list = lit_parts_list(&pass->shadow->lit, (size_t)(object - pass->scene->objects));
	if (list == NULL || object->single_sided)
		return list;
	glm_mat4_mul(pass->world_to_clip, (vec4 *)object->transform, to_clip);
	return mesh_hides_back(mesh, to_clip) ? list : NULL;
}

static bool draw_object(
	struct surface_pass *pass, const struct object *object, struct sm_error *error)
{
	struct gpu *gpu = &pass->renderer->gpu;
	const struct gpu_mesh *mesh = &gpu->scene.meshes[object->mesh];
	uint64_t flags = object_flags(pass, object);
	if (!is_wanted(pass, object))
		return true;
	if (flags & FLAG_SHADOWED && has_parts(pass))
		return surface_parts_draw(pass, object, find_list(pass, object), flags, error);
	if (flags & FLAG_SHADOWED && pass->cells != NULL)
		flags |= FLAG_CELLS;
	if (!surface_pass_begin_object(pass, object, flags, error))
		return false;
	gpu_draw_surface(gpu, mesh, 0, mesh->cluster_count);
	return true;
}

/* Half the width of the light's cone on its screen. */
static float cone_of(const struct surface_pass *pass)
{
	const struct light_frame *frame = pass->frame;
	if (frame->parallel)
		return INFINITY;
	/* The cone is as wide as the screen, unless that is fitted. */
	return pass->renderer->shadows.technique->fits_screen
		       ? tanf(glm_rad(pass->light->angle) / 2.0f) / frame->half_extent
		       : 1.0f;
}

static bool find_lit_parts(struct surface_pass *pass, struct sm_error *error)
{
	struct sm_renderer *renderer = pass->renderer;
	struct light_shadow *shadow = pass->shadow;
	if (!has_lit_parts(pass))
		return true;
	const struct lit_request request = {.scene = pass->scene,
		.frame = pass->frame,
		.technique = renderer->shadows.technique,
		.state = shadow->state,
		.needs = &shadow->needs,
		.map_size = renderer->shadows.options.map_size};
	return lit_parts_find_more(&shadow->lit, &renderer->gpu, &request, error);
}

/* Finds the light's needs, unless they are known from an earlier pass or frame. */
static void map_needs(struct surface_pass *pass)
{
	const struct sm_renderer *renderer = pass->renderer;
	const struct technique *technique = renderer->shadows.technique;
	struct light_shadow *shadow = pass->shadow;
	if (pass->light == NULL || !has_parts(pass))
		return;
	if (!shadow->mapped)
		need_map_find(&shadow->needs, &renderer->gpu.scene, pass->scene, pass->frame,
			technique->soft_grid != NULL ? technique->soft_grid(shadow->state) : NULL,
			technique->soft_is_all,
			technique->reach != NULL ? technique->reach(shadow->state, pass->frame)
						 : 0.0f,
			renderer->shadows.options.map_size);
	shadow->mapped = true;
	shadow->needs.soft =
		technique->soft_depths != NULL ? technique->soft_depths(shadow->state) : NULL;
	/* Receivers are drawn alike wherever they lie. */
	bool alike = technique->farthest == NULL || pass->flags & FLAG_RECEIVERS;
	shadow->needs.farthest = alike ? NULL : technique->farthest(shadow->state);
	/* Where a screen is fitted the cone can change and the screen not. */
	shadow->needs.cone = cone_of(pass);
}

bool surface_pass_mark(struct surface_pass *pass, struct screen_grid *cells, struct sm_error *error)
{
	const struct draw_order *order = &pass->renderer->order;
	bool marked = true;
	screen_grid_clear(cells);
	gl_push_group(&pass->renderer->gpu.gl, "parts");
	map_needs(pass);
	for (size_t i = 0; i < order->count && marked; i++) {
		const struct object *object = order->items[i].object;
		if (!(object_flags(pass, object) & FLAG_SHADOWED))
			continue;
		if (has_parts(pass))
			marked = surface_parts_mark(pass, object, cells, error);
		else
			screen_grid_fill(cells);
	}
	/* Samples look at the pixels around. */
	if (pass->multisampled)
		screen_grid_widen(cells);
	gl_pop_group(&pass->renderer->gpu.gl);
	return marked;
}

bool surface_pass_draw(struct surface_pass *pass, struct sm_error *error)
{
	struct gl *gl = &pass->renderer->gpu.gl;
	const struct draw_order *order = &pass->renderer->order;
	bool drawn = true;
	map_needs(pass);
	if (!find_lit_parts(pass, error))
		return false;
	pass->program = NULL;
	gl_push_group(gl, pass->flags & FLAG_POINTS      ? "points"
			  : pass->flags & FLAG_RECEIVERS ? "receivers"
							 : "surfaces");
	for (size_t i = 0; i < order->count && drawn; i++)
		drawn = draw_object(pass, order->items[i].object, error);
	gl_pop_group(gl);
	return drawn;
}
