/* SPDX-License-Identifier: MIT */
#include "bench/report.h"
#include "base/log.h"
#include "bench/contents.h"
#include "bench/csv.h"
#include "bench/gnuplot.h"
#include "bench/html.h"
#include "bench/json.h"
#include "bench/markdown.h"
#include "bench/plot.h"
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool report_make_folder(const char *path, struct sm_error *error)
{
	struct stat found;
	if (mkdir(path, 0777) == 0)
		return true;
	int code = errno;
	if (code == EEXIST && stat(path, &found) == 0 && S_ISDIR(found.st_mode))
		return true;
	return error_set(error, SM_ERROR_INPUT, "cannot make the folder %.300s (%s)", path,
		strerror(code == EEXIST ? ENOTDIR : code));
}

/* The path of a file in the report's folder: PATH_MAX bytes. */
static bool find_path(
	const struct report *report, const char *name, char *path, struct sm_error *error)
{
	return snprintf(path, PATH_MAX, "%s/%s", report->folder, name) < PATH_MAX ||
	       error_set(error, SM_ERROR_INPUT, "the path of the folder %.100s... is too long",
		       report->folder);
}

static bool write_bytes(const struct report *report, const char *name, const void *bytes,
	size_t size, struct sm_error *error)
{
	char path[PATH_MAX];
	return find_path(report, name, path, error) && report->write(path, bytes, size, error);
}

static void write_csv(const struct contents *contents, FILE *file)
{
	csv_write(contents->results, file);
}

static void write_json(const struct contents *contents, FILE *file)
{
	json_write(contents->results, contents->facts, file);
}

/* What a page is made from, and by what. */
struct page {
	void (*write)(const struct contents *contents, FILE *file);
	const struct contents *contents; /* not owned */
};

static void print_page(FILE *file, const void *data)
{
	const struct page *page = data;
	page->write(page->contents, file);
}

static bool write_page(const struct report *report, const char *name,
	void (*write)(const struct contents *contents, FILE *file), const struct contents *contents,
	struct sm_error *error)
{
	const struct page page = {write, contents};
	char path[PATH_MAX];
	return find_path(report, name, path, error) &&
	       file_print(path, print_page, &page, report->write, error);
}

/* Everything in a file, from where it is. */
static bool read_whole(FILE *file, char **bytes, size_t *size, struct sm_error *error)
{
	char part[4096];
	size_t count;
	*bytes = NULL;
	FILE *whole = open_memstream(bytes, size);
	if (whole == NULL)
		return error_no_memory(error);
	while ((count = fread(part, 1, sizeof(part), file)) > 0)
		fwrite(part, 1, count, whole);
	bool copied = ferror(file) == 0 && ferror(whole) == 0;
	return (fclose(whole) == 0 && copied) || error_no_memory(error);
}

static bool draw(
	const struct plot *plot, enum plot_format format, FILE **picture, struct sm_error *error)
{
	FILE *script = tmpfile();
	*picture = NULL;
	if (script == NULL)
		return error_set(
			error, SM_ERROR_MACHINE, "cannot keep a chart (%s)", strerror(errno));
	bool drawn = plot_write_script(plot, format, script, error) &&
		     gnuplot_run(script, picture, error);
	fclose(script);
	return drawn;
}

static bool write_plot_as(const struct report *report, const struct plot *plot,
	enum plot_format format, const char *name, struct sm_error *error)
{
	FILE *picture;
	char *bytes = NULL;
	size_t size;
	if (!draw(plot, format, &picture, error))
		return false;
	bool written = read_whole(picture, &bytes, &size, error) &&
		       write_bytes(report, name, bytes, size, error);
	free(bytes);
	fclose(picture);
	return written;
}

static bool write_plot(const struct report *report, const struct contents *contents,
	const struct result *setting, const struct result *scene, struct sm_error *error)
{
	static const char *const extensions[PLOT_FORMATS] = {
		[PLOT_SVG] = "svg", [PLOT_PNG] = "png"};
	struct plot plot;
	char name[FILE_NAME_MAX];
	if (!has_plot(contents, setting, scene))
		return true;
	bool written = plot_init(&plot, contents, setting, scene, error);
	for (size_t i = 0; i < PLOT_FORMATS && written; i++) {
		plot_file_name(contents, setting, scene, extensions[i], name);
		written = write_plot_as(report, &plot, (enum plot_format)i, name, error);
	}
	plot_finish(&plot);
	return written;
}

static bool write_plots(
	const struct report *report, const struct contents *contents, struct sm_error *error)
{
	for (size_t i = 0; i < contents->settings.count; i++)
		if (!write_plot(report, contents, contents->settings.items[i], NULL, error))
			return false;
	for (size_t i = 0; i < contents->scenes.count; i++)
		if (!write_plot(report, contents, contents->main, contents->scenes.items[i], error))
			return false;
	return true;
}

/* Whether gnuplot is there with all that charts want. */
static bool can_plot(void)
{
	struct sm_error error;
	FILE *script = tmpfile(), *output;
	if (script == NULL)
		return false;
	fputs("set terminal svg\nset terminal pngcairo\n", script);
	bool runs = gnuplot_run(script, &output, &error);
	if (runs)
		fclose(output);
	else
		log_warning("going on without charts: %s", error.text);
	fclose(script);
	return runs;
}

static bool write_pages(
	const struct report *report, struct contents *contents, struct sm_error *error)
{
	char plots[PATH_MAX];
	contents->has_plots = contents->main != NULL && can_plot();
	if (contents->has_plots &&
		!(find_path(report, "plots", plots, error) && report_make_folder(plots, error) &&
			write_plots(report, contents, error)))
		return false;
	return write_page(report, "report.html", html_write, contents, error) &&
	       write_page(report, "results.md", markdown_write, contents, error);
}

bool report_write_data(const struct report *report, struct sm_error *error)
{
	const struct contents contents = {.results = report->results, .facts = report->facts};
	return write_page(report, "results.csv", write_csv, &contents, error) &&
	       write_page(report, "results.json", write_json, &contents, error);
}

bool report_write(const struct report *report, struct sm_error *error)
{
	struct contents contents;
	if (!report_make_folder(report->folder, error) || !report_write_data(report, error) ||
		!contents_init(&contents, report->results, report->facts, report->folder, error))
		return false;
	bool written = write_pages(report, &contents, error);
	contents_finish(&contents);
	return written;
}
