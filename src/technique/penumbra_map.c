/* SPDX-License-Identifier: MIT */
#include "technique/smoothie_state.h"

/*
 * Wyman & Hansen 2003. Cones with their apex at the silhouette's vertices, and sheets along its
 * edges between them, widen towards the receivers as the outer half of a penumbra does. Seen from
 * the light they cover what smoothies of the full width do, so that they are drawn as those; a
 * fragment's intensity is where it lies between silhouette and receiver, and the darkest is kept.
 * The paper looks a surface up in the map without asking for its depth; here what is in front of
 * the silhouette is not darkened, as with smoothies, since four texels are blended.
 */
static bool init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	static const struct fin_shape shape = {.share = 1.0f};
	return smoothie_init(state, gpu, options, &shape, FLAG_CONE, error);
}

const struct technique technique_penumbra_map = {
	.name = "penumbra-map",
	.summary = "cones and sheets along silhouettes (Wyman & Hansen 2003)",
	.options = OPTION_FALLOFF,
	.state_size = sizeof(struct smoothie),
	.reads_receivers = true,
	.init = init,
	.finish = smoothie_finish,
	.prepare = smoothie_prepare,
	.surface_flags = smoothie_surface_flags,
	.soft_grid = smoothie_soft_grid,
	.soft_depths = smoothie_soft_depths,
	.texels_around = LOOKUP_REACH_LINEAR,
	.fins = smoothie_fins,
	.casters = smoothie_casters,
	.list_memory = smoothie_list_memory,
	.bind = smoothie_bind,
};
