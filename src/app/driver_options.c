/* SPDX-License-Identifier: MIT */
#include "app/driver_options.h"
#include "base/array.h"
#include "platform.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool add_caps(struct driver_options *options, const char *list, struct sm_error *error)
{
	const char *before = options->caps != NULL ? options->caps : "";
	size_t size = strlen(before) + strlen(list) + 2;
	char *joined = array_alloc(size, 1);
	if (joined == NULL)
		return error_no_memory(error);
	snprintf(joined, size, "%s%s%s", before, before[0] != '\0' ? "," : "", list);
	free(options->caps);
	options->caps = joined;
	return true;
}

bool driver_options_flag(
	struct driver_options *options, int id, const char *value, struct sm_error *error)
{
	if (id == FLAG_CAPS)
		return add_caps(options, value, error);
	if (!array_reserve((void **)&options->paths, &options->path_capacity,
		    options->path_count + 1, sizeof(*options->paths)))
		return error_no_memory(error);
	options->paths[options->path_count++] = value;
	return true;
}

void driver_options_finish(struct driver_options *options)
{
	free(options->caps);
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
	return sm_renderer_create_with(platform_get_proc, &driver, error);
}
