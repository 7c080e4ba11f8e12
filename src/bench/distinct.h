/* SPDX-License-Identifier: MIT */
#ifndef BENCH_DISTINCT_H
#define BENCH_DISTINCT_H

#include "bench/result.h"

/** Whether two results have something in common. */
typedef bool (*result_match)(const struct result *a, const struct result *b);

bool same_scene(const struct result *a, const struct result *b);
bool same_technique(const struct result *a, const struct result *b);
/** The technique but for its number of samples: pcss-16 and pcss-32 are one family. */
bool same_family(const struct result *a, const struct result *b);
/** What makes results comparable: light, map, precision, sizes of pictures, machine. */
bool same_setting(const struct result *a, const struct result *b);
/** The same but for the precision. */
bool same_conditions(const struct result *a, const struct result *b);

/** The first result of each kind in a list, in its order; zero is empty. */
struct distinct {
	const struct result **items; /* owned; the results are not */
	size_t count;
};

/** Fails (MACHINE) when out of memory. The list must stay as it is meanwhile. */
bool distinct_init(struct distinct *distinct, const struct result_list *list, result_match same,
	struct sm_error *error);
void distinct_finish(struct distinct *distinct);

/** The number of the kind that a result is of, or `count`. */
size_t distinct_find(
	const struct distinct *distinct, const struct result *result, result_match same);

/** The setting with the most results, the first of these: what charts are of first. */
const struct result *main_setting(const struct distinct *settings, const struct result_list *list);

/** Writes a setting for people, such as "light radius 0.03, map 512, float". */
void setting_describe(const struct result *setting, char *text, size_t size);

#endif
