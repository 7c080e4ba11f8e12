/* SPDX-License-Identifier: MIT */
/* Which work is skipped, and when it is not; that it does not show is the test skip_frames. */
#include "canvas.h"
#include "parts.h"
#include "renderer.h"
#include "rig.h"
#include "technique/gather.h"
#include "technique/smoothie_state.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 64
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const struct sm_light_desc lamp = {
	.position = {1, 5, 1}, .radius = 0.4f, .angle = 60, .color = {1, 1, 1}, .intensity = 1};
static const struct sm_camera camera = {.eye = {2, 3, 5}, .up = {0, 1, 0}, .fov = 45};

/* A block over a floor that reaches far to the right. */
static void set_up(struct sm_scene *scene, float height)
{
	parts_add_object(scene, parts_add_cube(scene), PART_BOTH,
		&(struct pose){.scale = {0.6f, 0.2f, 0.4f}, .position = {0, height, 0}});
	parts_add_object(scene, parts_add_square(scene), PART_RECEIVES,
		&(struct pose){.scale = {50, 1, 3}, .position = {47, 0, 0}});
	parts_add_light(scene, &lamp);
}

static struct sm_view view_of(const struct canvas *canvas, const struct sm_camera *from)
{
	return (struct sm_view){.camera = *from,
		.framebuffer = canvas->framebuffer,
		.width = SIZE,
		.height = SIZE,
		.visibility_of = SM_NONE};
}

static void test_skips_have_names(void **state)
{
	struct rig *rig = *state;
	static const char *const wrong[] = {
		"light", "-", "", "-nothing", "-light,", "-light +frame"};
	struct sm_error error;
	size_t count = 0;
	for (; sm_skip_name(count) != NULL; count++) {
		char list[50];
		assert_true(strlen(sm_skip_summary(count)) > 0);
		snprintf(list, sizeof(list), "-%s,+%s", sm_skip_name(count), sm_skip_name(count));
		assert_true(sm_renderer_set_skips(rig->renderer, list, &error));
		for (size_t i = 0; i < count; i++)
			assert_string_not_equal(sm_skip_name(i), sm_skip_name(count));
	}
	assert_true(count > 0);
	assert_null(sm_skip_summary(count));
	assert_true(sm_renderer_set_skips(rig->renderer, NULL, &error));
	for (size_t i = 0; i < COUNT(wrong); i++) {
		assert_false(sm_renderer_set_skips(rig->renderer, wrong[i], &error));
		assert_int_equal(error.status, SM_ERROR_INPUT);
	}
}

struct passes {
	unsigned int surfaces, others;
};

static void begin_pass(void *data, const char *pass)
{
	struct passes *passes = data;
	if (strcmp(pass, "surfaces") == 0)
		passes->surfaces++;
	else
		passes->others++;
}

static void end_pass(void *data, const char *pass)
{
	(void)data, (void)pass;
}

static struct passes draw_observed(struct rig *rig, const struct sm_view *view)
{
	struct passes passes = {0};
	struct sm_pass_observer observer = {&passes, begin_pass, end_pass};
	sm_renderer_set_pass_observer(rig->renderer, &observer);
	rig_draw(rig, rig->scene, view);
	sm_renderer_set_pass_observer(rig->renderer, NULL);
	return passes;
}

static void test_a_moving_camera_draws_surfaces_alone(void **state)
{
	struct rig *rig = *state;
	struct canvas canvas;
	canvas_init(&canvas, GL_SRGB8_ALPHA8, SIZE, SIZE);
	set_up(rig->scene, 1);
	for (size_t i = 0; sm_technique_name(i) != NULL; i++) {
		struct sm_shadow_options options = {
			.technique = sm_technique_name(i), .map_size = 128};
		struct sm_camera moved = camera;
		struct sm_view view = view_of(&canvas, &camera);
		struct sm_frame_stats stats;
		if (!rig_can_draw(options.technique))
			continue;
		rig_set_shadows(rig, &options);
		assert_true(draw_observed(rig, &view).others > 0);
		moved.eye[0] = -1;
		view = view_of(&canvas, &moved);
		struct passes passes = draw_observed(rig, &view);
		assert_int_equal(passes.surfaces, 1);
		assert_int_equal(passes.others, 0);
		sm_renderer_get_stats(rig->renderer, &stats);
		assert_int_equal(stats.uploaded_bytes, 0);
		assert_int_equal(stats.lights, 1);
		assert_true(sm_renderer_set_skips(rig->renderer, "-light,-static", NULL));
		assert_true(draw_observed(rig, &view).others > 0);
		assert_true(sm_renderer_set_skips(rig->renderer, "+light,+static", NULL));
	}
	canvas_finish(&canvas);
}

static void set_radius(struct rig *rig, float radius)
{
	struct sm_light_desc light = lamp;
	light.radius = radius;
	assert_true(sm_scene_set_light(rig->scene, 0, &light, NULL));
}

static uint64_t count_edges(struct rig *rig, const struct sm_view *view, struct passes *passes)
{
	struct sm_frame_stats stats;
	*passes = draw_observed(rig, view);
	sm_renderer_get_stats(rig->renderer, &stats);
	return stats.silhouette_edges;
}

/* A block whose shadow the camera does not see is left out; once it does, all is drawn, and no
 * camera after that meets anything that is left to draw. */
static void test_a_shadow_beside_the_view_is_drawn_when_that_comes_to_it(void **state)
{
	struct rig *rig = *state;
	struct canvas canvas;
	struct sm_camera aside = {
		.eye = {3, 1, 4}, .target = {3, 0, 1}, .up = {0, 1, 0}, .fov = 20};
	canvas_init(&canvas, GL_SRGB8_ALPHA8, SIZE, SIZE);
	set_up(rig->scene, 1);
	struct sm_view view = view_of(&canvas, &aside), other = view_of(&canvas, &camera);
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "smoothie", .map_size = 128});
	struct passes passes;
	assert_int_equal(count_edges(rig, &view, &passes), 0);
	view.camera.fov = 15;
	assert_int_equal(count_edges(rig, &view, &passes), 0);
	assert_int_equal(passes.others, 0);
	assert_true(count_edges(rig, &other, &passes) > 0);
	assert_true(passes.others > 0);
	view.camera.fov = 20;
	for (int i = 0; i < 2; i++) {
		assert_int_equal(count_edges(rig, i == 0 ? &view : &other, &passes), 0);
		assert_int_equal(passes.others, 0);
	}
	/* Switched off, what is left out is drawn, too. */
	set_radius(rig, 0.3f);
	assert_int_equal(count_edges(rig, &view, &passes), 0);
	assert_true(sm_renderer_set_skips(rig->renderer, "-volume", NULL));
	assert_true(count_edges(rig, &view, &passes) > 0);
	assert_int_equal(count_edges(rig, &view, &passes), 0);
	assert_int_equal(passes.others, 0);
	canvas_finish(&canvas);
}

/* What of a frame is asked about. */
struct question {
	struct sm_view view;
	struct sm_scene *scene;
};

static void other_camera(struct rig *rig, struct question *question)
{
	(void)rig;
	question->view.camera.fov = 46;
}

static void other_size(struct rig *rig, struct question *question)
{
	(void)rig;
	question->view.width = SIZE - 1;
}

static void other_framebuffer(struct rig *rig, struct question *question)
{
	(void)rig;
	question->view.framebuffer = 0;
}

static void visibility(struct rig *rig, struct question *question)
{
	(void)rig;
	question->view.visibility_of = 0;
}

static void alone(struct rig *rig, struct question *question)
{
	(void)rig;
	question->view.alone = true;
}

static void other_place(struct rig *rig, struct question *question)
{
	(void)rig;
	float transform[16];
	pose_matrix(&(struct pose){.scale = {1, 1, 1}}, transform);
	assert_true(sm_scene_set_transform(question->scene, 0, transform, NULL));
}

static void other_light(struct rig *rig, struct question *question)
{
	(void)rig;
	struct sm_light_desc dimmed = lamp;
	dimmed.intensity = 0.5f;
	assert_true(sm_scene_set_light(question->scene, 0, &dimmed, NULL));
}

static void other_background(struct rig *rig, struct question *question)
{
	(void)rig;
	sm_scene_set_environment(
		question->scene, &(struct sm_environment){.background = {1, 0, 0}});
}

static void one_more_object(struct rig *rig, struct question *question)
{
	(void)rig;
	parts_add_object(question->scene, 0, PART_BOTH, &(struct pose){.scale = {1, 1, 1}});
}

static void other_shadows(struct rig *rig, struct question *question)
{
	(void)question;
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "pcf"});
}

static void skip_off(struct rig *rig, struct question *question)
{
	(void)question;
	assert_true(sm_renderer_set_skips(rig->renderer, "-frame", NULL));
}

static void failure(struct rig *rig, struct question *question)
{
	struct sm_view none = question->view;
	none.width = 0;
	assert_false(sm_renderer_draw(rig->renderer, question->scene, &none, NULL));
}

static void other_scene(struct rig *rig, struct question *question)
{
	(void)rig;
	question->scene = sm_scene_create();
	set_up(question->scene, 1);
}

/* Without any function of GL: it must not call one. */
static bool is_current_without_gl(struct rig *rig, const struct question *question)
{
	struct gl gl = rig->renderer->gpu.gl;
	rig->renderer->gpu.gl = (struct gl){0};
	bool current = sm_renderer_is_current(rig->renderer, question->scene, &question->view);
	rig->renderer->gpu.gl = gl;
	return current;
}

static void test_a_frame_is_current_until_something_changes(void **state)
{
	struct rig *rig = *state;
	static void (*const changes[])(struct rig * rig, struct question * question) = {
		other_camera, other_size, other_framebuffer, visibility, alone, other_place,
		other_light, other_background, one_more_object, other_shadows, skip_off, failure,
		other_scene};
	struct canvas canvas;
	canvas_init(&canvas, GL_RGBA8, SIZE, SIZE);
	set_up(rig->scene, 1);
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "hard"});
	for (size_t i = 0; i < COUNT(changes); i++) {
		struct question question = {view_of(&canvas, &camera), rig->scene};
		assert_true(sm_renderer_set_skips(rig->renderer, "+all", NULL));
		rig_draw(rig, rig->scene, &question.view);
		for (int again = 0; again < 2; again++)
			assert_true(is_current_without_gl(rig, &question));
		changes[i](rig, &question);
		if (is_current_without_gl(rig, &question))
			fail_msg("current after change %zu", i);
		if (question.scene != rig->scene)
			sm_scene_destroy(question.scene);
	}
	canvas_finish(&canvas);
}

static uint8_t *draw(struct rig *rig, const struct sm_scene *scene, const struct sm_camera *from)
{
	struct canvas canvas;
	canvas_init(&canvas, GL_RGBA8, SIZE, SIZE);
	struct sm_view view = view_of(&canvas, from);
	rig_draw(rig, scene, &view);
	uint8_t *rgba = canvas_read(&canvas);
	canvas_finish(&canvas);
	return rgba;
}

static bool look_alike(const uint8_t *a, const uint8_t *b)
{
	return memcmp(a, b, SIZE * SIZE * 4) == 0;
}

static struct sm_skip_stats stats_of(const struct rig *rig, const char *name)
{
	struct sm_skip_stats stats;
	size_t index = 0;
	while (strcmp(sm_skip_name(index), name) != 0)
		index++;
	sm_renderer_get_skip_stats(rig->renderer, index, &stats);
	return stats;
}

static uint8_t *draw_lit_from(struct rig *rig, float x)
{
	struct sm_light_desc light = lamp;
	light.position[0] = x;
	assert_true(sm_scene_set_light(rig->scene, 0, &light, NULL));
	return draw(rig, rig->scene, &camera);
}

static bool tests_all_for_fins(const void *state)
{
	const struct fin_set *fins = smoothie_fins(state);
	return fins->block_count > 0 && fins->tested_count == fins->block_count;
}

static bool tests_all_for_chains(const void *state)
{
	const struct edge_chains *chains = gather_chains(state);
	return chains->block_count > 0 && chains->tested_count == chains->block_count;
}

/* Of few, where a light moves a bit; turned off, none is passed over, which does not show. */
static void test_triangles_are_tested_that_may_have_turned(void **state)
{
	struct rig *rig = *state;
	static const struct {
		const char *technique;
		bool (*tests_all)(const void *state);
	} cases[] = {{"smoothie", tests_all_for_fins}, {"gather", tests_all_for_chains}};
	parts_add_object(rig->scene, parts_add_sphere(rig->scene, 64), PART_BOTH,
		&(struct pose){.scale = {1, 1, 1}, .position = {0, 1, 0}});
	parts_add_light(rig->scene, &lamp);
	for (size_t i = 0; i < COUNT(cases); i++) {
		rig_set_shadows(rig, &(struct sm_shadow_options){
					     .technique = cases[i].technique, .map_size = 128});
		free(draw_lit_from(rig, 1.01f));
		const struct sm_skip_stats before = stats_of(rig, "triangle");
		uint8_t *skipped = draw_lit_from(rig, 1.0f);
		const struct sm_skip_stats after = stats_of(rig, "triangle");
		assert_true(after.tested > before.tested);
		assert_true(2 * (after.skipped - before.skipped) > after.tested - before.tested);
		assert_true(after.redrawn > before.redrawn);
		assert_true(sm_renderer_set_skips(rig->renderer, "-triangle,-light,-static", NULL));
		uint8_t *thorough = draw_lit_from(rig, 1.0f);
		assert_int_equal(stats_of(rig, "triangle").tested, after.tested);
		assert_true(look_alike(skipped, thorough));
		assert_true(cases[i].tests_all(rig->renderer->lights[0].shadow->state));
		assert_true(sm_renderer_set_skips(rig->renderer, "+all", NULL));
		free(skipped);
		free(thorough);
	}
}

/* One half of a square, or the other: in the same box. */
static void set_up_half(struct sm_scene *scene, bool other)
{
	static const float corners[4][3] = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
	static const uint32_t halves[2][3] = {{0, 2, 1}, {0, 3, 2}};
	uint32_t half = parts_add_mesh(scene, corners, 4, halves[other], 3);
	parts_add_object(
		scene, half, PART_BOTH, &(struct pose){.scale = {1, 1, 1}, .position = {0, 1, 0}});
	parts_add_object(
		scene, parts_add_square(scene), PART_RECEIVES, &(struct pose){.scale = {3, 1, 3}});
	parts_add_light(scene, &lamp);
}

/* Scenes that count their versions alike, under a light that sees them the same way. */
static void test_what_is_kept_is_of_one_scene(void **state)
{
	struct rig *rig = *state;
	static const char *const techniques[] = {"hard", "gather"};
	struct sm_scene *other = sm_scene_create();
	set_up_half(rig->scene, false);
	set_up_half(other, true);
	for (size_t i = 0; i < COUNT(techniques); i++) {
		assert_true(sm_renderer_set_skips(rig->renderer, "+all", NULL));
		rig_set_shadows(rig,
			&(struct sm_shadow_options){.technique = techniques[i], .map_size = 256});
		uint8_t *first = draw(rig, rig->scene, &camera);
		uint8_t *second = draw(rig, other, &camera);
		rig_skip_nothing(rig);
		uint8_t *alone = draw(rig, other, &camera);
		assert_true(look_alike(second, alone));
		assert_false(look_alike(first, alone));
		free(first);
		free(second);
		free(alone);
	}
	sm_scene_destroy(other);
}

static bool is_hard(const struct rig *rig)
{
	struct sm_frame_stats stats;
	sm_renderer_get_stats(rig->renderer, &stats);
	return stats.hard_lights == 1;
}

/* The radius from which on a light that was hard before is soft. */
static float find_soft_radius(struct rig *rig)
{
	float hard = 0, soft = lamp.radius;
	for (int i = 0; i < 12; i++) {
		float middle = (hard + soft) / 2;
		set_radius(rig, 0);
		free(draw(rig, rig->scene, &camera));
		set_radius(rig, middle);
		free(draw(rig, rig->scene, &camera));
		if (is_hard(rig))
			hard = middle;
		else
			soft = middle;
	}
	return soft;
}

/* A light that wavers about the width where "auto" chooses stays what it was, but not while it is
 * out of view. */
static void test_choices_start_anew_when_a_light_comes_into_view(void **state)
{
	struct rig *rig = *state;
	struct sm_camera aside = camera;
	aside.eye[0] = aside.target[0] = 60;
	set_up(rig->scene, 1);
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "auto", .map_size = 128});
	float narrow = 0.9f * find_soft_radius(rig);
	for (int all = 0; all < 2; all++) {
		assert_true(sm_renderer_set_skips(rig->renderer, all ? "+all" : "-all", NULL));
		for (int away = 0; away < 2; away++) {
			set_radius(rig, lamp.radius);
			free(draw(rig, rig->scene, &camera));
			assert_false(is_hard(rig));
			set_radius(rig, narrow);
			if (away)
				free(draw(rig, rig->scene, &aside));
			free(draw(rig, rig->scene, &camera));
			assert_true(is_hard(rig) == away);
		}
	}
}

static void test_a_frame_alone_does_not_go_by_those_before(void **state)
{
	struct rig *rig = *state;
	struct canvas canvas;
	canvas_init(&canvas, GL_RGBA8, SIZE, SIZE);
	set_up(rig->scene, 1);
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "auto", .map_size = 128});
	float narrow = 0.9f * find_soft_radius(rig);
	for (int i = 0; i < 2; i++) {
		struct sm_view view = view_of(&canvas, &camera);
		set_radius(rig, lamp.radius);
		rig_draw(rig, rig->scene, &view);
		set_radius(rig, narrow);
		view.alone = i == 1;
		rig_draw(rig, rig->scene, &view);
		assert_true(is_hard(rig) == view.alone);
	}
	canvas_finish(&canvas);
}

/* Of lights that shine away from what is seen, before the one that lights it. */
static void add_aside(struct sm_scene *scene, int count)
{
	struct sm_light_desc aside = lamp;
	memcpy(aside.position, (const float[3]){20, 30, 50}, sizeof(aside.position));
	memcpy(aside.target, (const float[3]){40, 60, 100}, sizeof(aside.target));
	for (int i = 0; i < count; i++)
		parts_add_light(scene, &aside);
}

/* Wherever it is among the lights, and whatever the framebuffer encodes. */
static void test_one_light_in_view_costs_what_it_does_alone(void **state)
{
	struct rig *rig = *state;
	static const GLenum formats[] = {GL_SRGB8_ALPHA8, GL_RGBA8};
	static const struct sm_environment environment = {.sky = {0.1f, 0.2f, 0.3f}};
	struct sm_scene *many = sm_scene_create();
	assert_non_null(many);
	sm_scene_set_environment(rig->scene, &environment);
	sm_scene_set_environment(many, &environment);
	set_up(rig->scene, 1);
	add_aside(many, 5);
	set_up(many, 1);
	add_aside(many, 2);
	for (size_t i = 0; i < COUNT(formats); i++) {
		struct canvas canvas;
		struct sm_frame_stats alone, among;
		canvas_init(&canvas, formats[i], SIZE, SIZE);
		struct sm_view view = view_of(&canvas, &camera);
		rig_draw(rig, rig->scene, &view);
		sm_renderer_get_stats(rig->renderer, &alone);
		uint8_t *expected = canvas_read(&canvas);
		rig_draw(rig, many, &view);
		sm_renderer_get_stats(rig->renderer, &among);
		uint8_t *found = canvas_read(&canvas);
		assert_memory_equal(found, expected, SIZE * SIZE * 4);
		assert_int_equal(among.draw_calls, alone.draw_calls);
		assert_int_equal(among.lights, 1);
		free(expected);
		free(found);
		canvas_finish(&canvas);
	}
	sm_scene_destroy(many);
}

static void move_block(struct sm_scene *scene, float x)
{
	float transform[16];
	pose_matrix(&(struct pose){.scale = {0.6f, 0.2f, 0.4f}, .position = {x, 1, 0}}, transform);
	assert_true(sm_scene_set_transform(scene, 0, transform, NULL));
}

/* Parts of surfaces that need less than all, in a frame. */
static uint64_t count_plain_parts(struct rig *rig, const struct sm_view *view)
{
	struct sm_skip_stats before, after;
	size_t index = 0;
	while (strcmp(sm_skip_name(index), "receiver") != 0)
		index++;
	sm_renderer_get_skip_stats(rig->renderer, index, &before);
	rig_draw(rig, rig->scene, view);
	sm_renderer_get_skip_stats(rig->renderer, index, &after);
	assert_true(after.tested > before.tested);
	return after.skipped - before.skipped;
}

/* A caster that has gone leaves nothing that surfaces would be looked up for. */
static void test_fins_that_have_gone_reach_nothing(void **state)
{
	struct rig *rig = *state;
	struct canvas canvas;
	canvas_init(&canvas, GL_SRGB8_ALPHA8, SIZE, SIZE);
	set_up(rig->scene, 1);
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "smoothie"});
	struct sm_view view = view_of(&canvas, &camera);
	uint64_t there = count_plain_parts(rig, &view);
	move_block(rig->scene, 40);
	uint64_t gone = count_plain_parts(rig, &view);
	assert_true(gone > there);
	move_block(rig->scene, 0);
	assert_int_equal(count_plain_parts(rig, &view), there);
	canvas_finish(&canvas);
}

/* Where fins have changed their depths are found anew, and the others' stay. */
static void test_depths_of_fins_follow_what_moves(void **state)
{
	struct rig *rig = *state;
	static struct screen_depths followed;
	static const struct sm_shadow_options options = {.technique = "smoothie", .map_size = 128};
	struct canvas canvas;
	canvas_init(&canvas, GL_SRGB8_ALPHA8, SIZE, SIZE);
	set_up(rig->scene, 1);
	parts_add_object(rig->scene, parts_add_cube(rig->scene), PART_BOTH,
		&(struct pose){.scale = {2, 0.1f, 0.1f}, .position = {0, 0.5f, 0.3f}});
	struct sm_view view = view_of(&canvas, &camera);
	for (int step = 0; step < 8; step++) {
		rig_set_shadows(rig, &options);
		rig_draw(rig, rig->scene, &view);
		move_block(rig->scene, 0.4f * (float)(step + 1) - 1.6f);
		rig_draw(rig, rig->scene, &view);
		followed = *rig->renderer->shadows.shadows[0]->needs.soft;
		rig_set_shadows(rig, &options);
		rig_draw(rig, rig->scene, &view);
		assert_memory_equal(
			&followed, rig->renderer->shadows.shadows[0]->needs.soft, sizeof(followed));
	}
	canvas_finish(&canvas);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(test_skips_have_names),
		rig_test(test_a_moving_camera_draws_surfaces_alone),
		rig_test(test_a_shadow_beside_the_view_is_drawn_when_that_comes_to_it),
		rig_test(test_a_frame_is_current_until_something_changes),
		rig_test(test_triangles_are_tested_that_may_have_turned),
		rig_test(test_what_is_kept_is_of_one_scene),
		rig_test(test_choices_start_anew_when_a_light_comes_into_view),
		rig_test(test_a_frame_alone_does_not_go_by_those_before),
		rig_test(test_one_light_in_view_costs_what_it_does_alone),
		rig_test(test_fins_that_have_gone_reach_nothing),
		rig_test(test_depths_of_fins_follow_what_moves),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
