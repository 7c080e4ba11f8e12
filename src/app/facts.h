/* SPDX-License-Identifier: MIT */
#ifndef APP_FACTS_H
#define APP_FACTS_H

#include "base/error.h"
#include <stdio.h>

/** Prints facts as "key: value" lines, or as one JSON object in which values that read as decimal
 *  numbers are numbers. */
struct facts {
	FILE *file; /* not owned */
	bool json;
	size_t count;
};

void facts_begin(struct facts *facts, FILE *file, bool json);
void facts_add(struct facts *facts, const char *key, const char *value);
/** facts_add() with the value formatted, up to 200 characters. */
void facts_format(struct facts *facts, const char *key, const char *format, ...) PRINTF_LIKE(3, 4);
void facts_end(struct facts *facts);

/** facts_add() as an sm_fact; data is the struct facts. */
void facts_sink(void *data, const char *key, const char *value);

#endif
