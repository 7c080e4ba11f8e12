/* SPDX-License-Identifier: MIT */
#include "geom/averted.h"
#include "geom/mesh.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SLACK 1e-4f
#define STEPS 6

/* A mesh, and what is found of it for one light. */
struct world {
	struct mesh mesh;
	float *rises;
	uint8_t *averted;
	uint32_t *away, *rest;
	size_t away_count; /* indices */
};

/* Normals as far from the triangles' own as no shading has them. */
static void tilt_normals(struct mesh *mesh, float most)
{
	uint64_t random = 7;
	for (size_t i = 0; i < mesh->vertex_count; i++) {
		float *n = mesh->normals[i], square = 0.0f;
		for (int axis = 0; axis < 3; axis++) {
			n[axis] += most * random_signed(&random);
			square += n[axis] * n[axis];
		}
		for (int axis = 0; axis < 3; axis++)
			n[axis] /= sqrtf(square);
	}
}

static void make(struct world *world, struct model model, float tilt)
{
	struct sm_mesh_desc desc = model_desc(&model, "averted");
	assert_true(mesh_init(&world->mesh, &desc, NULL));
	model_finish(&model);
	const struct mesh *mesh = &world->mesh;
	tilt_normals(&world->mesh, tilt);
	world->rises = calloc(mesh->vertex_count, sizeof(*world->rises));
	world->averted = calloc(mesh->vertex_count, sizeof(*world->averted));
	world->away = calloc(mesh->index_count, sizeof(*world->away));
	world->rest = calloc(mesh->index_count, sizeof(*world->rest));
	assert_true(world->rises && world->averted && world->away && world->rest);
	averted_rises((const float(*)[3])mesh->positions, (const float(*)[3])mesh->normals,
		mesh->vertex_count, mesh->indices, mesh->index_count / 3, world->rises);
}

static void finish(struct world *world)
{
	mesh_finish(&world->mesh);
	free(world->rises);
	free(world->averted);
	free(world->away);
	free(world->rest);
}

static void find(struct world *world, const float light[4])
{
	const struct mesh *mesh = &world->mesh;
	averted_vertices((const float(*)[3])mesh->positions, (const float(*)[3])mesh->normals,
		world->rises, mesh->vertex_count, light, SLACK, world->averted);
	world->away_count = averted_split(
		mesh->indices, mesh->index_count, world->averted, world->away, world->rest);
}

/* Of the interpolated normal and the way to the light: above 0 where light arrives. */
static double facing(const struct mesh *mesh, const uint32_t *triangle, const double weights[3],
	const float light[4])
{
	double normal[3] = {0}, path[3], sum = 0;
	for (int axis = 0; axis < 3; axis++) {
		double place = 0;
		for (int i = 0; i < 3; i++) {
			normal[axis] += weights[i] * mesh->normals[triangle[i]][axis];
			place += weights[i] * mesh->positions[triangle[i]][axis];
		}
		path[axis] = light[axis] - light[3] * place;
		sum += normal[axis] * path[axis];
	}
	return sum;
}

static void check_away(const struct world *world, const float light[4])
{
	for (size_t t = 0; t < world->away_count; t += 3)
		for (int i = 0; i <= STEPS; i++)
			for (int j = 0; i + j <= STEPS; j++) {
				const double weights[3] = {i / (double)STEPS, j / (double)STEPS,
					(STEPS - i - j) / (double)STEPS};
				assert_true(
					facing(&world->mesh, &world->away[t], weights, light) < 0);
			}
}

/* Both lists together are the mesh, and each is in its order. */
static void check_split(const struct world *world)
{
	const struct mesh *mesh = &world->mesh;
	size_t away = 0, rest = 0, triangle = 3 * sizeof(uint32_t);
	for (size_t t = 0; t < mesh->index_count; t += 3) {
		if (away < world->away_count &&
			memcmp(&world->away[away], &mesh->indices[t], triangle) == 0) {
			away += 3;
			continue;
		}
		assert_memory_equal(&world->rest[rest], &mesh->indices[t], triangle);
		rest += 3;
	}
	assert_int_equal(away, world->away_count);
}

static void light_arrives_nowhere_on_what_is_averted(void **state)
{
	(void)state;
	uint64_t random = 1;
	size_t averted = 0;
	const struct model models[] = {
		model_sphere(2), model_sphere(4), model_cube(), model_tetrahedron()};
	for (size_t i = 0; i < sizeof(models) / sizeof(models[0]); i++) {
		struct world world;
		make(&world, models[i], 0.5f);
		for (int round = 0; round < 50; round++) {
			float reach = round % 2 == 0 ? 1.5f : 20.0f;
			const float light[4] = {reach * random_signed(&random),
				reach * random_signed(&random), reach * random_signed(&random),
				round % 5 == 0 ? 0.0f : 1.0f};
			find(&world, light);
			check_split(&world);
			check_away(&world, light);
			averted += world.away_count;
		}
		finish(&world);
	}
	assert_true(averted > 0);
}

static void half_a_sphere_is_averted_from_afar(void **state)
{
	(void)state;
	struct world world;
	make(&world, model_sphere(5), 0.0f);
	const float light[4] = {100.0f, 200.0f, -150.0f, 1.0f};
	find(&world, light);
	assert_in_range(world.away_count, world.mesh.index_count * 9 / 20,
		world.mesh.index_count * 11 / 20);
	finish(&world);
}

static void what_is_within_the_slack_is_not_averted(void **state)
{
	(void)state;
	static const float position[1][3] = {{0}}, rise[1] = {0};
	const float light[4] = {0.0f, 0.0f, 2.0f, 1.0f};
	static const struct {
		float normal[1][3];
		uint8_t averted;
	} cases[] = {
		{{{0.0f, 0.6f, -0.8f}}, 1},
		{{{0.0f, 0.6f, 0.8f}}, 0},
		{{{0.0f, 1.0f, -2.0f * SLACK}}, 1},
		{{{0.0f, 1.0f, -0.5f * SLACK}}, 0},
		{{{0.0f, 0.0f, 0.0f}}, 0},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		uint8_t averted;
		averted_vertices(position, cases[i].normal, rise, 1, light, SLACK, &averted);
		assert_int_equal(averted, cases[i].averted);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(light_arrives_nowhere_on_what_is_averted),
		cmocka_unit_test(half_a_sphere_is_averted_from_afar),
		cmocka_unit_test(what_is_within_the_slack_is_not_averted),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
