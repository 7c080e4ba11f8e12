/* SPDX-License-Identifier: MIT */
#include "app/info_memory.h"
#include "app/memory_parts.h"
#include "app/offscreen.h"
#include "platform.h"

static bool draw(struct sm_renderer *renderer, const struct stage *stage,
	const struct offscreen *target, struct sm_error *error)
{
	const struct sm_view view = {
		.camera = stage->camera,
		.framebuffer = target->framebuffer,
		.width = target->width,
		.height = target->height,
		.visibility_of = SM_NONE,
	};
	return sm_renderer_set_shadows(renderer, &stage->shadow, error) &&
	       sm_renderer_draw(renderer, stage->scene, &view, error);
}

static bool print_parts(const struct sm_renderer *renderer, const struct sm_scene *scene, bool json,
	struct sm_error *error)
{
	struct memory_parts parts;
	bool found = memory_parts_find(&parts, renderer, scene, error);
	if (found) {
		struct facts facts;
		facts_begin(&facts, stdout, json);
		memory_parts_describe(&parts, &facts);
		facts_end(&facts);
	}
	memory_parts_finish(&parts);
	return found;
}

bool info_memory(const struct common_options *common, const struct driver_options *driver,
	const struct scene_options *scene, bool json, struct sm_error *error)
{
	struct stage stage = {0};
	struct offscreen target = {0};
	struct platform *platform = NULL;
	struct sm_renderer *renderer = NULL;
	bool done = scene_options_load(scene, &stage, error) &&
		    (platform = platform_create(common->device, common->debug, error)) != NULL &&
		    (renderer = driver_options_renderer(driver, error)) != NULL &&
		    offscreen_init(&target, OFFSCREEN_PICTURE, stage.output.width,
			    stage.output.height, stage.output.samples, error) &&
		    draw(renderer, &stage, &target, error) &&
		    print_parts(renderer, stage.scene, json, error);
	sm_renderer_destroy(renderer);
	offscreen_finish(&target);
	platform_destroy(platform);
	stage_finish(&stage);
	return done;
}
