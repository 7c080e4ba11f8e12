/* SPDX-License-Identifier: MIT */
#include "app/memory_parts.h"
#include "base/array.h"
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static bool is_same_owner(const struct sm_memory_part *a, const struct sm_memory_part *b)
{
	return a->kind == b->kind && strcmp(a->owner, b->owner) == 0;
}

static struct sm_memory_part *find(
	const struct memory_parts *parts, const struct sm_memory_part *part)
{
	for (size_t i = 0; i < parts->count; i++)
		if (parts->items[i].light == part->light && is_same_owner(&parts->items[i], part))
			return &parts->items[i];
	return NULL;
}

static void add(void *data, const struct sm_memory_part *part)
{
	struct memory_parts *parts = data;
	struct sm_memory_part *known = find(parts, part);
	if (known != NULL) {
		known->bytes += part->bytes;
		return;
	}
	parts->failed = parts->failed || !array_reserve((void **)&parts->items, &parts->capacity,
						 parts->count + 1, sizeof(*parts->items));
	if (!parts->failed)
		parts->items[parts->count++] = *part;
}

bool memory_parts_find(struct memory_parts *parts, const struct sm_renderer *renderer,
	const struct sm_scene *scene, struct sm_error *error)
{
	*parts = (struct memory_parts){0};
	sm_renderer_list_memory(renderer, scene, add, parts);
	return !parts->failed || error_no_memory(error);
}

void memory_parts_finish(struct memory_parts *parts)
{
	free(parts->items);
	*parts = (struct memory_parts){0};
}

static const char *kind_name(enum sm_memory_kind kind)
{
	return kind == SM_MEMORY_GL ? "GL" : "processor";
}

/* Of an owner with all lights, by its first part; 0 for the others. */
static uint64_t bytes_of_owner(const struct memory_parts *parts, size_t first)
{
	uint64_t bytes = 0;
	for (size_t i = 0; i < parts->count; i++) {
		if (!is_same_owner(&parts->items[i], &parts->items[first]))
			continue;
		if (i < first)
			return 0;
		bytes += parts->items[i].bytes;
	}
	return bytes;
}

bool memory_parts_format(
	const struct memory_parts *parts, char *text, size_t size, struct sm_error *error)
{
	size_t used = 0;
	text[0] = '\0';
	for (size_t i = 0; i < parts->count && used < size; i++) {
		uint64_t bytes = bytes_of_owner(parts, i);
		if (bytes > 0)
			used += (size_t)snprintf(text + used, size - used, "%s%s: %s=%" PRIu64,
				used > 0 ? ";" : "", kind_name(parts->items[i].kind),
				parts->items[i].owner, bytes);
	}
	return used < size ||
	       error_set(error, SM_ERROR_MACHINE, "memory has too many owners to list");
}

void memory_parts_describe(const struct memory_parts *parts, struct facts *facts)
{
	uint64_t sums[2] = {0};
	for (size_t i = 0; i < parts->count; i++) {
		const struct sm_memory_part *part = &parts->items[i];
		char key[100], light[24] = "";
		if (part->light != SM_NONE)
			snprintf(light, sizeof(light), ": light %" PRIu32, part->light);
		snprintf(key, sizeof(key), "%s: %s%s", kind_name(part->kind), part->owner, light);
		facts_format(facts, key, "%" PRIu64, part->bytes);
		sums[part->kind] += part->bytes;
	}
	facts_format(facts, "GL, all", "%" PRIu64, sums[SM_MEMORY_GL]);
	facts_format(facts, "processor, all", "%" PRIu64, sums[SM_MEMORY_PROCESSOR]);
}
