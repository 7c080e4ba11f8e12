/* SPDX-License-Identifier: MIT */
#include "viewer.h"
#include "base/log.h"
#include "pixel_format.h"
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void note_warning(void *data, enum sm_log_level level, const char *line)
{
	struct viewer *viewer = data;
	if (level > SM_LOG_WARNING)
		return;
	viewer->warnings++;
	snprintf(viewer->warning, sizeof(viewer->warning), "%s", line);
}

bool viewer_init(struct viewer *viewer, const struct display_options *options)
{
	static const struct display_options none;
	*viewer = (struct viewer){.picture = 1};
	log_set_sink(note_warning, viewer);
	viewer->display = display_create(options != NULL ? options : &none, &viewer->error);
	viewer->ended = viewer->display == NULL;
	return !viewer->ended;
}

void viewer_start(struct viewer *viewer, const struct display_options *options)
{
	if (!viewer_init(viewer, options))
		fail_msg("%s", viewer->error.text);
}

void viewer_finish(struct viewer *viewer)
{
	display_destroy(viewer->display);
	viewer->display = NULL;
	free(viewer->rgba);
	viewer->rgba = NULL;
	log_set_sink(NULL, NULL);
}

static size_t picture_size(const struct viewer *viewer)
{
	return (size_t)viewer->target.width * viewer->target.height * 4;
}

/* Pictures differ in a few rows, as those of a scene in which something moves. */
static void draw_picture(struct viewer *viewer)
{
	uint32_t rows =
		viewer->target.rotation % 180 != 0 ? viewer->target.width : viewer->target.height;
	size_t row_size = picture_size(viewer) / rows;
	for (uint32_t y = 0; y < rows; y++) {
		unsigned last_change = viewer->picture - (viewer->picture + y) % 7;
		for (size_t i = 0; i < row_size; i++)
			viewer->rgba[y * row_size + i] =
				(uint8_t)(last_change * 2654435761u >> (i % 3 * 8)) ^
				(uint8_t)(y + i);
	}
}

static bool draw_frame(struct viewer *viewer)
{
	struct display_target before = viewer->target;
	if (!display_begin(viewer->display, &viewer->target, &viewer->error))
		return false;
	assert_true(viewer->target.takes_pixels);
	if (memcmp(&before, &viewer->target, sizeof(before)) != 0) {
		free(viewer->rgba);
		viewer->rgba = malloc(picture_size(viewer));
		assert_non_null(viewer->rgba);
	}
	if (viewer->moves)
		viewer->picture++;
	draw_picture(viewer);
	fake_world_wait(VIEWER_SECOND / 1000);
	viewer->drawn++;
	return display_end(viewer->display, viewer->rgba, &viewer->error);
}

/* Between two moves. */
static bool is_shown(const struct viewer *viewer)
{
	return viewer->pause > 0 && display_tick(viewer->display) % viewer->pause != 0 &&
	       !display_wants_frame(viewer->display, false);
}

static bool step(struct viewer *viewer, int64_t end)
{
	struct pollfd fds[DISPLAY_POLL_MAX];
	int64_t timeout, left = end - fake_world.now;
	if (!display_update(viewer->display, &viewer->error))
		return false;
	bool wanted = display_wants_frame(viewer->display, viewer->moves);
	if (wanted && !is_shown(viewer))
		return draw_frame(viewer);
	if (wanted) {
		viewer->kept++;
		display_keep(viewer->display);
		return true;
	}
	size_t count = display_poll(viewer->display, fds, &timeout);
	if (timeout < 0 || timeout > left)
		timeout = left;
	viewer->sleeps++;
	fake_world_poll(fds, count, timeout);
	return true;
}

void viewer_run(struct viewer *viewer, int64_t nanoseconds)
{
	int64_t end = fake_world.now + nanoseconds, before = -1;
	unsigned still = 0;
	while (!viewer->ended && fake_world.now < end) {
		viewer->ended = !step(viewer, end);
		still = fake_world.now == before ? still + 1 : 0;
		before = fake_world.now;
		if (still > 1000)
			fail_msg("it spins");
	}
}

void viewer_assert_shows(const struct viewer *viewer, struct fake_drm *drm, size_t index)
{
	const struct fake_crtc *crtc = &drm->crtcs[index];
	assert_non_null(crtc->screen);
	assert_int_equal((size_t)crtc->width * crtc->height * 4, picture_size(viewer));
	const struct pixel_format *format =
		pixel_format_of(fake_framebuffer(drm, crtc->shown)->format);
	uint8_t *row = malloc(crtc->row_size);
	assert_non_null(row);
	for (uint32_t y = 0; y < crtc->height; y++) {
		pixel_format_pack(format,
			viewer->rgba + (size_t)(crtc->height - 1 - y) * crtc->width * 4,
			crtc->width, row);
		if (memcmp(row, crtc->screen + y * crtc->row_size, crtc->row_size) != 0)
			fail_msg("row %u is not that of picture %u", y, viewer->picture);
	}
	free(row);
}

void viewer_assert_runs(const struct viewer *viewer)
{
	if (viewer->ended)
		fail_msg("it has ended: %s", viewer->error.text);
	assert_true(display_is_on(viewer->display));
	viewer_assert_shows(viewer, fake_drm_at(0), 0);
}

void viewer_assert_ended(const struct viewer *viewer, const char *text)
{
	assert_true(viewer->ended);
	assert_int_not_equal(viewer->error.status, SM_OK);
	assert_null(strchr(viewer->error.text, '\n'));
	if (strstr(viewer->error.text, text) == NULL)
		fail_msg("wanted \"%s\", got \"%s\"", text, viewer->error.text);
}

void viewer_assert_leaves_nothing(struct viewer *viewer)
{
	viewer_finish(viewer);
	for (size_t i = 0; i < 2; i++) {
		assert_int_equal(fake_drm_at(i)->left, 0);
		assert_int_equal(fake_drm_at(i)->fd, -1);
		assert_int_equal(fake_drm_count(fake_drm_at(i)), 0);
	}
}

static size_t count_descriptors(void)
{
	size_t count = 0;
	DIR *folder = opendir("/proc/self/fd");
	assert_non_null(folder);
	while (readdir(folder) != NULL)
		count++;
	closedir(folder);
	return count;
}

static size_t descriptors;

int viewer_setup(void **state)
{
	(void)state;
	fake_world_reset();
	descriptors = count_descriptors();
	return 0;
}

int viewer_teardown(void **state)
{
	(void)state;
	fake_drm_finish();
	size_t left = count_descriptors();
	if (left != descriptors)
		print_error("descriptors: %zu before, %zu after\n", descriptors, left);
	return left == descriptors ? 0 : -1;
}
