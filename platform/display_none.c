/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "display.h"

static bool refuse(struct sm_error *error)
{
	return error_set(error, SM_ERROR_INPUT,
		"a display needs GBM and libdrm, which this smoothie was built without");
}

struct display *display_create(const struct display_options *options, struct sm_error *error)
{
	(void)options;
	refuse(error);
	return NULL;
}

void display_destroy(struct display *display)
{
	(void)display;
}

size_t display_poll(
	const struct display *display, struct pollfd fds[DISPLAY_POLL_MAX], int64_t *timeout)
{
	(void)display, (void)fds;
	*timeout = -1;
	return 0;
}

bool display_update(struct display *display, struct sm_error *error)
{
	(void)display;
	return refuse(error);
}

bool display_wants_frame(const struct display *display, bool changed)
{
	(void)display, (void)changed;
	return false;
}

bool display_begin(struct display *display, struct display_target *target, struct sm_error *error)
{
	(void)display, (void)target;
	return refuse(error);
}

bool display_end(struct display *display, const uint8_t *rgba, struct sm_error *error)
{
	(void)display, (void)rgba;
	return refuse(error);
}

void display_keep(struct display *display)
{
	(void)display;
}

uint64_t display_tick(const struct display *display)
{
	(void)display;
	return 0;
}

void display_get_refresh(const struct display *display, uint32_t *numerator, uint32_t *denominator)
{
	(void)display;
	*numerator = *denominator = 1;
}

bool display_is_on(const struct display *display)
{
	(void)display;
	return false;
}

void display_get_stats(const struct display *display, struct display_stats *stats)
{
	(void)display;
	*stats = (struct display_stats){0};
}

void display_describe(const struct display *display, sm_fact fact, void *data)
{
	(void)display, (void)fact, (void)data;
}

bool display_list(const char *device, FILE *file, struct sm_error *error)
{
	(void)device, (void)file;
	return refuse(error);
}
