/* SPDX-License-Identifier: MIT */
#include "base/json.h"
#include "base/utf8.h"
#include "check/report.h"
#include <inttypes.h>

void check_tap_begin(FILE *file, size_t count)
{
	fprintf(file, "TAP version 13\n1..%zu\n", count);
}

/* One line of UTF-8 in which "#" starts no directive. */
static void print_text(const char *text, FILE *file)
{
	while (*text != '\0') {
		size_t size = utf8_size(text);
		if (*text == '#' || *text == '\\')
			fputc('\\', file);
		if (size == 0)
			fputs("\xef\xbf\xbd", file);
		else if ((unsigned char)*text < 0x20 || *text == 0x7f)
			fputc(' ', file);
		else
			fwrite(text, 1, size, file);
		text += size > 0 ? size : 1;
	}
}

static void print_directive(const struct check_result *result, FILE *file)
{
	if (result->status == CHECK_SKIP)
		fputs(" # SKIP ", file);
	else if (result->status == CHECK_EXPECTED_FAIL)
		fputs(" # TODO ", file);
	else
		return;
	print_text(result->message, file);
}

static void print_difference(const struct check_difference *difference, FILE *file)
{
	fprintf(file,
		"  difference:\n    pixels: %" PRIu64 "\n    failing: %" PRIu64
		"\n    budget: %" PRIu64 "\n    tolerance: %.9g\n    mean: %.9g\n    max: %.9g\n",
		difference->pixels, difference->failing, difference->budget, difference->tolerance,
		difference->mean, difference->max);
}

/* A string of JSON is one of YAML. */
static void print_string(const char *key, const char *value, FILE *file)
{
	fprintf(file, "%s: ", key);
	json_string(file, value);
	fputc('\n', file);
}

static void print_pictures(const struct check_pictures *pictures, FILE *file)
{
	fputs("  pictures:\n", file);
	print_string("    result", pictures->result, file);
	print_string("    reference", pictures->reference, file);
	print_string("    difference", pictures->difference, file);
}

static void print_diagnostics(const struct check_result *result, FILE *file)
{
	fprintf(file, "  ---\n  status: %s\n  attempts: %" PRIu32 "\n  seconds: %.3f\n",
		check_status_name(result->status), result->attempts, result->seconds);
	print_string("  message", result->message, file);
	if (result->difference.pixels > 0)
		print_difference(&result->difference, file);
	if (result->pictures.result[0] != '\0')
		print_pictures(&result->pictures, file);
	fputs("  ...\n", file);
}

void check_tap_result(FILE *file, size_t number, const struct check_result *result)
{
	bool ok = !check_status_is_unexpected(result->status) &&
		  result->status != CHECK_EXPECTED_FAIL; /* "not ok", but TODO */
	fprintf(file, "%s %zu - ", ok ? "ok" : "not ok", number);
	print_text(result->name, file);
	print_directive(result, file);
	fputc('\n', file);
	if (result->status != CHECK_PASS && result->status != CHECK_SKIP)
		print_diagnostics(result, file);
}

void check_tap_bail_out(FILE *file, const char *reason)
{
	fputs("Bail out! ", file);
	print_text(reason, file);
	fputc('\n', file);
}
