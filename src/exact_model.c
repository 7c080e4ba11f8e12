/* SPDX-License-Identifier: MIT */
#include "exact_model.h"
#include "base/error.h"
#include "exact_scene.h"
#include "fixed/passes.h"
#include "scene/camera.h"

bool exact_model_visibility(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, uint16_t *values, struct sm_error *error)
{
	struct light_frame frame;
	struct exact_scene exact = {0};
	struct exact_view exact_view = {
		.frame = &frame,
		.width = view->width,
		.height = view->height,
		.map_size = options->map_size,
		.fin_width = options->width,
		.sinusoid = options->falloff == SM_FALLOFF_SINUSOID,
	};
	if (!camera_world_to_clip(&view->camera, scene, view->width, view->height,
		    exact_view.world_to_clip, error))
		return false;
	light_frame_init(&frame, &scene->lights[view->visibility_of].desc, scene);
	const struct number_model *number =
		options->precision == SM_PRECISION_HALF ? &number_half : &number_fixed12;
	bool drawn = exact_scene_find(&exact, scene, &exact_view) &&
		     fixed_draw(&exact.fixed, number, values);
	exact_scene_finish(&exact);
	return drawn || error_no_memory(error);
}
