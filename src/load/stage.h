/* SPDX-License-Identifier: MIT */
#ifndef LOAD_STAGE_H
#define LOAD_STAGE_H

#include "load/defaults.h"
#include "load/stage_clips.h"
#include "load/stage_motion.h"

/** Pixels of the picture. */
struct stage_output {
	uint32_t width, height; /**< 1 to 16384 */
	uint32_t samples;       /**< of multisampling: 1 or 4 */
};

/** What a camera's defaults follow from. */
struct stage_framing {
	struct frame frame;
	struct sm_light_desc light; /**< without its name */
	struct sm_camera open;      /**< NaN where nothing was said */
};

/** All that the SCENE of a command line says, with what it leaves open filled in. */
struct stage {
	struct sm_scene *scene;
	struct sm_camera camera;
	struct stage_framing framing;
	struct stage_motion motion;
	struct stage_clips clips;
	struct sm_shadow_options shadow; /**< zero where nothing was said */
	struct stage_output output;
	char *technique; /**< owned; shadow.technique points here */
};

/**
 * Builds a stage.
 *
 * source: a model file of any format that assimp reads, a scene file (*.ini, docs/scene-file.md),
 * or builtin:NAME (builtin.h).
 * settings: "section.key=value" or "section NAME.key=value" with the keys of a scene file, applied
 * in order on top of the source. Without NAME, a light's or object's key is set on each of them.
 *
 * A model file is read by a forked child, because assimp does not survive every damaged file; so
 * call this before other threads hold locks that the child would need.
 *
 * On failure the stage is empty and *error (may be NULL) has one line with the place and the cause.
 * Finish with stage_finish(), which also takes a zeroed or failed stage.
 */
bool stage_load(struct stage *stage, const char *source, const char *const *settings,
	size_t setting_count, struct sm_error *error);
void stage_finish(struct stage *stage);

/** Makes it a picture of another size, as the setting output.size does; its time is 0 again. */
void stage_set_size(struct stage *stage, uint32_t width, uint32_t height);

/** Whether its picture changes with time. */
bool stage_moves(const struct stage *stage);
/** Puts what moves where it is at a time, which is finite: the same bits for the same time, and at
 * 0 those that were loaded. Fails (INPUT) where rounding puts a light onto its target, or numbers
 *  become too large. */
bool stage_set_time(struct stage *stage, double seconds, struct sm_error *error);

#endif
