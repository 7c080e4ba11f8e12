/* SPDX-License-Identifier: MIT */
#ifndef BASE_MEMORY_LIST_H
#define BASE_MEMORY_LIST_H

#include <smoothie.h>
#include <stddef.h>

/** Where parts of memory are told to. */
struct memory_list {
	sm_memory_sink sink;
	void *data;
	uint32_t light; /* that what is told serves alone; SM_NONE: none */
};

/** Tells of one part, unless it is empty. owner: static. */
void memory_list_add(const struct memory_list *list, enum sm_memory_kind kind, const char *owner,
	uint64_t bytes);

/** The same, of the processor's. */
void memory_list_processor(const struct memory_list *list, const char *owner, size_t bytes);

#endif
