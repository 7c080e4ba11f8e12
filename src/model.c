/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "exact_model.h"
#include "fixed/primitive.h"
#include "local_scene.h"
#include "shadow_set.h"

/* Pixels or texels a side. */
#define SIDE_MAX 16384

static bool check_view(const struct sm_scene *scene, const struct sm_view *view, uint32_t most,
	struct sm_error *error)
{
	if (view->width == 0 || view->height == 0 || view->width > most || view->height > most)
		return error_set(error, SM_ERROR_INPUT,
			"a picture of %ux%u pixels; this model draws from 1x1 to %ux%u",
			view->width, view->height, most, most);
	if (view->visibility_of >= scene->light_count)
		return error_set(error, SM_ERROR_INPUT, "no light %u to show; the scene has %zu",
			view->visibility_of, scene->light_count);
	return true;
}

bool sm_model_visibility(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, uint16_t *values, struct sm_error *error)
{
	static const struct caps caps = {.max_texture_size = SIDE_MAX};
	struct shadow_set set;
	struct local_scene local = {0};
	if (!shadow_set_init(&set, options, &caps, error))
		return false;
	bool exact = set.options.precision != SM_PRECISION_FLOAT;
	if (!check_view(scene, view, exact ? FIXED_SIZE_MAX : SIDE_MAX, error))
		return false;
	if (!exact)
		return error_set(error, SM_ERROR_INPUT, "float is not modelled");
	struct sm_view local_view = *view;
	bool drawn = local_scene_find(&local, scene, &view->camera, error);
	if (drawn) {
		local_view.camera = local.camera;
		drawn = exact_model_visibility(
			local.scene, &local_view, &set.options, values, error);
	}
	local_scene_finish(&local);
	return drawn;
}
