/* SPDX-License-Identifier: MIT */
#ifndef MODEL_FLOAT_VISIBILITY_H
#define MODEL_FLOAT_VISIBILITY_H

#include "scene/scene.h"

/**
 * sm_model_visibility() for SM_PRECISION_FLOAT, and sm_model_visibility_snapped(): what shaders_es/
 * and technique/ define, in double but for the formats of depth maps.
 *
 * scene and view: local ones (local_scene.h), with a light view->visibility_of. options: complete,
 * with the technique's name. Up to 16384 pixels and texels a side. snap_bits: 0, or those of the
 * grid that corners are moved to, up to 8. Fails (MACHINE) for lack of memory, (INPUT) on a camera
 * that sees nothing.
 */
bool model_float_visibility(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, uint32_t snap_bits, uint16_t *values,
	struct sm_error *error);

#endif
