/* SPDX-License-Identifier: MIT */
#ifndef APP_SCENE_OPTIONS_H
#define APP_SCENE_OPTIONS_H

#include "app/options.h"
#include "load/stage.h"

/** Flags of the subcommands that draw a scene, by the ids below. */
#define SCENE_FLAGS                                                                       \
	{FLAG_SAMPLES, "samples", "1|4", "samples a pixel against jagged edges"},         \
		{FLAG_TECHNIQUE, "technique", "NAME", "how shadows are made"},            \
		{FLAG_PRECISION, "precision", "NAME",                                     \
			"arithmetic of shadows: float, half or fixed12"},                 \
		{FLAG_SAMPLING, "sampling", "NAME",                                       \
			"dense, sparse, deferred or deferred-sparse: pixels of gather"},  \
		{FLAG_MAP, "map", "N", "texels a side of the shadow map"},                \
		{FLAG_ANIMATION, "animation", "NAME|N", "what models do; none: nothing"}, \
	{                                                                                 \
		FLAG_SET, "set", "SECTION.KEY=VALUE", "change the scene; may be repeated" \
	}

enum {
	FLAG_SAMPLES = FLAG_OWN,
	FLAG_TECHNIQUE,
	FLAG_PRECISION,
	FLAG_SAMPLING,
	FLAG_MAP,
	FLAG_ANIMATION,
	FLAG_SET,
	FLAG_OWN_OF_SCENES, /**< these subcommands count on from here */
};

/** What a command line says of the scene. */
struct scene_options {
	const char *scene;
	uint32_t samples, map_size;  /**< 0: not given */
	const char *technique;       /**< NULL: not given */
	enum sm_precision precision; /**< default: not given */
	enum sm_sampling sampling;   /**< likewise */
	char *animation;             /**< as a setting; NULL: not given; owned */
	const char **settings;       /**< owned array, with room for one more */
	size_t setting_count;
};

/** Nothing is given; argc: of the command line that will be read. */
bool scene_options_init(struct scene_options *options, int argc, struct sm_error *error);
/** Fine on a zeroed one. */
void scene_options_finish(struct scene_options *options);

/** Reads the name of a precision. */
bool scene_options_precision(const char *name, enum sm_precision *precision);

/** Whether a flag is one of SCENE_FLAGS. */
bool scene_options_has(int id);
/** Takes one. */
bool scene_options_flag(struct scene_options *options, const struct command *command, int id,
	const char *value, struct sm_error *error);

/** Takes the one argument that is left when all flags are read. */
bool scene_options_argument(struct scene_options *options, const struct command *command, int argc,
	char **argv, struct sm_error *error);

/** The name of a SCENE without folder, "builtin:" and extension: "horse" of "models/horse.3ds". It
 *  is in the text, *length characters long. */
const char *scene_name(const char *scene, size_t *length);

/** Loads the scene, as changed by the options. */
bool scene_options_load(
	const struct scene_options *options, struct stage *stage, struct sm_error *error);

#endif
