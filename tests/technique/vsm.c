/* SPDX-License-Identifier: MIT */
/* Variance shadow maps on drivers that lack one thing or another. */
#include "canvas.h"
#include "parts.h"
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

/* With the moments met in that way; skips the test where the driver cannot. */
static struct visibility draw(struct rig *rig, const char *path)
{
	struct visibility seen;
	rig_use_path(rig, path);
	rig_set_shadows(rig, &variance_map);
	visibility_draw(&seen, rig, rig->scene, &overhead, SIZE, SIZE);
	return seen;
}

static void four_fetches_are_like_the_sampler(void **state)
{
	struct rig *rig = *state;
	add_block(rig);
	struct visibility filtered = draw(rig, "moments=rg32f");
	struct visibility fetched = draw(rig, "moments=rg32f-fetch");
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
	add_block(rig);
	struct visibility seen = draw(rig, "moments=rgba16f");
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
	rig_use_driver(
		rig, &(struct sm_driver_options){
			     .caps = "-EXT_color_buffer_float,-EXT_color_buffer_half_float"});
	rig_set_shadows(rig, &variance_map);
	canvas_init(&canvas, GL_RGBA8, SIZE, SIZE);
	struct sm_view view = {.camera = overhead,
		.framebuffer = canvas.framebuffer,
		.width = SIZE,
		.height = SIZE};
	assert_false(sm_renderer_draw(rig->renderer, rig->scene, &view, &error));
	assert_int_equal(error.status, SM_ERROR_MACHINE);
	assert_non_null(strstr(error.text, "no way to have the moments of depth"));
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
