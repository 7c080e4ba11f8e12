/* SPDX-License-Identifier: MIT */
#ifndef BENCH_CONTENTS_H
#define BENCH_CONTENTS_H

#include "bench/distinct.h"
#include "bench/run_facts.h"

/** What pages about results are made from. */
struct contents {
	const struct result_list *results; /* not owned */
	const struct run_facts *facts;     /* not owned */
	const char *folder;                /* where the pages will be; not owned */
	bool has_plots;                    /* whether there are charts beside them */
	struct distinct scenes, settings, techniques, families;
	const char *passes[32]; /* distinct names, of as many as fit */
	size_t pass_count;
	const struct result *main; /* the setting that is shown first; NULL without results */
};

/** Fails (MACHINE) when out of memory. The results must stay as they are meanwhile. */
bool contents_init(struct contents *contents, const struct result_list *results,
	const struct run_facts *facts, const char *folder, struct sm_error *error);
void contents_finish(struct contents *contents);

/** The results of a scene in a setting. */
struct rows {
	const struct contents *contents; /* not owned */
	const struct result *scene, *setting;
};

/** The first result after another of them, or with NULL of all; NULL behind the last. */
const struct result *rows_next(const struct rows *rows, const struct result *after);

/** The number of a pass in contents->passes; pass_count where it is not there. */
size_t pass_number(const struct contents *contents, const char *pass);

/** The longest name of a file that pages refer to, with its folder and end. */
#define FILE_NAME_MAX 512

/** Writes where the chart of a setting is below the folder: of a scene in the main setting, or with
 *  NULL of the means over all. */
void plot_file_name(const struct contents *contents, const struct result *setting,
	const struct result *scene, const char *extension, char name[FILE_NAME_MAX]);

/** Writes where the difference picture of a result is below the folder. */
void difference_file_name(const struct result *result, char name[FILE_NAME_MAX]);

/** Writes where the techniques of a result's scene and setting, whatever its precision, are shown
 *  side by side, below the folder. */
void sheet_file_name(const struct result *result, char name[FILE_NAME_MAX]);

/** Whether there is a chart: gnuplot was there, and a time and an error were measured. */
bool has_plot(
	const struct contents *contents, const struct result *setting, const struct result *scene);

/** Whether the folder has such a picture. */
bool has_difference(const struct contents *contents, const struct result *result);
bool has_sheet(const struct contents *contents, const struct result *result);

#endif
