/* SPDX-License-Identifier: MIT */
#include "bench/table.h"
#include "bench/column.h"
#include <math.h>
#include <stdio.h>

enum format { FORMAT_ERROR, FORMAT_SIGNED, FORMAT_COUNT, FORMAT_TIME, FORMAT_BYTES };

struct table_column {
	const char *heading;
	const char *name; /* of the column in results.csv */
	enum format format;
	bool has_best; /* the lowest */
};

static const struct table_column columns[] = {
	{"RMSE", "penumbra_rmse", FORMAT_ERROR, true},
	{"bias", "penumbra_bias", FORMAT_SIGNED, false},
	{"p95", "penumbra_p95", FORMAT_ERROR, true},
	{"p99", "penumbra_p99", FORMAT_ERROR, true},
	{"max", "penumbra_max", FORMAT_ERROR, false},
	{"RMSE lit", "lit_rmse", FORMAT_ERROR, true},
	{"RMSE umbra", "umbra_rmse", FORMAT_ERROR, true},
	{"RMSE of all", "all_rmse", FORMAT_ERROR, true},
	{"wrong outside", "outside_wrong", FORMAT_COUNT, true},
	{"flicker", "flicker", FORMAT_ERROR, true},
	{"ms", "ms", FORMAT_TIME, false},
	{"ms / hard", "ratio", FORMAT_TIME, true},
	{"ms / pcss-16", "ratio_pcss_16", FORMAT_TIME, false},
	{"CPU ms", "cpu_ms", FORMAT_TIME, true},
	{"ms single", "ms_single", FORMAT_TIME, false},
	{"single / hard", "ratio_single", FORMAT_TIME, true},
	{"geometry", "geometry_bytes", FORMAT_BYTES, false},
	{"targets", "target_bytes", FORMAT_BYTES, false},
	{"peak", "peak_bytes", FORMAT_BYTES, false},
};

const char *table_heading(const struct table_column *column)
{
	return column->heading;
}

const char *table_help(const struct table_column *column)
{
	return column_at(column_find(column->name))->help;
}

/* NAN where nothing was measured: times and sizes of 0 were not. */
static double measured(const struct table_column *column, const struct result *result)
{
	double value = column_value(column_at(column_find(column->name)), result);
	bool zero_is_none = column->format == FORMAT_TIME || column->format == FORMAT_BYTES;
	return zero_is_none && value == 0 ? NAN : value;
}

static bool is_measured(const struct table_column *column, const struct result_list *list)
{
	for (size_t i = 0; i < list->count; i++)
		if (!isnan(measured(column, &list->items[i])))
			return true;
	return false;
}

const struct table_column *table_next_column(
	const struct table_column *after, const struct result_list *list)
{
	const struct table_column *column = after != NULL ? after + 1 : columns;
	for (; column < columns + sizeof(columns) / sizeof(columns[0]); column++)
		if (is_measured(column, list))
			return column;
	return NULL;
}

static void format_bytes(double bytes, char text[TABLE_CELL_MAX])
{
	static const char *const units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
	size_t unit = 0;
	while (bytes >= 1000 && unit + 1 < sizeof(units) / sizeof(units[0])) {
		bytes /= 1024;
		unit++;
	}
	snprintf(text, TABLE_CELL_MAX, "%.*f %s", unit > 0 && bytes < 100 ? 1 : 0, bytes,
		units[unit]);
}

void table_cell(
	const struct table_column *column, const struct result *result, char text[TABLE_CELL_MAX])
{
	double value = measured(column, result);
	if (isnan(value))
		snprintf(text, TABLE_CELL_MAX, "-");
	else if (column->format == FORMAT_BYTES)
		format_bytes(value, text);
	else if (column->format == FORMAT_COUNT)
		snprintf(text, TABLE_CELL_MAX, "%.0f", value);
	else if (column->format == FORMAT_TIME)
		snprintf(text, TABLE_CELL_MAX, "%.2f", value);
	else
		snprintf(text, TABLE_CELL_MAX, column->format == FORMAT_SIGNED ? "%+.4f" : "%.4f",
			value);
}

bool table_is_best(const struct table_column *column, const struct result_list *list,
	const struct result *result)
{
	double value = measured(column, result);
	if (!column->has_best || isnan(value))
		return false;
	for (size_t i = 0; i < list->count; i++)
		if (same_scene(&list->items[i], result) && same_setting(&list->items[i], result) &&
			measured(column, &list->items[i]) < value)
			return false;
	return true;
}
