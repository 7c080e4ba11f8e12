/* SPDX-License-Identifier: MIT */
#include "bench/distinct.h"
#include "bench/markdown.h"
#include <math.h>
#include <string.h>

/* What the others are held against. */
static const char base_name[] = "float";

static bool is_base(const struct result *result)
{
	return strcmp(result->precision, base_name) == 0;
}

/* The one in float that a result in another precision is the same as but for that; NULL: none. */
static const struct result *find_base(
	const struct result_list *results, const struct result *result)
{
	for (size_t i = 0; i < results->count; i++) {
		const struct result *base = &results->items[i];
		if (is_base(base) && same_scene(base, result) && same_technique(base, result) &&
			same_conditions(base, result))
			return base;
	}
	return NULL;
}

static bool is_compared(const struct result_list *results, const struct result *base)
{
	for (size_t i = 0; i < results->count; i++)
		if (!is_base(&results->items[i]) && find_base(results, &results->items[i]) == base)
			return true;
	return false;
}

/* NAN: not measured. */
static void write_number(const char *format, double value, FILE *file)
{
	if (isfinite(value))
		fprintf(file, format, value);
	else
		fputs(" - |", file);
}

static double median_of(const struct result *result)
{
	double ms = result->time[THREADS_DEFAULT].median;
	return ms > 0 ? ms : NAN;
}

static void write_row(const struct result *result, const struct result *base, FILE *file)
{
	const struct error_summary *error = &result->error[REGION_PENUMBRA];
	fputs("| ", file);
	markdown_text(result->scene, file);
	fprintf(file, " | %g | %u | ", result->radius, result->map);
	markdown_text(result->technique, file);
	fputs(" | ", file);
	markdown_text(result->precision, file);
	fputs(" |", file);
	write_number(" %.4f |", error->rmse, file);
	write_number(" %+.4f |", error->rmse - base->error[REGION_PENUMBRA].rmse, file);
	write_number(" %+.4f |", error->bias, file);
	write_number(" %.4f |", error->p99, file);
	write_number(" %.5f |", result->flicker, file);
	write_number(" %.2f |", median_of(result), file);
	write_number(" %.2f |", median_of(result) / median_of(base), file);
	fputc('\n', file);
}

static void write_head(FILE *file)
{
	static const char *const headings[] = {"scene", "radius", "map", "technique", "precision",
		"RMSE", "more", "bias", "p99", "flicker", "ms", "ms / float"};
	const size_t count = sizeof(headings) / sizeof(headings[0]);
	fputs("## What each precision costs\n\nErrors as below, against the same truth; \"more\" "
	      "is "
	      "RMSE above that of float. Times are of frames drawn in turns.\n\n|",
		file);
	for (size_t i = 0; i < count; i++)
		fprintf(file, " %s |", headings[i]);
	fputc('\n', file);
	markdown_rule(count, file);
}

void markdown_precisions(const struct result_list *results, FILE *file)
{
	bool begun = false;
	for (size_t i = 0; i < results->count; i++) {
		const struct result *base = &results->items[i];
		if (!is_base(base) || !is_compared(results, base))
			continue;
		if (!begun)
			write_head(file);
		begun = true;
		write_row(base, base, file);
		for (size_t j = 0; j < results->count; j++)
			if (!is_base(&results->items[j]) &&
				find_base(results, &results->items[j]) == base)
				write_row(&results->items[j], base, file);
	}
	if (begun)
		fputc('\n', file);
}
