/* SPDX-License-Identifier: MIT */
#include "load/builtin.h"
#include "load/builtin_scene.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool builtin_add_light(struct model *model, const struct sm_light_desc *light)
{
	model->lights = model_alloc(model, 1, sizeof(*model->lights));
	if (model->lights == NULL)
		return false;
	model->lights[model->light_count++] = (struct model_light){.desc = *light, .aimed = true};
	return true;
}

/** Either a scene or a solid. */
static const struct builtin {
	const char *name;
	bool (*scene)(struct model *);
	struct sm_object_desc *(*solid)(struct model *);
	bool (*sized)(struct model *, uint32_t triangles); /* NULL: it has one size */
} builtins[] = {
	{"cylinder", builtin_cylinder},
	{"boxes", builtin_boxes},
	{"fence", builtin_fence},
	{"knot", builtin_knot, .sized = builtin_sized_knot},
	{"urchin", builtin_urchin, .sized = builtin_sized_urchin},
	{"debris", builtin_debris, .sized = builtin_sized_debris},
	{"primitives", builtin_primitives},
	{"cube", .solid = builtin_cube},
	{"sphere", .solid = builtin_sphere},
	{"icosahedron", .solid = builtin_icosahedron},
	{"pillar", .solid = builtin_pillar},
	{"cone", .solid = builtin_cone},
	{"torus", .solid = builtin_torus},
	{"vase", .solid = builtin_vase},
};
static const size_t builtin_count = sizeof(builtins) / sizeof(*builtins);

const char *builtin_name(size_t index)
{
	return index < builtin_count ? builtins[index].name : NULL;
}

static bool report_unknown(const char *name, struct sm_error *error)
{
	char known[200] = "";
	for (size_t i = 0, used = 0; i < builtin_count; i++)
		used += (size_t)snprintf(known + used, sizeof(known) - used, "%s%s",
			i > 0 ? ", " : "", builtins[i].name);
	return error_set(
		error, SM_ERROR_INPUT, "builtin:%.40s: no such scene; there are %s", name, known);
}

static bool build_sized(const struct builtin *builtin, const char *size, struct model *model,
	struct sm_error *error)
{
	char *end;
	unsigned long triangles = strtoul(size, &end, 10);
	if (builtin->sized == NULL)
		return error_set(
			error, SM_ERROR_INPUT, "builtin:%s: it has one size", builtin->name);
	if (*size < '0' || *size > '9' || *end != '\0' || triangles < BUILTIN_TRIANGLES_MIN ||
		triangles > BUILTIN_TRIANGLES_MAX)
		return error_set(error, SM_ERROR_INPUT,
			"builtin:%s:%.40s: a number of triangles from %d to %d is wanted",
			builtin->name, size, BUILTIN_TRIANGLES_MIN, BUILTIN_TRIANGLES_MAX);
	return builtin->sized(model, (uint32_t)triangles) || error_no_memory(error);
}

bool builtin_build(const char *name, struct model *model, struct sm_error *error)
{
	size_t length = strcspn(name, ":");
	for (size_t i = 0; i < builtin_count; i++) {
		const struct builtin *builtin = &builtins[i];
		if (strlen(builtin->name) != length || strncmp(builtin->name, name, length) != 0)
			continue;
		if (name[length] == ':')
			return build_sized(builtin, name + length + 1, model, error);
		bool ok = builtin->scene != NULL
				  ? builtin->scene(model)
				  : model_reserve(model, 1, 1) && builtin->solid(model) != NULL;
		return ok || error_no_memory(error);
	}
	return report_unknown(name, error);
}
