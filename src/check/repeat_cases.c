/* SPDX-License-Identifier: MIT */
/* A frame that is drawn again has the same bits: nothing is left from before, nothing is raced for.
 */
#include "base/array.h"
#include "check/cases.h"
#include "check/context.h"
#include "check/needs.h"
#include "check/view.h"
#include "platform.h"
#include <stdlib.h>
#include <string.h>

#define TIMES 3

/* Draws the first frame and the others, whose values that differ from the first are counted. */
static bool draw_all(struct check_view *view, struct sm_renderer *renderer,
	struct check_context *context, struct check_result *result, struct sm_error *error)
{
	size_t count = (size_t)view->width * view->height;
	context->drawn = array_alloc(count, sizeof(*context->drawn));
	context->wanted = array_alloc(count, sizeof(*context->wanted));
	if (context->drawn == NULL || context->wanted == NULL)
		return error_no_memory(error);
	if (!check_view_draw(view, renderer, context->wanted, error))
		return false;
	for (int time = 1; time < TIMES && result->difference.failing == 0; time++) {
		if (!check_view_draw(view, renderer, context->drawn, error))
			return false;
		check_compare(result, context->drawn, context->wanted, count, 0);
	}
	return true;
}

static bool draw(const struct check_case *item, struct sm_renderer *renderer,
	struct check_context *context, struct check_result *result, struct sm_error *error)
{
	struct check_view view = {0};
	struct sm_shadow_options options = {
		.technique = sm_technique_name(item->choice[0]), .map_size = context->map};
	bool drawn = sm_renderer_set_shadows(renderer, &options, error) &&
		     check_view_init(&view, check_scene_name(item->choice[1]), context->width,
			     context->height, error) &&
		     draw_all(&view, renderer, context, result, error);
	check_view_finish(&view);
	return drawn;
}

static void run_repeat(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	struct sm_error error;
	struct sm_renderer *renderer =
		sm_renderer_create_with(platform_get_proc, &context->driver, &error);
	if (renderer == NULL)
		check_fail(result, "%s", error.text);
	else if (!sm_renderer_set_skips(renderer, "-all,+receiver", &error))
		check_fail(result, "%s", error.text);
	else if (check_lacks(renderer, item->choice[0]))
		check_skip(result, "the driver lacks what %s takes; see smoothie info",
			sm_technique_name(item->choice[0]));
	else if (!draw(item, renderer, context, result, &error))
		check_fail(result, "%s", error.text);
	else if (result->difference.failing > 0)
		check_fail(result, "a frame drawn again differs in %llu pixels",
			(unsigned long long)result->difference.failing);
	else
		check_pass(result, "the same bits %d times", TIMES);
	sm_renderer_destroy(renderer);
}

void check_repeat_cases(struct check_list *list)
{
	for (size_t technique = 0; sm_technique_name(technique) != NULL; technique++)
		for (size_t scene = 0; check_scene_name(scene) != NULL; scene++) {
			struct check_case *item =
				check_list_add(list, run_repeat, NULL, "repeat.%s.%s",
					sm_technique_name(technique), check_scene_name(scene));
			if (item != NULL) {
				item->choice[0] = technique;
				item->choice[1] = scene;
			}
		}
}
