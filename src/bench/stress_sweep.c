/* SPDX-License-Identifier: MIT */
#include "bench/stress_sweep.h"
#include "bench/stress_base.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* A sweep on its way through one kind of light and one way. */
struct course {
	const struct stress_sweep *sweep;
	struct stress_probe *probe;
	const struct stress_listener *listener;
	struct stress_outcome *outcome;
	enum sm_light_type type;
	struct stress_way way;
	struct stress_picture base; /* empty: there is none */
};

static bool make_scene(const struct course *course, double value, struct stress_scene *scene,
	struct sm_error *error)
{
	if (!stress_base_init(scene, course->type, error)) {
		stress_scene_finish(scene);
		return false;
	}
	scene->shadow.technique = course->way.technique;
	scene->shadow.samples = course->way.samples;
	if (course->sweep->make(scene, value, error))
		return true;
	stress_scene_finish(scene);
	return false;
}

static double error_of(const struct course *course, const struct stress_picture *seen)
{
	const struct stress_picture *base = &course->base;
	size_t count = (size_t)seen->width * seen->height;
	double sum = 0;
	if (course->sweep->truth == STRESS_BASE &&
		(base->width != seen->width || base->height != seen->height))
		return 0;
	for (size_t i = 0; i < count; i++)
		switch (course->sweep->truth) {
		case STRESS_BASE:
			sum += fabs((double)seen->values[i] - (double)base->values[i]);
			break;
		case STRESS_LIT:
			sum += 1 - (double)seen->values[i];
			break;
		case STRESS_DARK:
			sum += (double)seen->values[i];
			break;
		}
	return sum / (double)count;
}

static const char *light_name(const struct course *course)
{
	return course->type == SM_LIGHT_SPOT ? "spot" : "directional";
}

static void report(const struct course *course, double value, const struct stress_scene *scene,
	const struct stress_fault *fault)
{
	char place[160];
	snprintf(place, sizeof(place), "%s %g, %s, %s", course->sweep->name, value,
		light_name(course), course->way.name);
	course->outcome->failures++;
	course->listener->fault(course->listener->data, place, scene, fault);
}

/* As it is on this driver. */
static double possible(const struct course *course, double value)
{
	return course->sweep->of_map ? fmin(value, course->probe->max_texture_size) : value;
}

/* Holds a picture against the sweep's bound, and keeps the worst. */
static bool judge(const struct course *course, double value, const struct stress_picture *seen,
	struct stress_fault *fault)
{
	const struct stress_sweep *sweep = course->sweep;
	struct stress_outcome *outcome = course->outcome;
	bool is_bound =
		sweep->unbound == NULL || strcmp(sweep->unbound, course->way.technique) != 0;
	if (seen->values == NULL || !is_bound || value < sweep->from || value > sweep->to)
		return true;
	double error = error_of(course, seen), bound = sweep->constant + sweep->slope * value;
	if (outcome->bound == 0 || error * outcome->bound > outcome->error * bound) {
		outcome->error = error;
		outcome->bound = bound;
		outcome->value = value;
		snprintf(outcome->worst, sizeof(outcome->worst), "%s, %s", light_name(course),
			course->way.name);
	}
	return error <= bound || stress_fault_set(fault, STRESS_FAULT_BOUND,
					 "its error is %.5f, above %.5f", error, bound);
}

static bool run_value(struct course *course, double value, struct sm_error *error)
{
	struct stress_scene scene;
	struct stress_picture seen;
	struct stress_fault fault;
	if (!make_scene(course, value, &scene, error))
		return false;
	course->outcome->checks++;
	bool ok = stress_check_scene(course->probe, &scene, &seen, &fault) &&
		  judge(course, value, &seen, &fault);
	/* Many layers of a large map are more than some drivers allow. */
	if (!ok && course->sweep->of_map && fault.kind == STRESS_FAULT_MEMORY)
		course->outcome->left_out++;
	else if (!ok)
		report(course, value, &scene, &fault);
	stress_picture_finish(&seen);
	stress_scene_finish(&scene);
	return true;
}

static bool draw_base(struct course *course, struct sm_error *error)
{
	struct stress_scene scene;
	struct stress_fault fault;
	if (course->sweep->truth != STRESS_BASE)
		return true;
	double base = possible(course, course->sweep->base);
	if (!make_scene(course, base, &scene, error))
		return false;
	course->outcome->checks++;
	if (!stress_check_scene(course->probe, &scene, &course->base, &fault))
		report(course, base, &scene, &fault);
	stress_scene_finish(&scene);
	return true;
}

/* Whether the technique takes the options that the sweep sets. */
static bool applies(const struct course *course, bool *taken, struct sm_error *error)
{
	struct stress_scene scene;
	*taken = true;
	if (!course->sweep->is_optional)
		return true;
	if (!make_scene(course, course->sweep->values[0], &scene, error))
		return false;
	*taken = sm_renderer_set_shadows(course->probe->renderer, &scene.shadow, NULL);
	stress_scene_finish(&scene);
	return true;
}

/* Memory that nothing uses. */
static double free_bytes(void)
{
	return (double)sysconf(_SC_AVPHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

/* Whether a map of the sweep's first value can be had: what the last draw took, grown to its size,
 * twice (drivers may hold a copy), beside what else the machine does. */
static bool is_affordable(const struct course *course)
{
	struct stress_scene scene;
	struct sm_memory memory;
	double base = possible(course, course->sweep->base);
	if (!make_scene(course, base, &scene, NULL))
		return false;
	struct stress_fault fault;
	struct sm_scene *built = stress_scene_build(&scene, NULL);
	bool drawn = stress_check_scene(course->probe, &scene, NULL, &fault) && built != NULL;
	if (drawn)
		sm_renderer_get_memory(course->probe->renderer, built, &memory);
	sm_scene_destroy(built);
	stress_scene_finish(&scene);
	double growth = possible(course, course->sweep->values[0]) / base; /* > 0 */
	return drawn && 2 * (double)memory.targets * growth * growth < free_bytes() / 2;
}

static bool run_course(struct course *course, size_t count, struct sm_error *error)
{
	bool taken;
	if (count == 0)
		return true;
	if (!applies(course, &taken, error) || !taken)
		return !taken;
	if (course->sweep->is_large && !is_affordable(course)) {
		course->outcome->left_out++;
		return true;
	}
	bool ok = draw_base(course, error);
	for (size_t i = 0; i < count && ok; i++)
		ok = run_value(course, possible(course, course->sweep->values[i]), error);
	stress_picture_finish(&course->base);
	return ok;
}

/* A large one with the first choice of samples alone. */
static bool is_wanted(const struct course *course)
{
	struct stress_way first;
	return !course->sweep->is_large || (stress_way_at(0, course->way.technique, &first) &&
						   first.samples == course->way.samples);
}

bool stress_sweep_run(const struct stress_sweep *sweep, struct stress_probe *probe,
	const char *technique, enum stress_effort effort, const struct stress_listener *listener,
	struct stress_outcome *outcome, struct sm_error *error)
{
	static const enum sm_light_type types[] = {SM_LIGHT_SPOT, SM_LIGHT_DIRECTIONAL};
	struct course course = {
		.sweep = sweep, .probe = probe, .listener = listener, .outcome = outcome};
	bool ok = true;
	for (size_t i = 0; i < (sweep->spot_only ? 1 : 2) && ok; i++) {
		course.type = types[i];
		for (size_t j = 0; stress_way_at(j, technique, &course.way) && ok; j++)
			ok = !is_wanted(&course) ||
			     run_course(&course,
				     effort == STRESS_FULL ? sweep->count : sweep->quick, error);
	}
	return ok;
}
