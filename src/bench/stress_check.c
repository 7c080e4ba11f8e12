/* SPDX-License-Identifier: MIT */
#include "bench/stress_check.h"
#include "base/array.h"
#include "geom/silhouette.h"
#include "scene/scene.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool stress_way_at(size_t index, const char *only, struct stress_way *way)
{
	const char *technique;
	for (size_t i = 0; (technique = sm_technique_name(i)) != NULL; i++) {
		size_t choice = 0;
		if (only != NULL && strcmp(only, technique) != 0)
			continue;
		do {
			*way = (struct stress_way){technique, sm_technique_samples(i, choice), ""};
			snprintf(way->name, sizeof(way->name), way->samples > 0 ? "%s-%u" : "%s",
				technique, way->samples);
			if (index-- == 0)
				return true;
		} while (sm_technique_samples(i, ++choice) > 0);
	}
	return false;
}

/* Working memory for the silhouette of one mesh. */
struct outline {
	uint64_t *facing;
	struct silhouette_edge *edges;
	int32_t *balance; /* edges that start at a vertex, less those that end there */
};

static bool outline_init(struct outline *outline, const struct caster *caster)
{
	outline->facing = array_alloc(facing_words(caster), sizeof(*outline->facing));
	outline->edges = array_alloc(edge_table_records(&caster->edges), sizeof(*outline->edges));
	outline->balance = array_zalloc(caster->vertex_count, sizeof(*outline->balance));
	return outline->facing != NULL && outline->edges != NULL && outline->balance != NULL;
}

static void outline_finish(struct outline *outline)
{
	free(outline->facing);
	free(outline->edges);
	free(outline->balance);
}

static bool check_outline(
	const struct caster *caster, const float light[4], struct stress_fault *fault)
{
	struct outline outline;
	bool ok = outline_init(&outline, caster) ||
		  stress_fault_set(fault, STRESS_FAULT_OTHER, "out of memory");
	if (ok) {
		size_t most = edge_table_records(&caster->edges);
		facing_find(caster, light, outline.facing);
		size_t count = silhouette_find(caster, outline.facing, outline.edges, most);
		for (size_t i = 0; i < count; i++) {
			outline.balance[outline.edges[i].a]++;
			outline.balance[outline.edges[i].b]--;
		}
		for (size_t i = 0; i < caster->vertex_count && ok; i++)
			if (outline.balance[i] != 0)
				ok = stress_fault_set(fault, STRESS_FAULT_SILHOUETTE,
					"a silhouette is open: %d more edges start at vertex %zu "
					"than end",
					outline.balance[i], i);
	}
	outline_finish(&outline);
	return ok;
}

static bool check_silhouettes(
	const struct sm_scene *scene, const struct sm_light_desc *light, struct stress_fault *fault)
{
	bool spot = light->type == SM_LIGHT_SPOT, ok = true;
	vec4 origin = {0};
	glm_vec3_copy((float *)light->position, origin);
	if (!spot)
		glm_vec3_sub((float *)light->position, (float *)light->target, origin);
	origin[3] = spot;
	for (size_t i = 0; i < scene->object_count && ok; i++) {
		const struct object *object = &scene->objects[i];
		mat4 to_object;
		vec4 in_object;
		glm_mat4_inv((vec4 *)object->transform, to_object);
		glm_mat4_mulv(to_object, origin, in_object);
		ok = check_outline(&scene->meshes[object->mesh].caster, in_object, fault);
	}
	return ok;
}

bool stress_check(struct stress_probe *probe, const struct stress_subject *subject,
	struct stress_picture *seen, struct stress_fault *fault)
{
	uint32_t lights = sm_scene_light_count(subject->scene);
	struct stress_picture first = {0}, last = {0};
	fault->text[0] = '\0';
	bool ok = stress_probe_picture(probe, subject, fault);
	for (uint32_t i = 0; i < lights && ok; i++)
		ok = check_silhouettes(subject->scene, &subject->scene->lights[i].desc, fault);
	if (lights > 1 && ok)
		ok = stress_probe_visibility(probe, subject, lights - 1, &last, fault);
	stress_picture_finish(&last);
	if (lights > 0 && ok)
		ok = stress_probe_visibility(probe, subject, 0, &first, fault);
	if (ok && seen != NULL)
		*seen = first;
	else
		stress_picture_finish(&first);
	return ok;
}

bool stress_check_scene(struct stress_probe *probe, const struct stress_scene *scene,
	struct stress_picture *seen, struct stress_fault *fault)
{
	struct sm_error error;
	fault->text[0] = '\0';
	if (seen != NULL)
		*seen = (struct stress_picture){0};
	struct sm_scene *built = stress_scene_build(scene, &error);
	if (built == NULL)
		return stress_fault_set(
			fault, STRESS_FAULT_INVALID, "it is refused: %s", error.text);
	const struct stress_subject subject = {
		.scene = built,
		.camera = scene->camera,
		.shadow = scene->shadow,
		.width = scene->width,
		.height = scene->height,
	};
	bool ok = stress_check(probe, &subject, seen, fault);
	sm_scene_destroy(built);
	return ok;
}
