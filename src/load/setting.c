/* SPDX-License-Identifier: MIT */
#include "load/setting.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** A setting cut into its parts, which lie in text. */
struct setting {
	char *text;      /* owned */
	char place[120]; /* "--set section.key" */
	enum section section;
	const char *name; /* NULL: of all */
	const char *key, *value;
};

static void setting_finish(struct setting *setting)
{
	free(setting->text);
}

static bool setting_init(struct setting *setting, const char *source, struct sm_error *error)
{
	*setting = (struct setting){.text = strdup(source)};
	if (setting->text == NULL)
		return error_no_memory(error);
	char *value = strchr(setting->text, '=');
	if (value != NULL)
		*value++ = '\0';
	snprintf(setting->place, sizeof(setting->place), "--set %s", setting->text);
	char *key = strrchr(setting->text, '.');
	if (value == NULL || key == NULL)
		return error_set(error, SM_ERROR_INPUT,
			"%s: not of the form section.key=value or \"section NAME.key=value\"",
			setting->place);
	*key++ = '\0';
	char *name = strchr(setting->text, ' ');
	if (name != NULL)
		*name++ = '\0';
	setting->section = section_find(setting->text);
	setting->name = name;
	setting->key = key;
	setting->value = value;
	if (setting->section == SECTION_COUNT)
		return error_set(error, SM_ERROR_INPUT,
			"%s: no section \"%.40s\"; there are camera, light, object, ground, "
			"environment, motion, shadow, output",
			setting->place, setting->text);
	if (name != NULL && !section_is_named(setting->section))
		return error_set(error, SM_ERROR_INPUT, "%s: %s takes no name", setting->place,
			setting->text);
	return true;
}

static bool report_no_match(
	const struct setting *setting, const struct plan *plan, struct sm_error *error)
{
	char known[200];
	plan_list_names(plan, setting->section, known, sizeof(known));
	return error_set(error, SM_ERROR_INPUT, "%s: no such %s; known: %s", setting->place,
		section_name(setting->section), known);
}

static bool setting_apply(const struct setting *setting, struct plan *plan, struct sm_error *error)
{
	bool found = false;
	for (size_t i = 0; i < plan_count(plan, setting->section); i++) {
		if (setting->name != NULL &&
			strcmp(plan_name(plan, setting->section, i), setting->name) != 0)
			continue;
		struct plan_section open = plan_get(plan, setting->section, i);
		if (!plan_set(&open, setting->key, setting->value, setting->place, error))
			return false;
		found = true;
	}
	return found || report_no_match(setting, plan, error);
}

bool settings_apply(struct plan *plan, const char *const *settings, size_t count, bool lights,
	struct sm_error *error)
{
	bool ok = true;
	for (size_t i = 0; ok && i < count; i++) {
		struct setting setting;
		ok = setting_init(&setting, settings[i], error);
		if (ok && (setting.section == SECTION_LIGHT) == lights)
			ok = setting_apply(&setting, plan, error);
		setting_finish(&setting);
	}
	return ok;
}
