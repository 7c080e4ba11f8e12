/* SPDX-License-Identifier: MIT */
#ifndef EXACT_MODEL_H
#define EXACT_MODEL_H

#include "scene/scene.h"

/** sm_model_visibility() with SM_PRECISION_HALF and SM_PRECISION_FIXED12. scene and view: local
 * ones (local_scene.h), with a light view->visibility_of, of up to SM_EXACT_SIZE_MAX pixels a side.
 * options: complete. Fails (MACHINE) for lack of memory, (INPUT) on a camera that sees nothing. */
bool exact_model_visibility(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, uint16_t *values, struct sm_error *error);

#endif
