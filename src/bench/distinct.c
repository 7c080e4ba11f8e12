/* SPDX-License-Identifier: MIT */
#include "bench/distinct.h"
#include "base/array.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool same_scene(const struct result *a, const struct result *b)
{
	return strcmp(a->scene, b->scene) == 0;
}

bool same_technique(const struct result *a, const struct result *b)
{
	return strcmp(a->technique, b->technique) == 0;
}

/* How much of a technique's name is its family. */
static size_t family_length(const char *technique)
{
	const char *dash = strrchr(technique, '-');
	if (dash == NULL || dash[1] == '\0' || dash[1 + strspn(dash + 1, "0123456789")] != '\0')
		return strlen(technique);
	return (size_t)(dash - technique);
}

bool same_family(const struct result *a, const struct result *b)
{
	size_t length = family_length(a->technique);
	return length == family_length(b->technique) &&
	       memcmp(a->technique, b->technique, length) == 0;
}

bool same_conditions(const struct result *a, const struct result *b)
{
	return a->radius == b->radius && a->map == b->map && a->width == b->width &&
	       a->height == b->height && a->time_width == b->time_width &&
	       a->time_height == b->time_height && strcmp(a->machine, b->machine) == 0;
}

bool same_setting(const struct result *a, const struct result *b)
{
	return same_conditions(a, b) && strcmp(a->precision, b->precision) == 0;
}

bool distinct_init(struct distinct *distinct, const struct result_list *list, result_match same,
	struct sm_error *error)
{
	distinct->count = 0;
	distinct->items = array_alloc(list->count, sizeof(*distinct->items));
	if (distinct->items == NULL)
		return error_no_memory(error);
	for (size_t i = 0; i < list->count; i++)
		if (distinct_find(distinct, &list->items[i], same) == distinct->count)
			distinct->items[distinct->count++] = &list->items[i];
	return true;
}

void distinct_finish(struct distinct *distinct)
{
	free(distinct->items);
	*distinct = (struct distinct){0};
}

size_t distinct_find(
	const struct distinct *distinct, const struct result *result, result_match same)
{
	size_t i = 0;
	while (i < distinct->count && !same(distinct->items[i], result))
		i++;
	return i;
}

const struct result *main_setting(const struct distinct *settings, const struct result_list *list)
{
	const struct result *best = NULL;
	size_t most = 0;
	for (size_t i = 0; i < settings->count; i++) {
		size_t count = 0;
		for (size_t j = 0; j < list->count; j++)
			count += same_setting(settings->items[i], &list->items[j]);
		if (count > most) {
			most = count;
			best = settings->items[i];
		}
	}
	return best;
}

void setting_describe(const struct result *setting, char *text, size_t size)
{
	snprintf(text, size, "light radius %g of its distance, map %u, %s", setting->radius,
		setting->map, setting->precision);
}
