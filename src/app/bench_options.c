/* SPDX-License-Identifier: MIT */
#include "app/bench_options.h"
#include "ref/reference.h"
#include <getopt.h>
#include <stdio.h>
#include <string.h>

enum {
	FLAG_SCENE = FLAG_OWN,
	FLAG_TECHNIQUE,
	FLAG_RADIUS,
	FLAG_MAP,
	FLAG_PRECISION,
	FLAG_SIZE,
	FLAG_ERROR_SIZE,
	FLAG_ROUNDS,
	FLAG_SAMPLES,
	FLAG_OUT,
	FLAG_COMPARE,
	FLAG_ERRORS,
	FLAG_QUICK,
	FLAG_STRESS,
	FLAG_SEED,
	FLAG_RANDOM,
	FLAG_PAPER,
	FLAG_MODELS,
};

static const struct flag flags[] = {
	{FLAG_SCENE, "scene", "SCENE", "measure on this one; may be repeated"},
	{FLAG_TECHNIQUE, "technique", "NAME[-SAMPLES]", "measure this one; may be repeated"},
	{FLAG_RADIUS, "radius", "R/d", "of the light, as a share of its distance; repeatable"},
	{FLAG_MAP, "map", "N", "texels a side of the shadow map; may be repeated"},
	{FLAG_PRECISION, "precision", "NAME",
		"float, half or fixed12: of shadows; may be repeated"},
	{FLAG_SIZE, "size", "WxH", "pixels of the frames that are timed; default: 1024x1024"},
	{FLAG_ERROR_SIZE, "error-size", "WxH", "of pictures held against truth; default: 512x512"},
	{FLAG_ROUNDS, "rounds", "N", "frames timed of each technique"},
	{FLAG_SAMPLES, "samples", "N", "of the light, by the reference, in penumbrae"},
	{FLAG_OUT, "out", "DIR", "folder for what is written; default: bench-results"},
	{FLAG_COMPARE, "compare", "FILE", "print what changed since that results.csv"},
	{FLAG_ERRORS, "errors", NULL, "measure errors alone, no times and no memory"},
	{FLAG_QUICK, "quick", NULL, "measure a part, in minutes"},
	{FLAG_STRESS, "stress", "[=SWEEP]", "look for numbers that break the techniques instead"},
	{FLAG_SEED, "seed", "N", "with --stress: of the random scenes"},
	{FLAG_RANDOM, "random", "N", "with --stress: how many random scenes"},
	{FLAG_PAPER, "paper", NULL, "measure what the papers' own tables hold instead"},
	{FLAG_MODELS, "models", "DIR", "with --paper: folder of spot.glb and sheen-chair.glb"},
	DRIVER_FLAGS,
	SKIP_FLAG,
	RENDER_DEVICE_FLAG,
	COMMON_FLAGS,
};

/* The only one that is drawn in other precisions than float. */
static const char exact_technique[] = "smoothie";

static bool read_count(
	const char *flag, const char *value, uint32_t max, uint32_t *count, struct sm_error *error)
{
	return options_number(value, 1, max, count) ||
	       options_error(error, &bench_command, "--%s %.40s: a number from 1 to %u is wanted",
		       flag, value, max);
}

static bool read_size(
	const char *flag, const char *value, struct bench_size *size, struct sm_error *error)
{
	return options_size(value, &size->width, &size->height) ||
	       options_error(error, &bench_command,
		       "--%s %.40s: WIDTHxHEIGHT in pixels is wanted, each 1 or more", flag, value);
}

static bool check_room(const char *flag, size_t count, size_t max, struct sm_error *error)
{
	return count < max ||
	       options_error(error, &bench_command, "--%s: at most %zu are measured", flag, max);
}

static bool add_scene(struct bench_options *options, const char *scene, struct sm_error *error)
{
	for (size_t i = 0; i < options->scene_count; i++)
		if (strcmp(options->scenes[i], scene) == 0)
			return true;
	if (!check_room("scene", options->scene_count, BENCH_SCENES_MAX, error))
		return false;
	options->scenes[options->scene_count++] = scene;
	return true;
}

static bool add_radius(struct bench_options *options, const char *value, struct sm_error *error)
{
	double *radius = &options->radii[options->radius_count];
	if (!check_room("radius", options->radius_count, BENCH_RADII_MAX, error))
		return false;
	if (!options_real(value, 0, 10, radius))
		return options_error(error, &bench_command,
			"--radius %.40s: a share of the light's distance, from 0 to 10, is wanted",
			value);
	for (size_t i = 0; i < options->radius_count; i++)
		if (options->radii[i] == *radius)
			return true;
	options->radius_count++;
	return true;
}

static bool add_map(struct bench_options *options, const char *value, struct sm_error *error)
{
	if (!check_room("map", options->map_count, BENCH_MAPS_MAX, error) ||
		!read_count("map", value, INT32_MAX, &options->maps[options->map_count], error))
		return false;
	for (size_t i = 0; i < options->map_count; i++)
		if (options->maps[i] == options->maps[options->map_count])
			return true;
	options->map_count++;
	return true;
}

static bool add_technique(struct bench_options *options, const struct bench_technique *technique,
	struct sm_error *error)
{
	for (size_t i = 0; i < options->technique_count; i++)
		if (strcmp(options->techniques[i].name, technique->name) == 0 &&
			options->techniques[i].precision == technique->precision)
			return true;
	if (!check_room("technique", options->technique_count, BENCH_TECHNIQUES_MAX, error))
		return false;
	options->techniques[options->technique_count++] = *technique;
	return true;
}

/* The technique's least choice of samples above `least`; 0: there is none. */
static uint32_t next_samples(size_t index, uint32_t least)
{
	uint32_t next = 0, samples;
	for (size_t i = 0; (samples = sm_technique_samples(index, i)) > 0; i++)
		if (samples > least && (next == 0 || samples < next))
			next = samples;
	return next;
}

/* Adds the technique of that index with each choice of samples, or those of them that `name` is of;
 * NULL: all. *found: whether there was one. */
static bool add_choices(struct bench_options *options, size_t index, const char *name, bool *found,
	struct sm_error *error)
{
	struct bench_technique technique = {.technique = sm_technique_name(index)};
	bool several = sm_technique_samples(index, 0) > 0 && sm_technique_samples(index, 1) > 0;
	bool whole = name == NULL || strcmp(name, technique.technique) == 0;
	technique.samples = next_samples(index, 0);
	do {
		snprintf(technique.name, sizeof(technique.name), several ? "%s-%u" : "%s",
			technique.technique, technique.samples);
		if (!whole && strcmp(name, technique.name) != 0)
			continue;
		*found = true;
		if (!add_technique(options, &technique, error))
			return false;
	} while ((technique.samples = next_samples(index, technique.samples)) > 0);
	return true;
}

/* The names of all techniques, by commas. */
static void list_techniques(char *text, size_t size)
{
	size_t used = 0;
	const char *name;
	for (size_t i = 0; (name = sm_technique_name(i)) != NULL && used < size; i++)
		used += (size_t)snprintf(text + used, size - used, "%s%s", i > 0 ? ", " : "", name);
}

/* name: NULL for all. */
static bool add_techniques(struct bench_options *options, const char *name, struct sm_error *error)
{
	char names[200] = "";
	bool found = false;
	for (size_t i = 0; sm_technique_name(i) != NULL; i++)
		if (!add_choices(options, i, name, &found, error))
			return false;
	list_techniques(names, sizeof(names));
	return found ||
	       options_error(error, &bench_command,
		       "--technique %.40s: there is none of that name; there are: %s", name, names);
}

static bool add_precision(struct bench_options *options, const char *value, struct sm_error *error)
{
	const char *name;
	for (size_t i = 0; (name = sm_precision_name(i)) != NULL; i++)
		if (strcmp(value, name) == 0) {
			options->precisions |= 1u << (i + 1);
			return true;
		}
	return options_error(error, &bench_command,
		"--precision %.40s: float, half or fixed12 is wanted", value);
}

static bool read_flag(
	struct bench_options *options, int id, const char *value, struct sm_error *error)
{
	switch (id) {
	case FLAG_SCENE:
		return add_scene(options, value, error);
	case FLAG_TECHNIQUE:
		return add_techniques(options, value, error);
	case FLAG_RADIUS:
		return add_radius(options, value, error);
	case FLAG_MAP:
		return add_map(options, value, error);
	case FLAG_PRECISION:
		return add_precision(options, value, error);
	case FLAG_SIZE:
		return read_size("size", value, &options->time_size, error);
	case FLAG_ERROR_SIZE:
		return read_size("error-size", value, &options->error_size, error);
	case FLAG_ROUNDS:
		return read_count("rounds", value, 10000, &options->rounds, error);
	case FLAG_SAMPLES:
		return read_count(
			"samples", value, REFERENCE_SAMPLES_MOST, &options->samples, error);
	case FLAG_OUT:
		options->out = value;
		return true;
	case FLAG_COMPARE:
		options->compare = value;
		return true;
	case FLAG_ERRORS:
		options->errors = true;
		return true;
	case FLAG_QUICK:
		options->quick = true;
		return true;
	case FLAG_STRESS:
		options->stress = true;
		options->sweep = value;
		return true;
	case FLAG_SEED:
		return read_count("seed", value, UINT32_MAX, &options->seed, error);
	case FLAG_RANDOM:
		return read_count("random", value, 100000000, &options->random_scenes, error);
	case FLAG_PAPER:
		options->paper = true;
		return true;
	case FLAG_MODELS:
		options->models = value;
		return true;
	case FLAG_CAPS:
	case FLAG_PATH:
	case FLAG_NO_SKIP:
		return driver_options_flag(&options->driver, id, value, error);
	default:
		options_common(&options->common, id, value);
		return true;
	}
}

/* What a list that nothing was said of is to hold, up to NULL. */
struct defaults {
	const char *scenes[7], *radii[4], *maps[3];
	uint32_t rounds;
};

static const struct defaults full = {
	.scenes = {"builtin:cylinder", "builtin:boxes", "builtin:fence", "builtin:knot",
		"builtin:urchin", "builtin:debris"},
	.radii = {".03", ".01", ".10"},
	.maps = {"512", "1024"},
	.rounds = 15,
};

static const struct defaults quick = {
	.scenes = {"builtin:cylinder", "builtin:fence", "builtin:knot", "builtin:debris"},
	.radii = {".03"},
	.maps = {"512"},
	.rounds = 5,
};

static bool fill(const char *const *values, size_t count, struct bench_options *options,
	bool (*add)(struct bench_options *options, const char *value, struct sm_error *error),
	struct sm_error *error)
{
	for (size_t i = 0; count == 0 && values[i] != NULL; i++)
		if (!add(options, values[i], error))
			return false;
	return true;
}

/* Adds the technique in each precision that is asked for and that it has. */
static bool add_in_precisions(struct bench_options *options,
	const struct bench_technique *technique, struct sm_error *error)
{
	struct bench_technique copy = *technique;
	size_t last = strcmp(copy.technique, exact_technique) == 0 ? SM_PRECISION_FIXED12
								   : SM_PRECISION_FLOAT;
	for (size_t i = SM_PRECISION_FLOAT; i <= last; i++) {
		copy.precision = (enum sm_precision)i;
		if (options->precisions & 1u << i && !add_technique(options, &copy, error))
			return false;
	}
	return true;
}

/* named: whether the techniques were. One that was named is to be measured. */
static bool apply_precisions(struct bench_options *options, bool named, struct sm_error *error)
{
	struct bench_technique techniques[BENCH_TECHNIQUES_MAX];
	size_t count = options->technique_count;
	memcpy(techniques, options->techniques, count * sizeof(techniques[0]));
	options->technique_count = 0;
	for (size_t i = 0; i < count; i++) {
		size_t before = options->technique_count;
		if (!add_in_precisions(options, &techniques[i], error))
			return false;
		if (named && options->technique_count == before)
			return options_error(error, &bench_command,
				"--technique %s: only %s has other precisions than float",
				techniques[i].name, exact_technique);
	}
	return true;
}

static bool check_exact_size(const char *flag, struct bench_size size, struct sm_error *error)
{
	return (size.width <= SM_EXACT_SIZE_MAX && size.height <= SM_EXACT_SIZE_MAX) ||
	       options_error(error, &bench_command,
		       "--%s %ux%u: at most %d pixels a side are drawn in half and fixed12", flag,
		       size.width, size.height, SM_EXACT_SIZE_MAX);
}

/* Before hours have gone. */
static bool check_sizes(const struct bench_options *options, struct sm_error *error)
{
	bool exact = options->precisions & ~(1u << SM_PRECISION_FLOAT);
	return !exact || (check_exact_size("size", options->time_size, error) &&
				 check_exact_size("error-size", options->error_size, error));
}

static bool complete(struct bench_options *options, struct sm_error *error)
{
	const struct defaults *defaults = options->quick ? &quick : &full;
	bool named = options->technique_count > 0;
	if (options->rounds == 0)
		options->rounds = defaults->rounds;
	if (options->precisions == 0)
		options->precisions = 1u << SM_PRECISION_FLOAT;
	return fill(defaults->scenes, options->scene_count, options, add_scene, error) &&
	       fill(defaults->radii, options->radius_count, options, add_radius, error) &&
	       fill(defaults->maps, options->map_count, options, add_map, error) &&
	       (named || add_techniques(options, NULL, error)) &&
	       apply_precisions(options, named, error) && check_sizes(options, error);
}

/* What a run measures. */
enum mode { MODE_RESULTS = 1, MODE_STRESS = 2, MODE_PAPER = 4, MODES_ALL = 7 };

static const struct {
	enum mode mode;
	const char *name;
} modes[] = {
	{MODE_RESULTS, "without --stress or --paper"},
	{MODE_STRESS, "with --stress"},
	{MODE_PAPER, "with --paper"},
};

/* The modes that heed a flag of the command's own, from FLAG_SCENE on. */
static const uint8_t heeded[] = {
	[FLAG_SCENE - FLAG_OWN] = MODE_RESULTS | MODE_STRESS,
	[FLAG_TECHNIQUE - FLAG_OWN] = MODE_RESULTS | MODE_STRESS,
	[FLAG_RADIUS - FLAG_OWN] = MODE_RESULTS,
	[FLAG_MAP - FLAG_OWN] = MODE_RESULTS,
	[FLAG_PRECISION - FLAG_OWN] = MODE_RESULTS,
	[FLAG_SIZE - FLAG_OWN] = MODE_RESULTS,
	[FLAG_ERROR_SIZE - FLAG_OWN] = MODE_RESULTS,
	[FLAG_ROUNDS - FLAG_OWN] = MODE_RESULTS,
	[FLAG_SAMPLES - FLAG_OWN] = MODE_RESULTS,
	[FLAG_OUT - FLAG_OWN] = MODES_ALL,
	[FLAG_COMPARE - FLAG_OWN] = MODE_RESULTS,
	[FLAG_ERRORS - FLAG_OWN] = MODE_RESULTS,
	[FLAG_QUICK - FLAG_OWN] = MODE_RESULTS | MODE_STRESS,
	[FLAG_STRESS - FLAG_OWN] = MODE_STRESS,
	[FLAG_SEED - FLAG_OWN] = MODE_STRESS,
	[FLAG_RANDOM - FLAG_OWN] = MODE_STRESS,
	[FLAG_PAPER - FLAG_OWN] = MODE_PAPER,
	[FLAG_MODELS - FLAG_OWN] = MODE_PAPER,
};

/* A flag that a run would not heed is an error, not a silence. given: bit i is flag FLAG_OWN + i.
 */
static bool check_heeded(
	const struct bench_options *options, uint32_t given, struct sm_error *error)
{
	size_t mode = options->stress ? 1 : options->paper ? 2 : 0;
	for (size_t i = 0; i < bench_command.flag_count; i++) {
		const struct flag *flag = &flags[i];
		bool own = flag->id >= FLAG_OWN && given & 1u << (flag->id - FLAG_OWN);
		if (own && !(heeded[flag->id - FLAG_OWN] & modes[mode].mode))
			return options_error(error, &bench_command, "--%s does nothing %s",
				flag->name, modes[mode].name);
	}
	return true;
}

/* Skips show in times alone. */
static bool check_skips(const struct bench_options *options, struct sm_error *error)
{
	bool timed = !options->errors && !options->paper && !options->stress;
	return timed || options->driver.skips == NULL ||
	       options_error(error, &bench_command,
		       "--no-skip does nothing where frames are not timed one by one");
}

bool bench_options_read(
	struct bench_options *options, int argc, char **argv, struct sm_error *error)
{
	*options = (struct bench_options){
		.common = options_defaults(),
		.time_size = {1024, 1024},
		.error_size = {512, 512},
		.samples = REFERENCE_SAMPLES,
		.out = "bench-results",
	};
	uint32_t given = 0;
	int id;
	while ((id = options_next(&bench_command, argc, argv, error)) >= 0) {
		if (!read_flag(options, id, optarg, error))
			return false;
		if (id >= FLAG_OWN)
			given |= 1u << (id - FLAG_OWN);
	}
	if (id == FLAG_FAILED)
		return false;
	if (optind < argc)
		return options_error(
			error, &bench_command, "%.200s: name scenes by --scene", argv[optind]);
	if (options->common.help)
		return true;
	return check_heeded(options, given, error) && check_skips(options, error) &&
	       (options->stress || complete(options, error));
}

void bench_options_finish(struct bench_options *options)
{
	driver_options_finish(&options->driver);
}

const struct command bench_command = {
	.name = "bench",
	.arguments = "[flags]",
	.summary = "Measure techniques: error against ray-traced truth, time and memory.",
	.flags = flags,
	.flag_count = sizeof(flags) / sizeof(flags[0]),
	.run = bench_run,
};
