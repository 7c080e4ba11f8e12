/* SPDX-License-Identifier: MIT */
#include "stage_check.h"
#include "expect.h"
#include <math.h>

/* Of a stage that reaches up to 1e15: products of lengths are floats. */
static void expect_near_enough(const struct sm_camera *camera)
{
	for (int i = 0; i < 3; i++)
		expect(fabsf(camera->eye[i]) <= 1e18f && fabsf(camera->target[i]) <= 1e18f);
}

static void expect_sound_camera(const struct sm_camera *camera)
{
	expect_finite(camera->eye, 3);
	expect_finite(camera->target, 3);
	expect_finite(camera->up, 3);
	expect(camera->fov >= 1.0f && camera->fov <= 170.0f);
	expect(camera->near == 0.0f || (camera->near > 0.0f && camera->near < camera->far));
	expect_finite(&camera->far, 1);
}

static void expect_sound_scene(const struct sm_scene *scene)
{
	float box[2][3];
	expect(sm_scene_object_count(scene) > 0 && sm_scene_light_count(scene) > 0);
	expect(sm_scene_get_bounds(scene, false, box[0], box[1]));
	expect_finite(*box, 6);
}

void expect_sound_stage(struct stage *stage)
{
	static const double times[] = {0.0, 1.0, 0.25, 1e9};
	struct sm_error error = {0};
	expect(stage->output.width >= 1 && stage->output.width <= 16384);
	expect(stage->output.height >= 1 && stage->output.height <= 16384);
	expect(stage->output.samples == 1 || stage->output.samples == 4);
	expect_sound_scene(stage->scene);
	expect_sound_camera(&stage->camera);
	expect_near_enough(&stage->camera);
	for (size_t i = 0; i < sizeof(times) / sizeof(*times); i++) {
		if (stage_set_time(stage, times[i], &error))
			expect_sound_scene(stage->scene);
		else
			expect_clear_error(&error);
		expect_sound_camera(&stage->camera);
	}
	stage_set_size(stage, 1, 16384);
	expect_sound_camera(&stage->camera);
}
