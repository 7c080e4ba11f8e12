/* SPDX-License-Identifier: MIT */
/* How far the visibility that a technique draws is off the truth, in a picture and from frame to
 * frame. */
#include "app/bench_cell.h"
#include "app/bench_view.h"
#include "app/output.h"
#include "bench/contents.h"
#include "bench/difference.h"
#include "bench/sheet.h"
#include "bench/visibility_error.h"
#include "page/png.h"
#include "platform.h"
#include "ref/reference.h"
#include <limits.h>
#include <stdio.h>
#include <string.h>

#define FLICKER_FRAMES 6
#define FLICKER_SIZE 256 /* pixels a side at most */

/* How long a reference takes, in pictures. */
#define TRUTH_STEPS 20
#define FLICKER_TRUTH_STEPS 6

/* A light's visibility, drawn and true. */
struct gallery {
	struct bench_view view;
	struct reference truth[FLICKER_FRAMES]; /* by frame */
	uint32_t frames;
};

/* How far a reference is, as steps of the cell. */
struct advance {
	const struct bench_cell *cell;
	uint32_t steps, counted;
};

static void advance(void *data, double share)
{
	struct advance *advance = data;
	uint32_t now = (uint32_t)(share * advance->steps);
	*advance->cell->steps += now - advance->counted;
	advance->counted = now;
}

static bool trace(struct gallery *gallery, const struct bench_cell *cell, uint32_t frame,
	uint32_t steps, struct sm_error *error)
{
	struct advance so_far = {cell, steps, 0};
	struct reference_request request = {
		.scene = gallery->view.stage.scene,
		.camera = gallery->view.stage.camera,
		.width = gallery->view.target.width,
		.height = gallery->view.target.height,
		.samples = cell->options->samples,
		.cache = cell->cache,
		.progress = advance,
		.progress_data = &so_far,
	};
	bool traced = stage_set_time(&gallery->view.stage, frame, error) &&
		      reference_trace(&gallery->truth[frame], &request, error);
	advance(&so_far, 1); /* one from the cache tells nothing */
	return traced;
}

static bool gallery_init(struct gallery *gallery, const struct bench_cell *cell,
	struct bench_size size, uint32_t frames, uint32_t steps, struct sm_error *error)
{
	if (!bench_cell_load(cell, size, &gallery->view.stage, error) ||
		!bench_view_init(&gallery->view, error))
		return false;
	for (gallery->frames = 0; gallery->frames < frames; gallery->frames++)
		if (!trace(gallery, cell, gallery->frames, steps, error))
			return false;
	return true;
}

static void gallery_finish(struct gallery *gallery)
{
	for (uint32_t frame = 0; frame < gallery->frames; frame++)
		reference_finish(&gallery->truth[frame]);
	bench_view_finish(&gallery->view);
}

static bool draw(struct gallery *gallery, struct sm_renderer *renderer, uint32_t frame,
	struct sm_error *error)
{
	return bench_view_draw(&gallery->view, renderer, frame % 2, frame, error);
}

static bool encode(const struct picture *picture, const char *path, struct sm_error *error)
{
	struct png png = {0};
	bool written =
		png_init_picture(&png, picture->rgba, picture->width, picture->height, error) &&
		output_write(path, png.bytes, png.size, error);
	png_finish(&png);
	return written;
}

static bool find_path(
	const char *folder, const char *name, char path[PATH_MAX], struct sm_error *error)
{
	return snprintf(path, PATH_MAX, "%s/%s", folder, name) < PATH_MAX ||
	       error_set(error, SM_ERROR_INPUT, "--out: the name is too long");
}

static bool write_difference(const struct gallery *gallery, const char *folder,
	const struct result *result, struct sm_error *error)
{
	char name[FILE_NAME_MAX], path[PATH_MAX];
	struct picture picture = {0};
	difference_file_name(result, name);
	bool made =
		find_path(folder, name, path, error) &&
		difference_montage(&picture, gallery->view.seen[0], gallery->truth[0].visibility,
			gallery->view.target.width, gallery->view.target.height, error);
	bool written = made && encode(&picture, path, error);
	difference_finish(&picture);
	return written;
}

static bool measure_error(struct gallery *gallery, struct sm_renderer *renderer,
	const struct bench_cell *cell, struct result *result, struct sm_error *error)
{
	if (!draw(gallery, renderer, 0, error))
		return false;
	const float *seen = gallery->view.seen[0], *truth = gallery->truth[0].visibility;
	result->outside_wrong = visibility_outside_wrong(seen, truth, gallery->view.pixels);
	return visibility_error(seen, truth, gallery->view.pixels, result->error, error) &&
	       (!cell->pictures || write_difference(gallery, cell->options->out, result, error));
}

static bool measure_flicker(struct gallery *gallery, struct sm_renderer *renderer,
	const struct bench_cell *cell, struct result *result, struct sm_error *error)
{
	(void)cell;
	double sum = 0;
	if (!draw(gallery, renderer, 0, error))
		return false;
	for (uint32_t frame = 1; frame < FLICKER_FRAMES; frame++) {
		if (!draw(gallery, renderer, frame, error))
			return false;
		struct visibility_pair before = {
			gallery->view.seen[(frame - 1) % 2], gallery->truth[frame - 1].visibility};
		struct visibility_pair after = {
			gallery->view.seen[frame % 2], gallery->truth[frame].visibility};
		sum += visibility_flicker(before, after, gallery->view.pixels);
	}
	result->flicker = sum / (FLICKER_FRAMES - 1);
	return true;
}

/* Both galleries show one scene to one renderer, but as two scenes: each of them gets its own. */
static bool with_renderer(struct gallery *gallery, const struct bench_cell *cell, size_t technique,
	bool (*measure)(struct gallery *gallery, struct sm_renderer *renderer,
		const struct bench_cell *cell, struct result *result, struct sm_error *error),
	struct sm_error *error)
{
	struct sm_shadow_options shadow = bench_cell_shadow(cell, technique);
	struct sm_renderer *renderer = driver_options_renderer(&cell->options->driver, error);
	bool measured = renderer != NULL && sm_renderer_set_shadows(renderer, &shadow, error) &&
			measure(gallery, renderer, cell, &cell->results[technique], error);
	sm_renderer_destroy(renderer);
	++*cell->steps;
	return measured;
}

static uint32_t smaller(uint32_t a, uint32_t b)
{
	return a < b ? a : b;
}

/* What was drawn last in the gallery. */
static void show(struct sheet *sheet, const struct gallery *gallery, const struct result *result)
{
	char name[64], note[32] = "";
	bool plain = strcmp(result->precision, "float") == 0;
	snprintf(name, sizeof(name), "%s%s%s", result->technique, plain ? "" : " ",
		plain ? "" : result->precision);
	if (result->error[REGION_PENUMBRA].pixels > 0)
		snprintf(note, sizeof(note), "rmse %.4f", result->error[REGION_PENUMBRA].rmse);
	sheet_add(sheet, name, note, gallery->view.seen[0]);
}

static bool write_sheet(
	const struct sheet *sheet, const struct bench_cell *cell, struct sm_error *error)
{
	char name[FILE_NAME_MAX], path[PATH_MAX];
	sheet_file_name(&cell->results[0], name);
	return find_path(cell->options->out, name, path, error) &&
	       encode(&sheet->picture, path, error);
}

static bool measure_errors(
	const struct bench_cell *cell, struct gallery *still, struct sm_error *error)
{
	size_t count = cell->options->technique_count;
	struct sheet sheet;
	bool measured = sheet_init(&sheet, still->truth[0].visibility, still->view.target.width,
		still->view.target.height, count, error);
	for (size_t i = 0; i < count && measured; i++) {
		measured = with_renderer(still, cell, i, measure_error, error);
		if (measured)
			show(&sheet, still, &cell->results[i]);
	}
	measured = measured && write_sheet(&sheet, cell, error);
	sheet_finish(&sheet);
	return measured;
}

static bool measure_all(const struct bench_cell *cell, struct gallery *still,
	struct gallery *moving, struct sm_error *error)
{
	struct bench_size size = cell->options->error_size;
	struct bench_size small = {
		smaller(size.width, FLICKER_SIZE), smaller(size.height, FLICKER_SIZE)};
	if (!gallery_init(still, cell, size, 1, TRUTH_STEPS, error) ||
		!gallery_init(moving, cell, small, FLICKER_FRAMES, FLICKER_TRUTH_STEPS, error))
		return false;
	if (!measure_errors(cell, still, error))
		return false;
	for (size_t i = 0; i < cell->options->technique_count; i++)
		if (!with_renderer(moving, cell, i, measure_flicker, error))
			return false;
	return true;
}

bool bench_accuracy(const struct bench_cell *cell, struct sm_error *error)
{
	struct gallery still = {0}, moving = {0};
	struct platform *platform =
		platform_create(cell->options->common.device, cell->options->common.debug, error);
	bool measured = platform != NULL && measure_all(cell, &still, &moving, error);
	gallery_finish(&still);
	gallery_finish(&moving);
	platform_destroy(platform);
	return measured;
}

uint32_t bench_accuracy_steps(const struct bench_options *options)
{
	return TRUTH_STEPS + FLICKER_FRAMES * FLICKER_TRUTH_STEPS +
	       2 * (uint32_t)options->technique_count;
}
