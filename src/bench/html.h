/* SPDX-License-Identifier: MIT */
#ifndef BENCH_HTML_H
#define BENCH_HTML_H

#include "bench/contents.h"
#include <stdio.h>

/** Writes report.html: charts, tables, difference pictures, machine, and how to repeat it. It shows
 *  the pictures that are in the folder. The caller checks the file for errors. */
void html_write(const struct contents *contents, FILE *file);

/** Writes the section of one scene. */
void html_write_scene(const struct contents *contents, const struct result *scene, FILE *file);

/** Writes a chart of the setting, of a scene or with NULL of all, where there are charts. */
void html_write_plot(const struct contents *contents, const struct result *setting,
	const struct result *scene, FILE *file);

#endif
