/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "base/log.h"
#include "display_state.h"
#include <errno.h>
#include <string.h>
#include <unistd.h>

/* A driver that takes longer to show a frame has lost it. Setting a mode may take a while. */
static const int64_t flip_limit = 3 * SECOND;
/* After a commit that failed for want of something that may come. */
static const int64_t pause_after_failure = SECOND / 10;
/* In a row: after these it will not come. */
enum { FAILURES_MAX = 50 };

bool display_begin(struct display *display, struct display_target *target, struct sm_error *error)
{
	/* Not every driver survives drawing to a device that is gone. */
	if (display_device_is_gone(display))
		return display_device_removed(display, error);
	/* From the next tick on where nothing waits for blanks, before it where the driver does. */
	int64_t due = display_clock_next(&display->clock) + display_clock_period(&display->clock);
	display->flip_follows = display_now() < due;
	if (!display->target.takes_pixels)
		egl_wait(&display->egl, display->fence);
	else if (display->fence >= 0)
		close(display->fence);
	display->fence = -1;
	display->drawn_tick = display_tick(display);
	*target = display->target;
	return swapchain_begin(display->swapchain, error);
}

static enum kms_result commit(struct display *display, const struct kms_frame *frame)
{
	enum kms_result result = KMS_REFUSED;
	display->flip_sets_mode = !display->mode_set;
	if (display->mode_set) {
		bool async = display->async_works;
		result = display->kms->flip(
			&display->device, &display->output, frame, async, display);
		if (result == KMS_REFUSED && async) {
			log_warning("%s: the driver has no flips without vsync: flips wait for the "
				    "vertical blank",
				display->output.name);
			display->async_works = false;
			result = display->kms->flip(
				&display->device, &display->output, frame, false, display);
		}
	}
	/* Drivers without flips can set a mode for every frame. */
	if (result == KMS_REFUSED) {
		display->flip_sets_mode = true;
		result = display->kms->set_mode(&display->device, &display->output, frame, display);
	}
	return result;
}

static void commit_done(struct display *display, uint32_t framebuffer)
{
	display->pending = framebuffer;
	display->flip_pending = true;
	display->flip_deadline = display_now() + flip_limit;
	display->mode_set = true;
	display->stale = false;
	display->failures = 0;
	if (display->flip_sets_mode && !display->kms->set_mode_sends_event)
		display_flip_done(display, false, display_now());
}

/* Nothing came of the frame: it will be asked for again, when that may help. */
static bool commit_failed(struct display *display, enum kms_result result, struct sm_error *error)
{
	struct sm_error why;
	int code = errno;
	display->stale = true;
	error_set(&why, SM_ERROR_MACHINE, "the driver refuses the frame (%s)", strerror(code));
	switch (result) {
	case KMS_GONE:
		return display_device_removed(display, error);
	case KMS_NO_MASTER:
		display_lose_master(display);
		return true;
	case KMS_REFUSED:
		return display_next_attempt(display, &why, error);
	default:
		if (display->failures++ < FAILURES_MAX) {
			display->not_before = display_now() + pause_after_failure;
			return true;
		}
		return error_set(error, SM_ERROR_MACHINE, "%s cannot show a frame (%s)",
			display->output.name, strerror(code));
	}
}

bool display_end(struct display *display, const uint8_t *rgba, struct sm_error *error)
{
	struct kms_frame frame;
	struct sm_error why;
	if (!swapchain_end(display->swapchain, rgba, &frame, &why)) {
		if (display_device_is_gone(display))
			return display_device_removed(display, error);
		return display_next_attempt(display, &why, error);
	}
	bool has_fences = !display->target.takes_pixels && display->egl.native_fences;
	display->stats.frames++;
	frame.rotation =
		display->attempts[display->attempt].plane_turns ? display->options.rotation : 0;
	frame.out_fence = has_fences ? &display->fence : NULL;
	int64_t start = display_thread_time();
	enum kms_result result = commit(display, &frame);
	int code = errno;
	display->stats.overhead += (double)(display_thread_time() - start) * 1e-6;
	if (frame.in_fence >= 0)
		close(frame.in_fence);
	if (result == KMS_DONE) {
		commit_done(display, frame.framebuffer);
		return true;
	}
	swapchain_release(display->swapchain, frame.framebuffer);
	errno = code;
	return commit_failed(display, result, error);
}
