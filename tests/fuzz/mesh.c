/* SPDX-License-Identifier: MIT */
/* Any numbers for vertices, triangles, a place and a light: what geom promises holds of the mesh,
 * its silhouette and its fins, and what scene promises of the lists of its edges.
 *	build-fuzz/tests/fuzz/fuzz-mesh FOUND tests/fuzz/corpus/mesh
 */
#include "../geom/facing.h"
#include "expect.h"
#include "geom/fins.h"
#include "geom/screen_grid.h"
#include "number.h"
#include "scene/edge_grid.h"
#include "scene/light.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HAS_NORMALS = 1, HAS_UVS = 2, IS_CUT = 4, HAS_OWN_CLIP = 8, IS_MIRRORED = 16 };

struct subject {
	uint8_t flags;
	float transform[16];
	struct sm_light_desc light;
	struct fin_params params; /* of its own */
	float origin[4];          /* of its own */
};

/* Exactly as much memory as is described, so that a sanitizer sees any read beyond. */
static float *take_array(struct numbers *numbers, size_t count)
{
	float *values = malloc(count * sizeof(*values));
	expect(values != NULL || count == 0);
	take_floats(numbers, values, count);
	return values;
}

static struct fin_law take_law(struct numbers *numbers)
{
	uint8_t kind = take_byte(numbers) % 3;
	float scale = take_float(numbers), near = take_float(numbers);
	if (kind == 0)
		return fin_law_constant(scale);
	return kind == 1 ? fin_law_perspective(scale, near, 3.0f * near) : fin_law_parallel(scale);
}

static void read_subject(struct numbers *numbers, struct subject *subject)
{
	*subject = (struct subject){.flags = take_byte(numbers)};
	struct sm_light_desc *light = &subject->light;
	light->type = take_byte(numbers) % 2 ? SM_LIGHT_DIRECTIONAL : SM_LIGHT_SPOT;
	take_floats(numbers, light->position, 3);
	take_floats(numbers, light->target, 3);
	light->radius = take_float(numbers);
	light->angle = 60.0f + 8.0f * take_float(numbers);
	for (int column = 0; column < 4; column++)
		take_floats(numbers, &subject->transform[4 * column], 3);
	subject->transform[15] = 1.0f;

	struct fin_params *params = &subject->params;
	params->law = take_law(numbers);
	params->finest = fmaxf(take_float(numbers), 0.0f);
	params->mirrored = subject->flags & IS_MIRRORED;
	if (subject->flags & HAS_OWN_CLIP) {
		take_floats(numbers, params->object_to_clip, 16);
		take_floats(numbers, subject->origin, 4);
	}
}

static bool add_mesh(struct numbers *numbers, uint8_t flags, struct sm_scene *scene)
{
	size_t vertex_count = take_byte(numbers), index_count = 3 * (size_t)take_byte(numbers);
	index_count += (flags & IS_CUT) != 0;
	float *positions = take_array(numbers, 3 * vertex_count);
	float *normals = flags & HAS_NORMALS ? take_array(numbers, 3 * vertex_count) : NULL;
	float *uvs = flags & HAS_UVS ? take_array(numbers, 2 * vertex_count) : NULL;
	uint32_t *indices = malloc(index_count * sizeof(*indices));
	expect(indices != NULL || index_count == 0);
	for (size_t i = 0; i < index_count; i++)
		indices[i] = take_byte(numbers);
	const struct sm_mesh_desc desc = {
		NULL, positions, normals, uvs, vertex_count, indices, index_count};
	uint32_t mesh;
	struct sm_error error = {0};
	bool added = sm_scene_add_mesh(scene, &desc, &mesh, &error);
	if (!added)
		expect_clear_error(&error);
	free(positions);
	free(normals);
	free(uvs);
	free(indices);
	return added;
}

static void check_mesh(const struct mesh *mesh)
{
	expect_finite(*mesh->positions, 3 * mesh->vertex_count);
	expect_finite(*mesh->uvs, 2 * mesh->vertex_count);
	for (size_t v = 0; v < mesh->vertex_count; v++) {
		const float *n = mesh->normals[v];
		expect(fabsf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0f) < 1e-5f);
	}
	for (size_t i = 0; i < mesh->index_count; i++)
		expect(mesh->indices[i] < mesh->vertex_count);
	for (int axis = 0; axis < 3; axis++)
		expect(mesh->min[axis] <= mesh->max[axis]);
	expect(mesh->stats.triangles == mesh->index_count / 3 + mesh->empty_count);
	expect(mesh->stats.degenerate_triangles + mesh->stats.repeated_triangles <=
		mesh->stats.triangles);
}

static uint64_t *find_facing(const struct caster *caster, const float light[4])
{
	uint64_t *facing = malloc(facing_words(caster) * sizeof(*facing));
	expect(facing != NULL);
	facing_find(caster, light, facing);
	for (size_t t = 0; t < 64 * facing_words(caster); t++)
		expect((facing[t / 64] >> t % 64 & 1) ==
			(t < caster->triangle_count && faces_by_definition(caster, t, light)));
	return facing;
}

/* At each vertex as many edges end as start. */
static void check_loops(
	const struct caster *caster, const struct silhouette_edge *edges, size_t count)
{
	int *balance = calloc(caster->vertex_count, sizeof(*balance));
	expect(balance != NULL);
	for (size_t e = 0; e < count; e++) {
		expect(edges[e].a < caster->vertex_count && edges[e].b < caster->vertex_count);
		balance[edges[e].a]++;
		balance[edges[e].b]--;
	}
	for (size_t v = 0; v < caster->vertex_count; v++)
		expect(balance[v] == 0);
	free(balance);
}

static void check_quad(const struct fin_vertex quad[4], const struct fin_params *params)
{
	static const uint8_t sides[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
	struct screen_point corners[4];
	struct screen_grid grid;
	float widest = 0.0f;
	for (int i = 0; i < 4; i++) {
		expect_finite(quad[i].position, 3);
		expect_finite(quad[i].offset, 2);
		expect(isfinite(quad[i].width) && (quad[i].width >= 0.0f || params->both_sides));
		expect(fabsf(quad[i].position[2]) <= 1.0f);
		widest = fmaxf(widest, fabsf(quad[i].width));
		corners[i] = (struct screen_point){quad[i].position[0], quad[i].position[1]};
	}
	expect(widest > 0.0f || params->law.drawn_far > params->law.width_far);
	screen_grid_clear(&grid);
	screen_grid_add(&grid, corners, sides, 4, 0.0f);
	for (int i = 0; i < 4; i++)
		expect(fabsf(corners[i].x) > 0.999f || fabsf(corners[i].y) > 0.999f ||
			screen_grid_touches(&grid, quad[i].position, quad[i].position));
}

static void check_fins(const struct caster *caster, const struct silhouette_edge *edges,
	size_t edge_count, const struct fin_params *params)
{
	struct fin_scratch scratch;
	fin_scratch_init(&scratch);
	expect(fin_scratch_reserve(&scratch, caster, edge_count));
	size_t count = fins_build(caster, edges, edge_count, params, &scratch, NULL, 0);
	struct fin *fins = malloc(count * sizeof(*fins));
	struct fin_vertex quads[FIN_VERTICES_MAX];
	expect(count <= fins_max(edge_count));
	expect(fins != NULL || count == 0);
	expect(fins_build(caster, edges, edge_count, params, &scratch, fins, count) == count);
	for (size_t i = 0; i < count; i++) {
		size_t vertices = fin_expand(&fins[i], &params->law, params->both_sides, quads);
		expect(vertices == 4 * fin_quads(&fins[i], params->both_sides));
		for (size_t first = 0; first < vertices; first += 4)
			check_quad(quads + first, params);
	}
	for (size_t v = 0; v < scratch.vertex_capacity; v++)
		expect(scratch.first[v] == UINT32_MAX);
	free(fins);
	fin_scratch_finish(&scratch);
}

/* Closed parts first, and whichever triangles count on one side, sheets have closed rims. */
static void check_sheets(const struct caster *caster, const float light[4], const uint64_t *facing)
{
	size_t closed = caster->found.closed_count, rules[2] = {0, closed};
	uint64_t *back = malloc(facing_words(caster) * sizeof(*back));
	expect(back != NULL && closed <= caster->triangle_count);
	expect(caster->found.turned <= caster->triangle_count);
	for (int i = 0; i < 2; i++) {
		struct sheet_rule rule = {.one_sided = rules[i]};
		size_t count = sheets_find(caster, &rule, light, facing, back, NULL, 0);
		struct silhouette_edge *edges = malloc(count * sizeof(*edges));
		expect(count <= 2 * edge_table_records(&caster->edges));
		expect(edges != NULL || count == 0);
		expect(sheets_find(caster, &rule, light, facing, back, edges, count) == count);
		check_loops(caster, edges, count);
		free(edges);
	}
	free(back);
}

/* What is passed over changes nothing. */
static void check_all(const struct caster *caster, const float light[4], const uint64_t *facing,
	const struct silhouette_edge *edges, size_t count)
{
	uint64_t *facing_all = malloc(facing_words(caster) * sizeof(*facing_all));
	struct silhouette_edge *edges_all = malloc(count * sizeof(*edges_all));
	expect(facing_all != NULL && (edges_all != NULL || count == 0));
	facing_find_all(caster, light, facing_all);
	expect(memcmp(facing, facing_all, facing_words(caster) * sizeof(*facing)) == 0);
	expect(silhouette_find_all(caster, facing, edges_all, count) == count);
	expect(count == 0 || memcmp(edges, edges_all, count * sizeof(*edges)) == 0);
	free(facing_all);
	free(edges_all);
}

static void check_shadow(
	const struct caster *caster, const float light[4], const struct fin_params *params)
{
	uint64_t *facing = find_facing(caster, light);
	size_t count = silhouette_find(caster, facing, NULL, 0);
	struct silhouette_edge *edges = malloc(count * sizeof(*edges));
	expect(count <= edge_table_records(&caster->edges) && (edges != NULL || count == 0));
	expect(silhouette_find(caster, facing, edges, count) == count);
	check_all(caster, light, facing, edges, count);
	check_loops(caster, edges, count);
	check_sheets(caster, light, facing);
	struct fin_params two_sided = *params;
	two_sided.both_sides = true;
	fin_law_add_apron(&two_sided.law, 4.0f * params->finest);
	check_fins(caster, edges, count, params);
	check_fins(caster, edges, count, &two_sided);
	free(facing);
	free(edges);
}

/* Puts an object and a light into the scene; false if they were refused. */
static bool place(struct sm_scene *scene, const struct subject *subject)
{
	struct sm_object_desc object = {.image = SM_NONE, .casts = true, .receives = true};
	memcpy(object.transform, subject->transform, sizeof(object.transform));
	uint32_t handle;
	struct sm_error error = {0};
	bool placed = sm_scene_add_object(scene, &object, &handle, &error) &&
		      sm_scene_add_light(scene, &subject->light, &handle, &error);
	if (!placed)
		expect_clear_error(&error);
	return placed;
}

/* Products of two lengths are floats up to here; a stage has nothing farther away. */
static bool is_moderate(const struct sm_scene *scene)
{
	const struct sm_light_desc *light = &scene->lights[0].desc;
	const float *const points[] = {
		scene->objects[0].min, scene->objects[0].max, light->position, light->target};
	for (int i = 0; i < 4; i++)
		for (int axis = 0; axis < 3; axis++)
			if (!(fabsf(points[i][axis]) <= 1e15f))
				return false;
	return light->radius <= 1e15f;
}

static void check_frame(const struct light_frame *frame, const struct sm_scene *scene)
{
	if (!is_moderate(scene))
		return;
	expect_finite(*frame->world_to_clip, 16);
	expect_finite(*frame->world_to_light, 16);
	expect_finite(frame->origin, 4);
	expect(frame->near < frame->far && isfinite(frame->far));
	expect(frame->half_extent > 0.0f && isfinite(frame->half_extent));
	expect(frame->disc >= 0.0f && isfinite(frame->disc));
	expect(frame->near_to_far > 0.0f && frame->near_to_far <= 1.0f);
	expect(frame->pole >= 1.0f && isfinite(frame->pole));
}

/* Finite edges, and nothing before what the list says. */
static void check_stretch(const struct edge_stretch *stretch, float start)
{
	expect(stretch->edges >= 1);
	for (uint32_t i = 0; i <= stretch->edges; i++) {
		const struct edge_vertex *at = &stretch->vertices[i];
		expect(isfinite(at->x) && isfinite(at->y) && isfinite(at->depth));
		expect(at->depth >= start);
	}
}

static void check_list(const struct edge_grid *grid, const struct edge_tile *tile)
{
	float start = tile->nearest;
	for (uint32_t i = 0; i < edge_tile_stretches(grid, tile); i++) {
		struct edge_stretch stretch = edge_tile_stretch(grid, tile, i);
		expect(stretch.vertices + stretch.edges < grid->vertices + grid->vertex_count);
		const struct edge_run *run = &grid->runs[grid->lists.first[tile - grid->of] + i];
		expect(stretch.edges <= EDGE_RUN_MAX && run->start >= start);
		start = run->start;
		check_stretch(&stretch, start);
	}
	for (uint32_t k = 1; grid->whole && k < edge_tile_count(tile); k++)
		expect(edge_texel_nearest(&grid->texels[edge_tile_first(tile) + k - 1]) <=
			edge_texel_nearest(&grid->texels[edge_tile_first(tile) + k]));
}

static void check_edge_grid(const struct edge_grid *grid, const struct edge_room *room)
{
	size_t sum = 0, hollows = 0, count = grid->whole ? grid->hollow_base : grid->run_count;
	expect(grid->run_count <= room->runs && grid->vertex_count <= room->vertices);
	expect(!grid->whole || grid->texel_count <= room->copies);
	expect(grid->tiles >= 32 && grid->tiles <= EDGE_GRID_TILES_MAX);
	for (size_t t = 0; t < (size_t)grid->tiles * grid->tiles; t++) {
		const struct edge_tile *tile = &grid->of[t];
		expect(isfinite(tile->farthest) && isfinite(tile->nearest));
		expect(edge_tile_count(tile) > 0 || tile->nearest == 2.0f);
		expect(edge_tile_hollows(tile) <= HOLLOWS_MAX);
		expect(edge_tile_hollows(tile) == 0 || edge_tile_first_hollow(tile) == hollows);
		hollows += edge_tile_hollows(tile);
		if (edge_tile_count(tile) == 0)
			continue;
		expect(edge_tile_first(tile) == sum);
		sum += edge_tile_count(tile);
		expect(sum <= count);
		check_list(grid, tile);
	}
	expect(sum == count && hollows == grid->hollows.count);
	expect(grid->hollow_base + HOLLOW_TEXELS * hollows == grid->texel_count);
}

/* With room for all, and for few; as finely as Mesa's drivers draw, and as coarsely as may be. */
static void check_edges(const struct sm_scene *scene)
{
	const struct edge_grid_options options[] = {
		{.tiles = 128,
			.map_size = 512,
			.subpixel_bits = 8,
			.room = {100000, 100000, 100000}},
		{.tiles = 64,
			.map_size = 3,
			.subpixel_bits = 1,
			.finer_bits = edge_finer_bits(1),
			.room = {100, 100, 100}},
	};
	struct light_frame frame;
	struct edge_grid grid = {0};
	if (!is_moderate(scene))
		return;
	light_frame_fit(&frame, &scene->lights[0].desc, scene);
	check_frame(&frame, scene);
	for (size_t i = 0; i < sizeof(options) / sizeof(options[0]); i++) {
		expect(edge_grid_find(&grid, scene, &frame, &options[i]) &&
			edge_grid_find_stretches(&grid));
		check_edge_grid(&grid, &options[i].room);
	}
	edge_grid_finish(&grid);
}

/* As the light of the scene sees the object. */
static void see(const struct sm_scene *scene, struct fin_params *params, float origin[4])
{
	struct light_frame frame;
	mat4 to_clip, to_object;
	vec4 *transform = (vec4 *)scene->objects[0].transform;
	light_frame_init(&frame, &scene->lights[0].desc, scene);
	check_frame(&frame, scene);
	glm_mat4_mul(frame.world_to_clip, transform, to_clip);
	memcpy(params->object_to_clip, to_clip, sizeof(to_clip));
	glm_mat4_inv(transform, to_object);
	glm_mat4_mulv(to_object, frame.origin, origin);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct numbers numbers = {data, size};
	struct subject subject;
	struct sm_scene *scene = sm_scene_create();
	expect(scene != NULL);
	read_subject(&numbers, &subject);
	if (add_mesh(&numbers, subject.flags, scene)) {
		const struct mesh *mesh = &scene->meshes[0];
		check_mesh(mesh);
		bool seen = subject.flags & HAS_OWN_CLIP || place(scene, &subject);
		if (seen && !(subject.flags & HAS_OWN_CLIP)) {
			see(scene, &subject.params, subject.origin);
			check_edges(scene);
		}
		if (seen)
			check_shadow(&mesh->caster, subject.origin, &subject.params);
	}
	sm_scene_destroy(scene);
	return 0;
}
