/* SPDX-License-Identifier: MIT */
#include "app/driver_options.h"
#include "base/array.h"
#include "platform.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Adds "SIGNitem" to a list, behind a comma. */
static bool append(char **list, const char *sign, const char *item, struct sm_error *error)
{
	const char *before = *list != NULL ? *list : "";
	size_t size = strlen(before) + strlen(sign) + strlen(item) + 2;
	char *joined = array_alloc(size, 1);
	if (joined == NULL)
		return error_no_memory(error);
	snprintf(joined, size, "%s%s%s%s", before, before[0] != '\0' ? "," : "", sign, item);
	free(*list);
	*list = joined;
	return true;
}

bool driver_options_has(int id)
{
	return id == FLAG_CAPS || id == FLAG_PATH || id == FLAG_NO_SKIP;
}

bool driver_options_flag(
	struct driver_options *options, int id, const char *value, struct sm_error *error)
{
	if (id == FLAG_CAPS)
		return append(&options->caps, "", value, error);
	if (id == FLAG_NO_SKIP)
		return append(&options->skips, "-", value, error);
	if (!array_reserve((void **)&options->paths, &options->path_capacity,
		    options->path_count + 1, sizeof(*options->paths)))
		return error_no_memory(error);
	options->paths[options->path_count++] = value;
	return true;
}

void driver_options_finish(struct driver_options *options)
{
	free(options->caps);
	free(options->skips);
	free(options->paths);
	*options = (struct driver_options){0};
}

struct sm_driver_options driver_options_get(const struct driver_options *options)
{
	return (struct sm_driver_options){options->caps, options->paths, options->path_count};
}

struct sm_renderer *driver_options_renderer(
	const struct driver_options *options, struct sm_error *error)
{
	struct sm_driver_options driver = driver_options_get(options);
	struct sm_renderer *renderer = sm_renderer_create_with(platform_get_proc, &driver, error);
	if (renderer == NULL || sm_renderer_set_skips(renderer, options->skips, error))
		return renderer;
	sm_renderer_destroy(renderer);
	return NULL;
}

void driver_options_describe_skips(const struct sm_renderer *renderer, struct facts *facts)
{
	for (size_t i = 0; sm_skip_name(i) != NULL; i++) {
		struct sm_skip_stats stats;
		char key[50];
		sm_renderer_get_skip_stats(renderer, i, &stats);
		snprintf(key, sizeof(key), "skipped, %s", sm_skip_name(i));
		facts_format(facts, key, "%" PRIu64 " of %" PRIu64 ", %" PRIu64 " redrawn",
			stats.skipped, stats.tested, stats.redrawn);
	}
}
