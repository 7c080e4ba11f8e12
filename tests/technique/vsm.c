/* SPDX-License-Identifier: MIT */
/* Variance shadow maps on drivers that lack one thing or another. */
#include "canvas.h"
#include "parts.h"
#include "renderer.h"
#include "visibility.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 96

static const struct sm_shadow_options variance_map = {.technique = "vsm", .map_size = 256};

static const struct sm_camera overhead = {.eye = {0, 6, 0}, .up = {0, 0, -1}, .fov = 30};

static void add_block(struct rig *rig)
{
	parts_add_object(rig->scene, parts_add_cube(rig->scene), PART_BOTH,
		&(struct pose){{0.5f, 0.5f, 0.5f}, 30, {0, 0.5f, 0}});
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES,
		&(struct pose){{4, 1, 4}, 0, {0, 0, 0}});
	parts_add_light(rig->scene,
		&(struct sm_light_desc){.position = {4, 5, 0}, .radius = 0.2f, .angle = 60});
}

static struct visibility draw(struct rig *rig, const struct caps *caps)
{
	struct visibility seen;
	rig->renderer->gpu.caps = *caps;
	rig_set_shadows(rig, &variance_map);
	visibility_draw(&seen, rig, rig->scene, &overhead, SIZE, SIZE);
	return seen;
}

static struct caps caps_of(const struct rig *rig)
{
	return rig->renderer->gpu.caps;
}

static void four_fetches_are_like_the_sampler(void **state)
{
	struct rig *rig = *state;
	struct caps caps = caps_of(rig);
	if (!caps.moments_filtered)
		skip();
	add_block(rig);
	struct visibility filtered = draw(rig, &caps);
	caps.moments_filtered = false;
	struct visibility fetched = draw(rig, &caps);
	struct visibility_change change = visibility_compare(&filtered, &fetched);
	print_message("mean %g, off %g\n", change.mean, change.off);
	assert_true(change.mean < 0.002 && change.off < 0.02);
	visibility_finish(&filtered);
	visibility_finish(&fetched);
}

/* The shadow falls to the left of the block. */
static void half_floats_tell_shadow_from_light(void **state)
{
	struct rig *rig = *state;
	struct caps caps = caps_of(rig);
	if (caps.moment_format.name == NULL)
		skip();
	add_block(rig);
	caps.moment_format = (struct color_format){"RG16F", GL_RG16F};
	caps.moments_filtered = true;
	struct visibility seen = draw(rig, &caps);
	assert_true(visibility_at(&seen, SIZE / 4, SIZE / 2) < 0.1);
	for (uint32_t y = 0; y < SIZE; y++)
		assert_true(visibility_at(&seen, SIZE - 4, y) == 1.0);
	visibility_finish(&seen);
}

static void without_float_targets_there_is_an_error(void **state)
{
	struct rig *rig = *state;
	struct sm_error error = {0};
	struct canvas canvas;
	add_block(rig);
	rig->renderer->gpu.caps.moment_format = (struct color_format){0};
	rig_set_shadows(rig, &variance_map);
	canvas_init(&canvas, GL_RGBA8, SIZE, SIZE);
	struct sm_view view = {.camera = overhead,
		.framebuffer = canvas.framebuffer,
		.width = SIZE,
		.height = SIZE};
	assert_false(sm_renderer_draw(rig->renderer, rig->scene, &view, &error));
	assert_int_equal(error.status, SM_ERROR_MACHINE);
	assert_non_null(strstr(error.text, "needs a target of floats"));
	canvas_finish(&canvas);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(four_fetches_are_like_the_sampler),
		rig_test(half_floats_tell_shadow_from_light),
		rig_test(without_float_targets_there_is_an_error),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
