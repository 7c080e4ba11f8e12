/* SPDX-License-Identifier: MIT */
#include "rig.h"
#include "platform.h"
#include <GLES3/gl3.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void note_problem(void *data, enum sm_log_level level, const char *line)
{
	struct rig *rig = data;
	if (level != SM_LOG_ERROR)
		return;
	if (rig->problems++ == 0)
		snprintf(rig->problem, sizeof(rig->problem), "%s", line);
}

int rig_setup(void **state)
{
	struct sm_error error = {0};
	struct rig *rig = calloc(1, sizeof(*rig));
	assert_non_null(rig);
	*state = rig;
	sm_set_log(note_problem, rig);
	rig->platform = platform_create("surfaceless", true, &error);
	if (rig->platform != NULL)
		rig->renderer = sm_renderer_create(platform_get_proc, &error);
	if (rig->renderer == NULL)
		fail_msg("%s", error.text);
	rig->scene = sm_scene_create();
	assert_non_null(rig->scene);
	sm_scene_set_environment(rig->scene, &(struct sm_environment){0});
	return 0;
}

int rig_teardown(void **state)
{
	struct rig *rig = *state;
	sm_scene_destroy(rig->scene);
	sm_renderer_destroy(rig->renderer);
	platform_destroy(rig->platform);
	sm_set_log(NULL, NULL);
	unsigned int problems = rig->problems;
	if (problems > 0)
		print_error("%u errors logged, the first: %s\n", problems, rig->problem);
	free(rig);
	return problems > 0 ? -1 : 0;
}

void rig_use_driver(struct rig *rig, const struct sm_driver_options *options)
{
	struct sm_error error;
	sm_renderer_destroy(rig->renderer);
	rig->renderer = sm_renderer_create_with(platform_get_proc, options, &error);
	if (rig->renderer == NULL)
		fail_msg("%s", error.text);
}

void rig_use_path(struct rig *rig, const char *path)
{
	struct sm_error error;
	struct sm_driver_options options = {.paths = &path, .path_count = 1};
	sm_renderer_destroy(rig->renderer);
	rig->renderer = sm_renderer_create_with(platform_get_proc, &options, &error);
	if (rig->renderer != NULL)
		return;
	if (error.status != SM_ERROR_MACHINE)
		fail_msg("%s", error.text);
	print_message("%s\n", error.text);
	skip();
}

void rig_skip_nothing(struct rig *rig)
{
	assert_true(sm_renderer_set_skips(rig->renderer, "-all,+receiver", NULL));
}

bool rig_can_draw(const char *technique)
{
	if (technique == NULL || strcmp(technique, "vsm") != 0 ||
		platform_has_extension("GL_EXT_color_buffer_float") ||
		platform_has_extension("GL_EXT_color_buffer_half_float"))
		return true;
	print_message("%s is skipped: there is no target of floats\n", technique);
	return false;
}

void rig_set_shadows(struct rig *rig, const struct sm_shadow_options *options)
{
	struct sm_error error;
	if (!sm_renderer_set_shadows(rig->renderer, options, &error))
		fail_msg("%s", error.text);
}

void rig_draw(struct rig *rig, const struct sm_scene *scene, const struct sm_view *view)
{
	struct sm_error error;
	if (!sm_renderer_draw(rig->renderer, scene, view, &error))
		fail_msg("%s", error.text);
}
