/* SPDX-License-Identifier: MIT */
#include "bench/stress.h"
#include "base/error.h"
#include "bench/stress_file.h"
#include <inttypes.h>
#include <string.h>

struct run {
	const struct stress_options *options;
	struct stress_probe probe;
	uint32_t checks, failures;
	uint32_t done, total; /* of what progress is told */
};

/* "moved 1e+06, spot, pcf" gives "moved-1e+06-spot-pcf". */
static void file_name(const char *place, char *name, size_t size)
{
	size_t used = 0;
	for (const char *c = place; *c != '\0' && used + 1 < size; c++) {
		if (*c == ',')
			continue;
		name[used++] = *c == ' ' ? '-' : *c;
	}
	name[used] = '\0';
}

static void print_fault(void *data, const char *place, const struct stress_scene *scene,
	const struct stress_fault *fault)
{
	struct run *run = data;
	const struct stress_options *options = run->options;
	char name[200], path[1024];
	struct sm_error error;
	fprintf(options->lines, "FAILED %s: %s\n", place, fault->text);
	if (options->folder == NULL)
		return;
	file_name(place, name, sizeof(name));
	if (stress_file_write(scene, options->folder, name, path, sizeof(path), &error))
		fprintf(options->lines, "  smoothie render --visibility --samples 1 \"%s\"\n", path);
	else
		fprintf(options->lines, "  %s\n", error.text);
}

static void step(struct run *run, uint32_t count)
{
	run->done += count;
	if (run->options->progress != NULL)
		run->options->progress(run->options->data, run->done, run->total);
}

static void print_outcome(const struct run *run, const struct stress_sweep *sweep,
	const struct stress_outcome *outcome)
{
	FILE *lines = run->options->lines;
	fprintf(lines, "%-14s %5" PRIu32 " checks  ", sweep->name, outcome->checks);
	if (outcome->bound > 0)
		fprintf(lines, "worst error %.6f at %g (%s), bound %.6f\n", outcome->error,
			outcome->value, outcome->worst, outcome->bound);
	else
		fprintf(lines, "valid, without a bound\n");
}

static bool run_sweep(struct run *run, const struct stress_sweep *sweep, struct sm_error *error)
{
	const struct stress_options *options = run->options;
	const struct stress_listener listener = {run, print_fault};
	struct stress_outcome outcome = {0};
	if (!stress_sweep_run(sweep, &run->probe, options->technique, options->effort, &listener,
		    &outcome, error))
		return false;
	print_outcome(run, sweep, &outcome);
	run->checks += outcome.checks;
	run->failures += outcome.failures;
	step(run, 1);
	return true;
}

static bool run_sweeps(struct run *run, struct sm_error *error)
{
	const struct stress_sweep *sweep;
	const char *only = run->options->sweep;
	for (size_t i = 0; (sweep = stress_sweep_at(i)) != NULL; i++)
		if ((only == NULL || strcmp(only, sweep->name) == 0) &&
			!run_sweep(run, sweep, error))
			return false;
	return true;
}

bool stress_run(const struct stress_options *options, struct sm_error *error)
{
	struct run run = {.options = options};
	bool ok = stress_probe_init(&run.probe, options->get_proc, error) &&
		  run_sweeps(&run, error);
	stress_probe_finish(&run.probe);
	if (ok && run.failures > 0)
		return error_set(error, SM_ERROR_MACHINE,
			"%" PRIu32 " of %" PRIu32 " checks of numerical stress fail", run.failures,
			run.checks);
	return ok;
}
