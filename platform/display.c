/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "base/error.h"
#include "base/log.h"
#include "display_state.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Where no event tells of a monitor: how often to look for one, and whether the one that shows the
 * picture is still there, which takes one call that asks the kernel alone. */
static const int64_t look_waiting = 2 * SECOND;
static const int64_t look_showing = 5 * SECOND;
static const int64_t look_never = INT64_MAX;

static bool read_options(
	struct display *display, const struct display_options *options, struct sm_error *error)
{
	display->options = *options;
	display->wish.connector = options->connector;
	if (options->mode != NULL && !mode_wish_parse(&display->wish.mode, options->mode))
		return error_set(error, SM_ERROR_INPUT,
			"no mode \"%.40s\": preferred, current, WIDTHxHEIGHT or "
			"WIDTHxHEIGHT@HZ is wanted",
			options->mode);
	if (options->rotation % 90 != 0 || options->rotation >= 360)
		return error_set(error, SM_ERROR_INPUT, "no rotation by %u: 0, 90, 180 or 270",
			options->rotation);
	if (options->format == NULL)
		return true;
	display->wish.format = pixel_format_find(options->format);
	return display->wish.format != NULL ||
	       error_set(error, SM_ERROR_INPUT,
		       "no format \"%.40s\": xrgb8888, xbgr8888, xrgb2101010 or rgb565",
		       options->format);
}

static bool has_output(const struct display *display)
{
	return display->output.name[0] != '\0';
}

/* Looks for a device where none is open, or for changes of the one that is. probe: ask monitors. */
static bool look(struct display *display, bool probe, bool first, struct sm_error *error)
{
	if (!display->has_context && !display_find_device(display, first, error))
		return false;
	if (display->has_context && !display_find_output(display, probe, error))
		return false;
	display->next_look = display_now() + (has_output(display) ? look_showing : look_waiting);
	return true;
}

struct display *display_create(const struct display_options *options, struct sm_error *error)
{
	struct display *display = array_zalloc(1, sizeof(*display));
	if (display == NULL) {
		error_no_memory(error);
		return NULL;
	}
	display->device.fd = display->fence = -1;
	display->clock.refresh = (struct refresh){60, 1};
	display->async_works = options->async;
	if (!read_options(display, options, error))
		goto error;
	display->seat = seat_create(error);
	display->hotplug = display->seat != NULL ? hotplug_create(error) : NULL;
	if (display->hotplug == NULL)
		goto error;
	display->activations = seat_activations(display->seat);
	if (seat_is_active(display->seat) && !look(display, true, true, error))
		goto error;
	if (!seat_is_active(display->seat))
		log_warning("another virtual terminal is shown: waiting for ours");
	else if (!has_output(display))
		log_warning("no monitor yet: waiting for one");
	return display;

error:
	display_destroy(display);
	return NULL;
}

void display_destroy(struct display *display)
{
	if (display == NULL)
		return;
	if (display->device.fd >= 0 && !display->removed) {
		display_await_flip(display);
		if (seat_is_active(display->seat) && !display->lost_master)
			kms_restore(&display->saved, &display->device);
	}
	display_drop_output(display, false);
	if (display->fence >= 0)
		close(display->fence);
	display_close_device(display);
	hotplug_destroy(display->hotplug);
	seat_destroy(display->seat);
	free(display);
}

/* Others may have used the device meanwhile. */
static void resume(struct display *display)
{
	display->activations = seat_activations(display->seat);
	display->mode_set = display->lost_master = false;
	display->stale = display->changed = true;
	log_info("the seat is ours again");
}

static bool read_hotplug(struct display *display, struct sm_error *error)
{
	switch (hotplug_read(display->hotplug, display->number)) {
	case HOTPLUG_REMOVED:
		return display_device_removed(display, error);
	case HOTPLUG_CHANGED:
		display->changed = true;
		return true;
	default:
		return true;
	}
}

static bool take_back(struct display *display, struct sm_error *error)
{
	if (!display->lost_master || display_now() < display->next_take)
		return true;
	switch (kms_device_take(&display->device)) {
	case KMS_DONE:
		log_info("the display is ours again");
		display->lost_master = false;
		display->stale = display->changed = true;
		return true;
	case KMS_GONE:
		return display_device_removed(display, error);
	default:
		if (!display->told_loss)
			log_warning("another program has taken the display: waiting for it to end");
		display->told_loss = true;
		display->next_take = display_now() + SECOND;
		return true;
	}
}

static bool look_if_due(struct display *display, struct sm_error *error)
{
	bool probe = display->changed || !has_output(display);
	if (display->lost_master || (!display->changed && display_now() < display->next_look))
		return true;
	display->changed = false;
	if (display->has_context && display_device_is_gone(display))
		return display_device_removed(display, error);
	/* A program that has come and gone leaves its own picture, or none. */
	if (display->mode_set && kms_device_take(&display->device) != KMS_DONE) {
		display_lose_master(display);
		return true;
	}
	return look(display, probe, false, error);
}

static bool update(struct display *display, struct sm_error *error)
{
	if (display->removed)
		return display_device_removed(display, error);
	if (!seat_dispatch(display->seat, error) || !read_hotplug(display, error))
		return false;
	if (display->device.fd >= 0 && !display_read_events(display, error))
		return false;
	if (!seat_is_active(display->seat))
		return true;
	if (seat_activations(display->seat) != display->activations)
		resume(display);
	return take_back(display, error) && look_if_due(display, error);
}

bool display_update(struct display *display, struct sm_error *error)
{
	int64_t start = display_thread_time();
	bool updated = update(display, error);
	display->stats.overhead += (double)(display_thread_time() - start) * 1e-6;
	return updated;
}

bool display_wants_frame(const struct display *display, bool changed)
{
	return has_output(display) && seat_is_active(display->seat) && !display->lost_master &&
	       !display->flip_pending && (changed || display->stale) &&
	       display_now() >= display->not_before &&
	       ((display->async_works && display->clock.kept == 0) ||
		       display_now() >= display_clock_next(&display->clock));
}

static void limit(int64_t *time, int64_t other)
{
	if (other < *time)
		*time = other;
}

size_t display_poll(
	const struct display *display, struct pollfd fds[DISPLAY_POLL_MAX], int64_t *timeout)
{
	const int all[] = {
		seat_fd(display->seat), hotplug_fd(display->hotplug), display->device.fd};
	size_t count = 0;
	for (size_t i = 0; i < DISPLAY_POLL_MAX; i++)
		if (all[i] >= 0)
			fds[count++] = (struct pollfd){.fd = all[i], .events = POLLIN};
	int64_t now = display_now(), time = look_never;
	if (display->flip_pending)
		limit(&time, display->flip_deadline);
	if (seat_is_active(display->seat)) {
		limit(&time, display->lost_master ? display->next_take : display->next_look);
		if (!display->flip_pending && display->not_before > now)
			limit(&time, display->not_before);
		if (!display->flip_pending && display_clock_next(&display->clock) > now)
			limit(&time, display_clock_next(&display->clock));
	}
	*timeout = time == look_never ? -1 : time > now ? time - now : 0;
	return count;
}

void display_get_refresh(const struct display *display, uint32_t *numerator, uint32_t *denominator)
{
	*numerator = display->clock.refresh.numerator;
	*denominator = display->clock.refresh.denominator;
}

bool display_is_on(const struct display *display)
{
	return has_output(display) && seat_is_active(display->seat) && !display->lost_master;
}

void display_get_stats(const struct display *display, struct display_stats *stats)
{
	*stats = display->stats;
}

void display_describe(const struct display *display, sm_fact fact, void *data)
{
	char text[100];
	fact(data, "seat", seat_name(display->seat));
	if (display->path != NULL)
		fact(data, "device", display->path);
	if (!has_output(display)) {
		fact(data, "monitor", "none");
		return;
	}
	const drmModeModeInfo *mode = &display->output.mode;
	struct refresh refresh = display->clock.refresh;
	fact(data, "monitor", display->output.name);
	snprintf(text, sizeof(text), "%ux%u", mode->hdisplay, mode->vdisplay);
	fact(data, "mode", text);
	snprintf(text, sizeof(text), "%u/%u", refresh.numerator, refresh.denominator);
	fact(data, "refresh", text);
	fact(data, "format", display->output.format->name);
	fact(data, "mode-setting", display->kms->name);
	if (display->swapchain != NULL)
		fact(data, "buffers", display_buffers(display));
	snprintf(text, sizeof(text), "%u by the %s", display->options.rotation,
		display->target.rotation != 0 ? "GPU" : "plane");
	fact(data, "rotation", display->options.rotation == 0 ? "0" : text);
}
