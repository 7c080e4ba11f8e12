/* SPDX-License-Identifier: MIT */
#include "geom/sheets.h"
#include "capacity.h"
#include "changes.h"
#include "geom/mesh.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A caster as a light sees it, and what its sheets are found with. */
struct subject {
	struct mesh mesh;
	float light[4];
	double axes[3][3];   /* right, up, towards the light */
	double (*screen)[2]; /* [vertex_count] */
	bool mirrored;       /* the screen */
	uint64_t *facing, *back;
	struct silhouette_edge *edges; /* [capacity] */
	size_t capacity;
};

static struct subject subject_of(const struct model *model)
{
	struct subject s = {0};
	struct sm_mesh_desc desc = model_desc(model, "subject");
	assert_true(mesh_init(&s.mesh, &desc, NULL));
	const struct caster *caster = &s.mesh.caster;
	s.capacity = 2 * edge_table_records(&caster->edges);
	s.screen = malloc(caster->vertex_count * sizeof(*s.screen));
	s.facing = malloc(facing_words(caster) * sizeof(*s.facing));
	s.back = malloc(facing_words(caster) * sizeof(*s.back));
	s.edges = malloc(s.capacity * sizeof(*s.edges) + 1);
	assert_true(s.screen && s.facing && s.back && s.edges);
	return s;
}

static void subject_finish(struct subject *s)
{
	mesh_finish(&s->mesh);
	free(s->screen);
	free(s->facing);
	free(s->back);
	free(s->edges);
}

static void cross(const double a[3], const double b[3], double c[3])
{
	for (int i = 0; i < 3; i++)
		c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalise(double v[3])
{
	double length = sqrt(dot(v, v));
	assert_true(length > 0.0);
	for (int i = 0; i < 3; i++)
		v[i] /= length;
}

/* A direction, or a point at three radii from the mesh's centre. */
static void place_light(struct subject *s, uint64_t *state, bool directional)
{
	const struct face_planes *planes = &s->mesh.caster.planes;
	double *towards = s->axes[2];
	for (int i = 0; i < 3; i++)
		towards[i] = random_signed(state) + 0.01;
	normalise(towards);
	for (int i = 0; i < 3; i++)
		s->light[i] =
			directional
				? (float)towards[i]
				: (float)(planes->center[i] + 3.0 * planes->radius * towards[i]);
	s->light[3] = directional ? 0.0f : 1.0f;
	for (int i = 0; i < 3 && directional; i++)
		towards[i] = s->light[i];
	const double any[3] = {fabs(towards[0]) < 0.5, fabs(towards[0]) >= 0.5, 0.3};
	cross(any, towards, s->axes[0]);
	normalise(s->axes[0]);
	cross(towards, s->axes[0], s->axes[1]);
	s->mirrored = random_next(state) % 2 == 0;
}

/* Across the mesh from -1 to 1, or less. */
static void project(struct subject *s)
{
	const struct caster *caster = &s->mesh.caster;
	for (size_t v = 0; v < caster->vertex_count; v++) {
		double p[3];
		for (int i = 0; i < 3; i++)
			p[i] = caster->positions[v][i] - (s->light[3] == 0.0f
									 ? caster->planes.center[i]
									 : (double)s->light[i]);
		double depth = s->light[3] == 0.0f ? caster->planes.radius : -dot(p, s->axes[2]);
		s->screen[v][0] = dot(p, s->axes[0]) / depth * (s->mirrored ? -1.0 : 1.0);
		s->screen[v][1] = dot(p, s->axes[1]) / depth;
	}
}

/* How an edge counts for the winding number around q: crossings of the ray from q to the right. The
 * same, but for its sign, when the edge is reversed. */
static int crossing(const struct subject *s, uint32_t a, uint32_t b, const double q[2])
{
	if (a > b)
		return -crossing(s, b, a, q);
	const double *p0 = s->screen[a], *p1 = s->screen[b];
	if ((p0[1] <= q[1]) == (p1[1] <= q[1]))
		return 0;
	double x = p0[0] + (q[1] - p0[1]) / (p1[1] - p0[1]) * (p1[0] - p0[0]);
	return x <= q[0] ? 0 : p1[1] > p0[1] ? 1 : -1;
}

struct sheets {
	int counted, there;
};

/* One triangle after the other. */
static struct sheets sheets_over(
	const struct subject *s, const struct sheet_rule *rule, const double q[2])
{
	const struct caster *caster = &s->mesh.caster;
	struct sheets sheets = {0};
	for (size_t t = 0; t < caster->triangle_count; t++) {
		const uint32_t *v = &caster->indices[3 * t];
		int turns = crossing(s, v[0], v[1], q) + crossing(s, v[1], v[2], q) +
			    crossing(s, v[2], v[0], q);
		bool faces = s->mirrored ? turns < 0 : turns > 0;
		sheets.there += turns != 0;
		sheets.counted += turns != 0 && (faces || t >= rule->one_sided);
	}
	return sheets;
}

static int winding_around(const struct subject *s, size_t edge_count, const double q[2])
{
	int winding = 0;
	for (size_t e = 0; e < edge_count; e++)
		winding += crossing(s, s->edges[e].a, s->edges[e].b, q);
	return winding;
}

/* No sheet is missed, and none is counted that is not there. */
static void check_light(struct subject *s, uint64_t *state, size_t one_sided)
{
	const struct caster *caster = &s->mesh.caster;
	const struct sheet_rule rule = {one_sided, s->mirrored};
	facing_find(caster, s->light, s->facing);
	size_t count =
		sheets_find(caster, &rule, s->light, s->facing, s->back, s->edges, s->capacity);
	assert_true(count <= s->capacity);
	for (int i = 0; i < 40; i++) {
		const double q[2] = {0.4 * random_signed(state), 0.4 * random_signed(state)};
		struct sheets expected = sheets_over(s, &rule, q);
		int winding = winding_around(s, count, q);
		if (winding != expected.counted)
			fail_msg("%d sheets of %d, not %d, at %a %a", winding, expected.there,
				expected.counted, q[0], q[1]);
		assert_true((winding > 0) == (expected.there > 0));
	}
}

static void check_model(const char *name, const struct model *model)
{
	(void)name;
	struct subject s = subject_of(model);
	uint64_t state = 3;
	int lights = s.mesh.caster.triangle_count > 100000 ? 2 : 6;
	for (int i = 0; i < lights; i++) {
		place_light(&s, &state, i % 2 == 0);
		project(&s);
		check_light(&s, &state, s.mesh.caster.found.closed_count);
		check_light(&s, &state, 0);
	}
	subject_finish(&s);
}

static void windings_are_sheets(void **state)
{
	(void)state;
	models_visit(SMOOTHIE_SHARED, check_model);
}

static struct model some_turned(struct model model, uint64_t *state)
{
	for (size_t t = 0; t < model.index_count / 3; t++) {
		struct model one = {.indices = &model.indices[3 * t], .index_count = 3};
		if (random_next(state) % 3 == 0)
			model_inverted(one);
	}
	return model;
}

static void whatever_the_winding_of_triangles(void **state)
{
	(void)state;
	uint64_t random = 9;
	for (int i = 0; i < 20; i++) {
		struct model models[] = {
			model_sphere(3),
			model_torus(),
			model_opened(model_sphere(2)),
			model_joined(model_torus(), model_opened(model_cube())),
			model_joined(model_cube(), model_scaled(model_cube(), 0.5f)),
			model_moebius(),
			model_doubled(true),
		};
		for (size_t m = 0; m < sizeof(models) / sizeof(models[0]); m++) {
			models[m] = some_turned(models[m], &random);
			check_model("turned", &models[m]);
			model_finish(&models[m]);
		}
	}
}

static size_t edges_of(struct model model, const float light[4], struct sheet_rule rule)
{
	struct subject s = subject_of(&model);
	facing_find(&s.mesh.caster, light, s.facing);
	size_t count =
		sheets_find(&s.mesh.caster, &rule, light, s.facing, s.back, s.edges, s.capacity);
	subject_finish(&s);
	model_finish(&model);
	return count;
}

static void counts_edges(void **state)
{
	(void)state;
	const float above[4] = {0.1f, 0.2f, 9, 1}, below[4] = {0.1f, 0.2f, -9, 1};
	const struct sheet_rule closed = {.one_sided = 12}, open = {0};
	assert_int_equal(edges_of(model_cube(), above, closed), 4);
	assert_int_equal(edges_of(model_cube(), above, open), 8);
	assert_int_equal(edges_of(model_grid(5), above, open), 20);
	assert_int_equal(edges_of(model_grid(5), below, open), 20);
}

/* Of a cube that is seen from straight above the front and the back are left, each with its own
 * corners. */
static void what_is_edge_on_is_no_sheet(void **state)
{
	(void)state;
	struct model model = model_cube();
	struct subject s = subject_of(&model);
	const struct caster *caster = &s.mesh.caster;
	const struct sheet_rule open = {0};
	const float light[4] = {0, 0, 1, 0};
	int edges_from[8] = {0};
	facing_find(caster, light, s.facing);
	size_t count = sheets_find(caster, &open, light, s.facing, s.back, s.edges, s.capacity);
	assert_int_equal(count, 8);
	assert_int_equal(caster->vertex_count, 8);
	for (size_t i = 0; i < count; i++)
		assert_int_equal(edges_from[s.edges[i].a]++, 0);
	subject_finish(&s);
	model_finish(&model);
}

static size_t find_in_a_mirror(void *data, struct silhouette_edge *edges, size_t capacity)
{
	struct subject *s = data;
	const struct sheet_rule rule = {.mirrored = true};
	return sheets_find(&s->mesh.caster, &rule, s->light, s->facing, s->back, edges, capacity);
}

static void writes_no_more_than_capacity(void **state)
{
	(void)state;
	struct model model = model_opened(model_sphere(3));
	struct subject s = subject_of(&model);
	memcpy(s.light, (const float[4]){0.3f, 0.1f, 1, 0}, sizeof(s.light));
	facing_find(&s.mesh.caster, s.light, s.facing);
	size_t needed = find_in_a_mirror(&s, NULL, 0);
	assert_true(needed > 20 && needed <= s.capacity);
	check_capacity(find_in_a_mirror, &s, needed, 3);
	subject_finish(&s);
	model_finish(&model);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(windings_are_sheets),
		cmocka_unit_test(whatever_the_winding_of_triangles),
		cmocka_unit_test(counts_edges),
		cmocka_unit_test(what_is_edge_on_is_no_sheet),
		cmocka_unit_test(writes_no_more_than_capacity),
	};
	return cmocka_run_group_tests_name("sheets", tests, NULL, NULL);
}
