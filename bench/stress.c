/* SPDX-License-Identifier: MIT */
/* bench-stress [technique=NAME] [sweep=NAME] [scene=FILE] [folder=DIR] [seed=N] [random=N]
 * [full=1]: runs the numerical stress. */
#include "bench/stress.h"
#include "platform.h"
#include <stdlib.h>
#include <string.h>

static const char *value_of(int argc, char **argv, const char *key)
{
	size_t length = strlen(key);
	for (int i = 1; i < argc; i++)
		if (strncmp(argv[i], key, length) == 0 && argv[i][length] == '=')
			return argv[i] + length + 1;
	return NULL;
}

static uint32_t number_of(int argc, char **argv, const char *key, uint32_t initial)
{
	const char *value = value_of(argc, argv, key);
	return value != NULL ? (uint32_t)strtoul(value, NULL, 10) : initial;
}

int main(int argc, char **argv)
{
	struct sm_error error = {0};
	struct platform *platform = platform_create("surfaceless", false, &error);
	const struct stress_options options = {
		.get_proc = platform_get_proc,
		.technique = value_of(argc, argv, "technique"),
		.sweep = value_of(argc, argv, "sweep"),
		.scene = value_of(argc, argv, "scene"),
		.folder = value_of(argc, argv, "folder"),
		.seed = number_of(argc, argv, "seed", 1),
		.random_scenes = number_of(argc, argv, "random", 10000),
		.effort = number_of(argc, argv, "full", 0) ? STRESS_FULL : STRESS_QUICK,
		.lines = stdout,
	};
	setvbuf(stdout, NULL, _IOLBF, 0);
	bool ok = platform != NULL && stress_run(&options, &error);
	if (!ok)
		fprintf(stderr, "bench-stress: %s\n", error.text);
	platform_destroy(platform);
	return ok ? 0 : 1;
}
