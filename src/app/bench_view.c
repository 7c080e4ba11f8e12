/* SPDX-License-Identifier: MIT */
#include "app/bench_view.h"
#include "base/array.h"
#include "base/error.h"
#include <stdlib.h>

bool bench_view_init(struct bench_view *view, struct sm_error *error)
{
	const struct stage_output *output = &view->stage.output;
	if (!offscreen_init(
		    &view->target, OFFSCREEN_VISIBILITY, output->width, output->height, 1, error))
		return false;
	/* The target is within the driver's limits: below 2^32 pixels. */
	view->pixels = (size_t)output->width * output->height;
	view->rgba = array_alloc(view->pixels, 4);
	for (int i = 0; i < 2; i++)
		view->seen[i] = array_alloc(view->pixels, sizeof(float));
	return (view->rgba != NULL && view->seen[0] != NULL && view->seen[1] != NULL) ||
	       error_no_memory(error);
}

bool bench_view_draw(struct bench_view *view, struct sm_renderer *renderer, int which,
	double seconds, struct sm_error *error)
{
	if (!stage_set_time(&view->stage, seconds, error))
		return false;
	struct sm_view drawn = {
		.camera = view->stage.camera,
		.framebuffer = view->target.framebuffer,
		.width = view->target.width,
		.height = view->target.height,
		.visibility_of = 0,
	};
	if (!sm_renderer_draw(renderer, view->stage.scene, &drawn, error) ||
		!offscreen_read(&view->target, view->rgba, error))
		return false;
	offscreen_decode_visibility(&view->target, view->rgba, view->seen[which]);
	return true;
}

void bench_view_finish(struct bench_view *view)
{
	free(view->rgba);
	free(view->seen[0]);
	free(view->seen[1]);
	offscreen_finish(&view->target);
	stage_finish(&view->stage);
}
