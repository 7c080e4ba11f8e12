/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_DISPLAY_STATE_H
#define PLATFORM_DISPLAY_STATE_H

#include "display.h"
#include "display_clock.h"
#include "egl.h"
#include "hotplug.h"
#include "kms_saved.h"
#include "platform.h"
#include "seat.h"
#include "swapchain.h"

/** A way to bring pictures to the screen. */
struct attempt {
	enum { BUFFERS_GBM_MODIFIERS, BUFFERS_GBM, BUFFERS_DUMB } buffers;
	bool plane_turns; /* the rotation is done by the plane */
};

#define ATTEMPTS_MAX 6

/*
 * What is set depends on what stands before it: a device is open while there is a monitor or one
 * was there; an output needs a device and a context, a swapchain an output; the mode is set while
 * the output shows a frame of the swapchain.
 */
struct display {
	struct display_options options;
	struct kms_wish wish;
	struct seat *seat;
	struct hotplug *hotplug;
	unsigned activations; /* of the seat, that are dealt with */

	char *path;   /* of the device; NULL: none */
	dev_t number; /* its device number */
	struct kms_device device;
	const struct kms_interface *kms;
	struct gbm_device *gbm;     /* NULL: the device has none */
	struct egl egl;             /* the context, if it is on gbm */
	struct platform *elsewhere; /* the context, if it is not */
	bool has_context;

	struct kms_output output; /* name "": none */
	struct kms_saved saved;
	struct attempt attempts[ATTEMPTS_MAX];
	size_t attempt_count, attempt;
	struct swapchain *swapchain; /* of the attempt */
	struct swapchain *retired;   /* may be on the screen until the next frame is */
	struct display_target target;

	bool mode_set;
	bool stale;       /* the screen has lost the picture */
	bool lost_master; /* to another program, while our seat is active */
	bool told_loss;   /* so the log knows */
	bool changed;     /* monitors have to be looked for */
	bool removed;     /* the device */
	bool async_works;

	uint32_t shown, pending; /* framebuffers; 0: none */
	bool flip_pending, flip_sets_mode;
	uint64_t drawn_tick; /* that the last frame was drawn for */
	bool flip_follows;   /* was begun at once after the one before */
	uint32_t failures;   /* of commits, in a row */
	int fence;           /* of the last commit; -1: none */

	/* ns of the monotonic clock */
	int64_t flip_deadline, next_look, next_take, not_before;

	struct display_clock clock;
	struct display_stats stats;
};

/** In ns, as all times. */
#define SECOND INT64_C(1000000000)

/** ns of the monotonic clock. */
int64_t display_now(void);
/** ns of processor time of this thread. */
int64_t display_thread_time(void);

/** Another program has the device: it will be asked for until it can be had again. */
void display_lose_master(struct display *display);

/** The paths that display devices have, and what to say when there are none. */
#define DISPLAY_DEVICES "/dev/dri/card*"
bool display_no_device(struct sm_error *error);

/** Looks for a monitor on all devices, or the one of the options, and opens the device that has
 *  one. Without a monitor nothing stays open. first: a device in use is an error. */
bool display_find_device(struct display *display, bool first, struct sm_error *error);
/** Whether the kernel still knows the open device. */
bool display_device_is_gone(const struct display *display);
bool display_device_removed(struct display *display, struct sm_error *error);
/** Closes device and context. */
void display_close_device(struct display *display);

/** Looks at the monitors of the open device, and follows what has changed. */
bool display_find_output(struct display *display, bool probe, struct sm_error *error);
/** Goes on with the next way to show pictures, after `why`. Fails when none is left. */
bool display_next_attempt(
	struct display *display, const struct sm_error *why, struct sm_error *error);
/** The kind of buffers of the current way. */
const char *display_buffers(const struct display *display);
/** Lets the output go; off: switches it off. */
void display_drop_output(struct display *display, bool off);

/** Handles the events that have arrived. Fails (MACHINE) when there will be no more. */
bool display_read_events(struct display *display, struct sm_error *error);
/** Waits for a frame on its way, a second at most. */
void display_await_flip(struct display *display);
/** The frame on its way has appeared, at a time of the monotonic clock; waited: for a vertical
 *  blank. */
void display_flip_done(struct display *display, bool waited, int64_t time);

#endif
