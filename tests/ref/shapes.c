/* SPDX-License-Identifier: MIT */
/* Shadows that have closed forms, and what must not change them. */
#include "edge.h"
#include "load/stage.h"
#include "parts.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void an_edge_cuts_a_segment_off_the_light(void **state)
{
	(void)state;
	static const enum sm_light_type types[] = {SM_LIGHT_SPOT, SM_LIGHT_DIRECTIONAL};
	static const float radii[] = {0.1f, 1.0f};
	for (int i = 0; i < 4; i++) {
		struct edge edge;
		struct reference reference;
		uint32_t count;
		edge_init(&edge, types[i % 2], radii[i / 2], 1, 0);
		edge_trace(&reference, &edge);
		double error = edge_error(&edge, &reference, &count);
		print_message("%-11s light of radius %g: error %.5f over %u pixels\n",
			i % 2 ? "directional" : "spot", (double)radii[i / 2], error, count);
		assert_true(count > 80);
		if (error > 0.003)
			fail_msg("error %g", error);
		reference_finish(&reference);
		edge_finish(&edge);
	}
}

static void a_point_light_is_seen_or_not(void **state)
{
	(void)state;
	struct edge sharp, soft;
	struct reference reference;
	uint32_t dark = 0, count = EDGE_WIDTH * EDGE_HEIGHT;
	edge_init(&sharp, SM_LIGHT_SPOT, 0, 1, 0);
	edge_init(&soft, SM_LIGHT_SPOT, 1e-6f, 1, 0);
	edge_trace(&reference, &sharp);
	for (uint32_t i = 0; i < count; i++) {
		double v = edge_visibility(&soft, i % EDGE_WIDTH, i / EDGE_WIDTH);
		assert_true(reference.visibility[i] == round(v));
		dark += v < 0.5;
	}
	assert_true(dark > count / 10 && dark < count - count / 10);
	reference_finish(&reference);
	edge_finish(&soft);
	edge_finish(&sharp);
}

/* Share of a disc of radius a that another of radius b, d away, covers. */
static double overlap(double a, double b, double d)
{
	if (d >= a + b)
		return 0;
	if (d <= fabs(a - b))
		return a <= b ? 1 : b * b / (a * a);
	double x = (d * d + a * a - b * b) / (2 * d), y = (d * d + b * b - a * a) / (2 * d);
	double lens = a * a * acos(x / a) - x * sqrt(a * a - x * x) + b * b * acos(y / b) -
		      y * sqrt(b * b - y * y);
	return lens / (M_PI * a * a);
}

/* A sphere above the middle of the ground, a light above it, both so small as they are seen from
 * there that they are flat discs to 3e-4 of their size. */
#define SPHERE_HEIGHT 80.0
#define LIGHT_HEIGHT 200.0

static void trace_sphere(struct reference *reference, float radius, float light_radius)
{
	struct sm_error error;
	struct sm_scene *scene = sm_scene_create();
	struct reference_request request = {
		.scene = scene,
		/* Straight down, below the sphere: a pixel is .05 wide. */
		.camera = {.eye = {0, 40, 0}, .up = {0, 0, -1}, .fov = 9.1478443f},
		.width = 128,
		.height = 128,
	};
	parts_add_object(scene, parts_add_square(scene), PART_RECEIVES,
		&(struct pose){{10, 1, 10}, 0, {0, 0, 0}});
	parts_add_object(scene, parts_add_sphere(scene, 64), PART_BOTH,
		&(struct pose){{radius, radius, radius}, 0, {0, SPHERE_HEIGHT, 0}});
	parts_add_light(scene,
		&(struct sm_light_desc){
			.position = {0, LIGHT_HEIGHT, 0}, .radius = light_radius, .angle = 20});
	if (!reference_trace(reference, &request, &error))
		fail_msg("%s", error.text);
	sm_scene_destroy(scene);
}

static double sphere_error(const struct reference *reference, double radius, double light_radius)
{
	double sum = 0;
	uint32_t count = 0;
	for (uint32_t i = 0; i < 128 * 128; i++) {
		double x = 0.05 * (i % 128 + .5 - 64), z = 0.05 * (i / 128 + .5 - 64);
		double out = sqrt(x * x + z * z);
		/* Small angles: of the light, of the sphere, and between the two. */
		double light = light_radius / hypot(LIGHT_HEIGHT, out);
		double sphere = asin(radius / hypot(SPHERE_HEIGHT, out));
		double apart = atan(out / SPHERE_HEIGHT) - atan(out / LIGHT_HEIGHT);
		double v = 1 - overlap(light, sphere, apart);
		sum += (reference->visibility[i] - v) * (reference->visibility[i] - v);
		count += v > 0 && v < 1;
	}
	assert_true(count > 1000);
	return sqrt(sum / count);
}

static void a_sphere_covers_the_light_as_one_disc_another(void **state)
{
	(void)state;
	/* The shadow has an umbra, or the sphere is too small for it. */
	static const float radii[] = {1.0f, 0.5f};
	for (int i = 0; i < 2; i++) {
		struct reference reference;
		trace_sphere(&reference, radii[i], 2);
		double error = sphere_error(&reference, radii[i], 2);
		print_message("sphere of radius %g: error %.5f\n", (double)radii[i], error);
		if (error > 0.003)
			fail_msg("error %g", error);
		reference_finish(&reference);
	}
}

static double rms_difference(const struct reference *a, const struct reference *b)
{
	double sum = 0;
	uint32_t count = 0;
	for (size_t i = 0; i < (size_t)a->width * a->height; i++) {
		double v = b->visibility[i], off = a->visibility[i] - v;
		if (!(v > 0 && v < 1))
			continue;
		sum += off * off;
		count++;
	}
	assert_true(count > 1000);
	return sqrt(sum / count);
}

static void more_samples_are_nearer_to_the_limit(void **state)
{
	(void)state;
	static const uint32_t samples[] = {16384, 256, 1024, 4096};
	struct reference references[4];
	struct stage stage;
	struct sm_error error;
	const char *settings[] = {"light.radius=0.573149"};
	if (!stage_load(&stage, "builtin:boxes", settings, 1, &error))
		fail_msg("%s", error.text);
	for (int i = 0; i < 4; i++) {
		struct reference_request request = {.scene = stage.scene,
			.camera = stage.camera,
			.width = 128,
			.height = 128,
			.samples = samples[i]};
		if (!reference_trace(&references[i], &request, &error))
			fail_msg("%s", error.text);
	}
	double last = 0;
	for (int i = 1; i < 4; i++) {
		double found = rms_difference(&references[i], &references[0]);
		print_message("%u samples: error %.5f\n", samples[i], found);
		/* Stratified samples of an area with an edge: N^-3/4, so 4^-3/4 = .354. */
		if (i > 1 && !(found > 0.28 * last && found < 0.43 * last))
			fail_msg("error %g after %g", found, last);
		last = found;
	}
	assert_true(last < 0.001);
	for (int i = 0; i < 4; i++)
		reference_finish(&references[i]);
	stage_finish(&stage);
}

static void the_unit_of_length_does_not_matter(void **state)
{
	(void)state;
	for (double scale = 1e-4; scale < 2e6; scale *= 10) {
		struct edge edge;
		struct reference reference;
		uint32_t count;
		edge_init(&edge, SM_LIGHT_SPOT, 0.5f, scale, 0);
		edge_trace(&reference, &edge);
		double error = edge_error(&edge, &reference, &count);
		if (error > 0.003)
			fail_msg("error %g at scale %g", error, scale);
		reference_finish(&reference);
		edge_finish(&edge);
	}
}

static void where_the_scene_is_does_not_matter(void **state)
{
	(void)state;
	struct edge here, there;
	struct reference a, b;
	edge_init(&here, SM_LIGHT_SPOT, 0.5f, 1, 0);
	edge_init(&there, SM_LIGHT_SPOT, 0.5f, 1, 0x1p20);
	edge_trace(&a, &here);
	edge_trace(&b, &there);
	assert_memory_equal(
		a.visibility, b.visibility, EDGE_WIDTH * EDGE_HEIGHT * sizeof(*a.visibility));
	reference_finish(&b);
	reference_finish(&a);
	edge_finish(&there);
	edge_finish(&here);
}

/* Single precision finds the plane of such a ground no better than to a tenth of a unit. */
static void a_slope_a_million_units_wide_does_not_hide_itself(void **state)
{
	(void)state;
	struct sm_error error;
	struct reference reference;
	uint32_t object;
	const float wide = 0x1p20f;
	struct sm_scene *scene = sm_scene_create();
	struct sm_object_desc slope = {
		.mesh = parts_add_square(scene),
		.image = SM_NONE,
		.casts = true,
		.receives = true,
		.transform = {wide, .37f * wide, 0, 0, 0, 1, 0, 0, 0, .23f * wide, wide, 0, 0, 0, 0,
			1},
	};
	assert_true(sm_scene_add_object(scene, &slope, &object, &error));
	parts_add_light(
		scene, &(struct sm_light_desc){.position = {0, 4, 0}, .radius = .5f, .angle = 160});
	const struct reference_request request = {
		.scene = scene,
		.camera = {.eye = {0, 4, 0}, .up = {0, 0, -1}, .fov = 60},
		.width = 64,
		.height = 64,
	};
	if (!reference_trace(&reference, &request, &error))
		fail_msg("%s", error.text);
	for (uint32_t i = 0; i < 64 * 64; i++)
		if (reference.visibility[i] != 1)
			fail_msg("pixel %u sees %g", i, (double)reference.visibility[i]);
	reference_finish(&reference);
	sm_scene_destroy(scene);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(an_edge_cuts_a_segment_off_the_light),
		cmocka_unit_test(a_point_light_is_seen_or_not),
		cmocka_unit_test(a_sphere_covers_the_light_as_one_disc_another),
		cmocka_unit_test(more_samples_are_nearer_to_the_limit),
		cmocka_unit_test(the_unit_of_length_does_not_matter),
		cmocka_unit_test(where_the_scene_is_does_not_matter),
		cmocka_unit_test(a_slope_a_million_units_wide_does_not_hide_itself),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
