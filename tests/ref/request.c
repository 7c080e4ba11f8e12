/* SPDX-License-Identifier: MIT */
/* What is asked for, and what is judged. */
#include "edge.h"
#include "parts.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void what_cannot_be_traced_is_refused(void **state)
{
	(void)state;
	struct edge edge;
	edge_init(&edge, SM_LIGHT_SPOT, 0.5f, 1, 0);
	struct reference_request no_light = edge.request, no_width = edge.request,
				 too_high = edge.request, too_many = edge.request,
				 nowhere = edge.request, upright = edge.request,
				 wide = edge.request;
	no_light.light = 1;
	no_width.width = 0;
	too_high.height = REFERENCE_SIZE_MOST + 1;
	too_many.samples = REFERENCE_SAMPLES_MOST + 1;
	memcpy(nowhere.camera.target, nowhere.camera.eye, sizeof(nowhere.camera.eye));
	memcpy(upright.camera.eye, (float[3]){0, 1, 0}, sizeof(upright.camera.eye));
	memcpy(upright.camera.target, (float[3]){0, 0, 0}, sizeof(upright.camera.target));
	wide.camera.fov = 179;
	const struct {
		const struct reference_request *request;
		const char *text;
	} cases[] = {
		{&no_light, "no light 1"},
		{&no_width, "0x64 pixels"},
		{&too_high, "96x16385 pixels"},
		{&too_many, "65537 samples"},
		{&nowhere, "camera"},
		{&upright, "up direction"},
		{&wide, "field of view"},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct reference reference;
		struct sm_error error;
		assert_false(reference_trace(&reference, cases[i].request, &error));
		assert_int_equal(error.status, SM_ERROR_INPUT);
		if (strstr(error.text, cases[i].text) == NULL)
			fail_msg("\"%s\" does not tell of %s", error.text, cases[i].text);
		assert_null(reference.visibility);
	}
	edge_finish(&edge);
}

static void an_empty_scene_has_nothing_to_judge(void **state)
{
	(void)state;
	struct sm_error error;
	struct reference reference;
	struct sm_scene *scene = sm_scene_create();
	parts_add_light(scene, &(struct sm_light_desc){.position = {0, 1, 0}, .angle = 40});
	const struct reference_request request = {
		.scene = scene,
		.camera = {.eye = {0, 1, 1}, .up = {0, 1, 0}, .fov = 40},
		.width = 1,
		.height = 1,
	};
	assert_true(reference_trace(&reference, &request, &error));
	assert_true(isnan(reference.visibility[0]));
	reference_finish(&reference);
	sm_scene_destroy(scene);
}

static void threads_change_nothing(void **state)
{
	(void)state;
	struct edge edge;
	struct reference alone, crowd;
	edge_init(&edge, SM_LIGHT_SPOT, 0.5f, 1, 0);
	edge.request.threads = 1;
	edge_trace(&alone, &edge);
	edge.request.threads = 7;
	edge_trace(&crowd, &edge);
	assert_memory_equal(alone.visibility, crowd.visibility,
		EDGE_WIDTH * EDGE_HEIGHT * sizeof(*alone.visibility));
	reference_finish(&crowd);
	reference_finish(&alone);
	edge_finish(&edge);
}

static void hear(void *data, double share)
{
	double *last = data;
	assert_true(share >= *last && share <= 1);
	*last = share;
}

static void progress_grows_to_the_end(void **state)
{
	(void)state;
	static const float radii[] = {0.5f, 0};
	for (int i = 0; i < 2; i++) {
		struct edge edge;
		struct reference reference;
		double share = 0;
		edge_init(&edge, SM_LIGHT_SPOT, radii[i], 1, 0);
		edge.request.progress = hear;
		edge.request.progress_data = &share;
		edge_trace(&reference, &edge);
		assert_true(share == 1);
		reference_finish(&reference);
		edge_finish(&edge);
	}
}

/* A lid of side 2, one unit above the ground, right below the eye; what is seen in the middle of
 * the picture. The ground is lit, unless the lid is in the light's way. */
struct lid {
	unsigned int roles;
	bool single_sided, upside_down, mirrored;
	float near; /* of the camera, whose far plane is twice as far; 0: whatever is there */
	float expected;
};

static float look_at_lid(const struct lid *lid)
{
	struct sm_error error;
	struct reference reference;
	uint32_t object;
	struct sm_scene *scene = sm_scene_create();
	uint32_t square = parts_add_square(scene);
	float turn = lid->upside_down ? -1.0f : 1.0f, mirror = lid->mirrored ? -1.0f : 1.0f;
	struct sm_object_desc desc = {
		.mesh = square,
		.image = SM_NONE,
		.casts = lid->roles & PART_CASTS,
		.receives = lid->roles & PART_RECEIVES,
		.single_sided = lid->single_sided,
		/* Turned about x, and mirrored along z. */
		.transform = {1, 0, 0, 0, 0, turn, 0, 0, 0, 0, turn * mirror, 0, 0, 1, 0, 1},
	};
	parts_add_object(scene, square, PART_BOTH, &(struct pose){{20, 20, 20}, 0, {0, 0, 0}});
	assert_true(sm_scene_add_object(scene, &desc, &object, &error));
	parts_add_light(
		scene, &(struct sm_light_desc){.position = {0, 4, 0}, .radius = .1f, .angle = 60});
	struct reference_request request = {
		.scene = scene,
		.camera = {.eye = {0, 3, 0},
			.up = {0, 0, -1},
			.fov = 20,
			.near = lid->near,
			.far = 2 * lid->near},
		.width = 1,
		.height = 1,
	};
	if (!reference_trace(&reference, &request, &error))
		fail_msg("%s", error.text);
	float seen = reference.visibility[0];
	reference_finish(&reference);
	sm_scene_destroy(scene);
	return seen;
}

static void surfaces_are_seen_cast_and_receive_as_their_objects_say(void **state)
{
	(void)state;
	static const struct lid lids[] = {
		{.roles = PART_BOTH, .expected = 1},
		{.roles = PART_RECEIVES, .expected = 1},
		{.roles = PART_CASTS, .expected = NAN},
		/* Seen from behind, it is not there; its shadow is. */
		{.roles = PART_BOTH, .upside_down = true, .expected = 1},
		{.roles = PART_CASTS, .single_sided = true, .upside_down = true, .expected = 0},
		{.roles = PART_CASTS, .single_sided = true, .expected = NAN},
		{.roles = 0, .single_sided = true, .upside_down = true, .expected = 1},
		/* A mirror changes the winding, and not what is outside. */
		{.roles = PART_CASTS, .single_sided = true, .mirrored = true, .expected = NAN},
		{.roles = PART_CASTS,
			.single_sided = true,
			.mirrored = true,
			.upside_down = true,
			.expected = 0},
		/* The lid is nearer than the camera sees, or farther. */
		{.roles = PART_BOTH, .near = 2.5f, .expected = 0},
		{.roles = PART_BOTH, .near = 0.9f, .expected = NAN},
	};
	for (size_t i = 0; i < sizeof(lids) / sizeof(lids[0]); i++) {
		float seen = look_at_lid(&lids[i]);
		bool same = isnan(lids[i].expected) ? isnan(seen) : seen == lids[i].expected;
		if (!same)
			fail_msg("lid %zu: %g, not %g", i, (double)seen, (double)lids[i].expected);
	}
}

/* Seen from straight above the origin, which is lit from `height` above the ground, `away` along
 * x. */
struct glance {
	float away, height, radius;
	enum sm_light_type type;
	bool judged;
};

static void the_whole_light_must_be_above_the_horizon(void **state)
{
	(void)state;
	static const struct glance glances[] = {
		{0, 1, 0.9f, SM_LIGHT_SPOT, true},
		{0, 1, 0.99f, SM_LIGHT_SPOT, false}, /* 1 - R/d is below .02 */
		{0, -1, 0, SM_LIGHT_SPOT, false},
		{40, 1, 0, SM_LIGHT_SPOT, true}, /* its sine is .025 */
		{60, 1, 0, SM_LIGHT_SPOT, false},
		{40, 1, 0.5f, SM_LIGHT_SPOT, false}, /* the disc dips to .0125 */
		{40, 1, 0, SM_LIGHT_DIRECTIONAL, true},
		{40, 1, 0.5f, SM_LIGHT_DIRECTIONAL, false},
		{0, 1, 0.9f, SM_LIGHT_DIRECTIONAL, true},
		{0, 1, 0.99f, SM_LIGHT_DIRECTIONAL, false},
	};
	for (size_t i = 0; i < sizeof(glances) / sizeof(glances[0]); i++) {
		const struct glance *glance = &glances[i];
		struct reference reference;
		struct sm_error error;
		struct sm_scene *scene = sm_scene_create();
		parts_add_object(scene, parts_add_square(scene), PART_BOTH,
			&(struct pose){{100, 1, 100}, 0, {0, 0, 0}});
		parts_add_light(scene,
			&(struct sm_light_desc){.position = {glance->away, glance->height, 0},
				.type = glance->type,
				.radius = glance->radius,
				.angle = 40});
		struct reference_request request = {
			.scene = scene,
			.camera = {.eye = {0, 3, 0}, .up = {0, 0, -1}, .fov = 1},
			.width = 1,
			.height = 1,
		};
		assert_true(reference_trace(&reference, &request, &error));
		if (glance->judged ? reference.visibility[0] != 1 : !isnan(reference.visibility[0]))
			fail_msg("glance %zu: %g", i, (double)reference.visibility[0]);
		reference_finish(&reference);
		sm_scene_destroy(scene);
	}
}

static void beside_a_spots_square_nothing_is_judged(void **state)
{
	(void)state;
	struct reference reference;
	struct sm_error error;
	struct sm_scene *scene = sm_scene_create();
	parts_add_object(scene, parts_add_square(scene), PART_BOTH,
		&(struct pose){{20, 1, 20}, 0, {0, 0, 0}});
	parts_add_light(scene, &(struct sm_light_desc){.position = {0, 4, 0}, .angle = 53.13010f});
	/* The square has a side of 4, the picture one of 8. */
	struct reference_request request = {
		.scene = scene,
		.camera = {.eye = {0, 4, 0}, .up = {0, 0, -1}, .fov = 90},
		.width = 16,
		.height = 16,
	};
	assert_true(reference_trace(&reference, &request, &error));
	for (uint32_t i = 0; i < 256; i++) {
		uint32_t x = i % 16, y = i / 16;
		bool inside = x >= 4 && x < 12 && y >= 4 && y < 12;
		assert_true(inside ? reference.visibility[i] == 1 : isnan(reference.visibility[i]));
	}
	reference_finish(&reference);
	sm_scene_destroy(scene);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_cannot_be_traced_is_refused),
		cmocka_unit_test(an_empty_scene_has_nothing_to_judge),
		cmocka_unit_test(threads_change_nothing),
		cmocka_unit_test(progress_grows_to_the_end),
		cmocka_unit_test(surfaces_are_seen_cast_and_receive_as_their_objects_say),
		cmocka_unit_test(the_whole_light_must_be_above_the_horizon),
		cmocka_unit_test(beside_a_spots_square_nothing_is_judged),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
