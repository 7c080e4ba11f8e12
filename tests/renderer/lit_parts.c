/* SPDX-License-Identifier: MIT */
/*
 * Of a light that stays, triangles that nothing is in front of are drawn without look-ups, and that
 * does not show: the same bytes as with a look-up everywhere, whatever the camera does.
 */
#include "canvas.h"
#include "load/stage.h"
#include "parts.h"
#include "renderer.h"
#include "rig.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define WIDTH 240
#define HEIGHT 180
#define VIEWS 5
#define FRAMES_MAX 1000 /* until all is searched */
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* A renderer that skips what it can, and the rig's, which looks up what it draws. */
struct pair {
	struct sm_renderer *skipping, *thorough;
	struct canvas canvas;
};

static void pair_init(struct pair *pair, struct rig *rig)
{
	rig_use_driver(rig, &(struct sm_driver_options){0});
	pair->skipping = rig->renderer;
	rig->renderer = NULL;
	rig_use_driver(rig, &(struct sm_driver_options){0});
	pair->thorough = rig->renderer;
	assert_true(sm_renderer_set_skips(pair->thorough, "-receiver", NULL));
	canvas_init(&pair->canvas, GL_SRGB8_ALPHA8, WIDTH, HEIGHT);
}

static void pair_finish(struct pair *pair)
{
	canvas_finish(&pair->canvas);
	sm_renderer_destroy(pair->skipping);
}

static void pair_set_shadows(struct pair *pair, const struct sm_shadow_options *options)
{
	assert_true(sm_renderer_set_shadows(pair->skipping, options, NULL));
	assert_true(sm_renderer_set_shadows(pair->thorough, options, NULL));
}

static void pair_set_technique(struct pair *pair, const char *technique)
{
	pair_set_shadows(
		pair, &(struct sm_shadow_options){.technique = technique, .map_size = 256});
}

static void draw(struct pair *pair, struct sm_renderer *renderer, const struct sm_scene *scene,
	const struct sm_camera *camera, uint32_t visibility_of)
{
	struct sm_error error;
	const struct sm_view view = {.camera = *camera,
		.framebuffer = pair->canvas.framebuffer,
		.width = WIDTH,
		.height = HEIGHT,
		.visibility_of = visibility_of};
	if (!sm_renderer_draw(renderer, scene, &view, &error))
		fail_msg("%s", error.text);
}

static const struct lit_parts *parts_of(const struct pair *pair)
{
	const struct shadow_set *set = &pair->skipping->shadows;
	return set->count > 0 && set->shadows[0] != NULL ? &set->shadows[0]->lit : NULL;
}

/* Frames of a camera that stays, which the renderer itself draws each time. */
static void draw_until_searched(
	struct pair *pair, const struct sm_scene *scene, const struct sm_camera *camera)
{
	for (int frame = 0; frame < FRAMES_MAX; frame++) {
		draw(pair, pair->skipping, scene, camera, SM_NONE);
		if (parts_of(pair)->state == LIT_DONE)
			return;
	}
	fail_msg("not searched in %d frames", FRAMES_MAX);
}

struct tally {
	size_t triangles, lit; /* in lists */
};

static struct tally count_lists(const struct pair *pair, const struct sm_scene *scene)
{
	struct tally tally = {0};
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct lit_list *list = lit_parts_list(parts_of(pair), i);
		for (enum need need = 0; list != NULL && need < NEED_COUNT; need++) {
			tally.triangles += list->count[need] / 3;
			tally.lit += need <= NEED_LIGHT ? list->count[need] / 3 : 0;
		}
	}
	return tally;
}

/* Around what it looks at. */
static struct sm_camera turned(const struct sm_camera *camera, float angle)
{
	struct sm_camera turned = *camera;
	float x = camera->eye[0] - camera->target[0], z = camera->eye[2] - camera->target[2];
	turned.eye[0] = camera->target[0] + cosf(angle) * x - sinf(angle) * z;
	turned.eye[2] = camera->target[2] + sinf(angle) * x + cosf(angle) * z;
	return turned;
}

static void check_same(struct pair *pair, const struct sm_scene *scene,
	const struct sm_camera *camera, const char *what)
{
	draw(pair, pair->skipping, scene, camera, SM_NONE);
	uint8_t *skipped = canvas_read(&pair->canvas);
	draw(pair, pair->thorough, scene, camera, SM_NONE);
	uint8_t *looked_up = canvas_read(&pair->canvas);
	for (size_t i = 0; i < (size_t)WIDTH * HEIGHT * 4; i++)
		if (skipped[i] != looked_up[i])
			fail_msg("%s: byte %zu is %d, not %d", what, i, skipped[i], looked_up[i]);
	free(skipped);
	free(looked_up);
}

static void check_views(struct pair *pair, const struct sm_scene *scene,
	const struct sm_camera *camera, const char *what)
{
	for (int view = 0; view < VIEWS; view++) {
		struct sm_camera at = turned(camera, 1.3f * (float)view);
		check_same(pair, scene, &at, what);
	}
	assert_int_equal(parts_of(pair)->state, LIT_DONE);
}

static const struct sm_shadow_options ways[] = {
	{.technique = "hard", .map_size = 256},
	{.technique = "pcf", .map_size = 256},
	{.technique = "pcf", .map_size = 256, .samples = 16},
	{.technique = "pcss", .map_size = 256},
	{.technique = "smoothie", .map_size = 256},
	{.technique = "smoothie", .map_size = 256, .passes = 2},
	{.technique = "penumbra-map", .map_size = 256},
};

static void triangles_with_nothing_in_front_look_nothing_up(void **state)
{
	static const struct {
		const char *scene;
		float share; /* at least, of the triangles in lists, whatever the technique */
	} cases[] = {
		{"builtin:primitives", 0.5f},
		{"builtin:cylinder", 0.9f},
		{"builtin:boxes", 0.65f},
		{"builtin:fence", 0.45f},
		{"builtin:knot", 0.5f},
		{"builtin:debris", 0.5f},
	};
	struct pair pair;
	pair_init(&pair, *state);
	for (size_t i = 0; i < COUNT(cases); i++) {
		struct stage stage;
		assert_true(stage_load(&stage, cases[i].scene, NULL, 0, NULL));
		for (size_t t = 0; t < COUNT(ways); t++) {
			pair_set_shadows(&pair, &ways[t]);
			draw_until_searched(&pair, stage.scene, &stage.camera);
			struct tally tally = count_lists(&pair, stage.scene);
			print_message("%s, %s: %zu of %zu\n", cases[i].scene, ways[t].technique,
				tally.lit, tally.triangles);
			/* As wide a filter has objects left as they are that are much to search. */
			bool wide = strcmp(ways[t].technique, "pcss") == 0;
			assert_true(wide || tally.lit > 0);
			assert_true((float)tally.lit >= cases[i].share * (float)tally.triangles);
			check_views(&pair, stage.scene, &stage.camera, cases[i].scene);
		}
		stage_finish(&stage);
	}
	pair_finish(&pair);
}

/* Casters and fins are gathered once more, all of them. */
static void what_comes_back_is_found_again(void **state)
{
	struct pair pair;
	struct stage stage;
	pair_init(&pair, *state);
	pair_set_technique(&pair, "smoothie");
	assert_true(stage_load(&stage, "builtin:fence", NULL, 0, NULL));
	const struct sm_light_desc light = stage.scene->lights[0].desc;
	struct sm_light_desc other = light;
	other.position[1] += 1;
	draw_until_searched(&pair, stage.scene, &stage.camera);
	struct tally first = count_lists(&pair, stage.scene);
	assert_true(sm_scene_set_light(stage.scene, 0, &other, NULL));
	draw(&pair, pair.skipping, stage.scene, &stage.camera, SM_NONE);
	assert_true(sm_scene_set_light(stage.scene, 0, &light, NULL));
	draw_until_searched(&pair, stage.scene, &stage.camera);
	struct tally again = count_lists(&pair, stage.scene);
	assert_int_equal(again.triangles, first.triangles);
	assert_int_equal(again.lit, first.lit);
	check_views(&pair, stage.scene, &stage.camera, "back again");
	stage_finish(&stage);
	pair_finish(&pair);
}

#define BALL_STEPS 12

/* Twice the same faces, of which the second have normals of their own. turned: they are seen from
 * the other side. */
static uint32_t add_doubled_ball(struct sm_scene *scene, bool turned_round)
{
	enum { SIDE = 2 * BALL_STEPS, VERTICES = (SIDE + 1) * (BALL_STEPS + 1) };
	static float positions[2 * VERTICES][3], normals[2 * VERTICES][3];
	static uint32_t indices[2 * 6 * SIDE * BALL_STEPS];
	const float pi = acosf(-1);
	size_t count = 0;
	for (int i = 0; i < VERTICES; i++) {
		float a = (float)(i % (SIDE + 1)) * pi / BALL_STEPS;
		float b = (float)(i / (SIDE + 1)) * pi / BALL_STEPS;
		const float p[3] = {sinf(b) * cosf(a), cosf(b), sinf(b) * sinf(a)};
		for (int axis = 0; axis < 3; axis++) {
			positions[i][axis] = positions[VERTICES + i][axis] = p[axis];
			normals[i][axis] = p[axis];
			normals[VERTICES + i][axis] = axis == 1 ? 1 : 0;
		}
	}
	for (uint32_t copy = 0; copy < 2; copy++) {
		for (uint32_t i = 0; i < SIDE * BALL_STEPS; i++) {
			uint32_t corner = copy * VERTICES + i / SIDE * (SIDE + 1) + i % SIDE;
			const uint32_t quad[6] = {corner, corner + 1, corner + SIDE + 1, corner + 1,
				corner + SIDE + 2, corner + SIDE + 1};
			for (int j = 0; j < 6; j++)
				indices[count++] = quad[copy == 1 && turned_round ? 5 - j : j];
		}
	}
	uint32_t mesh;
	const struct sm_mesh_desc desc = {.name = "doubled ball",
		.positions = positions[0],
		.normals = normals[0],
		.vertex_count = 2 * VERTICES,
		.indices = indices,
		.index_count = count};
	assert_true(sm_scene_add_mesh(scene, &desc, &mesh, NULL));
	return mesh;
}

/* Half of it in the shadow of a slab, so that some of its triangles need look-ups. */
static void make_shaded(struct sm_scene *scene, uint32_t mesh)
{
	struct sm_object_desc desc = {.mesh = mesh,
		.base_color = {1, 1, 1, 1},
		.image = SM_NONE,
		.casts = true,
		.receives = true,
		.single_sided = true};
	uint32_t object;
	pose_matrix(&(struct pose){.scale = {1, 1, 1}, .position = {0, 1, 0}}, desc.transform);
	assert_true(sm_scene_add_object(scene, &desc, &object, NULL));
	parts_add_object(scene, parts_add_cube(scene), PART_BOTH,
		&(struct pose){.scale = {0.5f, 0.1f, 0.7f}, .position = {0.6f, 2.8f, 0.1f}});
	parts_add_object(
		scene, parts_add_square(scene), PART_RECEIVES, &(struct pose){.scale = {4, 1, 4}});
	parts_add_light(scene,
		&(struct sm_light_desc){.position = {0.4f, 6, 0.3f}, .radius = 0.2f, .angle = 60});
}

static const struct sm_camera aside = {
	.eye = {3, 2.5f, 3}, .target = {0, 1, 0}, .up = {0, 1, 0}, .fov = 40};

static void surfaces_at_one_depth_keep_their_order(void **state)
{
	struct rig *rig = *state;
	for (int turned_round = 0; turned_round < 2; turned_round++) {
		struct sm_scene *scene = sm_scene_create();
		struct pair pair;
		assert_non_null(scene);
		pair_init(&pair, rig);
		make_shaded(scene, add_doubled_ball(scene, turned_round));
		for (size_t t = 0; t < COUNT(ways); t++) {
			pair_set_shadows(&pair, &ways[t]);
			draw_until_searched(&pair, scene, &aside);
			assert_null(lit_parts_list(parts_of(&pair), 0));
			assert_non_null(lit_parts_list(parts_of(&pair), 1));
			check_views(&pair, scene, &aside, "a doubled ball");
		}
		pair_finish(&pair);
		sm_scene_destroy(scene);
	}
}

/* A ball, a slab above it that casts on it, and a floor. */
static void make_plain(struct sm_scene *scene)
{
	make_shaded(scene, parts_add_sphere(scene, 16));
}

static void move(struct sm_scene *scene, uint32_t object, float x)
{
	float transform[16];
	pose_matrix(
		&(struct pose){.scale = {0.5f, 0.1f, 0.5f}, .position = {x, 2.5f, 0}}, transform);
	assert_true(sm_scene_set_transform(scene, object, transform, NULL));
}

/* With each frame it is only begun. */
static void what_changes_is_searched_anew(void **state)
{
	struct rig *rig = *state;
	struct sm_light_desc light = {.position = {0, 6, 0},
		.radius = 0.2f,
		.angle = 60,
		.color = {1, 1, 1},
		.intensity = 1};
	struct pair pair;
	pair_init(&pair, rig);
	pair_set_technique(&pair, "smoothie");
	make_plain(rig->scene);
	for (int what = 0; what < 2; what++) {
		draw_until_searched(&pair, rig->scene, &aside);
		assert_non_null(lit_parts_list(parts_of(&pair), 0));
		for (int frame = 0; frame < 3; frame++) {
			float at = 0.1f * (float)frame - 0.3f;
			light.position[0] = at;
			if (what == 0)
				assert_true(sm_scene_set_light(rig->scene, 0, &light, NULL));
			else
				move(rig->scene, 1, at); /* the slab */
			check_same(&pair, rig->scene, &aside, "what moves");
			assert_null(lit_parts_list(parts_of(&pair), 0));
			assert_in_range(parts_of(&pair)->state, LIT_UNSEEN, LIT_SEEN);
		}
	}
	draw_until_searched(&pair, rig->scene, &aside);
	assert_true(sm_renderer_set_skips(pair.skipping, "-receiver", NULL));
	check_same(&pair, rig->scene, &aside, "without the skip");
	pair_finish(&pair);
}

/* Where a slope ends on level ground, what is filtered over the slope's own plane takes the ground
 * for a blocker. */
static void creases_look_up(void **state)
{
	enum { STRIPS = 16, SIDE = 2 };
	float positions[2 * (STRIPS + 1)][3];
	uint32_t indices[6 * STRIPS], *index = indices;
	struct rig *rig = *state;
	struct pair pair;
	for (int i = 0; i <= STRIPS; i++) {
		float x = (float)(i - STRIPS / 2) / 4;
		for (int end = 0; end < 2; end++) {
			float *p = positions[2 * i + end];
			p[0] = x;
			p[1] = x < 0 ? 0 : x;
			p[2] = end ? -SIDE : SIDE;
		}
	}
	for (uint32_t i = 0; i < STRIPS; i++) {
		const uint32_t quad[] = {
			2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 1, 2 * i + 2, 2 * i + 3};
		memcpy(index, quad, sizeof(quad));
		index += 6;
	}
	pair_init(&pair, rig);
	make_shaded(rig->scene,
		parts_add_mesh(rig->scene, positions, 2 * (STRIPS + 1), indices, 6 * STRIPS));
	for (size_t t = 0; t < COUNT(ways); t++) {
		pair_set_shadows(&pair, &ways[t]);
		draw_until_searched(&pair, rig->scene, &aside);
		assert_non_null(lit_parts_list(parts_of(&pair), 0));
		check_views(&pair, rig->scene, &aside, ways[t].technique);
	}
	pair_finish(&pair);
}

static void what_is_not_shaded_as_usual_is_not_searched(void **state)
{
	static const char *const others[] = {"smoothie-two-sided", "maps", "gather", "auto"};
	struct rig *rig = *state;
	struct pair pair;
	pair_init(&pair, rig);
	make_plain(rig->scene);
	for (size_t i = 0; i < COUNT(others); i++) {
		pair_set_technique(&pair, others[i]);
		for (int frame = 0; frame < 4; frame++)
			draw(&pair, pair.skipping, rig->scene, &aside, SM_NONE);
		assert_int_equal(parts_of(&pair)->state, LIT_UNSEEN);
	}
	pair_set_technique(&pair, "hard");
	for (int frame = 0; frame < 4; frame++)
		draw(&pair, pair.skipping, rig->scene, &aside, 0);
	assert_int_equal(parts_of(&pair)->state, LIT_UNSEEN);
	canvas_finish(&pair.canvas);
	canvas_init_multisampled(&pair.canvas, GL_SRGB8_ALPHA8, WIDTH, HEIGHT, 4);
	GLint samples; /* softpipe has one alone */
	glGetIntegerv(GL_SAMPLES, &samples);
	for (int frame = 0; frame < 4; frame++)
		draw(&pair, pair.skipping, rig->scene, &aside, SM_NONE);
	assert_true((parts_of(&pair)->state == LIT_UNSEEN) == (samples > 1));
	pair_finish(&pair);
}

/* Sorting it would take a frame too long. */
static void a_crowd_is_not_searched(void **state)
{
	struct rig *rig = *state;
	struct pair pair;
	pair_init(&pair, rig);
	pair_set_technique(&pair, "hard");
	make_plain(rig->scene);
	uint32_t ball = parts_add_sphere(rig->scene, 64);
	for (int i = 0; i < 4; i++)
		parts_add_object(rig->scene, ball, PART_BOTH,
			&(struct pose){
				.scale = {0.2f, 0.2f, 0.2f}, .position = {(float)i - 2, 3, -1}});
	draw_until_searched(&pair, rig->scene, &aside);
	assert_int_equal(count_lists(&pair, rig->scene).triangles, 0);
	check_views(&pair, rig->scene, &aside, "a crowd");
	pair_finish(&pair);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(triangles_with_nothing_in_front_look_nothing_up),
		rig_test(surfaces_at_one_depth_keep_their_order),
		rig_test(what_changes_is_searched_anew),
		rig_test(what_comes_back_is_found_again),
		rig_test(creases_look_up),
		rig_test(what_is_not_shaded_as_usual_is_not_searched),
		rig_test(a_crowd_is_not_searched),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
