/* SPDX-License-Identifier: MIT */
#include "geom/silhouette.h"
#include "capacity.h"
#include "facing.h"
#include "geom/mesh.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static bool has_bit(const uint64_t *words, size_t i)
{
	return words[i / 64] >> i % 64 & 1;
}

/* A caster with room for answers about it. */
struct subject {
	struct mesh mesh;
	uint64_t *facing;
	struct edge_record *records;
	uint64_t *facing_all;
	struct silhouette_edge *edges, *edges_all;
	int *balance; /* of each vertex: edges that start less edges that end */
};

static struct subject subject_of(const struct model *model)
{
	struct subject s;
	struct sm_mesh_desc desc = model_desc(model, "subject");
	assert_true(mesh_init(&s.mesh, &desc, NULL));
	const struct caster *caster = &s.mesh.caster;
	size_t records = edge_table_records(&caster->edges);
	s.facing = malloc(facing_words(caster) * sizeof(*s.facing));
	s.records = malloc(records * sizeof(*s.records) + 1);
	s.facing_all = malloc(facing_words(caster) * sizeof(*s.facing_all));
	s.edges = malloc(records * sizeof(*s.edges) + 1);
	s.edges_all = malloc(records * sizeof(*s.edges_all) + 1);
	s.balance = calloc(caster->vertex_count, sizeof(*s.balance));
	assert_true(s.facing && s.facing_all && s.records && s.edges && s.edges_all && s.balance);
	edge_table_decode(&caster->edges, s.records);
	return s;
}

static void subject_finish(struct subject *s)
{
	mesh_finish(&s->mesh);
	free(s->facing);
	free(s->records);
	free(s->facing_all);
	free(s->edges);
	free(s->edges_all);
	free(s->balance);
}

static void check_facing(struct subject *s, const float light[4])
{
	const struct caster *caster = &s->mesh.caster;
	memset(s->facing, 0xa5, facing_words(caster) * sizeof(*s->facing));
	facing_find(caster, light, s->facing);
	for (size_t t = 0; t < caster->triangle_count; t++)
		if (has_bit(s->facing, t) != faces_by_definition(caster, t, light))
			fail_msg("triangle %zu, light %a %a %a %a", t, light[0], light[1], light[2],
				light[3]);
	for (size_t t = caster->triangle_count; t < 64 * facing_words(caster); t++)
		assert_false(has_bit(s->facing, t));
}

/* The edges are those of the records whose triangles differ, directed as the one that faces. */
static void check_edges(struct subject *s)
{
	const struct caster *caster = &s->mesh.caster;
	size_t capacity = edge_table_records(&caster->edges);
	size_t count = silhouette_find(caster, s->facing, s->edges, capacity);
	size_t found = 0;
	for (size_t i = 0; i < capacity; i++) {
		size_t corner = s->records[i].corner;
		bool own = has_bit(s->facing, corner / 3);
		bool across = s->records[i].neighbour != EDGE_OPEN &&
			      has_bit(s->facing, s->records[i].neighbour);
		if (own == across)
			continue;
		assert_true(found < count);
		const uint32_t *v = &caster->indices[corner - corner % 3];
		uint32_t from = v[corner % 3], to = v[(corner + 1) % 3];
		assert_int_equal(s->edges[found].a, own ? from : to);
		assert_int_equal(s->edges[found].b, own ? to : from);
		found++;
	}
	assert_int_equal(found, count);
}

/* Whatever is passed over changes nothing. */
static void check_skips(struct subject *s, const float light[4])
{
	const struct caster *caster = &s->mesh.caster;
	size_t words = facing_words(caster), capacity = edge_table_records(&caster->edges);
	memset(s->facing_all, 0x5a, words * sizeof(*s->facing_all));
	facing_find_all(caster, light, s->facing_all);
	assert_memory_equal(s->facing, s->facing_all, words * sizeof(*s->facing));
	size_t count = silhouette_find(caster, s->facing, s->edges, capacity);
	assert_int_equal(silhouette_find_all(caster, s->facing, s->edges_all, capacity), count);
	assert_memory_equal(s->edges, s->edges_all, count * sizeof(*s->edges));
}

static void check_loops(struct subject *s)
{
	const struct caster *caster = &s->mesh.caster;
	size_t count =
		silhouette_find(caster, s->facing, s->edges, edge_table_records(&caster->edges));
	for (size_t e = 0; e < count; e++) {
		s->balance[s->edges[e].a]++;
		s->balance[s->edges[e].b]--;
	}
	for (size_t e = 0; e < count; e++) {
		assert_int_equal(s->balance[s->edges[e].a], 0);
		assert_int_equal(s->balance[s->edges[e].b], 0);
	}
}

static void random_point(uint64_t *state, const struct subject *s, double reach, float point[4])
{
	const struct face_planes *planes = &s->mesh.caster.planes;
	for (int i = 0; i < 3; i++)
		point[i] =
			(float)(planes->center[i] + reach * planes->radius * random_signed(state));
	point[3] = 1.0f;
}

/* In the plane of some triangle, but for rounding; or, of the directions, along it. */
static void point_in_plane(uint64_t *state, const struct subject *s, float w, float point[4])
{
	const struct caster *caster = &s->mesh.caster;
	const uint32_t *v = &caster->indices[3 * (random_next(state) % caster->triangle_count)];
	float a = 3.0f * random_signed(state), b = 3.0f * random_signed(state);
	for (int i = 0; i < 3; i++) {
		float p = caster->positions[v[0]][i];
		float q = caster->positions[v[1]][i], r = caster->positions[v[2]][i];
		point[i] = w * p + a * (q - p) + b * (r - p);
	}
	point[3] = w;
}

/* Just before or behind the tips of a block's cones. */
static void point_over_block(uint64_t *state, const struct caster *caster, float point[4])
{
	const struct face_cones *cones = &caster->cones;
	if (cones->count == 0)
		return;
	size_t b = random_next(state) % cones->count;
	bool averts = random_next(state) % 2;
	double from = averts ? -cones->averts_from[b] : cones->faces_from[b];
	double off = ldexp(random_signed(state), -(int)(random_next(state) % 25));
	const float *axis[3] = {cones->axis_x, cones->axis_y, cones->axis_z};
	const float *at[3] = {cones->x, cones->y, cones->z};
	for (int i = 0; i < 3; i++)
		point[i] = (float)(caster->planes.center[i] +
				   caster->planes.radius * (at[i][b] + axis[i][b] * (from + off)));
}

enum light_kind {
	NEAR,
	INSIDE,
	FAR,
	VERY_FAR,
	DIRECTION,
	CENTER,
	AT_VERTEX,
	IN_PLANE,
	ALONG_PLANE,
	ALONG_AXIS,
	HOMOGENEOUS,
	OPPOSITE,
	OVER_BLOCK,
	LIGHT_KINDS,
};

static void make_light(uint64_t *state, const struct subject *s, enum light_kind kind, float l[4])
{
	const struct caster *caster = &s->mesh.caster;
	random_point(state, s,
		kind == NEAR       ? 2.0
		: kind == FAR      ? 1e3
		: kind == VERY_FAR ? 1e6
				   : 0.7,
		l);
	if (kind == DIRECTION)
		memcpy(l,
			(float[4]){
				random_signed(state), random_signed(state), random_signed(state)},
			sizeof(float[4]));
	if (kind == CENTER)
		for (int i = 0; i < 3; i++)
			l[i] = (float)caster->planes.center[i];
	if (kind == AT_VERTEX)
		memcpy(l, caster->positions[random_next(state) % caster->vertex_count],
			sizeof(float[3]));
	if (kind == IN_PLANE || kind == ALONG_PLANE)
		point_in_plane(state, s, kind == IN_PLANE ? 1.0f : 0.0f, l);
	if (kind == ALONG_AXIS) {
		memset(l, 0, sizeof(float[4]));
		l[random_next(state) % 3] = random_signed(state);
	}
	if (kind == HOMOGENEOUS)
		l[3] = 3.0f * random_signed(state);
	if (kind == OPPOSITE)
		l[3] = -1.0f;
	if (kind == OVER_BLOCK)
		point_over_block(state, caster, l);
}

static void check_model(const char *name, const struct model *model)
{
	(void)name;
	struct subject s = subject_of(model);
	uint64_t state = 7;
	/* Some hundred lights for small models, each kind once for the largest. */
	size_t rounds = 1 + 300000 / s.mesh.caster.triangle_count;
	rounds = rounds < 40 ? rounds : 40;
	for (size_t i = 0; i < rounds * LIGHT_KINDS; i++) {
		float light[4];
		make_light(&state, &s, (enum light_kind)(i % LIGHT_KINDS), light);
		check_facing(&s, light);
		check_edges(&s);
		check_loops(&s);
		check_skips(&s, light);
	}
	subject_finish(&s);
}

static void equals_the_definition(void **state)
{
	(void)state;
	models_visit(SMOOTHIE_SHARED, check_model);
}

static void holds_after_vertices_moved(void **state)
{
	(void)state;
	struct model model = model_sphere(5);
	struct subject s = subject_of(&model);
	uint64_t random = 13;
	for (size_t v = 0; v < s.mesh.vertex_count; v++)
		s.mesh.positions[v][0] *= 1.0f + s.mesh.positions[v][2];
	assert_true(caster_let_move(&s.mesh.caster));
	caster_move(&s.mesh.caster, (const float(*)[3])s.mesh.positions);
	assert_int_equal(s.mesh.caster.cones.count, 0);
	for (int kind = 0; kind < LIGHT_KINDS; kind++) {
		float light[4];
		make_light(&random, &s, (enum light_kind)kind, light);
		check_facing(&s, light);
		check_edges(&s);
		check_loops(&s);
		check_skips(&s, light);
	}
	subject_finish(&s);
	model_finish(&model);
}

/* The loops close for any set of triangles, also for one that no light could make. */
static void check_any_set(const char *name, const struct model *model)
{
	(void)name;
	struct subject s = subject_of(model);
	const struct caster *caster = &s.mesh.caster;
	uint64_t state = 11;
	for (int i = 0; i < 4; i++) {
		for (size_t w = 0; w < facing_words(caster); w++)
			s.facing[w] = (uint64_t)random_next(&state) << 32 | random_next(&state);
		if (caster->triangle_count % 64 != 0)
			s.facing[facing_words(caster) - 1] &=
				(UINT64_C(1) << caster->triangle_count % 64) - 1;
		check_edges(&s);
		check_loops(&s);
	}
	subject_finish(&s);
}

static void closes_loops_for_any_set(void **state)
{
	(void)state;
	models_visit(SMOOTHIE_SHARED, check_any_set);
}

static void holds_at_any_scale_and_place(void **state)
{
	(void)state;
	models_visit_extremes(check_model);
}

static void nothing_faces_a_light_that_is_not_finite(void **state)
{
	(void)state;
	const float lights[][4] = {{NAN, 0, 0, 1}, {0, INFINITY, 0, 1}, {0, 0, -INFINITY, 0},
		{0, 5, 0, NAN}, {0, 5, 0, INFINITY}, {0, 5, 0, -INFINITY}, {0, 0, 0, 0}};
	struct model model = model_sphere(6);
	struct subject s = subject_of(&model);
	assert_true(s.mesh.caster.cones.count > 0);
	for (size_t i = 0; i < sizeof(lights) / sizeof(lights[0]); i++) {
		memset(s.facing, 0xff, facing_words(&s.mesh.caster) * sizeof(*s.facing));
		facing_find(&s.mesh.caster, lights[i], s.facing);
		for (size_t w = 0; w < facing_words(&s.mesh.caster); w++)
			assert_int_equal(s.facing[w], 0);
	}
	subject_finish(&s);
	model_finish(&model);
}

static void a_mesh_in_one_point_faces_nowhere(void **state)
{
	(void)state;
	const float positions[3][3] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
	const uint32_t indices[6] = {0, 1, 2, 2, 1, 0};
	struct model model = {3, (float(*)[3])positions, 6, (uint32_t *)indices};
	check_model("point", &model);
}

/* From above, the rim of the top face, counter-clockwise: the lit side is on its left. */
static void a_cube_from_above(void **state)
{
	(void)state;
	struct model model = model_cube();
	struct subject s = subject_of(&model);
	facing_find(&s.mesh.caster, (const float[4]){0.1f, 0.2f, 9, 1}, s.facing);
	size_t count = silhouette_find(&s.mesh.caster, s.facing, s.edges, 18);
	assert_int_equal(count, 4);
	float area = 0.0f;
	for (size_t e = 0; e < count; e++) {
		const float *a = s.mesh.caster.positions[s.edges[e].a];
		const float *b = s.mesh.caster.positions[s.edges[e].b];
		assert_true(a[2] == 1.0f && b[2] == 1.0f);
		area += (a[0] * b[1] - a[1] * b[0]) / 2.0f;
	}
	assert_true(area == 4.0f);
	subject_finish(&s);
	model_finish(&model);
}

static size_t find_silhouette(void *data, struct silhouette_edge *edges, size_t capacity)
{
	const struct subject *s = data;
	return silhouette_find(&s->mesh.caster, s->facing, edges, capacity);
}

static void writes_no_more_than_capacity(void **state)
{
	(void)state;
	struct model model = model_grid(20);
	struct subject s = subject_of(&model);
	facing_find(&s.mesh.caster, (const float[4]){0, 0, 1, 0}, s.facing);
	check_capacity(find_silhouette, &s, 80, 13);
	subject_finish(&s);
	model_finish(&model);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(equals_the_definition),
		cmocka_unit_test(closes_loops_for_any_set),
		cmocka_unit_test(holds_after_vertices_moved),
		cmocka_unit_test(holds_at_any_scale_and_place),
		cmocka_unit_test(nothing_faces_a_light_that_is_not_finite),
		cmocka_unit_test(a_mesh_in_one_point_faces_nowhere),
		cmocka_unit_test(a_cube_from_above),
		cmocka_unit_test(writes_no_more_than_capacity),
	};
	return cmocka_run_group_tests_name("silhouette", tests, NULL, NULL);
}
