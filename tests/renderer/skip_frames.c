/* SPDX-License-Identifier: MIT */
/*
 * What a renderer skips does not show: random scenes change at random from frame to frame, and each
 * frame is drawn by a renderer that skips what it can and by one that skips nothing. Both must draw
 * the same bytes.
 */
#include "canvas.h"
#include "parts.h"
#include "rig.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SCENES 40
#define FRAMES 25  /* of a scene */
#define MOVES 60   /* of casters, one after the other, with each technique */
#define LEDGES 20  /* moves of one */
#define GLANCES 50 /* at a part of a scene */
#define BRINKS 40  /* of a shadow, looked at */
#define STAYS 6    /* scenes in which the camera alone moves */
#define STAY 12    /* frames of one */
#define CROWD 12   /* of which one moves */
#define WIDTH 96
#define HEIGHT 64
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const struct sm_shadow_options choices[] = {
	{.map_size = 128},
	{.technique = "smoothie", .map_size = 128},
	{.technique = "smoothie", .map_size = 100, .passes = 2, .width = 0.05f},
	{.technique = "smoothie-two-sided", .map_size = 128},
	{.technique = "penumbra-map", .map_size = 128},
	{.technique = "hard", .map_size = 128},
	{.technique = "pcf", .map_size = 128},
	{.technique = "pcss", .map_size = 64},
	{.technique = "vsm", .map_size = 128, .samples = 9},
	{.technique = "maps", .map_size = 64, .samples = 4},
	{.technique = "gather", .map_size = 128},
	{.technique = "gather", .map_size = 128, .sampling = SM_SAMPLING_SPARSE},
	{.technique = "gather", .map_size = 128, .sampling = SM_SAMPLING_DEFERRED},
	{.technique = "gather", .map_size = 128, .sampling = SM_SAMPLING_DEFERRED_SPARSE},
	{.technique = "auto", .map_size = 128, .sampling = SM_SAMPLING_SPARSE},
	{.precision = SM_PRECISION_HALF, .map_size = 64},
	{.technique = "maps", .map_size = 64, .samples = 16},
};

/* What a sequence of frames is drawn with. */
struct run {
	struct sm_renderer *skipping, *thorough;
	struct canvas canvases[2]; /* of each */
	struct sm_scene *scene;
	uint32_t meshes[4], objects, lights;
	struct sm_light_desc light[3];
	struct sm_camera camera;
	uint32_t visibility_of;
	uint32_t state; /* of the generator */
};

/* xorshift (Marsaglia 2003). */
static uint32_t next(struct run *run)
{
	run->state ^= run->state << 13;
	run->state ^= run->state >> 17;
	run->state ^= run->state << 5;
	return run->state;
}

static uint32_t below(struct run *run, uint32_t end)
{
	return next(run) % end;
}

static float between(struct run *run, float low, float high)
{
	return low + (high - low) * (float)(next(run) >> 8) / (float)(1 << 24);
}

static struct pose random_pose(struct run *run)
{
	float size = between(run, 0.1f, 0.8f);
	return (struct pose){
		.scale = {size, between(run, 0.1f, 0.8f), size},
		.turn = between(run, 0, 360),
		.position = {between(run, -3, 3), between(run, 0, 2.5f), between(run, -3, 3)},
	};
}

/* The last mesh: a cloth of 4 x 4 squares. */
#define CLOTH_SIDE 5

static void random_cloth(struct run *run, float positions[][3])
{
	for (int i = 0; i < CLOTH_SIDE * CLOTH_SIDE; i++) {
		positions[i][0] = (float)(i % CLOTH_SIDE) / 2 - 1;
		positions[i][1] = between(run, 0, 1);
		positions[i][2] = (float)(i / CLOTH_SIDE) / 2 - 1;
	}
}

static uint32_t add_cloth(struct run *run)
{
	enum { QUADS = CLOTH_SIDE - 1 };
	float positions[CLOTH_SIDE * CLOTH_SIDE][3];
	uint32_t indices[6 * QUADS * QUADS], *index = indices;
	random_cloth(run, positions);
	for (uint32_t i = 0; i < QUADS * QUADS; i++) {
		uint32_t corner = i / QUADS * CLOTH_SIDE + i % QUADS,
			 below_it = corner + CLOTH_SIDE;
		const uint32_t corners[] = {
			corner, below_it, corner + 1, corner + 1, below_it, below_it + 1};
		memcpy(index, corners, sizeof(corners));
		index += 6;
	}
	return parts_add_mesh(run->scene, (const float(*)[3])positions, CLOTH_SIDE * CLOTH_SIDE,
		indices, COUNT(indices));
}

static void wave_cloth(struct run *run)
{
	float positions[CLOTH_SIDE * CLOTH_SIDE][3];
	random_cloth(run, positions);
	assert_true(sm_scene_set_vertices(run->scene, run->meshes[3], positions[0], NULL, NULL));
}

static void add_object(struct run *run)
{
	struct pose pose = random_pose(run);
	parts_add_object(run->scene, run->meshes[below(run, 4)], 1 + below(run, PART_BOTH), &pose);
	run->objects++;
}

static void move_object(struct run *run, uint32_t object, const struct pose *pose)
{
	float transform[16];
	pose_matrix(pose, transform);
	assert_true(sm_scene_set_transform(run->scene, object, transform, NULL));
}

static void move_any(struct run *run)
{
	struct pose pose = random_pose(run);
	move_object(run, below(run, run->objects), &pose);
}

/* Another block, of the same mesh. */
static void bend_cube(struct run *run)
{
	float positions[8][3];
	for (int i = 0; i < 8; i++)
		for (int axis = 0; axis < 3; axis++)
			positions[i][axis] =
				(i >> axis & 1 ? 1.0f : -1.0f) + between(run, -0.5f, 0.5f);
	assert_true(sm_scene_set_vertices(run->scene, run->meshes[0], positions[0], NULL, NULL));
}

/* Mostly above the scene, at times far aside, so that its screen misses some objects. */
static struct sm_light_desc random_light(struct run *run)
{
	float aside = below(run, 3) == 0 ? 8 : 3;
	return (struct sm_light_desc){
		.type = below(run, 3) == 0 ? SM_LIGHT_DIRECTIONAL : SM_LIGHT_SPOT,
		.position = {between(run, -aside, aside), between(run, 3, 6),
			between(run, -aside, aside)},
		.target = {between(run, -2, 2), 0, between(run, -2, 2)},
		.radius = below(run, 4) == 0 ? 0 : between(run, 0.05f, 0.8f),
		.angle = between(run, 15, 100),
		.softness = between(run, 0, 1),
		.color = {1, between(run, 0, 1), between(run, 0, 1)},
		.intensity = powf(10, below(run, 4) == 0 ? between(run, -6, -1) : 0),
	};
}

static void change_light(struct run *run)
{
	uint32_t light = below(run, run->lights), what = below(run, 6);
	struct sm_light_desc *desc = &run->light[light];
	if (what == 0)
		desc->intensity = between(run, 0, 1);
	else if (what == 1)
		desc->angle = between(run, 15, 100);
	else if (what == 2)
		desc->radius = between(run, 0, 0.8f);
	else
		*desc = random_light(run);
	assert_true(sm_scene_set_light(run->scene, light, desc, NULL));
}

/* At times so far from the origin that the scene is counted from elsewhere. */
static void change_camera(struct run *run)
{
	float far = below(run, 8) == 0 ? 600.0f : 0.0f;
	run->camera = (struct sm_camera){
		.eye = {far + between(run, -6, 6), between(run, 0.5f, 5), between(run, -6, 6)},
		.target = {far + between(run, -1, 1), 0.5f, 0},
		.up = {0, 1, 0},
		.fov = between(run, 20, 80),
	};
	if (far > 0.0f)
		run->camera.near = 0.1f, run->camera.far = 1000.0f;
}

static void use_shadows(struct run *run, const struct sm_shadow_options *options)
{
	struct sm_error error;
	if (!rig_can_draw(options->technique))
		return;
	if (!sm_renderer_set_shadows(run->skipping, options, &error) ||
		!sm_renderer_set_shadows(run->thorough, options, &error))
		fail_msg("%s", error.text);
}

static void set_shadows(struct run *run)
{
	use_shadows(run, &choices[below(run, COUNT(choices))]);
}

static void set_environment(struct run *run)
{
	struct sm_environment environment = {
		.sky = {between(run, 0, 0.3f), 0.1f, 0.1f},
		.background = {between(run, 0, 1), 0, 0.2f},
	};
	sm_scene_set_environment(run->scene, &environment);
}

static void make_scene(struct run *run)
{
	run->scene = sm_scene_create();
	assert_non_null(run->scene);
	run->meshes[0] = parts_add_cube(run->scene);
	run->meshes[1] = parts_add_sphere(run->scene, 5);
	run->meshes[2] = parts_add_square(run->scene);
	run->meshes[3] = add_cloth(run);
	parts_add_object(run->scene, run->meshes[2], below(run, 4) == 0 ? PART_BOTH : PART_RECEIVES,
		&(struct pose){.scale = {4, 1, 4}});
	run->objects = 1;
	for (uint32_t count = below(run, 10); run->objects < count;)
		add_object(run);
	run->lights = 1 + below(run, 3);
	for (uint32_t i = 0; i < run->lights; i++) {
		run->light[i] = random_light(run);
		parts_add_light(run->scene, &run->light[i]);
	}
	run->visibility_of = SM_NONE;
	change_camera(run);
	set_environment(run);
}

/* One of what a program does between two frames, or nothing. */
static void change(struct run *run)
{
	uint32_t what = below(run, 100);
	if (what < 30)
		change_camera(run);
	else if (what < 50)
		move_any(run);
	else if (what < 65)
		change_light(run);
	else if (what < 70)
		add_object(run);
	else if (what < 75)
		set_shadows(run);
	else if (what < 78)
		set_environment(run);
	else if (what < 84)
		bend_cube(run);
	else if (what < 88)
		run->visibility_of = below(run, 2) == 0 ? SM_NONE : below(run, run->lights);
	else if (what < 90)
		wave_cloth(run);
}

static uint8_t *draw(struct run *run, struct sm_renderer *renderer, const struct canvas *canvas)
{
	struct sm_error error;
	const struct sm_view view = {
		.camera = run->camera,
		.framebuffer = canvas->framebuffer,
		.width = WIDTH,
		.height = HEIGHT,
		.visibility_of = run->visibility_of,
	};
	if (!sm_renderer_is_current(renderer, run->scene, &view) &&
		!sm_renderer_draw(renderer, run->scene, &view, &error))
		fail_msg("%s", error.text);
	return canvas_read(canvas);
}

static void draw_by_both(struct run *run, uint32_t scene, uint32_t frame)
{
	uint8_t *skipped = draw(run, run->skipping, &run->canvases[0]);
	uint8_t *thorough = draw(run, run->thorough, &run->canvases[1]);
	for (size_t i = 0; i < (size_t)WIDTH * HEIGHT * 4; i++)
		if (skipped[i] != thorough[i])
			fail_msg("scene %u, frame %u: byte %zu is %d, and %d without skips", scene,
				frame, i, skipped[i], thorough[i]);
	free(skipped);
	free(thorough);
}

/* sRGB, where lights add up in place, but every third time; that has several samples at times. */
static void init_canvases(struct run *run, uint32_t scene)
{
	for (int i = 0; i < 2; i++)
		if (scene % 6 == 1)
			canvas_init_multisampled(
				&run->canvases[i], GL_SRGB8_ALPHA8, WIDTH, HEIGHT, 4);
		else
			canvas_init(&run->canvases[i], scene % 3 == 0 ? GL_RGBA8 : GL_SRGB8_ALPHA8,
				WIDTH, HEIGHT);
}

static void play(struct run *run, uint32_t scene)
{
	make_scene(run);
	init_canvases(run, scene);
	set_shadows(run);
	for (uint32_t frame = 0; frame < FRAMES; frame++) {
		draw_by_both(run, scene, frame);
		change(run);
	}
	canvas_finish(&run->canvases[0]);
	canvas_finish(&run->canvases[1]);
	sm_scene_destroy(run->scene);
}

/* What the lights see is bounded by objects that stay, so that it stays what it is: a floor and
 * blocks above the crowd's corners. */
static void make_still_scene(struct run *run)
{
	make_scene(run);
	for (int i = 0; i < 4; i++) {
		parts_add_object(run->scene, run->meshes[0], PART_BOTH,
			&(struct pose){.scale = {0.2f, 0.2f, 0.2f},
				.position = {i & 1 ? 1.3f : -1.3f, 2.8f, i & 2 ? 1.3f : -1.3f}});
		run->objects++;
	}
	for (uint32_t i = 0; i < run->lights; i++) {
		run->light[i] = random_light(run);
		run->light[i].position[0] = between(run, -1, 1);
		run->light[i].position[1] = 6;
		run->light[i].position[2] = between(run, -1, 1);
		memset(run->light[i].target, 0, sizeof(run->light[i].target));
		run->light[i].radius = between(run, 0.2f, 0.8f);
		run->light[i].angle = 45;
		run->light[i].intensity = 1;
		assert_true(sm_scene_set_light(run->scene, i, &run->light[i], NULL));
	}
}

/* In a crowd, where what one throws falls on others, and none goes far. */
static struct pose crowd_pose(struct run *run, uint32_t place)
{
	float size = between(run, 0.1f, 0.4f);
	return (struct pose){
		.scale = {size, between(run, 0.1f, 0.3f), size},
		.turn = between(run, 0, 360),
		.position = {0.7f * (float)(place % 4) - 1 + between(run, -0.2f, 0.2f),
			between(run, 0.2f, 2),
			0.7f * (float)(place / 4) - 0.7f + between(run, -0.2f, 0.2f)},
	};
}

static void add_crowd(struct run *run)
{
	for (uint32_t i = 0; i < CROWD; i++) {
		struct pose pose = crowd_pose(run, i);
		parts_add_object(
			run->scene, run->meshes[below(run, 4)], 1 + below(run, PART_BOTH), &pose);
	}
}

static void play_moves(struct run *run, const struct sm_shadow_options *options)
{
	make_still_scene(run);
	run->camera = (struct sm_camera){
		.eye = {1, 4, 3}, .target = {0, 0.5f, 0}, .up = {0, 1, 0}, .fov = 60};
	add_crowd(run);
	init_canvases(run, 0);
	use_shadows(run, options);
	for (uint32_t frame = 0; frame < MOVES; frame++) {
		uint32_t place = below(run, CROWD);
		struct pose pose = crowd_pose(run, place);
		draw_by_both(run, SCENES + (uint32_t)(options - choices), frame);
		move_object(run, run->objects + place, &pose);
	}
	canvas_finish(&run->canvases[0]);
	canvas_finish(&run->canvases[1]);
	sm_scene_destroy(run->scene);
}

/* What only receives moves about below the edge of a slab: there the edge's penumbra ends on it,
 * and so does what is found of the edge from texels far beside it. */
static void play_ledges(struct run *run, const struct sm_shadow_options *options)
{
	const float side = 0.6f, height = 2, lamp = 6;
	const struct sm_light_desc light = {.position = {0, lamp, 0},
		.radius = 0.8f,
		.angle = 60,
		.color = {1, 1, 1},
		.intensity = 1};
	run->scene = sm_scene_create();
	assert_non_null(run->scene);
	uint32_t square = parts_add_square(run->scene);
	parts_add_object(run->scene, square, PART_RECEIVES, &(struct pose){.scale = {4, 1, 4}});
	parts_add_object(run->scene, parts_add_cube(run->scene), PART_BOTH,
		&(struct pose){.scale = {side, 0.05f, side}, .position = {0, height, 0}});
	uint32_t ledge = parts_add_object(
		run->scene, square, PART_RECEIVES, &(struct pose){.scale = {0.1f, 1, 0.1f}});
	parts_add_light(run->scene, &light);
	run->camera = (struct sm_camera){
		.eye = {1, 4, 3}, .target = {0, 0.5f, 0}, .up = {0, 1, 0}, .fov = 60};
	run->visibility_of = SM_NONE;
	init_canvases(run, 0);
	use_shadows(run, options);
	for (uint32_t frame = 0; frame < LEDGES; frame++) {
		float y = between(run, 0.3f, 1.5f), edge = side * (lamp - y) / (lamp - height);
		move_object(run, ledge,
			&(struct pose){.scale = {0.1f, 1, 0.1f},
				.position = {edge + between(run, -0.1f, 0.1f), y,
					between(run, -side, side)}});
		draw_by_both(run, SCENES + (uint32_t)(COUNT(choices) + (options - choices)), frame);
	}
	canvas_finish(&run->canvases[0]);
	canvas_finish(&run->canvases[1]);
	sm_scene_destroy(run->scene);
}

/* At a small part of the floor, so that most shadows fall beside what is seen, or just reach in. */
static void glance(struct run *run)
{
	float x = between(run, -2, 2), z = between(run, -2, 2);
	run->camera = (struct sm_camera){
		.eye = {x + between(run, -1, 1), 4, z + 2},
		.target = {x, 0, z},
		.up = {0, 1, 0},
		.fov = between(run, 4, 25),
	};
}

static void change_around_glance(struct run *run)
{
	uint32_t what = below(run, 6), place = below(run, CROWD);
	uint32_t light = below(run, run->lights);
	struct pose pose = crowd_pose(run, place);
	if (what < 3)
		glance(run);
	else if (what < 5)
		move_object(run, run->objects + place, &pose);
	else
		run->light[light].position[0] = between(run, -1, 1);
	if (what == 5)
		assert_true(sm_scene_set_light(run->scene, light, &run->light[light], NULL));
}

static void play_glances(struct run *run, const struct sm_shadow_options *options)
{
	make_still_scene(run);
	add_crowd(run);
	glance(run);
	init_canvases(run, (uint32_t)(options - choices));
	use_shadows(run, options);
	for (uint32_t frame = 0; frame < GLANCES; frame++) {
		draw_by_both(
			run, SCENES + 2 * COUNT(choices) + (uint32_t)(options - choices), frame);
		change_around_glance(run);
	}
	canvas_finish(&run->canvases[0]);
	canvas_finish(&run->canvases[1]);
	sm_scene_destroy(run->scene);
}

/* What is seen is a spot of the floor where the shadow of a slab's edge just ends, which is on the
 * light's screen, or a bit beside it. */
static void move_to_brink(struct run *run, uint32_t slab)
{
	const float side = 0.6f, height = 2;
	struct sm_light_desc *light = &run->light[0];
	float lamp = light->position[1], slope = between(run, 0.1f, 0.3f);
	float x = slope * lamp - between(run, 0, 0.4f);
	float screen = below(run, 3) == 0 ? slope - between(run, 0, 0.03f) : 0.6f;
	run->camera = (struct sm_camera){
		.eye = {x + 1, 1, 0}, .target = {x, 0, 0}, .up = {0, 1, 0}, .fov = 2};
	if (below(run, 4) == 0)
		return;
	light->angle = 2 * atanf(screen) * 180 / acosf(-1);
	assert_true(sm_scene_set_light(run->scene, 0, light, NULL));
	move_object(run, slab,
		&(struct pose){.scale = {side, 0.05f, side},
			.position = {slope * (lamp - height) + side, height, 0}});
}

static void play_brinks(struct run *run, const struct sm_shadow_options *options)
{
	run->scene = sm_scene_create();
	assert_non_null(run->scene);
	run->light[0] = (struct sm_light_desc){.position = {0, 6, 0},
		.radius = 0.8f,
		.angle = 60,
		.color = {1, 1, 1},
		.intensity = 1};
	parts_add_object(run->scene, parts_add_square(run->scene), PART_RECEIVES,
		&(struct pose){.scale = {4, 1, 4}});
	uint32_t slab = parts_add_object(run->scene, parts_add_cube(run->scene), PART_BOTH,
		&(struct pose){.scale = {1, 1, 1}});
	parts_add_light(run->scene, &run->light[0]);
	run->visibility_of = SM_NONE;
	init_canvases(run, 0);
	use_shadows(run, options);
	for (uint32_t frame = 0; frame < BRINKS; frame++) {
		move_to_brink(run, slab);
		draw_by_both(
			run, SCENES + 3 * COUNT(choices) + (uint32_t)(options - choices), frame);
	}
	canvas_finish(&run->canvases[0]);
	canvas_finish(&run->canvases[1]);
	sm_scene_destroy(run->scene);
}

/* Random scenes that stay as they are while they are looked at from all about. */
static void play_stays(struct run *run, const struct sm_shadow_options *options)
{
	for (uint32_t scene = 0; scene < STAYS; scene++) {
		make_scene(run);
		init_canvases(run, 3 * scene);
		use_shadows(run, options);
		for (uint32_t frame = 0; frame < STAY; frame++) {
			draw_by_both(run,
				SCENES + 4 * COUNT(choices) + (uint32_t)(options - choices), frame);
			change_camera(run);
		}
		canvas_finish(&run->canvases[0]);
		canvas_finish(&run->canvases[1]);
		sm_scene_destroy(run->scene);
	}
}

/* A skip that never happens, or always does, has not been tested. */
static void check_counts(const struct run *run)
{
	for (size_t i = 0; sm_skip_name(i) != NULL; i++) {
		struct sm_skip_stats stats, none;
		sm_renderer_get_skip_stats(run->skipping, i, &stats);
		sm_renderer_get_skip_stats(run->thorough, i, &none);
		print_message("%s: %llu of %llu skipped\n", sm_skip_name(i),
			(unsigned long long)stats.skipped, (unsigned long long)stats.tested);
		assert_true(stats.skipped > 0 && stats.skipped < stats.tested);
		assert_int_equal(stats.redrawn, stats.tested - stats.skipped);
		assert_int_equal(none.tested + none.redrawn, 0);
	}
}

/* The rig keeps the thorough one. */
static void make_renderers(struct run *run, struct rig *rig, const struct sm_driver_options *driver)
{
	rig_use_driver(rig, driver);
	run->skipping = rig->renderer;
	rig->renderer = NULL;
	rig_use_driver(rig, driver);
	run->thorough = rig->renderer;
	assert_true(sm_renderer_set_skips(run->thorough, "-all", NULL));
}

static void skips_do_not_show(void **state)
{
	struct run run = {.state = 0x2545f491};
	make_renderers(&run, *state, &(struct sm_driver_options){0});
	for (uint32_t scene = 0; scene < SCENES; scene++)
		play(&run, scene);
	for (size_t i = 0; i < COUNT(choices); i++)
		play_moves(&run, &choices[i]);
	for (size_t i = 0; i < COUNT(choices); i++)
		play_ledges(&run, &choices[i]);
	for (size_t i = 0; i < COUNT(choices); i++)
		play_glances(&run, &choices[i]);
	for (size_t i = 0; i < COUNT(choices); i++)
		play_brinks(&run, &choices[i]);
	for (size_t i = 0; i < COUNT(choices); i++)
		play_stays(&run, &choices[i]);
	check_counts(&run);
	sm_renderer_destroy(run.skipping);
}

/* Each layer of "maps" is two textures then. */
static void they_do_not_where_depths_are_colours(void **state)
{
	static const char *const paths[] = {"depth=rgba8", "comparison=fetch"};
	struct run run = {.state = 0x2545f491};
	make_renderers(&run, *state,
		&(struct sm_driver_options){.paths = paths, .path_count = COUNT(paths)});
	for (size_t i = 0; i < COUNT(choices); i++) {
		if (choices[i].technique == NULL || strcmp(choices[i].technique, "maps") != 0)
			continue;
		play_moves(&run, &choices[i]);
		play_glances(&run, &choices[i]);
		play_brinks(&run, &choices[i]);
	}
	sm_renderer_destroy(run.skipping);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(skips_do_not_show),
		rig_test(they_do_not_where_depths_are_colours),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
