/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "base/log.h"
#include "display_state.h"
#include <xf86drm.h>

void display_flip_done(struct display *display, bool waited, int64_t time)
{
	/* The first blank after something else is not a period away. */
	bool comparable = waited == display->clock.waits;
	uint64_t kept = display->clock.kept;
	uint64_t steps = display_clock_flip(&display->clock, waited, time);
	if (comparable && display->flip_follows && !display->flip_sets_mode && steps > 1 + kept)
		display->stats.missed += steps - 1 - kept;
	display->stats.flips++;
	display->flip_pending = false;
	/* A frame of a swapchain that was retired meanwhile is 0: it stays on the screen. */
	if (display->pending != 0) {
		swapchain_destroy(display->retired);
		display->retired = NULL;
		swapchain_release(display->swapchain, display->shown);
		display->shown = display->pending;
		display->pending = 0;
	}
	log_debug("flip: frame %llu shows tick %llu", (unsigned long long)display->stats.flips,
		(unsigned long long)display->drawn_tick);
}

/* A driver without vertical blanks counts none; without vsync flips do not wait for those there
 * are. */
static void on_flip(
	int fd, unsigned count, unsigned seconds, unsigned microseconds, unsigned crtc, void *data)
{
	struct display *display = data;
	(void)fd, (void)crtc;
	if (display->flip_pending)
		display_flip_done(display, count != 0 && !display->async_works,
			seconds * SECOND + microseconds * INT64_C(1000));
}

/* An event that never comes must not stop the picture for ever. */
static bool check_deadline(struct display *display, struct sm_error *error)
{
	if (!display->flip_pending || display_now() < display->flip_deadline)
		return true;
	if (display_device_is_gone(display))
		return display_device_removed(display, error);
	log_warning("%s: the driver does not tell that a frame is shown: going on",
		display->output.name);
	display_flip_done(display, false, display_now());
	return true;
}

bool display_read_events(struct display *display, struct sm_error *error)
{
	drmEventContext context = {.version = 3, .page_flip_handler2 = on_flip};
	struct pollfd ready = {.fd = display->device.fd, .events = POLLIN};
	/* Reading would wait. */
	while (poll(&ready, 1, 0) > 0 && ready.revents & POLLIN)
		if (drmHandleEvent(display->device.fd, &context) != 0)
			return error_set(error, SM_ERROR_MACHINE,
				"the events of the display device %s cannot be read",
				display->path);
	if (ready.revents & (POLLERR | POLLHUP | POLLNVAL))
		return display_device_removed(display, error);
	return check_deadline(display, error);
}

void display_await_flip(struct display *display)
{
	int64_t limit = display_now() + SECOND;
	while (display->flip_pending && !display->removed && display_now() < limit) {
		struct pollfd ready = {.fd = display->device.fd, .events = POLLIN};
		if (poll(&ready, 1, 50) > 0 && !display_read_events(display, NULL))
			break;
	}
}
