/* SPDX-License-Identifier: MIT */
#include "likeness.h"
#include "model/difference.h"
#include "visibility.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#define PIXELS ((size_t)LIKENESS_SIZE * LIKENESS_SIZE)

static double processor_seconds(void)
{
	struct timespec now;
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
	return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static double share_off(const uint16_t *drawn, const uint16_t *model, double tolerance)
{
	return (double)model_difference(drawn, model, PIXELS, tolerance).failing / (double)PIXELS;
}

static struct likeness compare(const struct visibility *drawn, const uint16_t *model)
{
	return (struct likeness){
		.mean = model_difference(drawn->values, model, PIXELS, 0).mean,
		.by_001 = share_off(drawn->values, model, 0.001),
		.by_02 = share_off(drawn->values, model, 0.02),
		.by_1 = share_off(drawn->values, model, 0.1),
	};
}

struct likeness likeness_of(struct rig *rig, const struct sm_scene *scene,
	const struct sm_camera *camera, const struct sm_shadow_options *options)
{
	struct sm_view view = {.camera = *camera, .width = LIKENESS_SIZE, .height = LIKENESS_SIZE};
	uint16_t *models = malloc(2 * PIXELS * sizeof(*models));
	struct visibility drawn;
	struct sm_error error;
	assert_non_null(models);
	rig_set_shadows(rig, options);
	visibility_draw(&drawn, rig, scene, camera, LIKENESS_SIZE, LIKENESS_SIZE);
	double start = processor_seconds();
	if (!sm_model_visibility(scene, &view, options, models, &error))
		fail_msg("%s", error.text);
	double took = processor_seconds() - start;
	if (!sm_model_visibility_snapped(scene, &view, options, 4, models + PIXELS, &error))
		fail_msg("%s", error.text);
	struct likeness fine = compare(&drawn, models);
	struct likeness snapped = compare(&drawn, models + PIXELS);
	struct likeness nearer = fine.mean <= snapped.mean ? fine : snapped;
	nearer.seconds = took;
	visibility_finish(&drawn);
	free(models);
	return nearer;
}

static bool is_of_the_study(const char *scene)
{
	static const char *const scenes[] = {
		"cylinder", "boxes", "fence", "knot", "urchin", "debris"};
	for (size_t i = 0; i < sizeof(scenes) / sizeof(scenes[0]); i++)
		if (strcmp(scene, scenes[i]) == 0)
			return true;
	return false;
}

void likeness_load(struct stage *stage, const char *scene)
{
	char source[64];
	const char *radius = "light.radius=0.1719447"; /* d = 5.73149 */
	struct sm_error error;
	snprintf(source, sizeof(source), "builtin:%s", scene);
	if (!stage_load(stage, source, &radius, is_of_the_study(scene) ? 1 : 0, &error))
		fail_msg("%s", error.text);
}
