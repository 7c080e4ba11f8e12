/* SPDX-License-Identifier: MIT */
/* Whether the coarse samples find what must be measured: against measuring every pixel. */
#include "load/stage.h"
#include "ref/picture.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

#define SIZE 192

struct tally {
	uint32_t judged, part;      /* pixels, and those that the coarse samples see in part */
	uint32_t found, missed;     /* in part too: next to a change, and not found to be */
	double found_by, missed_by; /* how far the coarse samples are off there, at most */
};

static double measure(const struct ref_picture *picture, uint32_t x, uint32_t y)
{
	struct sight sight;
	struct surface surface;
	struct fan fan;
	pinhole_sight(&picture->pinhole, x, y, &sight);
	assert_true(tracer_see(&picture->tracer, &sight, &surface) &&
		    lamp_fan(&picture->lamp, &surface, &fan));
	const struct disc *disc = &picture->fine;
	return (double)tracer_count_free(
		       &picture->tracer, &surface, &fan, disc->x, disc->y, disc->count) /
	       disc->count;
}

static void add_pixel(
	struct tally *tally, const struct ref_picture *picture, uint32_t x, uint32_t y)
{
	enum seen seen = picture->seen[y * SIZE + x];
	if (seen == SEEN_UNJUDGED)
		return;
	tally->judged++;
	if (seen == SEEN_PART) {
		tally->part++;
		return;
	}
	double coarse = seen == SEEN_LIT, v = picture->visibility[y * SIZE + x];
	if (v != coarse) {
		tally->found++;
		tally->found_by = fmax(tally->found_by, fabs(v - coarse));
	} else {
		double by = fabs(measure(picture, x, y) - coarse);
		tally->missed += by > 0;
		tally->missed_by = fmax(tally->missed_by, by);
	}
}

static struct tally trace(const char *scene, const char *radius)
{
	struct tally tally = {0};
	struct ref_picture picture;
	struct stage stage;
	struct sm_error error;
	const char *settings[] = {radius};
	if (!stage_load(&stage, scene, settings, 1, &error))
		fail_msg("%s", error.text);
	const struct reference_request request = {.scene = stage.scene,
		.camera = stage.camera,
		.width = SIZE,
		.height = SIZE,
		.samples = REFERENCE_SAMPLES};
	if (!ref_picture_init(&picture, &request, &error))
		fail_msg("%s", error.text);
	ref_picture_trace(&picture);
	for (uint32_t i = 0; i < SIZE * SIZE; i++)
		add_pixel(&tally, &picture, i % SIZE, i / SIZE);
	ref_picture_finish(&picture);
	stage_finish(&stage);
	return tally;
}

static void hardly_a_pixel_is_taken_for_lit_or_dark(void **state)
{
	(void)state;
	static const char *const scenes[] = {"builtin:fence", "builtin:urchin", "builtin:debris"};
	static const char *const radii[] = {"light.radius=0.057315", "light.radius=0.573149"};
	for (int i = 0; i < 6; i++) {
		struct tally tally = trace(scenes[i / 2], radii[i % 2]);
		print_message("%-14s R/d %s: %u pixels judged, %u seen in part; in addition %u "
			      "next to a change, by %.3f; %u missed, by %.3f\n",
			scenes[i / 2], i % 2 ? ".10" : ".01", tally.judged, tally.part, tally.found,
			tally.found_by, tally.missed, tally.missed_by);
		assert_true(tally.judged > 10000);
		assert_true(tally.missed < tally.judged / 500);
		assert_true(tally.missed_by < 0.02);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(hardly_a_pixel_is_taken_for_lit_or_dark),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
