/* SPDX-License-Identifier: MIT */
#ifndef TESTS_DISPLAY_VIEWER_H
#define TESTS_DISPLAY_VIEWER_H

#include "display.h"
#include "fake_drm.h"

/** A program that shows made-up pictures on the fake devices, as "smoothie show" does. */
struct viewer {
	struct display *display;
	bool moves;     /* every frame is another picture */
	unsigned pause; /* it moves once in so many ticks; 0: in each */
	unsigned kept;  /* ticks between that it was told to do without a frame */
	bool ended;     /* by *error */
	struct sm_error error;
	unsigned picture; /* number of the one that is wanted */
	unsigned drawn;   /* frames */
	unsigned sleeps;  /* times that it had to wait */
	uint8_t *rgba;    /* of the last, rows from the bottom */
	struct display_target target;
	unsigned warnings;
	char warning[200]; /* the last */
};

#define VIEWER_SECOND INT64_C(1000000000)

/** Fails, with *error, when there is no display to be had. */
bool viewer_init(struct viewer *viewer, const struct display_options *options);
/** viewer_init(), which must not fail. */
void viewer_start(struct viewer *viewer, const struct display_options *options);
/** Ends the display. */
void viewer_finish(struct viewer *viewer);

/** Goes on for that many ns, or until the display ends. */
void viewer_run(struct viewer *viewer, int64_t nanoseconds);

/** Asserts that CRTC `crtc` shows the last picture, as drawn for framebuffers unturned. */
void viewer_assert_shows(const struct viewer *viewer, struct fake_drm *drm, size_t crtc);
/** Asserts that the display runs and shows the picture that is wanted, on CRTC 0 of device 0. */
void viewer_assert_runs(const struct viewer *viewer);
/** Asserts that it has ended with that in its one line. */
void viewer_assert_ended(const struct viewer *viewer, const char *text);
/** Ends it and asserts that nothing of its own is left on the fake devices. */
void viewer_assert_leaves_nothing(struct viewer *viewer);

/** cmocka set-up and tear-down: the world as it was in the beginning, and descriptors counted. */
int viewer_setup(void **state);
int viewer_teardown(void **state);
#define viewer_test(test) cmocka_unit_test_setup_teardown(test, viewer_setup, viewer_teardown)

#endif
