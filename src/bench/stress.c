/* SPDX-License-Identifier: MIT */
#include "bench/stress.h"
#include "base/error.h"
#include "bench/stress_file.h"
#include "bench/stress_shrink.h"
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

/* Writes a scene that broke a rule, if there is a folder, and tells whether it does so again as it
 * is loaded. */
static void write_scene(struct run *run, const char *place, const struct stress_scene *scene)
{
	const struct stress_options *options = run->options;
	char name[200], path[1024];
	struct stress_fault fault;
	struct sm_error error;
	if (options->folder == NULL)
		return;
	if (!stress_file_can_say(scene)) {
		fprintf(options->lines, "  no scene file can say it\n");
		return;
	}
	file_name(place, name, sizeof(name));
	if (!stress_file_write(scene, options->folder, name, path, sizeof(path), &error) ||
		!stress_file_check(path, &run->probe, NULL, &fault, &error)) {
		fprintf(options->lines, "  %s\n", error.text);
		return;
	}
	fprintf(options->lines, "  smoothie render --visibility --samples 1 \"%s\"\n", path);
	if (fault.text[0] != '\0')
		fprintf(options->lines, "  loaded from there: %s\n", fault.text);
}

static void report_fault(void *data, const char *place, const struct stress_scene *scene,
	const struct stress_fault *fault)
{
	struct run *run = data;
	fprintf(run->options->lines, "FAILED %s: %s\n", place, fault->text);
	write_scene(run, place, scene);
}

static void step(struct run *run)
{
	run->done++;
	if (run->options->progress != NULL)
		run->options->progress(run->options->data, run->done, run->total);
}

static void print_outcome(const struct run *run, const struct stress_sweep *sweep,
	const struct stress_outcome *outcome)
{
	FILE *lines = run->options->lines;
	fprintf(lines, "%-13s %5" PRIu32 " checks, ", sweep->name, outcome->checks);
	if (outcome->left_out > 0)
		fprintf(lines, "%" PRIu32 " left out for lack of memory, ", outcome->left_out);
	if (outcome->bound > 0)
		fprintf(lines, "error at worst %.6f of %.6f (%g, %s)\n", outcome->error,
			outcome->bound, outcome->value, outcome->worst);
	else
		fprintf(lines, "for valid pictures alone\n");
}

static bool run_sweep(struct run *run, const struct stress_sweep *sweep, struct sm_error *error)
{
	const struct stress_options *options = run->options;
	const struct stress_listener listener = {run, report_fault};
	struct stress_outcome outcome = {0};
	if (!stress_sweep_run(sweep, &run->probe, options->technique, options->effort, &listener,
		    &outcome, error))
		return false;
	print_outcome(run, sweep, &outcome);
	run->checks += outcome.checks;
	run->failures += outcome.failures;
	step(run);
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

static bool run_random_scene(struct run *run, uint32_t number, struct sm_error *error)
{
	const struct stress_options *options = run->options;
	struct stress_scene scene;
	struct stress_fault fault;
	char place[80];
	if (!stress_random_scene(
		    &scene, options->seed, number, options->technique, &run->probe, error))
		return false;
	run->checks++;
	if (!stress_random_check(&run->probe, &scene, options->rule, &fault)) {
		run->failures++;
		stress_shrink(&scene, &run->probe, options->rule, &fault);
		snprintf(
			place, sizeof(place), "random %" PRIu64 " %" PRIu32, options->seed, number);
		report_fault(run, place, &scene, &fault);
	}
	stress_scene_finish(&scene);
	step(run);
	return true;
}

static bool run_random_scenes(struct run *run, struct sm_error *error)
{
	const struct stress_options *options = run->options;
	uint32_t failures = run->failures;
	bool ok = true;
	/* Before they are drawn, which might crash. */
	if (options->random_scenes > 0)
		fprintf(options->lines, "random scenes %5" PRIu32 " of seed %" PRIu64 "\n",
			options->random_scenes, options->seed);
	fflush(options->lines);
	for (uint32_t i = 0; i < options->random_scenes && ok; i++)
		ok = run_random_scene(run, i, error);
	if (ok && options->random_scenes > 0)
		fprintf(options->lines, "random scenes %5" PRIu32 " break a rule\n",
			run->failures - failures);
	return ok;
}

static bool run_file(struct run *run, struct sm_error *error)
{
	struct stress_fault fault;
	if (!stress_file_check(run->options->scene, &run->probe, NULL, &fault, error))
		return false;
	run->checks++;
	if (fault.text[0] != '\0') {
		run->failures++;
		fprintf(run->options->lines, "FAILED %s: %s\n", run->options->scene, fault.text);
	}
	return true;
}

static uint32_t count_steps(const struct stress_options *options)
{
	uint32_t sweeps = 0;
	while (options->sweep == NULL && stress_sweep_at(sweeps) != NULL)
		sweeps++;
	return (options->sweep != NULL ? 1 : sweeps) + options->random_scenes;
}

static bool error_unknown_sweep(const char *name, struct sm_error *error)
{
	char names[400] = "";
	size_t used = 0;
	for (size_t i = 0; stress_sweep_at(i) != NULL && used < sizeof(names); i++)
		used += (size_t)snprintf(names + used, sizeof(names) - used, "%s%s",
			i > 0 ? ", " : "", stress_sweep_at(i)->name);
	return error_set(error, SM_ERROR_INPUT, "no sweep \"%.40s\"; there are: %s", name, names);
}

static bool check_names(const struct stress_options *options, struct sm_error *error)
{
	struct stress_way way;
	bool known = options->sweep == NULL;
	for (size_t i = 0; stress_sweep_at(i) != NULL && !known; i++)
		known = strcmp(stress_sweep_at(i)->name, options->sweep) == 0;
	if (!known)
		return error_unknown_sweep(options->sweep, error);
	return stress_way_at(0, options->technique, &way) ||
	       error_set(error, SM_ERROR_INPUT, "no technique \"%.40s\"", options->technique);
}

static bool run_all(struct run *run, struct sm_error *error)
{
	if (run->options->scene != NULL)
		return run_file(run, error);
	return run_sweeps(run, error) && run_random_scenes(run, error);
}

bool stress_run(const struct stress_options *options, struct sm_error *error)
{
	struct run run = {.options = options, .total = count_steps(options)};
	bool ok = check_names(options, error) &&
		  stress_probe_init(&run.probe, options->get_proc, &options->driver, error) &&
		  run_all(&run, error);
	stress_probe_finish(&run.probe);
	if (ok && run.failures > 0)
		return error_set(error, SM_ERROR_MACHINE,
			"%" PRIu32 " of %" PRIu32 " checks of numerical stress fail", run.failures,
			run.checks);
	return ok;
}
