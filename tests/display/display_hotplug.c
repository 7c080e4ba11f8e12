/* SPDX-License-Identifier: MIT */
/* Monitors, seats and other programs that come and go. */
#include "viewer.h"
#include <malloc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SECOND VIEWER_SECOND

/* Each test once by atomic mode-setting, once without. */
static const struct fake_abilities kinds[] = {{.damage = true}, {.no_atomic = true}};

static struct fake_drm *begin(int kind)
{
	fake_world_reset();
	struct fake_drm *drm = fake_drm_init(0, &kinds[kind]);
	fake_drm_light_console(drm);
	return drm;
}

static void plug(struct fake_drm *drm, size_t connector, bool plugged)
{
	drm->connectors[connector].plugged = plugged;
	fake_world_tell();
}

static void it_waits_for_the_first_monitor(void **state)
{
	(void)state;
	for (int kind = 0; kind < 2; kind++) {
		for (int told = 0; told < 2; told++) {
			struct viewer viewer;
			struct fake_drm *drm = begin(kind);
			drm->connectors[0].plugged = false;
			fake_world.no_news = !told;
			viewer_start(&viewer, NULL);
			assert_non_null(strstr(viewer.warning, "no monitor yet"));
			viewer_run(&viewer, 30 * SECOND);
			assert_false(viewer.ended);
			assert_false(display_is_on(viewer.display));
			assert_in_range(viewer.sleeps, 15, 17);
			plug(drm, 0, true);
			viewer_run(&viewer, told ? SECOND / 10 : 3 * SECOND);
			viewer_assert_runs(&viewer);
			assert_int_equal(viewer.warnings, 1);
			viewer_assert_leaves_nothing(&viewer);
		}
	}
}

static void it_sleeps_while_the_monitor_is_unplugged(void **state)
{
	(void)state;
	for (int kind = 0; kind < 2; kind++) {
		for (int moves = 0; moves < 2; moves++) {
			struct viewer viewer;
			struct fake_drm *drm = begin(kind);
			viewer_start(&viewer, NULL);
			viewer.moves = moves;
			viewer_run(&viewer, SECOND);
			plug(drm, 0, false);
			viewer_run(&viewer, SECOND);
			assert_false(display_is_on(viewer.display));
			assert_int_equal(drm->crtcs[0].shown, 0);
			assert_int_equal(fake_drm_count(drm), 0);
			unsigned drawn = viewer.drawn;
			viewer.sleeps = 0;
			viewer_run(&viewer, 20 * SECOND);
			assert_int_equal(viewer.drawn, drawn);
			assert_in_range(viewer.sleeps, 9, 12);
			plug(drm, 0, true);
			viewer_run(&viewer, SECOND);
			viewer.moves = false;
			viewer_run(&viewer, SECOND);
			viewer_assert_runs(&viewer);
			assert_int_equal(viewer.warnings, 0);
			viewer_assert_leaves_nothing(&viewer);
			assert_int_equal(drm->crtcs[0].shown, FAKE_CONSOLE);
		}
	}
}

static void it_follows_a_change_of_modes(void **state)
{
	(void)state;
	for (int kind = 0; kind < 2; kind++) {
		for (int moves = 0; moves < 2; moves++) {
			struct viewer viewer;
			struct fake_drm *drm = begin(kind);
			viewer_start(&viewer, NULL);
			for (uint16_t width = 40; width < 140; width += 20) {
				viewer.moves = moves;
				viewer_run(&viewer, SECOND / 2);
				drm->connectors[0].modes[0] = fake_mode(width, 50, 50);
				drm->connectors[0].modes[0].type = DRM_MODE_TYPE_PREFERRED;
				fake_world_tell();
				viewer_run(&viewer, SECOND / 2);
				viewer.moves = false;
				viewer_run(&viewer, SECOND / 2);
				viewer_assert_runs(&viewer);
				assert_int_equal(drm->crtcs[0].width, width);
			}
			/* The screen never went dark in between. */
			assert_int_equal(drm->blanked, 0);
			assert_int_equal(viewer.warnings, 0);
			viewer_assert_leaves_nothing(&viewer);
		}
	}
}

static void a_monitor_without_the_wanted_mode_is_told_of_once(void **state)
{
	(void)state;
	struct viewer viewer;
	struct fake_drm *drm = begin(0);
	viewer_start(&viewer, &(struct display_options){.mode = "32x24"});
	viewer_run(&viewer, SECOND);
	drm->connectors[0].mode_count = 1;
	fake_world_tell();
	viewer_run(&viewer, 60 * SECOND);
	viewer_assert_runs(&viewer);
	assert_int_equal(drm->crtcs[0].width, 64);
	assert_int_equal(viewer.warnings, 1);
	assert_non_null(strstr(viewer.warning, "HDMI-A-1 lacks the wanted mode"));
	viewer_assert_leaves_nothing(&viewer);
}

static void it_moves_to_another_monitor_when_its_own_is_gone(void **state)
{
	(void)state;
	for (int kind = 0; kind < 2; kind++) {
		struct viewer viewer;
		struct fake_drm *drm = begin(kind);
		viewer_start(&viewer, NULL);
		viewer_run(&viewer, SECOND);
		plug(drm, 1, true);
		viewer_run(&viewer, SECOND);
		assert_int_not_equal(drm->objects[0].values[FAKE_CRTC_ID], 0);
		assert_int_equal(drm->objects[1].values[FAKE_CRTC_ID], 0);
		assert_int_equal(viewer.drawn, 1);
		plug(drm, 0, false);
		viewer_run(&viewer, SECOND);
		assert_true(display_is_on(viewer.display));
		size_t crtc = drm->objects[1].values[FAKE_CRTC_ID] - 10;
		viewer_assert_shows(&viewer, drm, crtc);
		/* And stays there. */
		plug(drm, 0, true);
		viewer_run(&viewer, SECOND);
		viewer_assert_shows(&viewer, drm, crtc);
		assert_int_equal(viewer.drawn, 2);
		viewer_assert_leaves_nothing(&viewer);
	}
}

static void other_monitors_are_left_alone(void **state)
{
	(void)state;
	for (int kind = 0; kind < 2; kind++) {
		struct viewer viewer;
		struct fake_drm *drm = begin(kind);
		plug(drm, 1, true);
		viewer_start(&viewer, &(struct display_options){.connector = "DP-1"});
		viewer_run(&viewer, SECOND);
		assert_int_equal(drm->crtcs[0].shown, FAKE_CONSOLE);
		viewer_assert_shows(&viewer, drm, 1);
		plug(drm, 1, false);
		viewer_run(&viewer, SECOND);
		assert_false(display_is_on(viewer.display));
		assert_int_equal(drm->crtcs[0].shown, FAKE_CONSOLE);
		plug(drm, 1, true);
		viewer_run(&viewer, SECOND);
		viewer_assert_shows(&viewer, drm, 1);
		viewer_assert_leaves_nothing(&viewer);
		assert_int_equal(drm->crtcs[0].shown, FAKE_CONSOLE);
		assert_int_equal(drm->crtcs[1].shown, 0);
	}
}

static void a_crtc_that_is_the_only_one_is_taken_over(void **state)
{
	(void)state;
	for (int kind = 0; kind < 2; kind++) {
		struct viewer viewer;
		struct fake_drm *drm = begin(kind);
		drm->connectors[0].possible_crtcs = drm->connectors[1].possible_crtcs = 1;
		plug(drm, 1, true);
		viewer_start(&viewer, &(struct display_options){.connector = "DP-1"});
		viewer_run(&viewer, SECOND);
		viewer_assert_runs(&viewer);
		assert_int_equal(drm->objects[0].values[FAKE_CRTC_ID], 0);
		viewer_assert_leaves_nothing(&viewer);
		assert_int_equal(drm->crtcs[0].shown, FAKE_CONSOLE);
		assert_int_equal(drm->objects[0].values[FAKE_CRTC_ID], 10);
	}
}

static void headsets_are_no_monitors(void **state)
{
	(void)state;
	struct viewer viewer;
	struct fake_drm *drm = begin(0);
	drm->objects[0].values[FAKE_NON_DESKTOP] = 1;
	viewer_start(&viewer, NULL);
	viewer_run(&viewer, 3 * SECOND);
	assert_false(display_is_on(viewer.display));
	plug(drm, 1, true);
	viewer_run(&viewer, SECOND);
	assert_int_not_equal(drm->objects[1].values[FAKE_CRTC_ID], 0);
	viewer_assert_leaves_nothing(&viewer);
}

static void a_broken_link_is_set_up_anew(void **state)
{
	(void)state;
	struct viewer viewer;
	struct fake_drm *drm = begin(0);
	viewer_start(&viewer, NULL);
	viewer_run(&viewer, SECOND);
	drm->objects[0].values[FAKE_LINK_STATUS] = 1;
	fake_world_tell();
	viewer_run(&viewer, SECOND);
	viewer_assert_runs(&viewer);
	assert_int_equal(drm->objects[0].values[FAKE_LINK_STATUS], 0);
	assert_int_equal(drm->steps[FAKE_SET_MODE], 2);
	viewer_run(&viewer, 60 * SECOND);
	assert_int_equal(drm->steps[FAKE_SET_MODE], 2);
	viewer_assert_leaves_nothing(&viewer);
}

/* Another program shows its own, with an overlay, and leaves it when it ends. */
static void show_other(struct fake_drm *drm)
{
	uint64_t *overlay = drm->objects[FAKE_OBJECTS - 1].values;
	fake_drm_light_console(drm);
	overlay[FAKE_FB_ID] = FAKE_CONSOLE;
	overlay[FAKE_CRTC_ID] = 10;
}

static void assert_other_is_gone(const struct fake_drm *drm)
{
	assert_int_equal(drm->objects[FAKE_OBJECTS - 1].values[FAKE_FB_ID], 0);
}

static void it_pauses_while_another_program_has_the_display(void **state)
{
	(void)state;
	for (int kind = 0; kind < 2; kind++) {
		for (int moves = 0; moves < 2; moves++) {
			struct viewer viewer;
			struct fake_drm *drm = begin(kind);
			viewer_start(&viewer, NULL);
			viewer.moves = moves;
			viewer_run(&viewer, SECOND);
			fake_drm_steal(drm);
			show_other(drm);
			viewer_run(&viewer, 10 * SECOND);
			assert_false(viewer.ended);
			assert_false(display_is_on(viewer.display));
			assert_int_equal(drm->crtcs[0].shown, FAKE_CONSOLE);
			assert_int_equal(viewer.warnings, 1);
			assert_non_null(
				strstr(viewer.warning, "another program has taken the display"));
			unsigned drawn = viewer.drawn;
			viewer.sleeps = 0;
			viewer_run(&viewer, 10 * SECOND);
			assert_int_equal(viewer.drawn, drawn);
			assert_in_range(viewer.sleeps, 9, 12);
			fake_drm_give_back(drm);
			viewer_run(&viewer, 2 * SECOND);
			viewer.moves = false;
			viewer_run(&viewer, SECOND);
			viewer_assert_runs(&viewer);
			assert_other_is_gone(drm);
			assert_int_equal(viewer.warnings, 1);
			viewer_assert_leaves_nothing(&viewer);
		}
	}
}

static void a_display_in_use_at_the_start_is_refused(void **state)
{
	(void)state;
	struct viewer viewer;
	struct fake_drm *drm = begin(0);
	drm->other_master = true;
	assert_false(viewer_init(&viewer, NULL));
	viewer_assert_ended(&viewer, "device /dev/dri/card0: it is in use by another program");
	assert_int_equal(viewer.error.status, SM_ERROR_MACHINE);
	viewer_assert_leaves_nothing(&viewer);
}

/* As a seat manager does: the device is taken away, and given back. */
static void set_seat(struct fake_drm *drm, bool active)
{
	fake_world.seat_active = active;
	fake_world.seat_activations += active;
	drm->other_master = !active;
	drm->master = active;
}

static void it_pauses_while_the_seat_is_away(void **state)
{
	(void)state;
	for (int kind = 0; kind < 2; kind++) {
		for (int moves = 0; moves < 2; moves++) {
			struct viewer viewer;
			struct fake_drm *drm = begin(kind);
			viewer_start(&viewer, NULL);
			viewer.moves = moves;
			viewer_run(&viewer, SECOND + SECOND / 100);
			set_seat(drm, false);
			drm->connectors[0].mode_count = 1; /* in the same mode */
			show_other(drm);
			viewer_run(&viewer, SECOND);
			assert_false(display_is_on(viewer.display));
			unsigned drawn = viewer.drawn;
			drm->calls = viewer.sleeps = 0;
			viewer_run(&viewer, 60 * SECOND);
			assert_int_equal(viewer.drawn, drawn);
			assert_int_equal(drm->calls, 0);
			assert_int_equal(viewer.sleeps, 1);
			set_seat(drm, true);
			viewer_run(&viewer, SECOND);
			viewer.moves = false;
			viewer_run(&viewer, SECOND);
			viewer_assert_runs(&viewer);
			assert_other_is_gone(drm);
			assert_int_equal(viewer.warnings, 0);
			viewer_assert_leaves_nothing(&viewer);
		}
	}
}

static void it_starts_on_a_seat_that_is_away(void **state)
{
	(void)state;
	struct viewer viewer;
	begin(0);
	fake_world.seat_active = false;
	viewer_start(&viewer, NULL);
	viewer_run(&viewer, 10 * SECOND);
	assert_int_equal(viewer.drawn, 0);
	fake_world.seat_active = true;
	fake_world.seat_activations++;
	viewer_run(&viewer, SECOND);
	viewer_assert_runs(&viewer);
	viewer_assert_leaves_nothing(&viewer);
}

static void a_seat_that_is_lost_ends_it(void **state)
{
	(void)state;
	struct viewer viewer;
	begin(0);
	viewer_start(&viewer, NULL);
	viewer_run(&viewer, SECOND);
	fake_world.seat_lost = true;
	viewer_run(&viewer, 10 * SECOND);
	viewer_assert_ended(&viewer, "the seat has gone");
	viewer_assert_leaves_nothing(&viewer);
}

static void replug_cycle(struct viewer *viewer, struct fake_drm *drm)
{
	plug(drm, 0, false);
	viewer_run(viewer, SECOND / 4);
	assert_false(display_is_on(viewer->display));
	plug(drm, 0, true);
	viewer_run(viewer, SECOND / 4);
	viewer_assert_runs(viewer);
}

static void nothing_grows_in_200_cycles(void **state)
{
	(void)state;
	for (int kind = 0; kind < 2; kind++) {
		struct viewer viewer;
		struct fake_drm *drm = begin(kind);
		viewer_start(&viewer, NULL);
		viewer_run(&viewer, SECOND);
		for (int i = 0; i < 3; i++)
			replug_cycle(&viewer, drm);
		unsigned count = fake_drm_count(drm);
		struct mallinfo2 before = mallinfo2();
		for (int i = 0; i < 200; i++)
			replug_cycle(&viewer, drm);
		struct mallinfo2 after = mallinfo2();
		assert_int_equal(fake_drm_count(drm), count);
		assert_in_range(after.uordblks, 0, before.uordblks + 1000);
		viewer_assert_leaves_nothing(&viewer);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		viewer_test(it_waits_for_the_first_monitor),
		viewer_test(it_sleeps_while_the_monitor_is_unplugged),
		viewer_test(it_follows_a_change_of_modes),
		viewer_test(a_monitor_without_the_wanted_mode_is_told_of_once),
		viewer_test(it_moves_to_another_monitor_when_its_own_is_gone),
		viewer_test(other_monitors_are_left_alone),
		viewer_test(a_crtc_that_is_the_only_one_is_taken_over),
		viewer_test(headsets_are_no_monitors),
		viewer_test(a_broken_link_is_set_up_anew),
		viewer_test(it_pauses_while_another_program_has_the_display),
		viewer_test(a_display_in_use_at_the_start_is_refused),
		viewer_test(it_pauses_while_the_seat_is_away),
		viewer_test(it_starts_on_a_seat_that_is_away),
		viewer_test(a_seat_that_is_lost_ends_it),
		viewer_test(nothing_grows_in_200_cycles),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
