/* SPDX-License-Identifier: MIT */
#include "app/memory_parts.h"
#include "base/array.h"
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static struct sm_memory_part *find(
	const struct memory_parts *parts, const struct sm_memory_part *part)
{
	for (size_t i = 0; i < parts->count; i++) {
		struct sm_memory_part *item = &parts->items[i];
		if (item->kind == part->kind && item->light == part->light &&
			strcmp(item->owner, part->owner) == 0)
			return item;
	}
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
