/* SPDX-License-Identifier: MIT */
#include "scene/tile_depths.h"
#include "base/array.h"
#include "scene/tile_fill.h"
#include <stdlib.h>

/* Meshes of up to so many triangles are gone through one by one. */
#define SINGLE_TRIANGLES_MAX 256

/* What a receiver's place is rounded by, tiles. */
#define RECEIVER_MARGIN 1e-3f

static void forget_meshes(struct tile_depths *depths)
{
	for (size_t i = 0; i < depths->mesh_count; i++) {
		free(depths->meshes[i].drawn);
		free(depths->meshes[i].casting);
	}
	depths->mesh_count = 0;
	depths->cluster_count = 0;
}

/* Meshes are never taken from a scene. */
static bool reserve_meshes(struct tile_depths *depths, const struct sm_scene *scene)
{
	if (depths->scene_id != scene->id)
		forget_meshes(depths);
	depths->scene_id = scene->id;
	if (!array_reserve((void **)&depths->meshes, &depths->mesh_capacity, scene->mesh_count,
		    sizeof(*depths->meshes)))
		return false;
	while (depths->mesh_count < scene->mesh_count)
		depths->meshes[depths->mesh_count++] = (struct mesh_clusters){0};
	return true;
}

bool tile_depths_clear(struct tile_depths *depths, const struct sm_scene *scene, uint32_t tiles)
{
	size_t count = (size_t)tiles * tiles;
	if (!array_reserve((void **)&depths->deepest, &depths->deepest_capacity, count,
		    sizeof(*depths->deepest)) ||
		!array_reserve((void **)&depths->farthest, &depths->farthest_capacity, count,
			sizeof(*depths->farthest)) ||
		!reserve_meshes(depths, scene))
		return false;
	depths->tiles = tiles;
	for (size_t i = 0; i < count; i++) {
		depths->deepest[i] = -1.0f;
		depths->farthest[i] = 0.0f;
	}
	return true;
}

/* Triangles of either kind of mesh. */
struct triangles {
	size_t vertex_count;
	const float (*positions)[3];
	size_t count;
	const uint32_t *indices;
	uint64_t version;
};

/* Sets *clusters to the triangles' boxes unless it has them, of *version. */
static bool have_clusters(struct tile_depths *depths, struct cluster **clusters, uint64_t *version,
	const struct triangles *triangles)
{
	if (*clusters == NULL) {
		*clusters = array_alloc(clusters_count(triangles->count), sizeof(**clusters));
		if (*clusters == NULL)
			return false;
		depths->cluster_count += clusters_count(triangles->count);
		*version = 0; /* no mesh has it */
	}
	if (*version != triangles->version)
		clusters_find(
			triangles->positions, triangles->indices, triangles->count, *clusters);
	*version = triangles->version;
	return true;
}

/* Whether triangle t of a caster counts as a sheet. */
static bool is_sheet(const struct caster_view *view, size_t t)
{
	return t >= view->rule.one_sided || (view->facing[t / EDGE_BLOCK] >> t % EDGE_BLOCK & 1);
}

/* Few enough to be gone through one by one. */
static bool are_few(const struct triangles *triangles)
{
	return triangles->count <= SINGLE_TRIANGLES_MAX &&
	       triangles->vertex_count <= 3 * SINGLE_TRIANGLES_MAX;
}

/* view: of a caster, only of whose sheets the triangles are; NULL: of all. */
static void fill_few(const struct tile_fill *fill, const struct triangles *triangles, mat4 to_clip,
	const struct caster_view *view)
{
	struct tile_vertex vertices[3 * SINGLE_TRIANGLES_MAX];
	for (size_t i = 0; i < triangles->vertex_count; i++)
		vertices[i] = tile_vertex_of(fill, to_clip, triangles->positions[i]);
	for (size_t t = 0; t < triangles->count; t++) {
		const uint32_t *corners = &triangles->indices[3 * t];
		if (view == NULL || is_sheet(view, t))
			tile_fill_triangle(
				fill, (const struct tile_vertex *const[]){&vertices[corners[0]],
					      &vertices[corners[1]], &vertices[corners[2]]});
	}
}

static bool has_sheets(const struct caster_view *view, size_t first)
{
	size_t words = facing_words(view->caster), w = first / EDGE_BLOCK;
	size_t end = first + CLUSTER_TRIANGLES;
	return end > view->rule.one_sided || view->facing[w] != 0 ||
	       (w + 1 < words && view->facing[w + 1] != 0);
}

bool tile_depths_add_receiver(struct tile_depths *depths, const struct sm_scene *scene,
	const struct object *object, const struct light_frame *frame)
{
	const struct mesh *mesh = &scene->meshes[object->mesh];
	struct triangles triangles = {mesh->vertex_count, (const float(*)[3])mesh->positions,
		mesh->index_count / 3, mesh->indices, mesh->version};
	struct tile_fill fill = {depths->deepest, depths->tiles, RECEIVER_MARGIN};
	struct mesh_clusters *known = &depths->meshes[object->mesh];
	mat4 to_clip;
	glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform, to_clip);
	if (tile_fill_has_box(&fill, to_clip, mesh->min, mesh->max))
		return true;
	if (are_few(&triangles)) {
		fill_few(&fill, &triangles, to_clip, NULL);
		return true;
	}
	if (!have_clusters(depths, &known->drawn, &known->drawn_version, &triangles))
		return false;
	for (size_t i = 0; i < clusters_count(triangles.count); i++)
		tile_fill_box(&fill, to_clip, known->drawn[i].min, known->drawn[i].max);
	return true;
}

bool tile_depths_add_caster(struct tile_depths *depths, const struct sm_scene *scene,
	const struct object *object, const struct caster_view *view, float margin)
{
	const struct mesh *mesh = &scene->meshes[object->mesh];
	const struct caster *caster = &mesh->caster;
	struct triangles triangles = {caster->vertex_count, (const float(*)[3])caster->positions,
		caster->triangle_count, caster->indices, mesh->version};
	struct tile_fill fill = {depths->farthest, depths->tiles, margin};
	struct mesh_clusters *known = &depths->meshes[object->mesh];
	vec4 *to_clip = (vec4 *)view->to_clip;
	if (are_few(&triangles)) {
		fill_few(&fill, &triangles, to_clip, view);
		return true;
	}
	if (!have_clusters(depths, &known->casting, &known->casting_version, &triangles))
		return false;
	for (size_t i = 0; i < clusters_count(triangles.count); i++)
		if (has_sheets(view, i * CLUSTER_TRIANGLES))
			tile_fill_box(&fill, to_clip, known->casting[i].min, known->casting[i].max);
	return true;
}

static void halve(float *values, uint32_t tiles)
{
	uint32_t half = tiles / 2;
	for (uint32_t y = 0; y < half; y++) {
		for (uint32_t x = 0; x < half; x++) {
			const float *low = &values[(size_t)2 * y * tiles + 2 * x];
			const float *high = low + tiles;
			/* Written no later than it is read. */
			values[(size_t)y * half + x] =
				fmaxf(fmaxf(low[0], low[1]), fmaxf(high[0], high[1]));
		}
	}
}

void tile_depths_halve(struct tile_depths *depths)
{
	halve(depths->deepest, depths->tiles);
	halve(depths->farthest, depths->tiles);
	depths->tiles /= 2;
}

void tile_depths_finish(struct tile_depths *depths)
{
	forget_meshes(depths);
	free(depths->deepest);
	free(depths->farthest);
	free(depths->meshes);
	*depths = (struct tile_depths){0};
}

size_t tile_depths_bytes(const struct tile_depths *depths)
{
	return (depths->deepest_capacity + depths->farthest_capacity) * sizeof(float) +
	       depths->mesh_capacity * sizeof(*depths->meshes) +
	       depths->cluster_count * sizeof(struct cluster);
}
