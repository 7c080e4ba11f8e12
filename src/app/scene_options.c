/* SPDX-License-Identifier: MIT */
#include "app/scene_options.h"
#include "base/array.h"
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool scene_options_init(struct scene_options *options, int argc, struct sm_error *error)
{
	*options = (struct scene_options){
		.settings = array_zalloc((size_t)argc, sizeof(*options->settings))};
	return options->settings != NULL || error_no_memory(error);
}

void scene_options_finish(struct scene_options *options)
{
	free(options->animation);
	free(options->settings);
}

bool scene_options_precision(const char *name, enum sm_precision *precision)
{
	for (size_t i = 0; sm_precision_name(i) != NULL; i++) {
		if (strcmp(sm_precision_name(i), name) == 0) {
			*precision = (enum sm_precision)(i + 1);
			return true;
		}
	}
	return false;
}

static bool read_sampling(const char *name, enum sm_sampling *sampling)
{
	static const char *const names[] = {"dense", "sparse", "deferred", "deferred-sparse"};
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
		if (strcmp(names[i], name) == 0) {
			*sampling = (enum sm_sampling)(i + 1);
			return true;
		}
	}
	return false;
}

/* What objects do is up to settings. */
static bool take_animation(struct scene_options *options, const struct command *command,
	const char *name, struct sm_error *error)
{
	static const char key[] = "object.animation=";
	if (name[0] == '\0')
		return options_error(error, command, "--animation: a name or number is wanted");
	free(options->animation);
	options->animation = array_alloc(sizeof(key) + strlen(name), 1);
	if (options->animation == NULL)
		return error_no_memory(error);
	sprintf(options->animation, "%s%s", key, name);
	return true;
}

bool scene_options_has(int id)
{
	return id >= FLAG_OWN && id < FLAG_OWN_OF_SCENES;
}

bool scene_options_flag(struct scene_options *options, const struct command *command, int id,
	const char *value, struct sm_error *error)
{
	switch (id) {
	case FLAG_SAMPLES:
		return (options_number(value, 1, 4, &options->samples) &&
			       (options->samples == 1 || options->samples == 4)) ||
		       options_error(error, command, "--samples %.40s: 1 or 4 is wanted", value);
	case FLAG_MAP:
		return options_number(value, 1, INT32_MAX, &options->map_size) ||
		       options_error(
			       error, command, "--map %.40s: a number of texels is wanted", value);
	case FLAG_TECHNIQUE:
		options->technique = value;
		break;
	case FLAG_PRECISION:
		return scene_options_precision(value, &options->precision) ||
		       options_error(error, command,
			       "--precision %.40s: float, half or fixed12 is wanted", value);
	case FLAG_SAMPLING:
		return read_sampling(value, &options->sampling) ||
		       options_error(error, command,
			       "--sampling %.40s: dense, sparse, deferred or deferred-sparse is "
			       "wanted",
			       value);
	case FLAG_ANIMATION:
		return take_animation(options, command, value, error);
	case FLAG_SET:
		options->settings[options->setting_count++] = value;
		break;
	}
	return true;
}

bool scene_options_argument(struct scene_options *options, const struct command *command, int argc,
	char **argv, struct sm_error *error)
{
	if (optind >= argc)
		return options_error(error, command, "SCENE is missing");
	if (optind + 1 < argc)
		return options_error(
			error, command, "one SCENE is wanted, not also %.200s", argv[optind + 1]);
	options->scene = argv[optind];
	return true;
}

const char *scene_name(const char *scene, size_t *length)
{
	const char *colon = strchr(scene, ':');
	const char *slash = strrchr(scene, '/');
	const char *name = slash != NULL ? slash + 1 : colon != NULL ? colon + 1 : scene;
	const char *dot = strrchr(name, '.');
	*length = dot != NULL && dot != name ? (size_t)(dot - name) : strlen(name);
	return name;
}

bool scene_options_load(
	const struct scene_options *options, struct stage *stage, struct sm_error *error)
{
	size_t setting_count = options->setting_count;
	if (options->animation != NULL)
		options->settings[setting_count++] = options->animation;
	if (!stage_load(stage, options->scene, options->settings, setting_count, error))
		return false;
	if (options->samples > 0)
		stage->output.samples = options->samples;
	if (options->technique != NULL)
		stage->shadow.technique = options->technique;
	if (options->precision != SM_PRECISION_DEFAULT)
		stage->shadow.precision = options->precision;
	if (options->sampling != SM_SAMPLING_DEFAULT)
		stage->shadow.sampling = options->sampling;
	if (options->map_size > 0)
		stage->shadow.map_size = options->map_size;
	return true;
}
