/* SPDX-License-Identifier: MIT */
#include "bench/contents.h"
#include "bench/mean.h"
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

const struct result *rows_next(const struct rows *rows, const struct result *after)
{
	const struct result_list *list = rows->contents->results;
	const struct result *result = after != NULL ? after + 1 : list->items;
	for (; result < list->items + list->count; result++)
		if (same_scene(result, rows->scene) && same_setting(result, rows->setting))
			return result;
	return NULL;
}

size_t pass_number(const struct contents *contents, const char *pass)
{
	size_t i = 0;
	while (i < contents->pass_count && strcmp(contents->passes[i], pass) != 0)
		i++;
	return i;
}

static void find_passes(struct contents *contents)
{
	const size_t max = sizeof(contents->passes) / sizeof(contents->passes[0]);
	for (size_t i = 0; i < contents->results->count; i++) {
		const struct pass_time *passes = contents->results->items[i].passes;
		for (size_t j = 0; j < PASSES_MAX && passes[j].name[0] != '\0'; j++)
			if (contents->pass_count < max &&
				pass_number(contents, passes[j].name) == contents->pass_count)
				contents->passes[contents->pass_count++] = passes[j].name;
	}
}

bool contents_init(struct contents *contents, const struct result_list *results,
	const struct run_facts *facts, const char *folder, struct sm_error *error)
{
	*contents = (struct contents){.results = results, .facts = facts, .folder = folder};
	if (!distinct_init(&contents->scenes, results, same_scene, error) ||
		!distinct_init(&contents->settings, results, same_setting, error) ||
		!distinct_init(&contents->techniques, results, same_technique, error) ||
		!distinct_init(&contents->families, results, same_family, error)) {
		contents_finish(contents);
		return false;
	}
	find_passes(contents);
	contents->main = main_setting(&contents->settings, results);
	return true;
}

void contents_finish(struct contents *contents)
{
	distinct_finish(&contents->families);
	distinct_finish(&contents->techniques);
	distinct_finish(&contents->settings);
	distinct_finish(&contents->scenes);
}

/* Of what stands for a text in the name of a file: file systems allow 255 in all. */
#define PART_MAX 96

/* FNV-1a, 32 bits */
static uint32_t hash(const char *text)
{
	uint32_t value = 2166136261u;
	for (; *text != '\0'; text++)
		value = (value ^ (unsigned char)*text) * 16777619u;
	return value;
}

/* Appends text with all but letters, digits, dots and dashes as "_" and two digits, so that names
 * differ as texts do and need no quotes in a shell or a page. What is too long ends in a hash. */
static void append_plain(char name[FILE_NAME_MAX], const char *text)
{
	static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
				    "0123456789.-";
	char *part = name + strlen(name);
	size_t used = 0;
	for (const char *at = text; *at != '\0'; at++) {
		if (used + 3 > PART_MAX) {
			sprintf(part + PART_MAX - 12, "__%08x", hash(text));
			return;
		}
		used += (size_t)sprintf(part + used, strchr(plain, *at) != NULL ? "%c" : "_%02x",
			(unsigned char)*at);
	}
}

void plot_file_name(const struct contents *contents, const struct result *setting,
	const struct result *scene, const char *extension, char name[FILE_NAME_MAX])
{
	size_t number = distinct_find(&contents->settings, setting, same_setting);
	if (scene != NULL) {
		strcpy(name, "plots/scene-");
		append_plain(name, scene->scene);
	} else if (setting == contents->main) {
		strcpy(name, "plots/overall");
	} else {
		snprintf(name, FILE_NAME_MAX, "plots/overall-%zu", number + 1);
	}
	strcat(name, ".");
	strcat(name, extension);
}

void difference_file_name(const struct result *result, char name[FILE_NAME_MAX])
{
	char setting[64];
	strcpy(name, "differences/");
	append_plain(name, result->scene);
	strcat(name, "-");
	append_plain(name, result->technique);
	snprintf(setting, sizeof(setting), "-r%g-m%u-", result->radius, result->map);
	append_plain(name, setting);
	append_plain(name, result->precision);
	strcat(name, ".png");
}

void sheet_file_name(const struct result *result, char name[FILE_NAME_MAX])
{
	char setting[64];
	strcpy(name, "sheets/");
	append_plain(name, result->scene);
	snprintf(setting, sizeof(setting), "-r%g-m%u", result->radius, result->map);
	append_plain(name, setting);
	strcat(name, ".png");
}

bool has_plot(
	const struct contents *contents, const struct result *setting, const struct result *scene)
{
	for (size_t i = 0; contents->has_plots && i < contents->techniques.count; i++) {
		struct mean mean =
			mean_of(contents->results, setting, contents->techniques.items[i], scene);
		if (mean_is_complete(&mean))
			return true;
	}
	return false;
}

static bool has_file(const struct contents *contents, const char *name)
{
	char path[PATH_MAX];
	int length = snprintf(path, sizeof(path), "%s/%s", contents->folder, name);
	return length < (int)sizeof(path) && access(path, R_OK) == 0;
}

bool has_difference(const struct contents *contents, const struct result *result)
{
	char name[FILE_NAME_MAX];
	difference_file_name(result, name);
	return has_file(contents, name);
}

bool has_sheet(const struct contents *contents, const struct result *result)
{
	char name[FILE_NAME_MAX];
	sheet_file_name(result, name);
	return has_file(contents, name);
}
