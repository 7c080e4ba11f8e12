/* SPDX-License-Identifier: MIT */
/* bench-stress [TECHNIQUE [SWEEP [FOLDER]]]: runs the numerical stress. */
#include "bench/stress.h"
#include "platform.h"

int main(int argc, char **argv)
{
	struct sm_error error = {0};
	struct platform *platform = platform_create("surfaceless", false, &error);
	const struct stress_options options = {
		.get_proc = platform_get_proc,
		.technique = argc > 1 && argv[1][0] != '\0' ? argv[1] : NULL,
		.sweep = argc > 2 ? argv[2] : NULL,
		.folder = argc > 3 ? argv[3] : NULL,
		.effort = STRESS_QUICK,
		.lines = stdout,
	};
	bool ok = platform != NULL && stress_run(&options, &error);
	if (!ok)
		fprintf(stderr, "bench-stress: %s\n", error.text);
	platform_destroy(platform);
	return ok ? 0 : 1;
}
