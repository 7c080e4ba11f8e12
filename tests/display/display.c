/* SPDX-License-Identifier: MIT */
/* What is shown on a display, how often, and what is there when it ends. */
#include "viewer.h"
#include <drm_fourcc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SECOND VIEWER_SECOND

static const struct fake_abilities kinds[] = {
	{0},
	{.no_atomic = true},
	{.no_atomic = true, .no_universal_planes = true},
	{.no_blanks = true},
	{.no_atomic = true, .no_blanks = true},
	{.modifiers = true, .fences = true, .damage = true},
	{.damage = true, .rotations = DRM_MODE_ROTATE_0},
	{.formats = {DRM_FORMAT_RGB565}},
	{.formats = {DRM_FORMAT_XBGR8888}},
	{.only_by_depth = true},
	{.no_atomic = true, .no_universal_planes = true, .only_by_depth = true},
};
#define KINDS (sizeof(kinds) / sizeof(kinds[0]))

static void a_moving_picture_is_shown_at_every_vertical_blank(void **state)
{
	(void)state;
	for (size_t i = 0; i < KINDS; i++) {
		struct viewer viewer;
		struct display_stats stats;
		fake_world_reset();
		struct fake_drm *drm = fake_drm_init(0, &kinds[i]);
		viewer_start(&viewer, NULL);
		viewer.moves = true;
		viewer_run(&viewer, SECOND);
		viewer.moves = false;
		viewer_run(&viewer, SECOND);
		viewer_assert_runs(&viewer);
		display_get_stats(viewer.display, &stats);
		assert_int_equal(stats.frames, viewer.drawn);
		assert_int_equal(stats.flips, viewer.drawn);
		assert_int_equal(stats.missed, 0);
		assert_in_range(stats.flips, 60, 63);
		assert_int_equal(drm->steps[FAKE_SET_MODE], 1);
		assert_int_equal(drm->blanked, 0);
		assert_int_equal(viewer.warnings, 0);
		viewer_assert_leaves_nothing(&viewer);
	}
}

/* Where nothing moves for some ticks there is no frame, nor is one missed. */
static void a_pausing_picture_is_shown_when_it_moves(void **state)
{
	(void)state;
	for (size_t i = 0; i < 2 * KINDS; i++) {
		struct viewer viewer;
		struct display_stats stats;
		struct display_options options = {.async = i >= KINDS};
		fake_world_reset();
		fake_drm_init(0, &kinds[i % KINDS]);
		viewer_start(&viewer, &options);
		viewer.moves = true;
		viewer.pause = 4;
		viewer_run(&viewer, SECOND);
		display_get_stats(viewer.display, &stats);
		assert_in_range(stats.flips, 15, 17);
		assert_in_range(viewer.kept, 43, 47);
		assert_in_range(display_tick(viewer.display), 59, 62);
		assert_int_equal(stats.missed, 0);
		viewer_run(&viewer, SECOND / 10);
		viewer_assert_leaves_nothing(&viewer);
	}
}

static void a_still_picture_is_shown_once(void **state)
{
	(void)state;
	for (size_t i = 0; i < KINDS; i++) {
		struct viewer viewer;
		fake_world_reset();
		struct fake_drm *drm = fake_drm_init(0, &kinds[i]);
		viewer_start(&viewer, NULL);
		viewer_run(&viewer, SECOND);
		viewer_assert_runs(&viewer);
		assert_int_equal(viewer.drawn, 1);
		drm->calls = drm->probes = viewer.sleeps = 0;
		viewer_run(&viewer, 60 * SECOND);
		viewer_assert_runs(&viewer);
		assert_int_equal(viewer.drawn, 1);
		assert_int_equal(drm->steps[FAKE_SET_MODE] + drm->steps[FAKE_FLIP], 1);
		/* A look every 5 seconds, which does not wake the monitor. */
		assert_in_range(viewer.sleeps, 12, 14);
		assert_in_range(drm->calls, 12, 12 * 200);
		assert_int_equal(drm->probes, 0);
		assert_false(display_wants_frame(viewer.display, false));
		viewer_assert_leaves_nothing(&viewer);
	}
}

static void between_looks_there_is_not_one_call(void **state)
{
	(void)state;
	struct viewer viewer;
	struct pollfd fds[DISPLAY_POLL_MAX];
	int64_t timeout;
	struct fake_drm *drm = fake_drm_init(0, &kinds[0]);
	viewer_start(&viewer, NULL);
	viewer_run(&viewer, 6 * SECOND);
	drm->calls = 0;
	assert_int_equal(display_poll(viewer.display, fds, &timeout), 1);
	assert_int_equal(fds[0].fd, drm->fd);
	assert_in_range(timeout, 3 * SECOND, 5 * SECOND);
	fake_world_wait(timeout - SECOND);
	assert_true(display_update(viewer.display, &viewer.error));
	assert_false(display_wants_frame(viewer.display, false));
	assert_int_equal(drm->calls, 0);
	viewer_assert_leaves_nothing(&viewer);
}

enum turner { THE_PLANE, THE_GPU };

static void assert_turned(
	const struct fake_abilities *can, const struct display_options *options, enum turner turner)
{
	static const uint64_t counter_clockwise[] = {
		DRM_MODE_ROTATE_0, DRM_MODE_ROTATE_270, DRM_MODE_ROTATE_180, DRM_MODE_ROTATE_90};
	struct viewer viewer;
	bool upright = options->rotation % 180 == 0;
	fake_world_reset();
	struct fake_drm *drm = fake_drm_init(0, can);
	fake_drm_light_console(drm);
	viewer_start(&viewer, options);
	viewer.moves = true;
	viewer_run(&viewer, SECOND);
	viewer.moves = false;
	viewer_run(&viewer, SECOND);
	viewer_assert_runs(&viewer);
	assert_int_equal(viewer.target.width, upright ? 64 : 48);
	assert_int_equal(viewer.target.height, upright ? 48 : 64);
	assert_int_equal(viewer.target.rotation, turner == THE_GPU ? options->rotation : 0);
	assert_int_equal(drm->crtcs[0].width, upright || turner == THE_GPU ? 64 : 48);
	assert_int_equal(fake_primary(drm->objects, 0)->values[FAKE_ROTATION],
		counter_clockwise[turner == THE_PLANE ? options->rotation / 90 : 0]);
	assert_int_equal(viewer.warnings, 0);
	viewer_assert_leaves_nothing(&viewer);
	/* The console is not turned. */
	assert_int_equal(drm->crtcs[0].shown, FAKE_CONSOLE);
	assert_int_equal(fake_primary(drm->objects, 0)->values[FAKE_ROTATION], DRM_MODE_ROTATE_0);
}

static void the_picture_is_turned_by_the_plane_where_it_can(void **state)
{
	(void)state;
	const uint64_t half = DRM_MODE_ROTATE_0 | DRM_MODE_ROTATE_180;
	const uint64_t all = half | DRM_MODE_ROTATE_90 | DRM_MODE_ROTATE_270;
	const struct {
		struct fake_abilities can;
		bool legacy;
		enum turner half, quarter;
	} cases[] = {
		{{.rotations = all}, false, THE_PLANE, THE_PLANE},
		{{.rotations = all | DRM_MODE_REFLECT_X, .damage = true}, false, THE_PLANE,
			THE_PLANE},
		{{.rotations = half}, false, THE_PLANE, THE_GPU},
		{{.rotations = all, .refuses_rotations = true}, false, THE_GPU, THE_GPU},
		{{.rotations = all}, true, THE_GPU, THE_GPU},
		{{.rotations = all, .no_atomic = true}, false, THE_GPU, THE_GPU},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		for (unsigned rotation = 0; rotation < 360; rotation += 90)
			assert_turned(&cases[i].can,
				&(struct display_options){
					.rotation = rotation, .legacy = cases[i].legacy},
				rotation % 180 == 90 ? cases[i].quarter
				: rotation == 180    ? cases[i].half
						     : THE_PLANE);
}

static void assert_console_is_back(struct fake_drm *drm)
{
	assert_int_equal(drm->crtcs[0].shown, FAKE_CONSOLE);
	assert_int_equal(drm->crtcs[0].mode.hdisplay, 32);
	assert_int_equal(drm->crtcs[0].mode.vrefresh, 75);
	assert_int_equal(drm->objects[0].values[FAKE_CRTC_ID], 10);
}

static void what_was_there_before_is_shown_again(void **state)
{
	(void)state;
	for (size_t i = 0; i < KINDS; i++) {
		/* Ended in peace, during a flip, and during one of which the driver does not tell.
		 */
		for (int way = 0; way < 3; way++) {
			struct viewer viewer;
			fake_world_reset();
			struct fake_drm *drm = fake_drm_init(0, &kinds[i]);
			if (kinds[i].formats[0] != 0)
				drm->can.formats[1] = DRM_FORMAT_XRGB8888; /* of the console */
			fake_drm_light_console(drm);
			viewer_start(&viewer, NULL);
			viewer.moves = way > 0;
			viewer_run(&viewer, SECOND);
			while (way > 0 && !drm->crtcs[0].pending && !kinds[i].no_blanks)
				viewer_run(&viewer, SECOND / 1000);
			drm->withholds_events = way == 2;
			int64_t start = fake_world.now;
			viewer_assert_leaves_nothing(&viewer);
			assert_in_range(fake_world.now - start, 0, SECOND + SECOND / 10);
			assert_console_is_back(drm);
		}
	}
}

static void where_nothing_was_shown_the_screen_goes_dark(void **state)
{
	(void)state;
	struct viewer viewer;
	struct fake_drm *drm = fake_drm_init(0, &kinds[0]);
	viewer_start(&viewer, NULL);
	viewer_run(&viewer, SECOND);
	viewer_assert_leaves_nothing(&viewer);
	assert_int_equal(drm->crtcs[0].shown, 0);
	assert_int_equal(drm->objects[0].values[FAKE_CRTC_ID], 0);
}

static void planes_that_others_left_are_switched_off(void **state)
{
	(void)state;
	for (int legacy = 0; legacy < 2; legacy++) {
		struct viewer viewer;
		fake_world_reset();
		struct fake_drm *drm = fake_drm_init(0, &kinds[0]);
		uint64_t *overlay = drm->objects[FAKE_OBJECTS - 1].values;
		fake_drm_light_console(drm);
		overlay[FAKE_FB_ID] = FAKE_CONSOLE;
		overlay[FAKE_CRTC_ID] = 10;
		viewer_start(&viewer, &(struct display_options){.legacy = legacy});
		viewer_run(&viewer, SECOND);
		viewer_assert_runs(&viewer);
		assert_int_equal(overlay[FAKE_FB_ID], 0);
		viewer_assert_leaves_nothing(&viewer);
	}
}

static void flips_do_not_wait_where_they_need_not(void **state)
{
	(void)state;
	static const struct {
		struct fake_abilities can;
		bool works;
	} cases[] = {
		{{.async_flip = true}, true},
		{{.async_flip = true, .no_atomic = true}, true},
		{{0}, false},
		{{.no_atomic = true}, false},
		{{.async_claim = true, .damage = true}, false},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct viewer viewer;
		fake_world_reset();
		struct fake_drm *drm = fake_drm_init(0, &cases[i].can);
		viewer_start(&viewer, &(struct display_options){.async = true});
		viewer.moves = true;
		while (!viewer.ended && viewer.drawn < 100)
			viewer_run(&viewer, SECOND / 1000);
		int64_t time = fake_world.now - 1000 * SECOND;
		viewer.moves = false;
		viewer_run(&viewer, SECOND);
		viewer_assert_runs(&viewer);
		if (cases[i].works) {
			assert_int_equal(drm->async_flips, 99);
			assert_in_range(time, SECOND / 10, SECOND / 2);
			assert_int_equal(viewer.warnings, 0);
		} else {
			assert_int_equal(drm->async_flips, 0);
			assert_in_range(time, SECOND, 2 * SECOND);
			assert_int_equal(viewer.warnings, 1);
			assert_non_null(strstr(viewer.warning, "no flips without vsync"));
		}
		viewer_assert_leaves_nothing(&viewer);
	}
}

static void formats_and_modes_are_those_asked_for(void **state)
{
	(void)state;
	static const struct {
		struct display_options options;
		uint32_t format, width, hz;
	} cases[] = {
		{{0}, DRM_FORMAT_XRGB8888, 64, 60},
		{{.format = "rgb565"}, DRM_FORMAT_RGB565, 64, 60},
		{{.format = "xrgb2101010"}, DRM_FORMAT_XRGB2101010, 64, 60},
		{{.mode = "preferred"}, DRM_FORMAT_XRGB8888, 64, 60},
		{{.mode = "current"}, DRM_FORMAT_XRGB8888, 32, 75},
		{{.mode = "32x24"}, DRM_FORMAT_XRGB8888, 32, 75},
		{{.mode = "32x24@60", .legacy = true}, DRM_FORMAT_XRGB8888, 32, 60},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct viewer viewer;
		fake_world_reset();
		struct fake_drm *drm = fake_drm_init(0, &kinds[0]);
		fake_drm_light_console(drm);
		viewer_start(&viewer, &cases[i].options);
		viewer_run(&viewer, SECOND);
		viewer_assert_runs(&viewer);
		assert_int_equal(
			fake_framebuffer(drm, drm->crtcs[0].shown)->format, cases[i].format);
		assert_int_equal(drm->crtcs[0].mode.hdisplay, cases[i].width);
		assert_int_equal(drm->crtcs[0].mode.vrefresh, cases[i].hz);
		viewer_assert_leaves_nothing(&viewer);
	}
}

static void what_is_not_there_is_refused(void **state)
{
	(void)state;
	static const struct {
		struct display_options options;
		enum sm_status status;
		const char *text;
	} cases[] = {
		{{.mode = "9x"}, SM_ERROR_INPUT, "no mode \"9x\""},
		{{.mode = "64x48@24"}, SM_ERROR_INPUT,
			"HDMI-A-1 has no such mode; it has 64x48@60, 32x24@5"},
		{{.rotation = 45}, SM_ERROR_INPUT, "no rotation by 45"},
		{{.rotation = 360}, SM_ERROR_INPUT, "no rotation by 360"},
		{{.format = "nope"}, SM_ERROR_INPUT, "no format \"nope\""},
		{{.format = "xbgr8888"}, SM_ERROR_INPUT,
			"HDMI-A-1 does not show xbgr8888; it shows xrgb8888, xrgb2101010, rgb565"},
		{{.connector = "VGA-1"}, SM_ERROR_INPUT,
			"no connector VGA-1; it has HDMI-A-1, DP-1"},
		{{.device = "/dev/dri/none"}, SM_ERROR_INPUT,
			"device /dev/dri/none: No such file or directory"},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct viewer viewer;
		fake_drm_init(0, &kinds[0]);
		assert_false(viewer_init(&viewer, &cases[i].options));
		viewer_assert_ended(&viewer, cases[i].text);
		assert_int_equal(viewer.error.status, cases[i].status);
		viewer_assert_leaves_nothing(&viewer);
		fake_world_reset();
	}
}

static void devices_that_cannot_are_refused(void **state)
{
	(void)state;
	static const struct {
		struct fake_abilities can;
		const char *text;
	} cases[] = {
		{{.formats = {DRM_FORMAT_NV12}}, "HDMI-A-1 shows none that smoothie draws"},
		{{.no_dumb = true}, "it has neither a GPU nor dumb buffers"},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct viewer viewer;
		fake_world_reset();
		fake_drm_init(0, &cases[i].can);
		assert_false(viewer_init(&viewer, NULL));
		viewer_assert_ended(&viewer, cases[i].text);
		assert_int_equal(viewer.error.status, SM_ERROR_MACHINE);
		viewer_assert_leaves_nothing(&viewer);
	}
}

static void the_device_with_a_monitor_is_used(void **state)
{
	(void)state;
	struct viewer viewer;
	struct fake_drm *none = fake_drm_init(0, &kinds[0]), *one = fake_drm_init(1, &kinds[0]);
	none->connectors[0].plugged = false;
	viewer_start(&viewer, NULL);
	viewer_run(&viewer, SECOND);
	viewer_assert_shows(&viewer, one, 0);
	assert_int_equal(none->fd, -1);
	viewer_assert_leaves_nothing(&viewer);

	none->connectors[0].plugged = true;
	viewer_start(&viewer, &(struct display_options){.device = "/dev/dri/card1"});
	viewer_run(&viewer, SECOND);
	viewer_assert_shows(&viewer, one, 0);
	viewer_assert_leaves_nothing(&viewer);

	/* One that cannot does not stand in the way of one that can. */
	none->connectors[0].absent = none->connectors[1].absent = true;
	viewer_start(&viewer, NULL);
	viewer_run(&viewer, SECOND);
	viewer_assert_shows(&viewer, one, 0);
	viewer_assert_leaves_nothing(&viewer);
}

static void without_a_device_there_is_no_display(void **state)
{
	(void)state;
	struct viewer viewer;
	assert_false(viewer_init(&viewer, NULL));
	viewer_assert_ended(&viewer, "there is no display device (/dev/dri/card*)");
	assert_int_equal(viewer.error.status, SM_ERROR_MACHINE);
	viewer_finish(&viewer);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		viewer_test(a_moving_picture_is_shown_at_every_vertical_blank),
		viewer_test(a_pausing_picture_is_shown_when_it_moves),
		viewer_test(a_still_picture_is_shown_once),
		viewer_test(between_looks_there_is_not_one_call),
		viewer_test(the_picture_is_turned_by_the_plane_where_it_can),
		viewer_test(what_was_there_before_is_shown_again),
		viewer_test(where_nothing_was_shown_the_screen_goes_dark),
		viewer_test(planes_that_others_left_are_switched_off),
		viewer_test(flips_do_not_wait_where_they_need_not),
		viewer_test(formats_and_modes_are_those_asked_for),
		viewer_test(what_is_not_there_is_refused),
		viewer_test(devices_that_cannot_are_refused),
		viewer_test(the_device_with_a_monitor_is_used),
		viewer_test(without_a_device_there_is_no_display),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
