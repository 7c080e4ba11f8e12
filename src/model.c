/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "exact_model.h"
#include "local_scene.h"
#include "model/float_visibility.h"
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

/* snap_bits: 0 for a grid that only coverage follows. */
static bool draw(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, uint32_t snap_bits, uint16_t *values,
	struct sm_error *error)
{
	static const struct caps caps = {.max_texture_size = SIDE_MAX};
	struct shadow_set set;
	struct local_scene local = {0};
	if (!shadow_set_init(&set, options, &caps, error))
		return false;
	bool exact = set.options.precision != SM_PRECISION_FLOAT;
	if (!check_view(scene, view, exact ? SM_EXACT_SIZE_MAX : SIDE_MAX, error))
		return false;
	if (exact && snap_bits > 0)
		return error_set(error, SM_ERROR_INPUT,
			"with the precision \"%s\" every driver has the same grid",
			sm_precision_name((size_t)set.options.precision - 1));
	struct sm_view local_view = *view;
	set.options.technique = set.technique->name;
	bool drawn = local_scene_find(&local, scene, &view->camera, error);
	if (drawn) {
		local_view.camera = local.camera;
		drawn = exact ? exact_model_visibility(
					local.scene, &local_view, &set.options, values, error)
			      : model_float_visibility(local.scene, &local_view, &set.options,
					snap_bits, values, error);
	}
	local_scene_finish(&local);
	return drawn;
}

bool sm_model_visibility(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, uint16_t *values, struct sm_error *error)
{
	return draw(scene, view, options, 0, values, error);
}

bool sm_model_visibility_snapped(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, uint32_t bits, uint16_t *values,
	struct sm_error *error)
{
	if (bits < 1 || bits > 8)
		return error_set(error, SM_ERROR_INPUT,
			"a grid of 2^-%u pixels; a model has from 1 to 8 bits", bits);
	return draw(scene, view, options, bits, values, error);
}
