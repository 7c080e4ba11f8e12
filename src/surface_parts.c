/* SPDX-License-Identifier: MIT */
#include "surface_parts.h"
#include "base/array.h"
#include "geom/screen_parts.h"
#include "tiles.h"
#include <string.h>

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

/* Draws a mesh of few triangles over the tiles that have this need, a rectangle at a time. */
static void draw_tiles(const struct surface_pass *pass, const struct gpu_mesh *mesh,
	const struct tiles *all, enum need need)
{
	struct gl *gl = &pass->renderer->gpu.gl;
	struct screen_grid tiles = all->of[need];
	struct screen_part part = {0};
	if (pass->wanted != NULL)
		screen_grid_cut(&tiles, pass->wanted);
	gl->Enable(GL_SCISSOR_TEST);
	while (screen_part_next(&part, &tiles, pass->width, pass->height)) {
		const struct pixel_box *box = &part.box;
		gl->Scissor(box->left, box->bottom, box->right - box->left, box->top - box->bottom);
		gpu_draw_surface(&pass->renderer->gpu, mesh, 0, mesh->cluster_count);
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

/* What an object is drawn by: either, or neither, which leaves its clusters. */
struct division {
	const struct tiles *tiles;
	const struct lit_list *list;
};

/* Draws the tiles, or else the triangles or clusters, that have this need. */
static bool draw_part(struct surface_pass *pass, const struct object *object,
	const struct division *by, enum need need, uint64_t flags, struct sm_error *error)
{
	const struct gpu_mesh *mesh = &pass->renderer->gpu.scene.meshes[object->mesh];
	if (!surface_pass_begin_object(pass, object, flags, error))
		return false;
	struct sm_renderer *renderer = pass->renderer;
	bool whole = by->tiles == NULL && by->list == NULL;
	bool split = whole && renderer->averted.split;
	if (by->tiles != NULL)
		draw_tiles(pass, mesh, by->tiles, need);
	else if (by->list != NULL)
		gpu_draw_indices(&renderer->gpu, mesh, by->list->buffer, by->list->first[need],
			by->list->count[need]);
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
	const struct division *by, enum need need, uint64_t flags, struct sm_error *error)
{
	const struct technique *technique = pass->renderer->shadows.technique;
	uint64_t needed = flags_of(pass, flags, need);
	if (need < NEED_BEHIND || pass->cells == NULL)
		return draw_part(pass, object, by, need, needed, error);
	if (!pass->first || way_choose(&pass->renderer->gpu, DRIVER_BRANCH, NULL) == BRANCH_SHADER)
		return draw_part(pass, object, by, need, needed | FLAG_CELLS, error);
	uint64_t edges = technique->surface_flags(pass->shadow->state) | FLAG_BEHIND;
	uint64_t known = (needed & ~edges) | FLAG_CELLS;
	return draw_part(pass, object, by, need, known, error) &&
	       draw_part(pass, object, by, need, needed, error);
}

/* How many parts there are, and how many of them do without the technique. */
static void count_parts(
	struct sm_renderer *renderer, const struct division *by, const struct gpu_mesh *mesh)
{
	size_t count, needy = 0;
	if (by->tiles != NULL) {
		struct screen_grid all = by->tiles->of[NEED_TECHNIQUE];
		screen_grid_unite(&all, &by->tiles->of[NEED_BEHIND]);
		count = SCREEN_GRID_SIZE * SCREEN_GRID_SIZE;
		needy = screen_grid_count(&all);
	} else if (by->list != NULL) {
		count = (size_t)mesh->surface_count / 3;
		needy = (by->list->count[NEED_BEHIND] + by->list->count[NEED_TECHNIQUE]) / 3;
	} else {
		count = mesh->cluster_count;
		for (size_t i = 0; i < count; i++)
			needy += renderer->needs[i] >= NEED_BEHIND;
	}
	skip_count(&renderer->gpu.skips, SKIP_RECEIVER, count, count - needy);
}

static bool has_need(const struct sm_renderer *renderer, const struct division *by,
	const struct gpu_mesh *mesh, enum need need)
{
	if (by->tiles != NULL)
		return true;
	if (by->list != NULL)
		return by->list->count[need] > 0;
	return memchr(renderer->needs, need, mesh->cluster_count) != NULL ||
	       (need == NEED_AMBIENT && renderer->averted.split);
}

bool surface_parts_draw(struct surface_pass *pass, const struct object *object,
	const struct lit_list *list, uint64_t flags, struct sm_error *error)
{
	struct sm_renderer *renderer = pass->renderer;
	const struct gpu_mesh *mesh = &renderer->gpu.scene.meshes[object->mesh];
	struct tiles tiles;
	struct division by = {.list = list};
	if (cut_to_tiles(pass, object, &tiles))
		by = (struct division){.tiles = &tiles};
	else if (list == NULL && (!find_needs(pass, object, mesh, error) ||
					 !find_averted(pass, object, flags, error)))
		return false;
	count_parts(renderer, &by, mesh);
	/* What a further light does not reach it adds nothing to. */
	enum need least = pass->first ? NEED_AMBIENT : NEED_LIGHT;
	for (enum need need = least; need < NEED_COUNT; need++)
		if (has_need(renderer, &by, mesh, need) &&
			!draw_need(pass, object, &by, need, flags, error))
			return false;
	return true;
}

bool surface_parts_mark(const struct surface_pass *pass, const struct object *object,
	struct screen_grid *cells, struct sm_error *error)
{
	const struct gpu_mesh *mesh = &pass->renderer->gpu.scene.meshes[object->mesh];
	struct tiles tiles;
	mat4 to_clip;
	if (cut_to_tiles(pass, object, &tiles)) {
		screen_grid_unite(cells, &tiles.of[NEED_BEHIND]);
		screen_grid_unite(cells, &tiles.of[NEED_TECHNIQUE]);
		return true;
	}
	if (!find_needs(pass, object, mesh, error))
		return false;
	glm_mat4_mul(pass->world_to_clip, (vec4 *)object->transform, to_clip);
	/* A pixel for the one that the side of a box cuts, and for how vertices are snapped. */
	uint32_t pixels = pass->width < pass->height ? pass->width : pass->height;
	for (size_t i = 0; i < mesh->cluster_count; i++)
		if (pass->renderer->needs[i] >= NEED_BEHIND)
			mark_box(cells, to_clip, &mesh->clusters[i],
				(float)SCREEN_GRID_SIZE / (float)pixels);
	return true;
}

void surface_parts_find_ways(const struct surface_pass *pass)
{
	const struct technique *technique = pass->renderer->shadows.technique;
	if (technique->farthest != NULL && !pass->multisampled &&
		(float)pass->width * (float)pass->height >= AVERTED_PIXELS_MIN)
		way_choose(&pass->renderer->gpu, DRIVER_BRANCH, NULL);
}
