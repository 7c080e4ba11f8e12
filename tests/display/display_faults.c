/* SPDX-License-Identifier: MIT */
/* What fails once or always, at each step: a right picture follows, or an end with one clear line;
 * and nothing stays behind. */
#include "viewer.h"
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SECOND VIEWER_SECOND

struct fault_case {
	enum fake_step step;
	struct fake_fault fault;
	const char *end; /* of the one line; NULL: it goes on */
};

#define REFUSED \
	"HDMI-A-1 cannot show 64x48 in xrgb8888: the driver refuses the frame (Invalid argument)"
#define NO_BUFFER "HDMI-A-1 cannot show 64x48 in xrgb8888: "
#define REMOVED "the display device /dev/dri/card0 was removed"

static const struct fault_case cases[] = {
	{FAKE_SET_MODE, {EBUSY, 0, 1}, NULL},
	{FAKE_SET_MODE, {EBUSY, 0, 0}, "HDMI-A-1 cannot show a frame (Device or resource busy)"},
	{FAKE_SET_MODE, {EINVAL, 0, 1}, REFUSED},
	{FAKE_SET_MODE, {ENOMEM, 0, 1}, NULL},
	{FAKE_SET_MODE, {ENOMEM, 0, 0}, "HDMI-A-1 cannot show a frame (Cannot allocate memory)"},
	{FAKE_SET_MODE, {EACCES, 0, 1}, NULL},
	{FAKE_SET_MODE, {ENODEV, 0, 1}, REMOVED},
	/* The first flip. */
	{FAKE_FLIP, {EBUSY, 0, 1}, NULL},
	{FAKE_FLIP, {EBUSY, 0, 0}, "HDMI-A-1 cannot show a frame (Device or resource busy)"},
	{FAKE_FLIP, {EINVAL, 0, 1}, NULL},
	{FAKE_FLIP, {EINVAL, 0, 0}, NULL}, /* it sets the mode for each frame */
	{FAKE_FLIP, {ENOMEM, 0, 1}, NULL},
	{FAKE_FLIP, {EACCES, 0, 1}, NULL},
	{FAKE_FLIP, {ENODEV, 0, 1}, REMOVED},
	/* Later ones. */
	{FAKE_FLIP, {EBUSY, 5, 7}, NULL},
	{FAKE_FLIP, {EINVAL, 5, 1}, NULL},
	{FAKE_FLIP, {ENOMEM, 5, 7}, NULL},
	{FAKE_FLIP, {ENOMEM, 5, 0}, "HDMI-A-1 cannot show a frame (Cannot allocate memory)"},
	{FAKE_FLIP, {EACCES, 5, 1}, NULL},
	{FAKE_FLIP, {ENODEV, 5, 1}, REMOVED},
	{FAKE_SWITCH_OFF, {EBUSY, 0, 0}, NULL},
	{FAKE_SWITCH_OFF, {EINVAL, 0, 0}, NULL},
	{FAKE_SWITCH_OFF, {EACCES, 0, 0}, NULL},
	/* The first is made by its format, then by its depth. */
	{FAKE_ADD_FRAMEBUFFER, {EINVAL, 0, 1}, NULL},
	{FAKE_ADD_FRAMEBUFFER, {EINVAL, 0, 2},
		NO_BUFFER "making a framebuffer of a dumb buffer fails (Invalid argument)"},
	{FAKE_ADD_FRAMEBUFFER, {ENOMEM, 1, 0},
		NO_BUFFER "making a framebuffer of a dumb buffer fails (Cannot allocate memory)"},
	{FAKE_CREATE_DUMB, {ENOMEM, 0, 1},
		NO_BUFFER "making a dumb buffer fails (Cannot allocate memory)"},
	{FAKE_CREATE_DUMB, {EINVAL, 1, 1},
		NO_BUFFER "making a dumb buffer fails (Invalid argument)"},
	{FAKE_MAP_DUMB, {EINVAL, 0, 1}, NO_BUFFER "mapping a dumb buffer fails (Invalid argument)"},
	{FAKE_MMAP, {ENOMEM, 1, 1},
		NO_BUFFER "mapping a dumb buffer fails (Cannot allocate memory)"},
};

/* Only atomic mode-setting makes blobs: of the mode, and of what changes. */
static const struct fault_case atomic_cases[] = {
	{FAKE_CREATE_BLOB, {ENOMEM, 0, 1}, NULL},
	{FAKE_CREATE_BLOB, {ENOMEM, 0, 0}, "HDMI-A-1 cannot show a frame (Cannot allocate memory)"},
	{FAKE_CREATE_BLOB, {ENOMEM, 1, 3}, NULL},
	{FAKE_CREATE_BLOB, {ENOMEM, 1, 0}, NULL},
};

static void unplug_and_replug(struct viewer *viewer, struct fake_drm *drm)
{
	drm->connectors[0].plugged = false;
	fake_world_tell();
	viewer_run(viewer, SECOND);
	drm->connectors[0].plugged = true;
	fake_world_tell();
	viewer_run(viewer, SECOND);
}

static void check(const struct fake_abilities *can, const struct fault_case *fault)
{
	struct viewer viewer;
	fake_world_reset();
	struct fake_drm *drm = fake_drm_init(0, can);
	drm->faults[fault->step] = fault->fault;
	if (viewer_init(&viewer, NULL)) {
		viewer.moves = true;
		viewer_run(&viewer, 4 * SECOND);
		if (fault->step == FAKE_SWITCH_OFF)
			unplug_and_replug(&viewer, drm);
		viewer.moves = false;
		viewer_run(&viewer, 8 * SECOND);
	}
	if (fault->end != NULL)
		viewer_assert_ended(&viewer, fault->end);
	else
		viewer_assert_runs(&viewer);
	/* A display that could be taken back at once was not taken away by another program. */
	assert_int_equal(viewer.warnings, 0);
	viewer_assert_leaves_nothing(&viewer);
}

static void a_fault_is_followed_by_a_right_picture_or_a_clear_end(void **state)
{
	(void)state;
	static const struct fake_abilities kinds[] = {
		{0}, {.damage = true}, {.no_atomic = true}, {.no_atomic = true, .no_blanks = true}};
	for (size_t kind = 0; kind < 4; kind++)
		for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
			check(&kinds[kind], &cases[i]);
}

static void blobs_that_cannot_be_made_cost_no_picture(void **state)
{
	(void)state;
	static const struct fake_abilities can = {.damage = true};
	for (size_t i = 0; i < sizeof(atomic_cases) / sizeof(atomic_cases[0]); i++)
		check(&can, &atomic_cases[i]);
}

static void what_a_lost_frame_changed_is_part_of_the_next_damage(void **state)
{
	(void)state;
	struct viewer viewer;
	struct fake_drm *drm = fake_drm_init(0, &(struct fake_abilities){.damage = true});
	viewer_start(&viewer, NULL);
	viewer.moves = true;
	viewer_run(&viewer, SECOND);
	/* The next frame gets lost, and the picture stays as it is in that one. */
	drm->faults[FAKE_FLIP] = (struct fake_fault){EBUSY, 0, 1};
	while (drm->faults[FAKE_FLIP].code != 0)
		viewer_run(&viewer, SECOND / 1000);
	viewer.moves = false;
	viewer_run(&viewer, SECOND);
	viewer_assert_runs(&viewer);
	viewer_assert_leaves_nothing(&viewer);
}

static void an_event_that_never_comes_does_not_stop_the_picture(void **state)
{
	(void)state;
	for (int legacy = 0; legacy < 2; legacy++) {
		struct viewer viewer;
		fake_world_reset();
		struct fake_drm *drm = fake_drm_init(0, &(struct fake_abilities){0});
		viewer_start(&viewer, &(struct display_options){.legacy = legacy});
		viewer.moves = true;
		viewer_run(&viewer, SECOND);
		drm->withholds_events = true;
		viewer_run(&viewer, 5 * SECOND);
		assert_in_range(viewer.warnings, 1, 2);
		assert_non_null(strstr(viewer.warning, "does not tell that a frame is shown"));
		drm->withholds_events = false;
		viewer_run(&viewer, 4 * SECOND);
		viewer.moves = false;
		viewer_run(&viewer, SECOND);
		viewer_assert_runs(&viewer);
		viewer_assert_leaves_nothing(&viewer);
	}
}

static void a_device_that_is_removed_ends_it(void **state)
{
	(void)state;
	/* While it moves; while it is still, with news of it, and without. */
	for (int way = 0; way < 3; way++) {
		struct viewer viewer;
		fake_world_reset();
		struct fake_drm *drm = fake_drm_init(0, &(struct fake_abilities){0});
		viewer_start(&viewer, NULL);
		viewer.moves = way == 0;
		viewer_run(&viewer, SECOND);
		drm->gone = true;
		if (way == 1)
			fake_world.news = HOTPLUG_REMOVED;
		viewer_run(&viewer, way == 2 ? 6 * SECOND : SECOND / 10);
		viewer_assert_ended(&viewer, REMOVED);
		assert_false(display_update(viewer.display, NULL));
		assert_int_equal(viewer.warnings, 0);
		viewer_finish(&viewer);
	}
}

/* Drivers may crash when they draw to it. */
static void nothing_is_drawn_for_a_device_that_is_gone(void **state)
{
	(void)state;
	struct viewer viewer;
	struct display_target target;
	struct sm_error error = {0};
	fake_world_reset();
	struct fake_drm *drm = fake_drm_init(0, &(struct fake_abilities){0});
	viewer_start(&viewer, NULL);
	viewer_run(&viewer, SECOND);
	drm->gone = true;
	assert_true(display_wants_frame(viewer.display, true));
	assert_false(display_begin(viewer.display, &target, &error));
	assert_string_equal(error.text, REMOVED);
	assert_int_equal(error.status, SM_ERROR_MACHINE);
	viewer_finish(&viewer);
}

/* It was there at the start: that it is not any more is no mistake of the user's. */
static void a_device_may_go_while_its_monitor_is_waited_for(void **state)
{
	(void)state;
	struct viewer viewer;
	fake_world_reset();
	struct fake_drm *drm = fake_drm_init(0, &(struct fake_abilities){0});
	drm->connectors[0].plugged = false;
	viewer_start(&viewer, &(struct display_options){.device = "/dev/dri/card0"});
	viewer_run(&viewer, SECOND);
	drm->gone = true;
	viewer_run(&viewer, 5 * SECOND);
	viewer_assert_ended(&viewer, "device /dev/dri/card0: No such file or directory");
	assert_int_equal(viewer.error.status, SM_ERROR_MACHINE);
	viewer_finish(&viewer);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		viewer_test(a_fault_is_followed_by_a_right_picture_or_a_clear_end),
		viewer_test(blobs_that_cannot_be_made_cost_no_picture),
		viewer_test(what_a_lost_frame_changed_is_part_of_the_next_damage),
		viewer_test(an_event_that_never_comes_does_not_stop_the_picture),
		viewer_test(a_device_that_is_removed_ends_it),
		viewer_test(nothing_is_drawn_for_a_device_that_is_gone),
		viewer_test(a_device_may_go_while_its_monitor_is_waited_for),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
