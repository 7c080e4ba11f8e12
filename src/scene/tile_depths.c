/* SPDX-License-Identifier: MIT */
#include "scene/tile_depths.h"
#include "base/array.h"
#include "base/float_range.h"
#include "scene/tile_fill.h"
#include <math.h>
#include <stdlib.h>

/* Meshes of up to so many triangles are gone through one by one, casters that are larger as well:
 * what lies behind all of a tile's costs least. */
#define SINGLE_TRIANGLES_MAX 256
#define SINGLE_CASTING_MAX 32768

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

static bool reserve_values(struct tile_values *values, uint32_t tiles)
{
	return array_reserve((void **)&values->of, &values->capacity, (size_t)tiles * tiles,
		sizeof(*values->of));
}

static void show(struct tile_depths *depths, uint32_t tiles, const struct tile_values *received,
	const struct tile_values *cast)
{
	depths->tiles = tiles;
	depths->deepest = received->of;
	depths->farthest = cast->of;
}

bool tile_depths_reserve(struct tile_depths *depths, const struct sm_scene *scene, uint32_t tiles)
{
	if (!reserve_values(&depths->received, tiles) || !reserve_values(&depths->cast, tiles) ||
		!reserve_meshes(depths, scene))
		return false;
	show(depths, tiles, &depths->received, &depths->cast);
	return true;
}

/* First tile, and the one past the last, that a range of NDC touches. */
static void find_tiles(uint32_t tiles, float min, float max, uint32_t *first, uint32_t *end)
{
	float half = 0.5f * (float)tiles, most = (float)tiles;
	float from = fmaxf(floorf(half * min + half), 0.0f);
	float past = fminf(floorf(half * max + half) + 1.0f, most);
	*first = from < past ? (uint32_t)from : 0;
	*end = from < past ? (uint32_t)past : 0;
}

/* What the tiles of a thing are rounded by, tiles; more than enough. */
#define ROUNDING 0.5f

static struct screen_box clear_part(
	uint32_t tiles, float *values, float none, const struct screen_box *part, float margin)
{
	float tile = 2.0f / (float)tiles, reach = (margin + ROUNDING) * tile;
	struct screen_box within = screen_box_widened(part, reach);
	uint32_t first[2], end[2];
	for (int axis = 0; axis < 2; axis++)
		find_tiles(tiles, within.min[axis], within.max[axis], &first[axis], &end[axis]);
	for (uint32_t y = first[1]; y < end[1]; y++)
		for (uint32_t x = first[0]; x < end[0]; x++)
			values[(size_t)y * tiles + x] = none;
	/* The tiles have parts beside the box, and what is beside them reaches into them. */
	return screen_box_widened(&within, tile + reach);
}

struct screen_box tile_depths_clear_receivers(
	struct tile_depths *depths, const struct screen_box *part)
{
	return clear_part(depths->tiles, depths->received.of, -1.0f, part, RECEIVER_MARGIN);
}

struct screen_box tile_depths_clear_casters(
	struct tile_depths *depths, const struct screen_box *part, float margin)
{
	return clear_part(depths->tiles, depths->cast.of, 0.0f, part, margin);
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

/* Which triangles of block w count, a bit each: of a caster its sheets; view NULL: all. */
static uint64_t counted(const struct triangles *triangles, const struct caster_view *view, size_t w)
{
	size_t first = w * EDGE_BLOCK, rest = triangles->count - first;
	uint64_t all = rest < EDGE_BLOCK ? ((uint64_t)1 << rest) - 1 : UINT64_MAX;
	if (view == NULL || first >= view->rule.one_sided)
		return all;
	size_t one_sided = view->rule.one_sided - first;
	uint64_t both = one_sided < EDGE_BLOCK ? UINT64_MAX << one_sided : 0;
	return all & (view->facing[w] | both);
}

/* Few enough to be gone through one by one. */
static bool are_few(const struct triangles *triangles, size_t most)
{
	return triangles->count <= most && triangles->vertex_count <= 3 * most;
}

/* view: of a caster, only of whose sheets the triangles are; NULL: of all. False: out of memory. */
static bool fill_few(struct tile_depths *depths, const struct tile_fill *fill,
	const struct triangles *triangles, mat4 to_clip, const struct caster_view *view)
{
	if (!array_reserve((void **)&depths->vertices, &depths->vertex_capacity,
		    triangles->vertex_count, sizeof(*depths->vertices)))
		return false;
	struct tile_vertex *vertices = depths->vertices;
	for (size_t i = 0; i < triangles->vertex_count; i++)
		tile_vertex_set(&vertices[i], fill, to_clip, triangles->positions[i]);
	for (size_t first = 0; first < triangles->count; first += EDGE_BLOCK) {
		uint64_t bits = counted(triangles, view, first / EDGE_BLOCK);
		for (; bits != 0; bits &= bits - 1) {
			size_t t = first + (size_t)__builtin_ctzll(bits);
			tile_fill_triangle(fill, vertices, &triangles->indices[3 * t]);
		}
	}
	return true;
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
	struct tile_fill fill = {depths->received.of, depths->tiles, RECEIVER_MARGIN};
	struct mesh_clusters *known = &depths->meshes[object->mesh];
	mat4 to_clip;
	glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform, to_clip);
	if (tile_fill_has_box(&fill, to_clip, mesh->min, mesh->max))
		return true;
	if (are_few(&triangles, SINGLE_TRIANGLES_MAX))
		return fill_few(depths, &fill, &triangles, to_clip, NULL);
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
	struct tile_fill fill = {depths->cast.of, depths->tiles, margin};
	struct mesh_clusters *known = &depths->meshes[object->mesh];
	vec4 *to_clip = (vec4 *)view->to_clip;
	if (are_few(&triangles, SINGLE_CASTING_MAX))
		return fill_few(depths, &fill, &triangles, to_clip, view);
	if (!have_clusters(depths, &known->casting, &known->casting_version, &triangles))
		return false;
	for (size_t i = 0; i < clusters_count(triangles.count); i++)
		if (has_sheets(view, i * CLUSTER_TRIANGLES))
			tile_fill_box(&fill, to_clip, known->casting[i].min, known->casting[i].max);
	return true;
}

/* to: may be from. */
static void halve(float *to, const float *from, uint32_t tiles)
{
	uint32_t half = tiles / 2;
	for (uint32_t y = 0; y < half; y++) {
		for (uint32_t x = 0; x < half; x++) {
			const float *low = &from[(size_t)2 * y * tiles + 2 * x];
			const float *high = low + tiles;
			/* Written no later than it is read. */
			to[(size_t)y * half + x] =
				larger(larger(low[0], low[1]), larger(high[0], high[1]));
		}
	}
}

bool tile_depths_halve(struct tile_depths *depths)
{
	struct tile_values *received = &depths->received_halved, *cast = &depths->cast_halved;
	uint32_t half = depths->tiles / 2;
	if (!reserve_values(received, half) || !reserve_values(cast, half))
		return false;
	halve(received->of, depths->deepest, depths->tiles);
	halve(cast->of, depths->farthest, depths->tiles);
	show(depths, half, received, cast);
	return true;
}

void tile_depths_finish(struct tile_depths *depths)
{
	forget_meshes(depths);
	free(depths->received.of);
	free(depths->cast.of);
	free(depths->received_halved.of);
	free(depths->cast_halved.of);
	free(depths->vertices);
	free(depths->meshes);
	*depths = (struct tile_depths){0};
}

size_t tile_depths_bytes(const struct tile_depths *depths)
{
	return (depths->received.capacity + depths->cast.capacity +
		       depths->received_halved.capacity + depths->cast_halved.capacity) *
		       sizeof(float) +
	       depths->vertex_capacity * sizeof(*depths->vertices) +
	       depths->mesh_capacity * sizeof(*depths->meshes) +
	       depths->cluster_count * sizeof(struct cluster);
}
