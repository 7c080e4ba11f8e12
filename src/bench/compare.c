/* SPDX-License-Identifier: MIT */
#include "bench/compare.h"
#include "bench/column.h"
#include "bench/distinct.h"
#include <math.h>
#include <string.h>

/* What a measure depends on beside the program. */
enum kind { KIND_ERROR, KIND_TIME, KIND_MEMORY };

struct measure {
	const char *name; /* of a column of which less is better */
	enum kind kind;
	double absolute, relative;  /* smaller changes are noise */
	enum thread_choice threads; /* of times */
};

static const struct measure measures[] = {
	{"penumbra_rmse", KIND_ERROR, 1e-4, 0.01},
	{"penumbra_p99", KIND_ERROR, 1e-4, 0.01},
	{"all_rmse", KIND_ERROR, 1e-4, 0.01},
	{"outside_wrong", KIND_ERROR, 2, 0.01},
	{"flicker", KIND_ERROR, 1e-4, 0.01},
	{"ratio", KIND_TIME, 0, 0.05, THREADS_DEFAULT},
	{"ratio_single", KIND_TIME, 0, 0.05, THREADS_NONE},
	{"geometry_bytes", KIND_MEMORY, 0, 0.01},
	{"target_bytes", KIND_MEMORY, 0, 0.01},
	{"peak_bytes", KIND_MEMORY, 0, 0.05},
};

static bool same_result(const struct result *a, const struct result *b)
{
	return same_scene(a, b) && same_technique(a, b) &&
	       strcmp(a->precision, b->precision) == 0 && a->radius == b->radius &&
	       a->map == b->map;
}

static const struct result *find(const struct result_list *list, const struct result *result)
{
	for (size_t i = 0; i < list->count; i++)
		if (same_result(&list->items[i], result))
			return &list->items[i];
	return NULL;
}

static bool same_machine(const struct result *a, const struct result *b)
{
	return strcmp(a->machine, b->machine) == 0;
}

static bool same_size(const struct result *a, const struct result *b)
{
	return a->width == b->width && a->height == b->height;
}

static bool same_time_size(const struct result *a, const struct result *b)
{
	return a->time_width == b->time_width && a->time_height == b->time_height;
}

static bool can_compare(enum kind kind, const struct result *a, const struct result *b)
{
	switch (kind) {
	case KIND_ERROR:
		return same_size(a, b);
	case KIND_TIME:
		return same_machine(a, b) && same_time_size(a, b);
	case KIND_MEMORY:
		break;
	}
	return same_time_size(a, b);
}

/* How far times lie apart, as a share of their median. */
static double half_spread(const struct time_summary *time)
{
	double spread = (time->p90 - time->p10) / 2;
	return time->median > 0 && spread > 0 ? spread / time->median : 0;
}

static double noise(
	const struct measure *measure, const struct result *from, const struct result *to)
{
	if (measure->kind != KIND_TIME)
		return measure->relative;
	double spread = fmax(half_spread(&from->time[measure->threads]),
		half_spread(&to->time[measure->threads]));
	return fmax(measure->relative, spread);
}

/* Below 0: better, above: worse, 0: alike, or one of them was not measured. */
static int change(const struct measure *measure, const struct result *from, const struct result *to)
{
	const struct column *column = column_at(column_find(measure->name));
	double old_value = column_value(column, from), new_value = column_value(column, to);
	bool zero_is_none = measure->kind != KIND_ERROR;
	if (isnan(old_value) || isnan(new_value) || !can_compare(measure->kind, from, to) ||
		(zero_is_none && (old_value == 0 || new_value == 0)))
		return 0;
	double limit = fmax(measure->absolute, noise(measure, from, to) * old_value);
	double difference = new_value - old_value;
	return fabs(difference) <= limit ? 0 : difference < 0 ? -1 : 1;
}

static void print_name(const struct result *result, FILE *file)
{
	fprintf(file, "%s, %s, %s, radius %g, map %u", result->scene, result->technique,
		result->precision, result->radius, result->map);
}

static void print_change(const struct measure *measure, const struct result *from,
	const struct result *to, int sign, FILE *file)
{
	const struct column *column = column_at(column_find(measure->name));
	double old_value = column_value(column, from), new_value = column_value(column, to);
	bool exact = measure->kind == KIND_MEMORY;
	fputs(sign < 0 ? "better  " : "worse   ", file);
	print_name(to, file);
	fprintf(file, ": %s %.*g -> %.*g", measure->name, exact ? 15 : 4, old_value, exact ? 15 : 4,
		new_value);
	/* Of 0 there is no share. */
	if (old_value > 0)
		fprintf(file, " (%+.1f %%)", 100 * (new_value / old_value - 1));
	fputc('\n', file);
}

static void compare_result(const struct result *from, const struct result *to,
	struct comparison *comparison, FILE *file)
{
	bool better = false, worse = false;
	for (size_t i = 0; i < sizeof(measures) / sizeof(measures[0]); i++) {
		int sign = change(&measures[i], from, to);
		better |= sign < 0;
		worse |= sign > 0;
		if (sign != 0)
			print_change(&measures[i], from, to, sign, file);
	}
	comparison->worse += worse;
	comparison->better += better && !worse;
	comparison->alike += !better && !worse;
}

/* Prints once what keeps results from being compared. */
static void print_obstacles(
	const struct result_list *old_results, const struct result_list *new_results, FILE *file)
{
	bool machine = false, size = false, time_size = false;
	for (size_t i = 0; i < new_results->count; i++) {
		const struct result *to = &new_results->items[i], *from = find(old_results, to);
		if (from == NULL)
			continue;
		if (!same_machine(from, to) && !machine)
			fprintf(file, "machines differ, so times are not compared: %s -> %s\n",
				from->machine, to->machine);
		if (!same_size(from, to) && !size)
			fprintf(file, "sizes differ, so errors are not compared: %ux%u -> %ux%u\n",
				from->width, from->height, to->width, to->height);
		if (!same_time_size(from, to) && !time_size)
			fprintf(file,
				"sizes differ, so times and memory are not compared: %ux%u -> "
				"%ux%u\n",
				from->time_width, from->time_height, to->time_width,
				to->time_height);
		machine |= !same_machine(from, to);
		size |= !same_size(from, to);
		time_size |= !same_time_size(from, to);
	}
}

/* Prints those of a list that the other has not, and returns how many. */
static size_t print_missing(const struct result_list *list, const struct result_list *other,
	const char *where, FILE *file)
{
	size_t count = 0;
	for (size_t i = 0; i < list->count; i++) {
		if (find(other, &list->items[i]) != NULL)
			continue;
		fprintf(file, "%s  ", where);
		print_name(&list->items[i], file);
		fputc('\n', file);
		count++;
	}
	return count;
}

struct comparison compare_print(
	const struct result_list *old_results, const struct result_list *new_results, FILE *file)
{
	struct comparison comparison = {0};
	print_obstacles(old_results, new_results, file);
	for (size_t i = 0; i < new_results->count; i++) {
		const struct result *from = find(old_results, &new_results->items[i]);
		if (from != NULL)
			compare_result(from, &new_results->items[i], &comparison, file);
	}
	comparison.gone = print_missing(old_results, new_results, "gone  ", file);
	comparison.added = print_missing(new_results, old_results, "new   ", file);
	fprintf(file, "%zu better, %zu worse, %zu alike", comparison.better, comparison.worse,
		comparison.alike);
	if (comparison.gone + comparison.added > 0)
		fprintf(file, ", %zu gone, %zu new", comparison.gone, comparison.added);
	fputc('\n', file);
	return comparison;
}
