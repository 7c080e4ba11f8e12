/* SPDX-License-Identifier: MIT */
#include "bench/column.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FIELD(type, field, help)                                                                   \
	{                                                                                          \
#field, type, offsetof(struct result, field), sizeof(((struct result *)0)->field), \
			help                                                                       \
	}
#define MEMBER(name, type, field, help)                                                          \
	{                                                                                        \
		name, type, offsetof(struct result, field), sizeof(((struct result *)0)->field), \
			help                                                                     \
	}

#define ERROR(prefix, region, which)                                                        \
	MEMBER(prefix "_pixels", COLUMN_COUNT64, error[region].pixels, "number of " which), \
		MEMBER(prefix "_rmse", COLUMN_REAL, error[region].rmse,                     \
			"root mean square of the error, in " which),                        \
		MEMBER(prefix "_bias", COLUMN_REAL, error[region].bias,                     \
			"mean error, above 0: too bright, in " which),                      \
		MEMBER(prefix "_p95", COLUMN_REAL, error[region].p95,                       \
			"95th percentile of the absolute error, in " which),                \
		MEMBER(prefix "_p99", COLUMN_REAL, error[region].p99,                       \
			"99th percentile of the absolute error, in " which),                \
		MEMBER(prefix "_max", COLUMN_REAL, error[region].max,                       \
			"largest absolute error, in " which)

#define TIME(suffix, threads, how)                                                            \
	MEMBER("ms" suffix, COLUMN_REAL, time[threads].median,                                \
		"milliseconds of a frame, wall clock, median" how),                           \
		MEMBER("ms_p10" suffix, COLUMN_REAL, time[threads].p10,                       \
			"milliseconds that a tenth of the frames take less than" how),        \
		MEMBER("ms_p90" suffix, COLUMN_REAL, time[threads].p90,                       \
			"milliseconds that a tenth of the frames take more than" how),        \
		MEMBER("cpu_ms" suffix, COLUMN_REAL, time[threads].cpu,                       \
			"milliseconds of a frame in all threads of the process, median" how), \
		MEMBER("ratio" suffix, COLUMN_REAL, time[threads].ratio,                      \
			"median time of a frame to that of \"hard\" in the same rounds" how), \
		MEMBER("ratio_pcss_16" suffix, COLUMN_REAL, time[threads].ratio_pcss,         \
			"median time of a frame to that of \"pcss-16\" in the same rounds" how)

/* Errors are visibility minus reference, both linear in [0, 1]. */
static const struct column columns[] = {
	FIELD(COLUMN_TEXT, scene, "scene"),
	FIELD(COLUMN_TEXT, technique, "technique, with its number of samples where it has choices"),
	FIELD(COLUMN_TEXT, precision, "arithmetic of the shadows, as of --precision"),
	FIELD(COLUMN_REAL, radius, "radius of the light as a share of its distance"),
	FIELD(COLUMN_COUNT32, map, "texels along a side of the shadow map"),
	FIELD(COLUMN_COUNT32, width, "pixels across the picture that errors are of"),
	FIELD(COLUMN_COUNT32, height, "pixels down that picture"),
	FIELD(COLUMN_COUNT32, time_width, "pixels across the picture that times are of"),
	FIELD(COLUMN_COUNT32, time_height, "pixels down that picture"),
	FIELD(COLUMN_COUNT32, triangles, "triangles in the scene"),
	FIELD(COLUMN_TEXT, machine, "processor and driver"),
	ERROR("all", REGION_ALL, "pixels that face the light"),
	ERROR("lit", REGION_LIT, "pixels that see all of the light"),
	ERROR("umbra", REGION_UMBRA, "pixels that see nothing of the light"),
	ERROR("penumbra", REGION_PENUMBRA, "pixels that see a part of the light"),
	FIELD(COLUMN_REAL, outside_wrong,
		"number of pixels that see all or nothing of the light, with an error above 0.1"),
	FIELD(COLUMN_REAL, flicker,
		"mean of |change of visibility - change of reference| a frame, under a slow light"),
	TIME("", THREADS_DEFAULT, ""),
	TIME("_single", THREADS_NONE, ", without threads of the driver"),
	FIELD(COLUMN_PASSES, passes, "median milliseconds of each pass, GL waited for after it"),
	FIELD(COLUMN_COUNT64, geometry_bytes,
		"bytes of casters and fins in the processor's memory"),
	FIELD(COLUMN_COUNT64, target_bytes, "bytes of the textures that passes draw into"),
	FIELD(COLUMN_COUNT64, peak_bytes,
		"bytes of a process that draws this alone, at its largest"),
	FIELD(COLUMN_TEXT, memory, "bytes by owner, of all lights together: KIND: OWNER=BYTES;..."),
};

const struct column *column_at(size_t i)
{
	return i < sizeof(columns) / sizeof(columns[0]) ? &columns[i] : NULL;
}

size_t column_find(const char *name)
{
	for (size_t i = 0; column_at(i) != NULL; i++)
		if (strcmp(column_at(i)->name, name) == 0)
			return i;
	return SIZE_MAX;
}

void column_format_real(double value, char text[32])
{
	char number[32] = "";
	/* Counts as people write them. */
	if (fabs(value) < 1e6 && value == floor(value)) {
		snprintf(text, 32, "%.0f", value);
		return;
	}
	for (int digits = 1; digits <= 17 && !isnan(value); digits++) {
		snprintf(number, sizeof(number), "%.*g", digits, value);
		if (strtod(number, NULL) == value)
			break;
	}
	memcpy(text, number, sizeof(number));
}

static void format_passes(const struct pass_time *passes, char text[COLUMN_TEXT_MAX])
{
	char number[32];
	size_t used = 0;
	text[0] = '\0';
	for (size_t i = 0; i < PASSES_MAX && passes[i].name[0] != '\0'; i++) {
		column_format_real(passes[i].ms, number);
		used += (size_t)snprintf(text + used, COLUMN_TEXT_MAX - used, "%s%s=%s",
			i == 0 ? "" : ";", passes[i].name, number);
	}
}

void column_format(
	const struct column *column, const struct result *result, char text[COLUMN_TEXT_MAX])
{
	const void *value = (const char *)result + column->offset;
	switch (column->type) {
	case COLUMN_TEXT:
		snprintf(text, COLUMN_TEXT_MAX, "%s", (const char *)value);
		break;
	case COLUMN_REAL:
		column_format_real(*(const double *)value, text);
		break;
	case COLUMN_COUNT32:
		snprintf(text, COLUMN_TEXT_MAX, "%u", *(const uint32_t *)value);
		break;
	case COLUMN_COUNT64:
		snprintf(text, COLUMN_TEXT_MAX, "%llu",
			(unsigned long long)*(const uint64_t *)value);
		break;
	case COLUMN_PASSES:
		format_passes(value, text);
		break;
	}
}

double column_value(const struct column *column, const struct result *result)
{
	const void *value = (const char *)result + column->offset;
	switch (column->type) {
	case COLUMN_REAL:
		return *(const double *)value;
	case COLUMN_COUNT32:
		return *(const uint32_t *)value;
	case COLUMN_COUNT64:
		return (double)*(const uint64_t *)value;
	case COLUMN_TEXT:
	case COLUMN_PASSES:
		break;
	}
	return NAN;
}

static const char *parse_text(char *value, size_t size, const char *text)
{
	if (strlen(text) >= size)
		return "is too long";
	strcpy(value, text);
	return NULL;
}

static const char *parse_real(double *value, const char *text)
{
	char *end;
	*value = NAN;
	if (text[0] == '\0')
		return NULL;
	*value = strtod(text, &end);
	return *end == '\0' && !strchr(" \t\n", text[0]) ? NULL : "is not a number";
}

static const char *parse_count(uint64_t *value, uint64_t max, const char *text)
{
	if (text[0] == '\0' || strspn(text, "0123456789") != strlen(text))
		return "is not a whole number";
	errno = 0;
	*value = strtoull(text, NULL, 10);
	return errno == 0 && *value <= max ? NULL : "is too large";
}

static const char *parse_passes(struct pass_time passes[PASSES_MAX], const char *text)
{
	char number[32];
	memset(passes, 0, PASSES_MAX * sizeof(passes[0]));
	for (size_t i = 0; *text != '\0'; i++) {
		size_t name = strcspn(text, "=;");
		if (i == PASSES_MAX)
			return "has too many passes";
		if (text[name] != '=' || name == 0 || name >= sizeof(passes[i].name))
			return "is not NAME=MS;NAME=MS...";
		memcpy(passes[i].name, text, name);
		text += name + 1;
		size_t length = strcspn(text, ";");
		if (length >= sizeof(number))
			return "is not NAME=MS;NAME=MS...";
		snprintf(number, sizeof(number), "%.*s", (int)length, text);
		const char *problem = parse_real(&passes[i].ms, number);
		if (problem != NULL)
			return problem;
		text += length + (text[length] == ';');
	}
	return NULL;
}

const char *column_parse(const struct column *column, struct result *result, const char *text)
{
	void *value = (char *)result + column->offset;
	uint64_t count = 0;
	const char *problem = NULL;
	switch (column->type) {
	case COLUMN_TEXT:
		return parse_text(value, column->size, text);
	case COLUMN_REAL:
		return parse_real(value, text);
	case COLUMN_COUNT32:
		problem = parse_count(&count, UINT32_MAX, text);
		*(uint32_t *)value = (uint32_t)count;
		return problem;
	case COLUMN_COUNT64:
		return parse_count(value, UINT64_MAX, text);
	case COLUMN_PASSES:
		return parse_passes(value, text);
	}
	return problem;
}
