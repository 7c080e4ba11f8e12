/* SPDX-License-Identifier: MIT */
#include "app/check_describe.h"
#include "platform.h"
#include "process/worker.h"
#include <stdio.h>
#include <string.h>

/* Facts as the child leaves them: keys and values, each ended by a 0, and an empty key. */
#define FACTS_SIZE 65536

struct description {
	const struct check_options *options;
	char *facts; /* [FACTS_SIZE], shared, zeroed */
	size_t used;
};

static void append(struct description *description, const char *text)
{
	size_t size = strlen(text) + 1;
	memcpy(description->facts + description->used, text, size);
	description->used += size;
}

static void add_fact(void *data, const char *key, const char *value)
{
	struct description *description = data;
	/* One byte stays for the empty key. */
	if (strlen(key) + strlen(value) + 2 >= FACTS_SIZE - description->used)
		return;
	append(description, key);
	append(description, value);
}

/* A driver that does not work is what the run is to find: another one is no stand-in. */
static struct platform *open_device(const struct common_options *common, struct sm_error *error)
{
	return common->device != NULL ? platform_create_on(common->device, common->debug, error)
				      : platform_create(NULL, common->debug, error);
}

static bool describe(void *data, struct sm_error *error)
{
	struct description *description = data;
	struct platform *platform = open_device(&description->options->common, error);
	struct sm_renderer *renderer =
		platform != NULL ? driver_options_renderer(&description->options->driver, error)
				 : NULL;
	bool described = renderer != NULL;
	if (described) {
		platform_describe(platform, add_fact, description);
		sm_renderer_describe(renderer, add_fact, description);
	}
	sm_renderer_destroy(renderer);
	platform_destroy(platform);
	return described;
}

static bool take_facts(struct check_run *run, const char *facts)
{
	for (const char *key = facts; key[0] != '\0';) {
		const char *value = key + strlen(key) + 1;
		if (!check_run_add_fact(run, key, value))
			return false;
		key = value + strlen(value) + 1;
	}
	return true;
}

static bool add_size(
	const struct check_options *options, struct check_run *run, enum check_class class)
{
	char size[32];
	uint32_t side = check_class_size(class);
	snprintf(size, sizeof(size), "%ux%u", options->width > 0 ? options->width : side,
		options->width > 0 ? options->height : side);
	return check_run_add_fact(run, "class of drivers", check_class_name(class)) &&
	       check_run_add_fact(run, "size of pictures", size);
}

bool check_describe(const struct check_options *options, struct check_run *run,
	enum check_class *class, struct sm_error *error)
{
	struct description description = {.options = options, .facts = worker_share(FACTS_SIZE)};
	struct worker worker = {.name = "the driver", .work = describe, .data = &description};
	if (description.facts == NULL)
		return error_no_memory(error);
	bool described = worker_run(&worker, error);
	if (described) {
		bool taken = check_run_add_fact(run, "smoothie", sm_version()) &&
			     take_facts(run, description.facts);
		*class = check_class_find(check_run_fact(run, "renderer"));
		described = (taken && add_size(options, run, *class)) || error_no_memory(error);
	}
	worker_unshare(description.facts, FACTS_SIZE);
	return described;
}
