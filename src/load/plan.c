/* SPDX-License-Identifier: MIT */
#include "load/plan.h"
#include "base/array.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool plan_init(struct plan *plan, struct sm_error *error)
{
	*plan = (struct plan){.camera.origin.object = SM_NONE};
	for (enum section section = 0; section < SECTION_COUNT; section++)
		if (!section_is_named(section) &&
			!section_reset(section, plan_get(plan, section, 0).data))
			return error_no_memory(error);
	return true;
}

void plan_finish(struct plan *plan)
{
	for (size_t i = 0; i < plan->light_count; i++)
		free(plan->lights[i].name);
	for (size_t i = 0; i < plan->object_count; i++) {
		free(plan->objects[i].name);
		free(plan->objects[i].model);
		free(plan->objects[i].animation);
	}
	free(plan->lights);
	free(plan->objects);
	free(plan->motion.light);
	free(plan->shadow.technique);
	*plan = (struct plan){0};
}

struct plan_light *plan_add_light(struct plan *plan, const char *name, struct sm_error *error)
{
	struct plan_light light = {.name = strdup(name), .origin.object = SM_NONE};
	if (light.name == NULL || !section_reset(SECTION_LIGHT, &light) ||
		!array_reserve((void **)&plan->lights, &plan->light_capacity, plan->light_count + 1,
			sizeof(light))) {
		free(light.name);
		error_no_memory(error);
		return NULL;
	}
	plan->lights[plan->light_count] = light;
	return &plan->lights[plan->light_count++];
}

struct plan_object *plan_add_object(struct plan *plan, const char *name, struct sm_error *error)
{
	struct plan_object object = {.name = strdup(name)};
	if (object.name == NULL || !section_reset(SECTION_OBJECT, &object) ||
		!array_reserve((void **)&plan->objects, &plan->object_capacity,
			plan->object_count + 1, sizeof(object))) {
		free(object.name);
		error_no_memory(error);
		return NULL;
	}
	plan->objects[plan->object_count] = object;
	return &plan->objects[plan->object_count++];
}

struct plan_section plan_get(struct plan *plan, enum section section, size_t index)
{
	void *const alone[SECTION_COUNT] = {
		[SECTION_CAMERA] = &plan->camera,
		[SECTION_GROUND] = &plan->ground,
		[SECTION_ENVIRONMENT] = &plan->environment,
		[SECTION_MOTION] = &plan->motion,
		[SECTION_SHADOW] = &plan->shadow,
		[SECTION_OUTPUT] = &plan->output,
	};
	if (section == SECTION_LIGHT) {
		struct plan_light *light = &plan->lights[index];
		return (struct plan_section){section, light, &light->given};
	}
	if (section == SECTION_OBJECT) {
		struct plan_object *object = &plan->objects[index];
		return (struct plan_section){section, object, &object->given};
	}
	return (struct plan_section){section, alone[section], &plan->given[section]};
}

size_t plan_count(const struct plan *plan, enum section section)
{
	if (section == SECTION_LIGHT)
		return plan->light_count;
	return section == SECTION_OBJECT ? plan->object_count : 1;
}

const char *plan_name(const struct plan *plan, enum section section, size_t index)
{
	return section == SECTION_LIGHT ? plan->lights[index].name : plan->objects[index].name;
}

size_t plan_find(const struct plan *plan, enum section section, const char *name)
{
	for (size_t i = 0; i < plan_count(plan, section); i++)
		if (strcmp(plan_name(plan, section, i), name) == 0)
			return i;
	return SIZE_MAX;
}

void plan_list_names(const struct plan *plan, enum section section, char *text, size_t size)
{
	size_t count = plan_count(plan, section);
	size_t used = (size_t)snprintf(text, size, "%s", count > 0 ? "" : "none");
	for (size_t i = 0; i < count && used < size; i++)
		used += (size_t)snprintf(text + used, size - used, "%s%s", i > 0 ? ", " : "",
			plan_name(plan, section, i));
}

/** "it has type, position, ..." */
static void describe_keys(enum section section, char *text, size_t size)
{
	const struct key *key;
	size_t used = (size_t)snprintf(text, size, "it has");
	const char *separator = " ";
	for (size_t i = 0; (key = key_at(i)) != NULL; i++) {
		if (key->section != section || used >= size)
			continue;
		used += (size_t)snprintf(text + used, size - used, "%s%s", separator, key->name);
		separator = ", ";
	}
}

bool plan_set(const struct plan_section *open, const char *name, const char *value,
	const char *place, struct sm_error *error)
{
	char allowed[200];
	size_t index = key_find(open->section, name);
	if (index == SIZE_MAX) {
		describe_keys(open->section, allowed, sizeof(allowed));
		return error_set(error, SM_ERROR_INPUT, "%s: [%s] has no key \"%.40s\"; %s", place,
			section_name(open->section), name, allowed);
	}
	const struct key *key = key_at(index);
	if (!key_parse(key, value, open->data)) {
		key_describe(key, allowed, sizeof(allowed));
		return error_set(error, SM_ERROR_INPUT, "%s: %s cannot be \"%.60s\"; it takes %s",
			place, name, value, allowed);
	}
	*open->given |= UINT64_C(1) << index;
	return true;
}
