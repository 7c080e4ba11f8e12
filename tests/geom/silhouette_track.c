/* SPDX-License-Identifier: MIT */
#include "geom/silhouette_track.h"
#include "geom/mesh.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct mesh mesh_of(const struct model *model)
{
	struct mesh mesh;
	struct sm_mesh_desc desc = model_desc(model, "track");
	assert_true(mesh_init(&mesh, &desc, NULL));
	return mesh;
}

/* The track is what a search finds that passes nothing over and keeps nothing. */
static void check_found(
	const struct silhouette_track *track, const struct caster *caster, const float light[4])
{
	size_t words = facing_words(caster), capacity = edge_table_records(&caster->edges);
	uint64_t *facing = malloc(words * sizeof(*facing));
	struct silhouette_edge *edges = malloc(capacity * sizeof(*edges) + 1);
	assert_true(facing != NULL && edges != NULL);
	facing_find_all(caster, light, facing);
	assert_memory_equal(track->facing.facing, facing, words * sizeof(*facing));
	size_t count = silhouette_find_all(caster, facing, edges, capacity);
	assert_int_equal(track->edge_count, count);
	if (count > 0)
		assert_memory_equal(track->edges, edges, count * sizeof(*edges));
	free(facing);
	free(edges);
}

static void check_shared(struct silhouette_track *track, const struct caster *caster,
	const float light[4], struct workers *workers)
{
	assert_true(silhouette_track(track, caster, light, workers));
	assert_true(track->tested <= facing_words(caster));
	check_found(track, caster, light);
}

static void check_track(
	struct silhouette_track *track, const struct caster *caster, const float light[4])
{
	check_shared(track, caster, light, NULL);
}

/* Each triangle is tested, where it can be told at all. */
static void check_all(
	struct silhouette_track *track, const struct caster *caster, const float light[4])
{
	bool finite = isfinite(light[0]) && isfinite(light[1]) && isfinite(light[2]) &&
		      isfinite(light[3]);
	assert_true(silhouette_track_all(track, caster, light));
	assert_int_equal(track->tested, finite ? facing_words(caster) : 0);
	assert_int_equal(track->searched, facing_words(caster));
	check_found(track, caster, light);
}

/* Anywhere around the caster, or one of its vertices. */
static void jump(uint64_t *state, const struct caster *caster, float light[4])
{
	const struct face_planes *planes = &caster->planes;
	for (int i = 0; i < 3; i++)
		light[i] = (float)(planes->center[i] + 2.0 * planes->radius * random_signed(state));
	if (random_next(state) % 4 == 0)
		memcpy(light, caster->positions[random_next(state) % caster->vertex_count],
			sizeof(float[3]));
	light[3] = 1.0f;
}

/* By a step, mostly; else by a jump, or to a light of another kind. */
static void move_light(uint64_t *state, const struct caster *caster, float light[4])
{
	const float kinds[] = {1.0f, 0.0f, -1.0f, 0.5f, NAN, INFINITY};
	double step = ldexp(caster->planes.radius, -(int)(random_next(state) % 24));
	unsigned what = random_next(state) % 32;
	if (what == 0 || !isfinite(light[0]))
		jump(state, caster, light);
	else if (what == 1)
		light[3] = kinds[random_next(state) % 6];
	else if (what == 2)
		light[random_next(state) % 3] = NAN;
	else if (what > 3)
		for (int i = 0; i < 3; i++)
			light[i] += (float)(step * random_signed(state));
}

static void check_walk(const char *name, const struct model *model)
{
	(void)name;
	struct mesh mesh = mesh_of(model);
	struct silhouette_track track = {0};
	uint64_t state = 5;
	float light[4];
	size_t rounds = 8 + 2000000 / mesh.caster.triangle_count;
	jump(&state, &mesh.caster, light);
	for (size_t i = 0; i < rounds && i < 600; i++) {
		if (random_next(&state) % 8 == 0)
			check_all(&track, &mesh.caster, light);
		else
			check_track(&track, &mesh.caster, light);
		move_light(&state, &mesh.caster, light);
	}
	silhouette_track_finish(&track);
	mesh_finish(&mesh);
}

static void equals_a_search_of_all(void **state)
{
	(void)state;
	models_visit(SMOOTHIE_SHARED, check_walk);
}

static void holds_at_any_scale_and_place(void **state)
{
	(void)state;
	models_visit_extremes(check_walk);
}

/* A track goes from one caster to another, and knows one that has moved. */
static void forgets_other_casters(void **state)
{
	(void)state;
	struct model sphere = model_sphere(5), grid = model_grid(40);
	struct mesh meshes[3] = {mesh_of(&sphere), mesh_of(&grid), mesh_of(&sphere)};
	struct silhouette_track track = {0};
	const float light[4] = {0.5f, 0.25f, 3, 1};
	for (int i = 0; i < 12; i++) {
		struct mesh *mesh = &meshes[i % 3];
		check_track(&track, &mesh->caster, light);
		for (size_t v = 0; v < mesh->vertex_count; v++)
			mesh->positions[v][2] += 0.125f * mesh->positions[v][i % 2];
		assert_true(caster_let_move(&mesh->caster));
		caster_move(&mesh->caster, (const float(*)[3])mesh->positions);
		check_track(&track, &mesh->caster, light);
	}
	silhouette_track_finish(&track);
	for (int i = 0; i < 3; i++)
		mesh_finish(&meshes[i]);
	model_finish(&sphere);
	model_finish(&grid);
}

static void small_steps_leave_most_blocks_alone(void **state)
{
	(void)state;
	struct model model = model_sphere(7);
	struct mesh mesh = mesh_of(&model);
	struct silhouette_track track = {0};
	size_t blocks = facing_words(&mesh.caster), tested = 0, searched = 0;
	for (int i = 0; i < 50; i++) {
		float angle = 0.002f * (float)i,
		      light[4] = {3 * cosf(angle), 2, 3 * sinf(angle), 1};
		check_track(&track, &mesh.caster, light);
		tested += track.tested;
		searched += track.searched;
	}
	assert_true(tested > 0 && tested < blocks * 50 / 10);
	assert_true(searched >= track.edge_count / EDGE_BLOCK && searched < blocks * 50 / 10);
	check_track(&track, &mesh.caster, track.facing.light);
	assert_int_equal(track.searched, 0);
	silhouette_track_finish(&track);
	mesh_finish(&mesh);
	model_finish(&model);
}

/* A track goes from so many threads to as many others. */
static void is_the_same_whoever_works(void **state)
{
	(void)state;
	struct model model = model_sphere(8);
	struct mesh mesh = mesh_of(&model);
	struct silhouette_track track = {0};
	uint64_t random = 17;
	float light[4];
	assert_true(mesh.caster.triangle_count >= TRACK_SHARED_MIN);
	jump(&random, &mesh.caster, light);
	for (unsigned i = 0; i < 32; i++) {
		struct workers workers = {.most = 1 + i / 2 % 4};
		check_shared(&track, &mesh.caster, light, &workers);
		workers_finish(&workers);
		if (i % 8 == 7)
			jump(&random, &mesh.caster, light);
		else
			light[i % 3] += 0.002f * (float)i;
	}
	silhouette_track_finish(&track);
	mesh_finish(&mesh);
	model_finish(&model);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(equals_a_search_of_all),
		cmocka_unit_test(holds_at_any_scale_and_place),
		cmocka_unit_test(forgets_other_casters),
		cmocka_unit_test(is_the_same_whoever_works),
		cmocka_unit_test(small_steps_leave_most_blocks_alone),
	};
	return cmocka_run_group_tests_name("silhouette_track", tests, NULL, NULL);
}
