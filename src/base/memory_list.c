/* SPDX-License-Identifier: MIT */
#include "base/memory_list.h"

void memory_list_add(
	const struct memory_list *list, enum sm_memory_kind kind, const char *owner, uint64_t bytes)
{
	const struct sm_memory_part part = {
		.kind = kind, .owner = owner, .light = list->light, .bytes = bytes};
	if (bytes > 0)
		list->sink(list->data, &part);
}

void memory_list_processor(const struct memory_list *list, const char *owner, size_t bytes)
{
	memory_list_add(list, SM_MEMORY_PROCESSOR, owner, bytes);
}
