/* SPDX-License-Identifier: MIT */
#include "surface_pass.h"
#include "base/array.h"
#include "deferred_pass.h"
#include "sparse_pass.h"
#include "tiles.h"
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
	if (gpu->flat_inputs && flags & FLAT_SURFACE_FLAGS)
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

/* Fewer clusters than these in a row are not worth a draw call of their own. */
#define RUN_MIN 4

/* End of the run of clusters of one need that starts at `first`. */
static size_t run_end(const uint8_t *needs, size_t count, size_t first)
{
	size_t end = first + 1;
	while (end < count && needs[end] == needs[first])
		end++;
	return end;
}

/* Gives short runs what the more needy of their neighbours gets. */
static void join_short_runs(uint8_t *needs, size_t count)
{
	for (size_t first = 0, end; first < count; first = end) {
		end = run_end(needs, count, first);
		uint8_t before = first > 0 ? needs[first - 1] : NEED_AMBIENT;
		uint8_t after = end < count ? needs[end] : NEED_AMBIENT;
		uint8_t neighbour = before > after ? before : after;
		if (end - first < RUN_MIN && neighbour > needs[first])
			memset(&needs[first], neighbour, end - first);
	}
}

/* Finds what each cluster needs, into renderer->needs. */
static bool find_needs(const struct surface_pass *pass, const struct object *object,
	const struct gpu_mesh *mesh, struct sm_error *error)
{
	struct sm_renderer *renderer = pass->renderer;
	if (!array_reserve((void **)&renderer->needs, &renderer->need_capacity, mesh->cluster_count,
		    sizeof(*renderer->needs)))
		return error_no_memory(error);
	mat4 to_clip;
	glm_mat4_mul((vec4 *)pass->frame->world_to_clip, (vec4 *)object->transform, to_clip);
	for (size_t i = 0; i < mesh->cluster_count; i++)
		renderer->needs[i] =
			(uint8_t)need_of_box(&pass->shadow->needs, to_clip, &mesh->clusters[i]);
	join_short_runs(renderer->needs, mesh->cluster_count);
	return true;
}

/* Draws the clusters that have this need. */
static void draw_clusters(
	const struct surface_pass *pass, const struct gpu_mesh *mesh, enum need need)
{
	const uint8_t *needs = pass->renderer->needs;
	for (size_t first = 0, end; first < mesh->cluster_count; first = end) {
		end = run_end(needs, mesh->cluster_count, first);
		if (needs[first] == need)
			gpu_draw_surface(&pass->renderer->gpu, mesh, first, end - first);
	}
}

/* Left or lower pixel of a tile: the first whose centre is in it. */
static GLint tile_start(uint32_t pixels, int tile)
{
	uint64_t twice = 2 * (uint64_t)pixels * (uint64_t)tile;
	return (GLint)((twice + SCREEN_GRID_SIZE - 1) / (2 * SCREEN_GRID_SIZE));
}

/* Draws a mesh of few triangles over the tiles that have this need, a rectangle at a time: rows
 * that are alike go together. */
static void draw_tiles(const struct surface_pass *pass, const struct gpu_mesh *mesh,
	const struct tiles *all, enum need need)
{
	struct gl *gl = &pass->renderer->gpu.gl;
	const struct screen_grid *tiles = &all->of[need];
	gl->Enable(GL_SCISSOR_TEST);
	for (int row = 0, next; row < SCREEN_GRID_SIZE; row = next) {
		next = row + 1;
		while (next < SCREEN_GRID_SIZE && tiles->rows[next] == tiles->rows[row])
			next++;
		GLint bottom = tile_start(pass->height, row), top = tile_start(pass->height, next);
		for (int x = 0, end; x < SCREEN_GRID_SIZE; x = end) {
			end = screen_grid_run_end(tiles, x, row);
			if (!screen_grid_has(tiles, x, row))
				continue;
			GLint left = tile_start(pass->width, x);
			gl->Scissor(
				left, bottom, tile_start(pass->width, end) - left, top - bottom);
			gpu_draw_surface(&pass->renderer->gpu, mesh, 0, mesh->cluster_count);
		}
	}
	gl->Disable(GL_SCISSOR_TEST);
}

/* How much of the picture a mesh's first cluster may take, in NDC units of which all is 4. */
static float area_on_screen(
	const struct surface_pass *pass, const struct object *object, const struct gpu_mesh *mesh)
{
	mat4 to_clip;
	float min[3], max[3];
	glm_mat4_mul(pass->world_to_clip, (vec4 *)object->transform, to_clip);
	if (!box_on_screen(to_clip, mesh->clusters, min, max))
		return INFINITY;
	for (int axis = 0; axis < 2; axis++) {
		min[axis] = fmaxf(min[axis], -1.0f);
		max[axis] = fmaxf(fminf(max[axis], 1.0f), min[axis]);
	}
	return (max[0] - min[0]) * (max[1] - min[1]);
}

/* From which on cutting a cluster by tiles pays for the draw calls: a quarter of the picture. */
#define LARGE_AREA 1.0f

/* The flags that a need takes: those of all, less what can be left out. */
static uint64_t flags_of(const struct surface_pass *pass, uint64_t all, enum need need)
{
	const struct technique *technique = pass->renderer->shadows.technique;
	uint64_t shadowed = FLAG_SHADOWED | FLAG_FOUND | FLAG_SAMPLES;
	uint64_t lit = all & ~(shadowed | technique->surface_flags(pass->shadow->state));
	switch (need) {
	case NEED_AMBIENT:
		/* Visibility tells the sides of a surface apart wherever it is. */
		return all & FLAG_VISIBILITY ? lit : lit & ~FLAG_LIT;
	case NEED_LIGHT:
		return lit;
	case NEED_MAP:
		return lit | pass->renderer->shadows.map_flags;
	case NEED_BEHIND:
		return all & FLAG_EDGES ? (all & ~(FLAG_TWO_LAYERS | FLAG_HOLLOWS)) | FLAG_BEHIND
					: all;
	default:
		return all;
	}
}

/* What is of few triangles and large in the picture is cut by its tiles. Multisampling drivers
 * (llvmpipe) may draw the pixels along a scissor's side on either side of it: where light is added
 * up, that would show. */
static bool cut_to_tiles(
	const struct surface_pass *pass, const struct object *object, struct tiles *tiles)
{
	const struct mesh *mesh = &pass->scene->meshes[object->mesh];
	const struct gpu_mesh *gpu_mesh = &pass->renderer->gpu.scene.meshes[object->mesh];
	bool adds_up = !pass->first && pass->multisampled;
	if (adds_up || mesh->index_count > 3 * TILE_TRIANGLES_MAX ||
		area_on_screen(pass, object, gpu_mesh) < LARGE_AREA)
		return false;
	mat4 to_clip, to_light_clip;
	glm_mat4_mul(pass->world_to_clip, (vec4 *)object->transform, to_clip);
	glm_mat4_mul((vec4 *)pass->frame->world_to_clip, (vec4 *)object->transform, to_light_clip);
	tiles_find(tiles, &pass->shadow->needs, mesh, pass->width, pass->height, to_clip,
		to_light_clip);
	return true;
}

/* Pixels around a mesh of one cluster, or of the picture, from which on it pays to draw apart what
 * is averted. */
#define AVERTED_PIXELS_MIN 4096.0f

static bool is_worth_splitting(
	const struct surface_pass *pass, const struct object *object, const struct gpu_mesh *mesh)
{
	const uint8_t *needs = pass->renderer->needs;
	float pixels = (float)pass->width * (float)pass->height;
	if (mesh->cluster_count == 1)
		pixels *= 0.25f * fminf(area_on_screen(pass, object, mesh), 4.0f);
	return pixels >= AVERTED_PIXELS_MIN &&
	       (memchr(needs, NEED_BEHIND, mesh->cluster_count) != NULL ||
		       memchr(needs, NEED_TECHNIQUE, mesh->cluster_count) != NULL);
}

/* Whether what no light arrives at can be drawn apart: where a processor with lanes would walk
 * along edges for it in vain. Of several samples of a pixel the middle is shaded, which may lie
 * beside the surface; visibility is told by other normals; and those of backs lead the other way.
 */
static bool can_split(const struct surface_pass *pass, const struct object *object, uint64_t flags)
{
	mat4 to_clip;
	glm_mat4_mul(pass->world_to_clip, (vec4 *)object->transform, to_clip);
	return flags & FLAG_EDGES && !(flags & FLAG_VISIBILITY) && !pass->multisampled &&
	       (object->single_sided ||
		       mesh_hides_back(&pass->scene->meshes[object->mesh], to_clip)) &&
	       way_choose(&pass->renderer->gpu, DRIVER_BRANCH, NULL) != BRANCH_SHADER;
}

static bool find_averted(const struct surface_pass *pass, const struct object *object,
	uint64_t flags, struct sm_error *error)
{
	struct sm_renderer *renderer = pass->renderer;
	const struct mesh *mesh = &pass->scene->meshes[object->mesh];
	const struct gpu_mesh *gpu_mesh = &renderer->gpu.scene.meshes[object->mesh];
	renderer->averted.split = false;
	return !is_worth_splitting(pass, object, gpu_mesh) || !can_split(pass, object, flags) ||
	       averted_parts_find(&renderer->averted, &renderer->gpu, mesh, gpu_mesh,
		       (vec4 *)object->transform, pass->frame, renderer->needs, error);
}

/* Draws the tiles, or else the clusters, that have this need. */
static bool draw_part(struct surface_pass *pass, const struct object *object,
	const struct tiles *tiles, enum need need, uint64_t flags, struct sm_error *error)
{
	const struct gpu_mesh *mesh = &pass->renderer->gpu.scene.meshes[object->mesh];
	if (!use_program(pass, flags, error))
		return false;
	set_object(pass, object, pass->program);
	struct sm_renderer *renderer = pass->renderer;
	bool split = tiles == NULL && renderer->averted.split;
	if (tiles != NULL)
		draw_tiles(pass, mesh, tiles, need);
	else if (!split || need < NEED_BEHIND)
		draw_clusters(pass, mesh, need);
	if (split)
		averted_parts_draw(&renderer->averted, &renderer->gpu, mesh, need);
	return true;
}

/* What cells know is drawn first, and the rest where that has left it out, or both by one program,
 * as the driver has it. A further light, which is added where the depth is the same, cannot tell
 * two passes apart. */
static bool draw_need(struct surface_pass *pass, const struct object *object,
	const struct tiles *tiles, enum need need, uint64_t flags, struct sm_error *error)
{
	const struct technique *technique = pass->renderer->shadows.technique;
	uint64_t needed = flags_of(pass, flags, need);
	if (need < NEED_BEHIND || pass->cells == NULL)
		return draw_part(pass, object, tiles, need, needed, error);
	if (!pass->first || way_choose(&pass->renderer->gpu, DRIVER_BRANCH, NULL) == BRANCH_SHADER)
		return draw_part(pass, object, tiles, need, needed | FLAG_CELLS, error);
	uint64_t edges = technique->surface_flags(pass->shadow->state) | FLAG_BEHIND;
	uint64_t known = (needed & ~edges) | FLAG_CELLS;
	return draw_part(pass, object, tiles, need, known, error) &&
	       draw_part(pass, object, tiles, need, needed, error);
}

/* How many parts there are, and how many of them do without the technique. */
static void count_parts(
	struct sm_renderer *renderer, const struct tiles *tiles, const struct gpu_mesh *mesh)
{
	size_t count = SCREEN_GRID_SIZE * SCREEN_GRID_SIZE, needy = 0;
	if (tiles == NULL) {
		count = mesh->cluster_count;
	} else {
		struct screen_grid all = tiles->of[NEED_TECHNIQUE];
		screen_grid_unite(&all, &tiles->of[NEED_BEHIND]);
		needy = screen_grid_count(&all);
	}
	for (size_t i = 0; tiles == NULL && i < count; i++)
		needy += renderer->needs[i] >= NEED_BEHIND;
	skip_count(&renderer->gpu.skips, SKIP_RECEIVER, count, count - needy);
}

static bool has_clusters(
	const struct sm_renderer *renderer, const struct gpu_mesh *mesh, enum need need)
{
	return memchr(renderer->needs, need, mesh->cluster_count) != NULL ||
	       (need == NEED_AMBIENT && renderer->averted.split);
}

/* Draws an object that a shadow may fall on, each part with no more than it needs: that is the same
 * there and costs less. */
static bool draw_in_parts(struct surface_pass *pass, const struct object *object, uint64_t flags,
	struct sm_error *error)
{
	struct sm_renderer *renderer = pass->renderer;
	const struct gpu_mesh *mesh = &renderer->gpu.scene.meshes[object->mesh];
	struct tiles tiles;
	bool tiled = cut_to_tiles(pass, object, &tiles);
	if (!tiled && (!find_needs(pass, object, mesh, error) ||
			      !find_averted(pass, object, flags, error)))
		return false;
	count_parts(renderer, tiled ? &tiles : NULL, mesh);
	/* What a further light does not reach it adds nothing to. */
	enum need least = pass->first ? NEED_AMBIENT : NEED_LIGHT;
	for (enum need need = least; need < NEED_COUNT; need++) {
		if (!tiled && !has_clusters(renderer, mesh, need))
			continue;
		if (!draw_need(pass, object, tiled ? &tiles : NULL, need, flags, error))
			return false;
	}
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

static bool draw_object(
	struct surface_pass *pass, const struct object *object, struct sm_error *error)
{
	struct gpu *gpu = &pass->renderer->gpu;
	const struct gpu_mesh *mesh = &gpu->scene.meshes[object->mesh];
	uint64_t flags = object_flags(pass, object);
	if (flags & FLAG_SHADOWED && has_parts(pass))
		return draw_in_parts(pass, object, flags, error);
	if (flags & FLAG_SHADOWED && pass->cells != NULL)
		flags |= FLAG_CELLS;
	if (!use_program(pass, flags, error))
		return false;
	set_object(pass, object, pass->program);
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

void surface_pass_find_ways(const struct surface_pass *pass)
{
	const struct technique *technique = pass->renderer->shadows.technique;
	if (technique->farthest != NULL && !pass->multisampled &&
		(float)pass->width * (float)pass->height >= AVERTED_PIXELS_MIN)
		way_choose(&pass->renderer->gpu, DRIVER_BRANCH, NULL);
}

bool surface_pass_draw(struct surface_pass *pass, struct sm_error *error)
{
	struct gl *gl = &pass->renderer->gpu.gl;
	const struct draw_order *order = &pass->renderer->order;
	bool drawn = true;
	map_needs(pass);
	pass->program = NULL;
	gl_push_group(gl, pass->flags & FLAG_POINTS      ? "points"
			  : pass->flags & FLAG_RECEIVERS ? "receivers"
							 : "surfaces");
	for (size_t i = 0; i < order->count && drawn; i++)
		drawn = draw_object(pass, order->items[i].object, error);
	gl_pop_group(gl);
	return drawn;
}
