/* SPDX-License-Identifier: MIT */
#ifndef BENCH_JSON_H
#define BENCH_JSON_H

#include "bench/result.h"
#include "bench/run_facts.h"
#include <stdio.h>

/** Writes results.json: {"facts": {KEY: TEXT}, "columns": {NAME: HELP}, "results": [{NAME:
 * VALUE}]}. What is not known, or not finite, is null. The caller checks the file for errors. */
void json_write(const struct result_list *list, const struct run_facts *facts, FILE *file);

#endif
