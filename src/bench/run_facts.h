/* SPDX-License-Identifier: MIT */
#ifndef BENCH_RUN_FACTS_H
#define BENCH_RUN_FACTS_H

#include "base/error.h"

struct run_fact {
	char *key, *value; /* owned */
};

/** What a run needs to be repeated: versions, machine, command line, settings, in their order.
 *  Zero is empty. */
struct run_facts {
	struct run_fact *items; /* owned */
	size_t count, capacity;
	bool failed; /* memory ran out, once */
};

/** Adds program, version, commit, date, command line, system, processor and cores. */
void run_facts_init(struct run_facts *facts, int argc, char *const *argv);

/** Adds a fact; the value is formatted, up to 400 characters. Without memory it notes that in
 *  `failed`. */
void run_facts_add(struct run_facts *facts, const char *key, const char *format, ...)
	PRINTF_LIKE(3, 4);

/** An sm_fact: adds what sm_renderer_describe() tells as "driver KEY"; data is the run_facts. */
void run_facts_driver(void *data, const char *key, const char *value);

/** The value, or "" where there is none. */
const char *run_facts_get(const struct run_facts *facts, const char *key);

/** Writes processor, cores and driver: what struct result's machine is to be. */
void run_facts_machine(const struct run_facts *facts, char *text, size_t size);

void run_facts_finish(struct run_facts *facts);

#endif
