/* SPDX-License-Identifier: MIT */
#include "bench/frontier.h"
#include "bench/pareto.h"

/* Whether it has a place in a chart of error against time. */
static bool find_point(const struct result *result, double point[2])
{
	point[0] = result->time[THREADS_DEFAULT].median;
	point[1] = result->error[REGION_PENUMBRA].rmse;
	return result->error[REGION_PENUMBRA].pixels > 0 && point[0] > 0 && point[1] >= 0;
}

static bool is_beaten(const double point[2], const double other[2], bool other_is_first)
{
	return pareto_dominates(other, point) ||
	       (other_is_first && other[0] == point[0] && other[1] == point[1]);
}

bool frontier_has(const struct result_list *list, const struct result *result)
{
	double point[2], other[2];
	if (!find_point(result, point) || point[1] >= FRONTIER_RMSE)
		return false;
	for (const struct result *at = list->items; at < list->items + list->count; at++)
		if (same_scene(at, result) && same_setting(at, result) && find_point(at, other) &&
			is_beaten(point, other, at < result))
			return false;
	return true;
}

/* The first row after another that is on the frontier, or with NULL of all; NULL behind the last.
 */
static const struct result *next_on_frontier(const struct rows *rows, const struct result *after)
{
	while ((after = rows_next(rows, after)) != NULL)
		if (frontier_has(rows->contents->results, after))
			break;
	return after;
}

static bool has_points(const struct rows *rows)
{
	const struct result *row = NULL;
	double point[2];
	while ((row = rows_next(rows, row)) != NULL)
		if (find_point(row, point))
			return true;
	return false;
}

void frontier_write(
	const struct rows *rows, void (*escape)(const char *text, FILE *file), FILE *file)
{
	const struct result *row = NULL;
	size_t count = 0;
	if (!has_points(rows))
		return;
	fprintf(file, "Below an RMSE of %g, those that none beats in both time and error: ",
		FRONTIER_RMSE);
	for (; (row = next_on_frontier(rows, row)) != NULL; count++) {
		fputs(count > 0 ? ", " : "", file);
		escape(row->technique, file);
	}
	fputs(count > 0 ? "." : "none.", file);
}

/* In how many scenes and settings the frontier has that technique alone; NULL: how many there are
 * with points. */
static size_t count_alone(const struct contents *contents, const struct result *technique)
{
	size_t count = 0;
	for (size_t i = 0; i < contents->scenes.count; i++)
		for (size_t j = 0; j < contents->settings.count; j++) {
			const struct rows rows = {
				contents, contents->scenes.items[i], contents->settings.items[j]};
			const struct result *first = next_on_frontier(&rows, NULL);
			if (technique == NULL)
				count += has_points(&rows);
			else
				count += first != NULL && same_technique(first, technique) &&
					 next_on_frontier(&rows, first) == NULL;
		}
	return count;
}

void frontier_write_alone(
	const struct contents *contents, void (*escape)(const char *text, FILE *file), FILE *file)
{
	size_t all = count_alone(contents, NULL), listed = 0;
	if (all == 0)
		return;
	fprintf(file, "Below an RMSE of %g, one alone that none beats in both time and error: ",
		FRONTIER_RMSE);
	for (size_t i = 0; i < contents->techniques.count; i++) {
		const struct result *technique = contents->techniques.items[i];
		size_t alone = count_alone(contents, technique);
		if (alone == 0)
			continue;
		fputs(listed++ > 0 ? ", " : "", file);
		escape(technique->technique, file);
		fprintf(file, " in %zu", alone);
	}
	fprintf(file, "%s of %zu scenes and settings.", listed > 0 ? "" : "in none", all);
}
