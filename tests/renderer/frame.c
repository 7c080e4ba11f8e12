/* SPDX-License-Identifier: MIT */
/* What a frame does: which objects shadow which, what it keeps, and how it leaves GL. */
#include "canvas.h"
#include "parts.h"
#include "platform.h"
#include "visibility.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 64

/* A floor, and a board over its middle that hides a quarter of it from the light. */
static const struct pose floor_pose = {.scale = {2, 1, 2}};
static const struct pose board_pose = {.scale = {0.5f, 1, 0.5f}, .position = {0, 2, 0}};
static const struct pose elsewhere = {.scale = {0.5f, 1, 0.5f}, .position = {20, 2, 0}};

/* Looks under the board, at the middle of the floor. */
static const struct sm_camera low = {
	.eye = {0, 1.5f, 6}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov = 30};

static const struct sm_light_desc lamp = {
	.type = SM_LIGHT_SPOT,
	.position = {0, 4, 0},
	.radius = 0.2f,
	.angle = 80,
	.color = {1, 1, 1},
	.intensity = 0.8f,
};

/* Returns the board. */
static uint32_t set_up(struct sm_scene *scene, unsigned int board_roles, unsigned int floor_roles)
{
	uint32_t square = parts_add_square(scene);
	uint32_t board = parts_add_object(scene, square, board_roles, &board_pose);
	parts_add_object(scene, square, floor_roles, &floor_pose);
	parts_add_light(scene, &lamp);
	return board;
}

static double center_of(struct rig *rig, const struct sm_scene *scene)
{
	struct visibility seen;
	visibility_draw(&seen, rig, scene, &low, SIZE, SIZE);
	double center = visibility_at(&seen, SIZE / 2, SIZE / 2);
	visibility_finish(&seen);
	return center;
}

static void the_roles_of_objects_decide_who_shadows_whom(void **state)
{
	struct rig *rig = *state;
	static const struct {
		unsigned int board, floor;
		double center;
	} cases[] = {
		{PART_BOTH, PART_BOTH, 0},
		{PART_CASTS, PART_RECEIVES, 0},
		{PART_RECEIVES, PART_BOTH, 1},
		{PART_BOTH, PART_CASTS, 1},
		{0, 0, 1},
	};
	static const char *const techniques[] = {"hard", "smoothie"};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_scene *scene = sm_scene_create();
		assert_non_null(scene);
		set_up(scene, cases[i].board, cases[i].floor);
		for (size_t t = 0; t < 2; t++) {
			rig_set_shadows(
				rig, &(struct sm_shadow_options){.technique = techniques[t]});
			assert_true(center_of(rig, scene) == cases[i].center);
		}
		sm_scene_destroy(scene);
	}
}

static void nothing_but_background_is_all_lit(void **state)
{
	struct rig *rig = *state;
	struct visibility seen;
	parts_add_light(rig->scene, &lamp);
	visibility_draw(&seen, rig, rig->scene, &low, SIZE, SIZE);
	for (size_t i = 0; i < SIZE * SIZE; i++)
		assert_int_equal(seen.values[i], 65535);
	visibility_finish(&seen);
}

/* A wall that reaches out of a cone on all sides; the floor is far wider, and goes on behind. */
static void beside_and_behind_a_spot_nothing_is_shadowed(void **state)
{
	struct rig *rig = *state;
	static const char *const techniques[] = {"hard", "smoothie"};
	static const struct sm_camera overhead = {
		.eye = {0, 9, 0}, .up = {0, 0, -1}, .fov = 60}; /* 5.2 units to either side */
	struct sm_light_desc narrow = lamp;
	float *p = narrow.position;
	p[0] = -1;
	p[1] = 0.6f;
	narrow.target[1] = 0.6f;
	narrow.angle = 40;
	parts_add_light(rig->scene, &narrow);
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_BOTH,
		&(struct pose){.scale = {7, 1, 7}});
	parts_add_object(rig->scene, parts_add_cube(rig->scene), PART_CASTS,
		&(struct pose){.scale = {0.05f, 0.4f, 6}, .position = {2, 0.6f, 0}});
	for (size_t t = 0; t < 2; t++) {
		struct visibility seen;
		uint32_t dark = 0;
		rig_set_shadows(rig,
			&(struct sm_shadow_options){.technique = techniques[t], .map_size = 256});
		visibility_draw(&seen, rig, rig->scene, &overhead, SIZE, SIZE);
		for (uint32_t y = 0; y < SIZE; y++) {
			for (uint32_t i = 0; i < SIZE; i++) {
				double x = 5.2 * (2 * (i + 0.5) / SIZE - 1), ahead = x - p[0];
				double z = 5.2 * (2 * (y + 0.5) / SIZE - 1);
				double reach = fmax(fabs(z), 0.6) / 0.364 /* tan 20 degrees */;
				/* The wall's own top is in the way of the eye. */
				if (reach > ahead + 0.4 && fabs(x - 2) > 0.4)
					assert_true(visibility_at(&seen, i, y) == 1);
				dark += visibility_at(&seen, i, y) == 0;
			}
		}
		assert_true(dark > 20);
		visibility_finish(&seen);
	}
}

static void changes_show_in_the_next_frame(void **state)
{
	struct rig *rig = *state;
	float transform[16];
	uint32_t board = set_up(rig->scene, PART_BOTH, PART_BOTH);
	assert_true(center_of(rig, rig->scene) == 0);
	pose_matrix(&elsewhere, transform);
	assert_true(sm_scene_set_transform(rig->scene, board, transform, NULL));
	assert_true(center_of(rig, rig->scene) == 1);
	pose_matrix(&board_pose, transform);
	assert_true(sm_scene_set_transform(rig->scene, board, transform, NULL));
	assert_true(center_of(rig, rig->scene) == 0);

	struct sm_light_desc aside = lamp;
	aside.position[0] = 3;
	assert_true(sm_scene_set_light(rig->scene, 0, &aside, NULL));
	assert_true(center_of(rig, rig->scene) == 1);

	/* A further object, of a further mesh: right above the floor, under where the lamp was. */
	parts_add_object(rig->scene, parts_add_cube(rig->scene), PART_BOTH,
		&(struct pose){.scale = {0.3f, 0.3f, 0.3f}, .position = {1.5f, 2, 0}});
	assert_true(center_of(rig, rig->scene) == 0);
}

static void a_scene_may_go_and_another_come(void **state)
{
	struct rig *rig = *state;
	for (int i = 0; i < 4; i++) {
		struct sm_scene *scene = sm_scene_create();
		assert_non_null(scene);
		if (i % 2 == 0) {
			set_up(scene, PART_RECEIVES, PART_BOTH);
		} else {
			/* Another mesh of the same number, whose side looks away from the light. */
			parts_add_object(scene, parts_add_cube(scene), PART_BOTH,
				&(struct pose){.scale = {0.3f, 0.3f, 0.3f}});
			parts_add_light(scene, &lamp);
		}
		assert_true(center_of(rig, scene) == (i % 2 == 0));
		sm_scene_destroy(scene);
	}
}

static void the_same_frame_has_the_same_bits(void **state)
{
	struct rig *rig = *state;
	struct visibility first, second;
	set_up(rig->scene, PART_BOTH, PART_BOTH);
	visibility_draw(&first, rig, rig->scene, &low, SIZE, SIZE);
	visibility_draw(&second, rig, rig->scene, &low, SIZE, SIZE);
	assert_int_equal(visibility_compare(&first, &second).differing, 0);
	visibility_finish(&first);
	visibility_finish(&second);
}

static void renderers_in_one_context_do_not_disturb_each_other(void **state)
{
	struct rig *rig = *state;
	struct rig second = *rig;
	struct visibility soft, hard, again;
	set_up(rig->scene, PART_BOTH, PART_BOTH);
	second.renderer = sm_renderer_create(platform_get_proc, NULL);
	assert_non_null(second.renderer);
	rig_set_shadows(&second, &(struct sm_shadow_options){.technique = "hard"});
	visibility_draw(&soft, rig, rig->scene, &low, SIZE, SIZE);
	visibility_draw(&hard, &second, rig->scene, &low, SIZE, SIZE);
	visibility_draw(&again, rig, rig->scene, &low, SIZE, SIZE);
	assert_int_equal(visibility_compare(&soft, &again).differing, 0);
	assert_int_not_equal(visibility_compare(&soft, &hard).differing, 0);
	sm_renderer_destroy(second.renderer);
	visibility_finish(&again);
	visibility_draw(&again, rig, rig->scene, &low, SIZE, SIZE);
	assert_int_equal(visibility_compare(&soft, &again).differing, 0);
	visibility_finish(&soft);
	visibility_finish(&hard);
	visibility_finish(&again);
}

static void renderers_come_and_go(void **state)
{
	struct rig *rig = *state;
	set_up(rig->scene, PART_BOTH, PART_RECEIVES);
	sm_renderer_destroy(NULL);
	for (int i = 0; i < 50; i++) {
		struct rig other = *rig;
		other.renderer = sm_renderer_create(platform_get_proc, NULL);
		assert_non_null(other.renderer);
		/* Some leave before their first frame. */
		if (i % 10 == 0)
			assert_true(center_of(&other, rig->scene) == 0);
		sm_renderer_destroy(other.renderer);
	}
}

static void pictures_have_any_size_up_to_the_driver_s(void **state)
{
	struct rig *rig = *state;
	static const uint32_t sizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {33, 2}};
	set_up(rig->scene, PART_BOTH, PART_BOTH);
	for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
		struct visibility seen;
		visibility_draw(&seen, rig, rig->scene, &low, sizes[i][0], sizes[i][1]);
		visibility_finish(&seen);
	}
}

/* Draws into nothing, because it is refused before. */
static void assert_refused(
	struct rig *rig, const struct sm_view *view, enum sm_status status, const char *text)
{
	struct sm_error error = {0};
	assert_false(sm_renderer_draw(rig->renderer, rig->scene, view, &error));
	assert_int_equal(error.status, status);
	if (strstr(error.text, text) == NULL)
		fail_msg("\"%s\" says nothing of \"%s\"", error.text, text);
	assert_false(sm_renderer_draw(rig->renderer, rig->scene, view, NULL));
}

static void views_that_cannot_be_drawn_are_refused(void **state)
{
	struct rig *rig = *state;
	GLint most[2];
	char limits[64];
	glGetIntegerv(GL_MAX_VIEWPORT_DIMS, most);
	snprintf(limits, sizeof(limits), "%dx%d", most[0], most[1]);
	set_up(rig->scene, PART_BOTH, PART_BOTH);
	const struct {
		uint32_t width, height, visibility_of;
		const char *text;
	} cases[] = {
		{0, 1, SM_NONE, "0x1"},
		{1, 0, SM_NONE, "1x0"},
		{(uint32_t)most[0] + 1, 1, SM_NONE, limits},
		{1, (uint32_t)most[1] + 1, SM_NONE, limits},
		{UINT32_MAX, UINT32_MAX, SM_NONE, limits},
		{1, 1, 1, "no light 1"},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_view view = {.camera = low,
			.width = cases[i].width,
			.height = cases[i].height,
			.visibility_of = cases[i].visibility_of};
		assert_refused(rig, &view, SM_ERROR_INPUT, cases[i].text);
	}
	rig_set_shadows(rig, &(struct sm_shadow_options){.precision = SM_PRECISION_HALF});
	const struct sm_view wide = {.camera = low, .width = 2048, .height = 1};
	assert_refused(rig, &wide, SM_ERROR_INPUT, "\"half\" it has at most 2047x2047");
}

static void without_a_light_there_is_a_picture_and_no_visibility(void **state)
{
	struct rig *rig = *state;
	struct canvas canvas;
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_BOTH, &floor_pose);
	canvas_init(&canvas, GL_RGBA8, SIZE, SIZE);
	struct sm_view view = {
		.camera = low, .framebuffer = canvas.framebuffer, .width = SIZE, .height = SIZE};
	assert_refused(rig, &view, SM_ERROR_INPUT, "no light 0");
	view.visibility_of = SM_NONE;
	rig_draw(rig, rig->scene, &view);
	canvas_finish(&canvas);
}

static void cameras_that_see_nothing_are_refused(void **state)
{
	struct rig *rig = *state;
	static const struct {
		struct sm_camera camera;
		const char *text;
	} cases[] = {
		{{.up = {0, 1, 0}, .fov = 40}, "its target is its eye"},
		{{.eye = {0, (float)NAN, 0}, .up = {0, 1, 0}, .fov = 40}, "not finite"},
		{{.eye = {0, 2, 0}, .up = {0, 1, 0}, .fov = 40}, "along its up"},
		{{.eye = {0, 2, 0}, .fov = 40}, "along its up"},
		{{.eye = {0, 2, 1}, .up = {0, 1, 0}, .fov = 0}, "field of view"},
		{{.eye = {0, 2, 1}, .up = {0, 1, 0}, .fov = 179}, "field of view"},
		{{.eye = {0, 2, 1}, .up = {0, 1, 0}, .fov = (float)NAN}, "field of view"},
		{{.eye = {0, 2, 1}, .up = {0, 1, 0}, .fov = 40, .near = 2, .far = 1}, "near"},
		{{.eye = {0, 2, 1}, .up = {0, 1, 0}, .fov = 40, .near = -1, .far = 1}, "near"},
		{{.eye = {0, 2, 1}, .up = {0, 1, 0}, .fov = 40, .near = 1}, "near"},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_view view = {.camera = cases[i].camera,
			.width = 1,
			.height = 1,
			.visibility_of = SM_NONE};
		assert_refused(rig, &view, SM_ERROR_INPUT, cases[i].text);
	}
}

static GLint state_of(GLenum name)
{
	GLint value = -1;
	glGetIntegerv(name, &value);
	return value;
}

static void assert_gl_is_as_promised(const struct canvas *canvas)
{
	static const struct {
		GLenum name;
		GLint value;
	} defaults[] = {
		{GL_DEPTH_TEST, GL_FALSE},
		{GL_SCISSOR_TEST, GL_FALSE},
		{GL_BLEND, GL_FALSE},
		{GL_DITHER, GL_TRUE},
		{GL_CULL_FACE, GL_FALSE},
		{GL_DEPTH_FUNC, GL_LESS},
		{GL_DEPTH_WRITEMASK, GL_TRUE},
		{GL_BLEND_SRC_RGB, GL_ONE},
		{GL_BLEND_SRC_ALPHA, GL_ONE},
		{GL_BLEND_DST_RGB, GL_ZERO},
		{GL_BLEND_DST_ALPHA, GL_ZERO},
		{GL_BLEND_EQUATION_RGB, GL_FUNC_ADD},
		{GL_BLEND_EQUATION_ALPHA, GL_FUNC_ADD},
		{GL_CURRENT_PROGRAM, 0},
		{GL_VERTEX_ARRAY_BINDING, 0},
		{GL_ARRAY_BUFFER_BINDING, 0},
		{GL_ELEMENT_ARRAY_BUFFER_BINDING, 0},
		{GL_ACTIVE_TEXTURE, GL_TEXTURE0},
	};
	for (size_t i = 0; i < sizeof(defaults) / sizeof(defaults[0]); i++)
		assert_int_equal(state_of(defaults[i].name), defaults[i].value);
	assert_int_equal(state_of(GL_DRAW_FRAMEBUFFER_BINDING), canvas->framebuffer);
	assert_int_equal(state_of(GL_READ_FRAMEBUFFER_BINDING), canvas->framebuffer);
	GLint viewport[4];
	glGetIntegerv(GL_VIEWPORT, viewport);
	const GLint expected[4] = {0, 0, (GLint)canvas->width, (GLint)canvas->height};
	assert_memory_equal(viewport, expected, sizeof(viewport));
	for (GLint unit = 0; unit < state_of(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS); unit++) {
		glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
		assert_int_equal(state_of(GL_TEXTURE_BINDING_2D), 0);
		assert_int_equal(state_of(GL_SAMPLER_BINDING), 0);
	}
	glActiveTexture(GL_TEXTURE0);
	assert_int_equal(glGetError(), GL_NO_ERROR);
}

static void gl_is_left_at_its_defaults(void **state)
{
	struct rig *rig = *state;
	static const struct {
		const char *technique;
		uint32_t visibility_of, passes;
		GLenum format;
		enum sm_precision precision;
	} cases[] = {
		{"hard", SM_NONE, 0, GL_RGBA8}, /* two lights: by way of the accumulator */
		{"smoothie", SM_NONE, 0, GL_RGBA8},
		{"smoothie", SM_NONE, 2, GL_SRGB8_ALPHA8},
		{"smoothie", 1, 2, GL_RGBA8},
		{"gather", SM_NONE, 0, GL_SRGB8_ALPHA8},
		{"auto", 1, 0, GL_RGBA8},
		{"smoothie", SM_NONE, 0, GL_RGBA8, SM_PRECISION_HALF},
		{"smoothie", 1, 0, GL_RGBA8, SM_PRECISION_FIXED12},
	};
	set_up(rig->scene, PART_CASTS, PART_RECEIVES);
	parts_add_light(rig->scene, &lamp);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct canvas canvas;
		struct sm_shadow_options options = {.technique = cases[i].technique,
			.passes = cases[i].passes,
			.precision = cases[i].precision};
		canvas_init(&canvas, cases[i].format, SIZE, SIZE / 2);
		struct sm_view view = {.camera = low,
			.framebuffer = canvas.framebuffer,
			.width = SIZE,
			.height = SIZE / 2,
			.visibility_of = cases[i].visibility_of};
		rig_set_shadows(rig, &options);
		/* The first frame makes what the second one keeps. */
		for (int frame = 0; frame < 2; frame++) {
			rig_draw(rig, rig->scene, &view);
			assert_gl_is_as_promised(&canvas);
		}
		canvas_finish(&canvas);
	}
}

/* A driver that does not compile one of the shaders: sources until then, and whether it came. */
static unsigned int good_sources;
static bool spoiled;

static void GL_APIENTRY spoil_source(
	GLuint shader, GLsizei count, const GLchar *const *strings, const GLint *lengths)
{
	static const GLchar *const error = "#error";
	PFNGLSHADERSOURCEPROC source = (PFNGLSHADERSOURCEPROC)platform_get_proc("glShaderSource");
	spoiled = spoiled || good_sources == 0;
	if (good_sources-- == 0)
		source(shader, 1, &error, NULL);
	else
		source(shader, count, strings, lengths);
}

static void (*get_spoiling_proc(const char *name))(void)
{
	return strcmp(name, "glShaderSource") == 0 ? (void (*)(void))spoil_source
						   : platform_get_proc(name);
}

/* With the first shader, the second, ... until there is none left to spoil; how many failed.
 * Where it is a probe's, another way may be taken. */
static unsigned int spoil_one_by_one(struct rig *rig, const char *technique)
{
	const struct sm_shadow_options options = {.technique = technique};
	unsigned int failures = 0;
	spoiled = true;
	for (unsigned int i = 0; spoiled; i++) {
		struct canvas canvas;
		struct sm_renderer *renderer = sm_renderer_create(get_spoiling_proc, NULL);
		assert_non_null(renderer);
		assert_true(sm_renderer_set_shadows(renderer, &options, NULL));
		canvas_init(&canvas, GL_RGBA8, SIZE, SIZE / 2);
		const struct sm_view view = {.camera = low,
			.framebuffer = canvas.framebuffer,
			.width = SIZE,
			.height = SIZE / 2,
			.visibility_of = SM_NONE};
		good_sources = i;
		spoiled = false;
		failures += !sm_renderer_draw(renderer, rig->scene, &view, NULL);
		assert_gl_is_as_promised(&canvas);
		canvas_finish(&canvas);
		sm_renderer_destroy(renderer);
		assert_true(failures < 100); /* there are not so many shaders */
	}
	rig->problems = 0; /* they are wanted */
	return failures;
}

static void so_it_is_when_drawing_fails(void **state)
{
	struct rig *rig = *state;
	set_up(rig->scene, PART_CASTS, PART_RECEIVES);
	parts_add_light(rig->scene, &lamp);
	/* Depth, fins, and more than one kind of surface, of two shaders each. */
	assert_true(spoil_one_by_one(rig, "smoothie") >= 6);
	assert_true(spoil_one_by_one(rig, "smoothie-two-sided") >= 6);
	/* A layer, those behind it, surfaces, and points that are joined to cells. */
	assert_true(spoil_one_by_one(rig, "gather") >= 6);
	if (rig_can_draw("vsm"))
		assert_true(spoil_one_by_one(rig, "vsm") >= 6);
}

static void so_it_is_after_a_copy_to_a_screen(void **state)
{
	struct rig *rig = *state;
	struct canvas canvas;
	GLuint texture;
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, SIZE, SIZE / 2);
	canvas_init(&canvas, GL_RGB565, SIZE / 2, SIZE);
	struct sm_screen screen = {texture, SIZE, SIZE / 2, canvas.framebuffer, 90, {5, 6, 5}};
	assert_true(sm_renderer_copy_to_screen(rig->renderer, &screen, NULL));
	assert_gl_is_as_promised(&canvas);
	canvas_finish(&canvas);
	glDeleteTextures(1, &texture);
}

/* Floor, ceiling and a small board under the lamp, all one mesh: the lamp is inside its box, with
 * the board much nearer than any of the box's faces in the cone. */
static void a_lamp_in_a_room_sees_what_is_near(void **state)
{
	struct rig *rig = *state;
	static const float half[3] = {5, 5, 0.5f}, height[3] = {0, 6, 4};
	float positions[12][3];
	uint32_t indices[18];
	for (uint32_t i = 0; i < 12; i++) {
		positions[i][0] = i & 1 ? half[i / 4] : -half[i / 4];
		positions[i][1] = height[i / 4];
		positions[i][2] = i & 2 ? half[i / 4] : -half[i / 4];
	}
	for (uint32_t i = 0; i < 18; i++)
		indices[i] = i / 6 * 4 + (const uint32_t[]){0, 2, 1, 1, 2, 3}[i % 6];
	uint32_t mesh = parts_add_mesh(rig->scene, (const float(*)[3])positions, 12, indices, 18);
	parts_add_object(rig->scene, mesh, PART_BOTH, &(struct pose){.scale = {1, 1, 1}});
	struct sm_light_desc below_ceiling = {.position = {0, 5, 0}, .radius = 0.1f, .angle = 100};
	parts_add_light(rig->scene, &below_ceiling);
	struct sm_camera camera = {.eye = {4, 1, 0}, .up = {0, 1, 0}, .fov = 40};
	static const char *const techniques[] = {"hard", "smoothie"};
	for (size_t i = 0; i < 2; i++) {
		struct visibility seen;
		rig_set_shadows(rig, &(struct sm_shadow_options){.technique = techniques[i]});
		visibility_draw(&seen, rig, rig->scene, &camera, 65, 65);
		assert_true(visibility_at(&seen, 32, 32) == 0);
		visibility_finish(&seen);
	}
}

static void the_counters_are_those_of_the_last_frame(void **state)
{
	struct rig *rig = *state;
	struct sm_frame_stats first, second;
	rig_skip_nothing(rig);
	set_up(rig->scene, PART_BOTH, PART_RECEIVES);
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "smoothie"});
	center_of(rig, rig->scene);
	sm_renderer_get_stats(rig->renderer, &first);
	center_of(rig, rig->scene);
	sm_renderer_get_stats(rig->renderer, &second);
	assert_int_equal(second.lights, 1);
	assert_int_equal(second.silhouette_edges, 4);
	/* Four edges and four corners, a quad each, two of which are uploaded as one fin. */
	assert_int_equal(second.fin_vertices, 32);
	assert_int_equal(second.fins_left_out, 0);
	assert_int_equal(second.fin_bytes, 4 * 32);
	/* Casters, receivers, fins and two surfaces, each in a call at least. */
	assert_true(second.draw_calls >= 5);
	assert_true(second.triangles >= 2 + 2 + 16 + 4);
	/* The scene is uploaded once, the fins each time. */
	assert_true(first.uploaded_bytes > second.uploaded_bytes);
	assert_int_equal(second.uploaded_bytes, second.fin_bytes);

	/* Less than half of one of these texels wide. */
	rig_set_shadows(rig, &(struct sm_shadow_options){
				     .technique = "smoothie", .width = 0.04f, .map_size = 8});
	center_of(rig, rig->scene);
	sm_renderer_get_stats(rig->renderer, &second);
	assert_int_equal(second.silhouette_edges, 4);
	assert_int_equal(second.fin_vertices, 0);
	assert_int_equal(second.fins_left_out, 4);

	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "hard"});
	center_of(rig, rig->scene);
	sm_renderer_get_stats(rig->renderer, &second);
	assert_true(second.draw_calls >= 3);
	assert_int_equal(second.uploaded_bytes, 0);
	assert_int_equal(second.silhouette_edges, 0);
}

static void vertices_that_move_are_uploaded_once(void **state)
{
	struct rig *rig = *state;
	struct sm_frame_stats stats;
	const float high[][3] = {{-1, .2f, -1}, {-1, .2f, 1}, {1, .2f, 1}, {1, .2f, -1}};
	set_up(rig->scene, PART_BOTH, PART_RECEIVES);
	uint32_t further = parts_add_square(rig->scene);
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "hard"});
	center_of(rig, rig->scene);
	assert_true(sm_scene_set_vertices(rig->scene, further, high[0], NULL, NULL));
	for (int frame = 0; frame < 2; frame++) {
		center_of(rig, rig->scene);
		sm_renderer_get_stats(rig->renderer, &stats);
		/* Positions, normals and uvs of four vertices, and their positions once more. */
		assert_int_equal(stats.uploaded_bytes, frame == 0 ? 4 * (32 + 12) : 0);
	}
}

#define SHEET 321 /* vertices a side: 204,800 triangles, which threads share */

/* A sheet in waves over [-1, 1]^2. */
static uint32_t add_sheet(struct sm_scene *scene)
{
	size_t count = 6 * (SHEET - 1) * (SHEET - 1), used = 0;
	float(*positions)[3] = malloc(SHEET * SHEET * sizeof(*positions));
	uint32_t *indices = malloc(count * sizeof(*indices));
	assert_true(positions != NULL && indices != NULL);
	for (uint32_t v = 0; v < SHEET * SHEET; v++) {
		float x = 2.0f * (float)(v % SHEET) / (SHEET - 1) - 1.0f;
		float z = 2.0f * (float)(v / SHEET) / (SHEET - 1) - 1.0f;
		positions[v][0] = x;
		positions[v][1] = 1.0f + 0.2f * sinf(9.0f * x) * cosf(7.0f * z);
		positions[v][2] = z;
	}
	for (uint32_t q = 0; q < SHEET * (SHEET - 1); q++)
		for (int i = 0; q % SHEET != SHEET - 1 && i < 6; i++)
			indices[used++] =
				q + (const uint32_t[]){0, SHEET, 1, 1, SHEET, SHEET + 1}[i];
	uint32_t mesh =
		parts_add_mesh(scene, (const float(*)[3])positions, SHEET * SHEET, indices, count);
	free(positions);
	free(indices);
	return mesh;
}

static void any_number_of_threads_draws_the_same(void **state)
{
	struct rig *rig = *state;
	struct sm_frame_stats stats[3];
	struct visibility seen[3];
	struct sm_camera camera = {.eye = {4, 3, 0}, .up = {0, 1, 0}, .fov = 40};
	struct sm_light_desc light = {.position = {1, 4, 2}, .radius = 0.2f, .angle = 60};
	uint32_t mesh = add_sheet(rig->scene), square = parts_add_square(rig->scene);
	parts_add_object(rig->scene, mesh, PART_BOTH, &(struct pose){.scale = {1, 1, 1}});
	parts_add_object(rig->scene, square, PART_RECEIVES, &(struct pose){.scale = {4, 1, 4}});
	parts_add_light(rig->scene, &light);
	rig_skip_nothing(rig);
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "smoothie"});
	for (uint32_t i = 0; i < 3; i++) {
		sm_renderer_set_threads(rig->renderer, (const uint32_t[]){1, 3, 0}[i]);
		visibility_draw(&seen[i], rig, rig->scene, &camera, 65, 65);
		sm_renderer_get_stats(rig->renderer, &stats[i]);
		assert_true(stats[i].silhouette_edges > 500);
		assert_int_equal(stats[i].silhouette_edges, stats[0].silhouette_edges);
		assert_int_equal(visibility_compare(&seen[i], &seen[0]).differing, 0);
	}
	for (int i = 0; i < 3; i++)
		visibility_finish(&seen[i]);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(the_roles_of_objects_decide_who_shadows_whom),
		rig_test(nothing_but_background_is_all_lit),
		rig_test(beside_and_behind_a_spot_nothing_is_shadowed),
		rig_test(changes_show_in_the_next_frame),
		rig_test(a_scene_may_go_and_another_come),
		rig_test(the_same_frame_has_the_same_bits),
		rig_test(renderers_in_one_context_do_not_disturb_each_other),
		rig_test(renderers_come_and_go),
		rig_test(pictures_have_any_size_up_to_the_driver_s),
		rig_test(views_that_cannot_be_drawn_are_refused),
		rig_test(without_a_light_there_is_a_picture_and_no_visibility),
		rig_test(cameras_that_see_nothing_are_refused),
		rig_test(gl_is_left_at_its_defaults),
		rig_test(so_it_is_when_drawing_fails),
		rig_test(so_it_is_after_a_copy_to_a_screen),
		rig_test(a_lamp_in_a_room_sees_what_is_near),
		rig_test(the_counters_are_those_of_the_last_frame),
		rig_test(vertices_that_move_are_uploaded_once),
		rig_test(any_number_of_threads_draws_the_same),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
