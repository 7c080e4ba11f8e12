/* SPDX-License-Identifier: MIT */
#ifndef TECHNIQUE_TECHNIQUE_H
#define TECHNIQUE_TECHNIQUE_H

#include "base/memory_list.h"
#include "geom/screen_depths.h"
#include "geom/screen_grid.h"
#include "gles/gpu.h"
#include "scene/fin_set.h"
#include "scene/object_watch.h"

/** Whether visibility is found at points of the view first (src/sparse_pass.h). */
static inline bool sampling_is_sparse(enum sm_sampling sampling)
{
	return sampling == SM_SAMPLING_SPARSE || sampling == SM_SAMPLING_DEFERRED_SPARSE;
}

/** Whether it is found once surfaces are known (src/deferred_pass.h). */
static inline bool sampling_is_deferred(enum sm_sampling sampling)
{
	return sampling == SM_SAMPLING_DEFERRED || sampling == SM_SAMPLING_DEFERRED_SPARSE;
}

/** Fields of sm_shadow_options that not every technique uses. */
enum technique_option {
	OPTION_WIDTH = 1 << 0,
	OPTION_FALLOFF = 1 << 1,
	OPTION_PASSES = 1 << 2,
	OPTION_PRECISION = 1 << 3, /* any but float */
	OPTION_SAMPLING = 1 << 4,
};

#define SAMPLE_CHOICES_MAX 4

/** What a camera sees. */
struct technique_view {
	vec4 *world_to_clip;
	uint32_t width, height; /* of the picture */
	bool visibility;        /* for sm_view.visibility_of, not to shade surfaces */
	bool multisampled;      /* several samples a pixel */
	bool deferrable;        /* surfaces can look up what was found for each pixel */
	size_t triangles;       /* of all objects */
};

/** One way to make shadows. The state is one light's: its textures, and what fills them. */
struct technique {
	const char *name, *summary;
	unsigned int options; /* technique_option bits that it uses */
	/* Of options.samples, the default first; ends with 0. All 0: it is not used. */
	uint32_t samples[SAMPLE_CHOICES_MAX + 1];
	size_t state_size;    /* zeroed before init */
	bool fits_screen;     /* the light's screen may be what shadows fall on alone */
	bool reads_receivers; /* prepare() depends on what only receives as well */

	/** options: every 0 replaced by its default, where it has one. */
	bool (*init)(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
		struct sm_error *error);
	/** Tolerates a half-made or zeroed state. */
	void (*finish)(void *state, struct gpu *gpu);
	/** Before prepare(), once a frame and light: how the light is drawn. Returns whether that
	 *  is another way than in the last frame. NULL: there is one. */
	bool (*choose)(void *state, struct gpu *gpu, const struct sm_scene *scene,
		const struct light_frame *frame);
	/** Has what a choice depends on of frames before forgotten: the light did not show in the
	 * last one, or they are not to count. NULL: nothing. */
	void (*leave)(void *state);
	/** Draws what the light sees; not called while all that it depends on stays the same and
	 *  it has succeeded. Leaves blending and culling off. */
	bool (*prepare)(void *state, struct gpu *gpu, const struct sm_scene *scene,
		const struct light_frame *frame, struct sm_error *error);
	/** Instead of prepare(), which then is NULL: draws how much of the light reaches each pixel
	 *  of a view as well, so that surfaces need look up no more than that. */
	bool (*prepare_view)(void *state, struct gpu *gpu, const struct sm_scene *scene,
		const struct light_frame *frame, const struct technique_view *view,
		struct sm_error *error);
	/** Copies what prepare_view() drew into the framebuffer that is bound, as
	 *  sm_view.visibility_of wants it. */
	bool (*show)(const void *state, struct gpu *gpu, struct sm_error *error);
	/** Flags of PROGRAM_SURFACE for surfaces that receive. */
	uint64_t (*surface_flags)(const void *state);
	/** Where on the light's screen surfaces may look otherwise than FLAG_HARD draws them, for
	 *  which bind() serves as well; owned by the state. NULL: everywhere. */
	const struct screen_grid *(*soft_grid)(const void *state);
	/** Within soft_grid(), the same for surfaces alone that are farther from the light than a
	 *  depth; owned by the state. NULL, or returns that: for all. */
	const struct screen_depths *(*soft_depths)(const void *state);
	/** What no caster can reach is lit, which it would not always be if it were looked up:
	 *  variances are of receivers as well, and visibility that was found before may be of
	 *  another surface in the same pixel. */
	bool needs_parts;
	/** The window depth that no caster over a cell of that is behind, row after row, for
	 *  FLAG_BEHIND; owned by the state. NULL, or returns NULL: not known. */
	const float *(*farthest)(const void *state);
	bool soft_is_all; /* elsewhere nothing is darkened at all */
	/** Chooses, once a frame and light, for which pixels visibility is found, and when
	 *  (src/sparse_pass.h, src/deferred_pass.h). NULL: for each, with its surface. */
	enum sm_sampling (*sampling)(void *state, const struct sm_scene *scene,
		const struct light_frame *frame, const struct technique_view *view);
	/** How far on the light's screen, NDC, from where it is a surface may be darkened by a
	 *  caster, beyond the texels of a bilinear look-up. NULL: no farther. */
	float (*reach)(const void *state, const struct light_frame *frame);
	/** How far around a surface, texels, the centres of those lie that it is compared with,
	 * where that is all it looks up, within reach() of it: then what nothing is in front of is
	 * lit. 0: it is not so. */
	float texels_around;
	/** Fins that darken surfaces as casters do; owned by the state. NULL: there are none. */
	const struct fin_set *(*fins)(const void *state);
	/** The watch on casters that prepare() draws by, and may leave some out by: those that are
	 *  beside all that is looked up. reach: set to how far, NDC, from a surface a caster may be
	 *  that what is looked up for it depends on, beyond the texels around. NULL, or it is: all
	 *  are drawn. */
	struct object_watch *(*casters)(void *state, const struct light_frame *frame, float *reach);
	/** Tells what the state holds of the processor's memory. NULL: nothing beside itself. */
	void (*list_memory)(const void *state, const struct memory_list *list);
	/** Binds textures and sets uniforms of a program with these flags, in use. */
	void (*bind)(const void *state, struct gpu *gpu, const struct light_frame *frame,
		const struct program *program);
};

extern const struct technique technique_hard, technique_pcf, technique_smoothie;
extern const struct technique technique_smoothie_two_sided;
extern const struct technique technique_penumbra_map;
extern const struct technique technique_pcss, technique_vsm, technique_maps;
extern const struct technique technique_gather, technique_auto;

/** NULL past the last one. */
const struct technique *technique_at(size_t index);
/** NULL if there is none of that name. */
const struct technique *technique_find(const char *name);

#endif
