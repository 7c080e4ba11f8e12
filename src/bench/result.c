/* SPDX-License-Identifier: MIT */
#include "bench/result.h"
#include "base/array.h"
#include <stdlib.h>

bool result_list_add(struct result_list *list, const struct result *result, struct sm_error *error)
{
	void *items = list->items;
	if (!array_reserve(&items, &list->capacity, list->count + 1, sizeof(*result)))
		return error_no_memory(error);
	list->items = items;
	list->items[list->count++] = *result;
	return true;
}

void result_list_finish(struct result_list *list)
{
	free(list->items);
	*list = (struct result_list){0};
}
