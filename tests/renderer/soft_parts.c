/* SPDX-License-Identifier: MIT */
/*
 * What is left out to make frames cheap is not missed: surfaces drawn by the plain shadow map where
 * no fin reaches, back faces of solids, and what is hidden behind what was drawn first.
 */
#include "canvas.h"
#include "load/builtin.h"
#include "load/stage.h"
#include "models.h"
#include "parts.h"
#include "renderer.h"
#include "visibility.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Not whole tiles. */
#define WIDTH 149
#define HEIGHT 101

/* How a shadow map that is looked up without smoothies compares: GL_LEQUAL, or GL_NEVER and
 * GL_ALWAYS to see where it is. */
static GLenum plain_compare = GL_LEQUAL;

static void bind_comparing(const struct technique *technique, const void *state, struct gpu *gpu,
	const struct light_frame *frame, const struct program *program)
{
	GLint sampler;
	technique->bind(state, gpu, frame, program);
	glActiveTexture(GL_TEXTURE0 + UNIT_DEPTH_COMPARE);
	glGetIntegerv(GL_SAMPLER_BINDING, &sampler);
	glSamplerParameteri((GLuint)sampler, GL_TEXTURE_COMPARE_FUNC,
		program->key.flags & FLAG_HARD ? (GLint)plain_compare : GL_LEQUAL);
}

static void bind_pcf(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	bind_comparing(&technique_pcf, state, gpu, frame, program);
}

static void bind_smoothie(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	bind_comparing(&technique_smoothie, state, gpu, frame, program);
}

static void bind_two_sided(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	bind_comparing(&technique_smoothie_two_sided, state, gpu, frame, program);
}

static void bind_penumbra_map(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	bind_comparing(&technique_penumbra_map, state, gpu, frame, program);
}

static const struct way {
	const struct technique *technique;
	size_t pixels_a_plain; /* at least one in so many is drawn by the shadow map alone */
	void (*bind)(const void *state, struct gpu *gpu, const struct light_frame *frame,
		const struct program *program);
} ways[] = {
	{&technique_smoothie, 25, bind_smoothie},
	{&technique_pcf, 25, bind_pcf},
	{&technique_smoothie_two_sided, 300, bind_two_sided},
	{&technique_penumbra_map, 50, bind_penumbra_map},
};
#define WAYS (sizeof(ways) / sizeof(ways[0]))

/* The technique that these options choose, with a comparison that can be changed. */
static void set_shadows(struct rig *rig, const struct sm_shadow_options *options)
{
	static struct technique changed;
	rig_set_shadows(rig, options);
	changed = *rig->renderer->shadows.technique;
	for (size_t i = 0; i < WAYS; i++)
		if (ways[i].technique == rig->renderer->shadows.technique)
			changed.bind = ways[i].bind;
	rig->renderer->shadows.technique = &changed;
}

static struct visibility draw_comparing(struct rig *rig, const struct sm_scene *scene,
	const struct sm_camera *camera, bool whole, GLenum compare)
{
	struct visibility picture;
	plain_compare = compare;
	rig->renderer->whole = whole;
	visibility_draw(&picture, rig, scene, camera, WIDTH, HEIGHT);
	rig->renderer->whole = false;
	plain_compare = GL_LEQUAL;
	return picture;
}

/* What the pictures of a test have shown, so that it can be seen to have looked at something. */
struct census {
	size_t pixels, penumbra;
	size_t plain;      /* drawn by the shadow map alone */
	size_t unshadowed; /* not even by that; counted with "pcf" */
};

/* Pixels that the shadow map alone draws are as the technique draws them, and so are the others. */
static void check_parts(struct census *census, struct rig *rig, const struct sm_scene *scene,
	const struct sm_camera *camera, const char *what)
{
	struct visibility whole = draw_comparing(rig, scene, camera, true, GL_LEQUAL);
	struct visibility never = draw_comparing(rig, scene, camera, true, GL_NEVER);
	struct visibility dark = draw_comparing(rig, scene, camera, false, GL_NEVER);
	struct visibility lit = draw_comparing(rig, scene, camera, false, GL_ALWAYS);
	struct visibility parts = draw_comparing(rig, scene, camera, false, GL_LEQUAL);
	for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
		bool plain = dark.values[i] != lit.values[i];
		if (parts.values[i] != whole.values[i])
			fail_msg("%s, pixel %zu, %zu (%s): %d, not %d", what, i % WIDTH, i / WIDTH,
				plain ? "plain" : "not plain", parts.values[i], whole.values[i]);
		census->pixels++;
		census->plain += plain;
		census->unshadowed += never.values[i] < dark.values[i];
		census->penumbra += whole.values[i] > 0 && whole.values[i] < 65535;
	}
	visibility_finish(&whole);
	visibility_finish(&never);
	visibility_finish(&dark);
	visibility_finish(&lit);
	visibility_finish(&parts);
}

static void check_census(const struct census *census, const struct way *way)
{
	print_message("%s: %zu pixels, %zu plain, %zu unshadowed, %zu in penumbras\n",
		way->technique->name, census->pixels, census->plain, census->unshadowed,
		census->penumbra);
	assert_true(census->plain > census->pixels / way->pixels_a_plain);
	assert_true(census->penumbra > census->pixels / 200);
}

/* Closed, in 16 clusters. */
static uint32_t add_ball(struct sm_scene *scene)
{
	struct model model = model_sphere(4);
	struct sm_mesh_desc desc = model_desc(&model, "ball");
	uint32_t mesh;
	desc.normals = desc.positions;
	assert_true(sm_scene_add_mesh(scene, &desc, &mesh, NULL));
	model_finish(&model);
	return mesh;
}

/* A spread of meshes between one cluster and many, one cut in half, one mirrored. */
static void add_things(struct sm_scene *scene, unsigned int ground_roles, bool reversed)
{
	static const float wall[][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
	static const uint32_t wall_indices[] = {0, 1, 2, 0, 2, 3};
	uint32_t square = parts_add_square(scene), cube = parts_add_cube(scene);
	uint32_t ball = add_ball(scene);
	uint32_t upright = parts_add_mesh(scene, wall, 4, wall_indices, 6);
	const struct {
		uint32_t mesh;
		unsigned int roles;
		struct pose pose;
	} things[] = {
		{square, ground_roles, {{20, 1, 20}, 0, {0, 0, 0}}},
		{upright, ground_roles, {{8, 4, 1}, 0, {0, 4, -5}}},
		{cube, PART_BOTH, {{0.8f, 0.8f, 0.8f}, 30, {-1.5f, 0.9f, 0.5f}}},
		{ball, PART_BOTH, {{1, 1, 1}, 0, {1.2f, 1.5f, 0}}},
		{ball, PART_BOTH, {{-0.5f, 0.7f, 0.5f}, 70, {0, 0.9f, 2}}},
		{cube, PART_CASTS, {{-0.1f, 2, 0.1f}, 10, {3, 2.1f, 1}}},
		{square, PART_RECEIVES, {{1, 1, 1}, 15, {-3, 0.3f, 2}}},
	};
	const size_t count = sizeof(things) / sizeof(things[0]);
	for (size_t i = 0; i < count; i++) {
		size_t thing = reversed ? count - 1 - i : i;
		parts_add_object(
			scene, things[thing].mesh, things[thing].roles, &things[thing].pose);
	}
}

static const struct sm_light_desc lights[] = {
	{.name = "spot above", .position = {2, 8, 3}, .radius = 0.3f, .angle = 60},
	{.name = "wide spot inside",
		.position = {0, 3, 1},
		.target = {0.5f, 0, 0},
		.radius = 0.05f,
		.angle = 150},
	{.name = "narrow spot",
		.position = {-9, 6, 5},
		.target = {0, 1, 0},
		.radius = 0.1f,
		.angle = 12},
	{.name = "low spot",
		.position = {12, 0.7f, 2},
		.target = {0, 0.6f, 0},
		.radius = 0.2f,
		.angle = 50},
	{.name = "spot in a cube",
		.position = {-1.5f, 0.9f, 0.5f},
		.target = {2, 0.5f, 0},
		.radius = 0.02f,
		.angle = 100},
	{.name = "large spot", .position = {0, 6, 6}, .radius = 3, .angle = 70},
	{.name = "sun", .type = SM_LIGHT_DIRECTIONAL, .position = {3, 9, 4}, .radius = 0.1f},
	{.name = "low sun",
		.type = SM_LIGHT_DIRECTIONAL,
		.position = {9, 0.4f, 3},
		.radius = 0.08f},
	{.name = "overhead sun",
		.type = SM_LIGHT_DIRECTIONAL,
		.position = {0, 5, 0},
		.radius = 0.5f},
};
#define LIGHTS (sizeof(lights) / sizeof(lights[0]))

static const struct {
	const char *name;
	struct sm_camera camera;
} views[] = {
	{"aside", {{6, 4, 8}, {0, 1, 0}, {0, 1, 0}, 45, 0, 0}},
	{"above", {{0.1f, 14, 0}, {0, 0, 0}, {0, 0, -1}, 60, 0, 0}},
	{"below", {{2, -3, 4}, {0, 1, 0}, {0, 1, 0}, 80, 0.1f, 60}},
	{"near the ground", {{5, 0.05f, 5}, {0, 0.4f, 0}, {0, 1, 0}, 60, 0.02f, 60}},
	{"within the light", {{1, 4, 2}, {0.5f, 0, 0}, {0, 1, 0}, 100, 0.05f, 60}},
	{"towards the light", {{-2, 0.5f, -2}, {2, 8, 3}, {0, 1, 0}, 90, 0.05f, 60}},
	{"behind the light", {{5, 16, 8}, {2, 8, 3}, {0, 1, 0}, 30, 0, 0}},
	{"away from all", {{0, 3, 12}, {0, 4, 30}, {0, 1, 0}, 60, 0.1f, 60}},
	{"far away", {{60, 50, 90}, {0, 0, 0}, {0, 1, 0}, 20, 0, 0}},
	{"tilted", {{-5, 3, 3}, {0, 1, 0}, {1, 1, 0.3f}, 70, 0, 0}},
	{"in the ball", {{1.2f, 1.5f, 0.1f}, {5, 0, 5}, {0, 1, 0}, 90, 0.05f, 60}},
};
#define VIEWS (sizeof(views) / sizeof(views[0]))

static void describe(char text[100], const struct sm_light_desc *light, const char *view)
{
	snprintf(text, 100, "%s, seen from %s", light->name, view);
}

static const struct sm_shadow_options small_map = {.technique = "smoothie", .map_size = 256};

static void check_views(struct census *census, struct rig *rig, const struct sm_light_desc *light)
{
	struct sm_light_desc desc = *light;
	desc.intensity = 1.0f;
	assert_true(sm_scene_set_light(rig->scene, 0, &desc, NULL));
	for (size_t view = 0; view < VIEWS; view++) {
		char what[100];
		describe(what, light, views[view].name);
		check_parts(census, rig, rig->scene, &views[view].camera, what);
	}
}

static void parts_look_like_the_whole(void **state)
{
	struct rig *rig = *state;
	rig_skip_nothing(rig);
	add_things(rig->scene, PART_BOTH, false);
	parts_add_light(rig->scene, &lights[0]);
	for (size_t i = 0; i < WAYS; i++) {
		struct census census = {0};
		set_shadows(rig, &(struct sm_shadow_options){
					 .technique = ways[i].technique->name, .map_size = 256});
		for (size_t light = 0; light < LIGHTS; light++)
			check_views(&census, rig, &lights[light]);
		check_census(&census, &ways[i]);
	}
}

/* Light and camera anywhere around the things. */
static void check_somewhere(struct census *census, struct rig *rig, uint64_t *random, bool sun)
{
	float r[12];
	for (int i = 0; i < 12; i++)
		r[i] = random_signed(random);
	struct sm_light_desc light = {
		.type = sun ? SM_LIGHT_DIRECTIONAL : SM_LIGHT_SPOT,
		.position = {9 * r[0], 4 + 5 * r[1], 9 * r[2]},
		.target = {2 * r[3], 1 + r[4], 2 * r[5]},
		.radius = 0.3f + 0.3f * r[6],
		.angle = 70 + 65 * r[7],
		.intensity = 1.0f,
	};
	struct sm_camera camera = {
		.eye = {10 * r[8], 3 + 5 * r[9], 10 * r[10]},
		.target = {r[11], 0, r[0]},
		.up = {0, 1, r[1]},
		.fov = 60 + 40 * r[2],
		.near = 0.05f,
		.far = 80,
	};
	char what[200];
	snprintf(what, sizeof(what), "light %g %g %g, camera %g %g %g", light.position[0],
		light.position[1], light.position[2], camera.eye[0], camera.eye[1], camera.eye[2]);
	assert_true(sm_scene_set_light(rig->scene, 0, &light, NULL));
	check_parts(census, rig, rig->scene, &camera, what);
}

/* With maps of all sizes, fins of constant width, and a ground that casts no shadow. */
static void parts_look_like_the_whole_from_anywhere(void **state)
{
	struct rig *rig = *state;
	rig_skip_nothing(rig);
	uint64_t random = 41;
	add_things(rig->scene, PART_RECEIVES, false);
	parts_add_light(rig->scene, &lights[0]);
	for (size_t i = 0; i < WAYS; i++) {
		struct census census = {0};
		for (int round = 0; round < 120; round++) {
			bool constant = ways[i].technique == &technique_smoothie && round % 5 == 0;
			set_shadows(rig,
				&(struct sm_shadow_options){.technique = ways[i].technique->name,
					.map_size = 16u << round % 6,
					.width = constant ? 0.02f : 0.0f});
			check_somewhere(&census, rig, &random, round % 3 == 0);
		}
		check_census(&census, &ways[i]);
	}
}

static void load(struct stage *stage, const char *name)
{
	char source[64];
	struct sm_error error;
	snprintf(source, sizeof(source), "builtin:%s", name);
	if (!stage_load(stage, source, NULL, 0, &error))
		fail_msg("%s", error.text);
}

static void parts_of_built_in_scenes_look_like_the_whole(void **state)
{
	struct rig *rig = *state;
	rig_skip_nothing(rig);
	for (size_t i = 0; i < WAYS; i++) {
		struct census census = {0};
		set_shadows(rig, &(struct sm_shadow_options){
					 .technique = ways[i].technique->name, .map_size = 512});
		for (size_t scene = 0; builtin_name(scene) != NULL; scene++) {
			struct stage stage;
			load(&stage, builtin_name(scene));
			check_parts(&census, rig, stage.scene, &stage.camera, builtin_name(scene));
			stage_finish(&stage);
		}
		check_census(&census, &ways[i]);
	}
}

/* sRGB bytes of all lights together; the caller's to free(). */
static uint8_t *draw_sampled(struct rig *rig, const struct sm_scene *scene,
	const struct sm_camera *camera, GLsizei samples)
{
	struct canvas canvas;
	/* As the program has it: several samples are added up and resolved in linear light. */
	GLenum format = samples > 1 ? GL_SRGB8_ALPHA8 : GL_RGBA8;
	canvas_init_multisampled(&canvas, format, WIDTH, HEIGHT, samples);
	struct sm_view view = {.camera = *camera,
		.framebuffer = canvas.framebuffer,
		.width = WIDTH,
		.height = HEIGHT,
		.visibility_of = SM_NONE};
	rig_draw(rig, scene, &view);
	uint8_t *rgba = canvas_read(&canvas);
	canvas_finish(&canvas);
	return rgba;
}

static uint8_t *draw_picture(
	struct rig *rig, const struct sm_scene *scene, const struct sm_camera *camera)
{
	return draw_sampled(rig, scene, camera, 1);
}

#define PICTURE_BYTES ((size_t)WIDTH * HEIGHT * 4)

static int most_apart(const uint8_t *a, const uint8_t *b)
{
	int most = 0;
	for (size_t i = 0; i < PICTURE_BYTES; i++)
		most = abs(a[i] - b[i]) > most ? abs(a[i] - b[i]) : most;
	return most;
}

static void add_dimmed_lights(struct sm_scene *scene)
{
	for (size_t i = 0; i < LIGHTS; i++) {
		struct sm_light_desc light = lights[i];
		light.intensity = 0.1f;
		light.color[0] = light.color[1] = light.color[2] = 1.0f;
		light.color[i % 3] = 0.5f;
		parts_add_light(scene, &light);
	}
	sm_scene_set_environment(scene,
		&(struct sm_environment){{0.2f, 0.2f, 0.2f}, {0.1f, 0.1f, 0.1f}, {0, 0, 0.5f}});
}

/* Added up light by light: each pixel once for each. */
static void parts_of_many_lights_add_up(void **state)
{
	struct rig *rig = *state;
	rig_skip_nothing(rig);
	rig_set_shadows(rig, &small_map);
	add_things(rig->scene, PART_BOTH, false);
	add_dimmed_lights(rig->scene);
	for (size_t view = 0; view < VIEWS; view++) {
		uint8_t *parts = draw_picture(rig, rig->scene, &views[view].camera);
		rig->renderer->whole = true;
		uint8_t *whole = draw_picture(rig, rig->scene, &views[view].camera);
		rig->renderer->whole = false;
		if (memcmp(parts, whole, PICTURE_BYTES) != 0)
			fail_msg("from %s", views[view].name);
		free(parts);
		free(whole);
	}
}

static size_t count_apart(const uint8_t *a, const uint8_t *b, int by)
{
	size_t count = 0;
	for (size_t i = 0; i < PICTURE_BYTES; i += 4)
		count += abs(a[i] - b[i]) > by || abs(a[i + 1] - b[i + 1]) > by ||
			 abs(a[i + 2] - b[i + 2]) > by;
	return count;
}

static const struct sm_shadow_options far_reaching[] = {
	{.technique = "pcss", .map_size = 256},
	{.technique = "vsm", .samples = 9, .map_size = 64},
	{.technique = "maps", .samples = 4, .map_size = 256},
	{.technique = "gather", .map_size = 256, .sampling = SM_SAMPLING_DENSE},
	{.technique = "gather", .map_size = 256, .sampling = SM_SAMPLING_SPARSE},
};

static const struct screen_grid *no_penumbra(const void *state)
{
	static const struct screen_grid none;
	(void)state;
	return &none;
}

static float no_reach(const void *state, const struct light_frame *frame)
{
	(void)state, (void)frame;
	return 0.0f;
}

/* How many pixels of a picture in parts are not as they are in the whole one. Beside a spot's cone,
 * where no light is, visibility has no meaning. */
static size_t count_missed(struct rig *rig, const struct sm_camera *camera)
{
	rig->renderer->whole = true;
	uint8_t *whole = draw_picture(rig, rig->scene, camera);
	rig->renderer->whole = false;
	uint8_t *parts = draw_picture(rig, rig->scene, camera);
	size_t missed = count_apart(whole, parts, 0);
	free(whole);
	free(parts);
	return missed;
}

/* Pixels that would be missed if the technique were thought to reach no farther than casters, or to
 * have no penumbrae where it tells itself where they are. */
static size_t check_reach(struct rig *rig)
{
	const struct technique *technique = rig->renderer->shadows.technique;
	struct technique near_sighted = *technique;
	size_t beyond = 0;
	near_sighted.reach = no_reach;
	near_sighted.soft_grid = technique->soft_grid != NULL ? no_penumbra : NULL;
	for (size_t i = 0; i < LIGHTS * VIEWS; i++) {
		const struct sm_camera *camera = &views[i / LIGHTS].camera;
		struct sm_light_desc light = lights[i % LIGHTS];
		light.intensity = light.color[0] = light.color[1] = light.color[2] = 1.0f;
		assert_true(sm_scene_set_light(rig->scene, 0, &light, NULL));
		size_t missed = count_missed(rig, camera);
		if (missed > 0)
			fail_msg("%s, %s, seen from %s: %zu pixels", technique->name, light.name,
				views[i / LIGHTS].name, missed);
		rig->renderer->shadows.technique = &near_sighted;
		beyond += count_missed(rig, camera);
		rig->renderer->shadows.technique = technique;
	}
	return beyond;
}

/* Nowhere else is their shadow looked for. All that does not cast is one plane: variance maps take
 * the nearer of several surfaces for a blocker, casting or not. None of its corners is at w = 0 in
 * a view, where SwiftShader gives the whole triangle one value. */
static void techniques_darken_no_farther_than_their_reach(void **state)
{
	struct rig *rig = *state;
	rig_skip_nothing(rig);
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES,
		&(struct pose){{19, 1, 19}, 0, {0, 0, 0}});
	parts_add_object(rig->scene, parts_add_cube(rig->scene), PART_BOTH,
		&(struct pose){{0.8f, 0.8f, 0.8f}, 30, {-1.5f, 0.9f, 0.5f}});
	parts_add_object(rig->scene, add_ball(rig->scene), PART_BOTH,
		&(struct pose){{1, 1, 1}, 0, {1.2f, 1.5f, 0}});
	parts_add_light(rig->scene, &lights[0]);
	for (size_t i = 0; i < sizeof(far_reaching) / sizeof(far_reaching[0]); i++) {
		if (!rig_can_draw(far_reaching[i].technique))
			continue;
		rig_set_shadows(rig, &far_reaching[i]);
		size_t beyond = check_reach(rig);
		print_message("%s: %zu pixels beyond casters\n", far_reaching[i].technique, beyond);
		assert_true(beyond > 0);
	}
}

/* With several samples a pixel that an edge crosses is shaded at its centre, which may lie outside
 * the triangle, where less may be drawn: a few such pixels, but no lines along the parts. */
static void parts_of_many_lights_add_up_in_samples(void **state)
{
	struct rig *rig = *state;
	rig_skip_nothing(rig);
	rig_set_shadows(rig, &small_map);
	add_things(rig->scene, PART_BOTH, false);
	add_dimmed_lights(rig->scene);
	for (size_t view = 0; view < VIEWS; view++) {
		uint8_t *parts = draw_sampled(rig, rig->scene, &views[view].camera, 4);
		rig->renderer->whole = true;
		uint8_t *whole = draw_sampled(rig, rig->scene, &views[view].camera, 4);
		rig->renderer->whole = false;
		size_t apart = count_apart(parts, whole, 3);
		print_message("%s: %zu pixels apart, most %d\n", views[view].name, apart,
			most_apart(parts, whole));
		free(parts);
		free(whole);
		assert_true(apart <= (size_t)WIDTH * HEIGHT / 500);
	}
}

/* Pixels of a picture. On the outline of a solid its front and its back meet, so that either may
 * win the depth test by rounding; where backs are not drawn, only the front can. */
#define TIES 2

/* Finishes both. ties: pixels that may differ. */
static void check_same(
	struct visibility *one, struct visibility *two, size_t ties, const char *what)
{
	size_t differing = visibility_compare(one, two).differing;
	if (differing > ties)
		fail_msg("%s: %zu pixels differ", what, differing);
	visibility_finish(one);
	visibility_finish(two);
}

static void check_same_visibility(struct rig *rig, const struct sm_scene *other,
	const struct sm_camera *camera, size_t ties, const char *what)
{
	struct visibility one, two;
	visibility_draw(&one, rig, rig->scene, camera, WIDTH, HEIGHT);
	visibility_draw(&two, rig, other, camera, WIDTH, HEIGHT);
	check_same(&one, &two, ties, what);
}

/* By each light alone, and by all together. */
static void check_same_pictures(struct rig *rig, struct sm_scene *other, size_t ties)
{
	rig_set_shadows(rig, &small_map);
	parts_add_light(rig->scene, &lights[0]);
	parts_add_light(other, &lights[0]);
	for (size_t light = 0; light < LIGHTS; light++) {
		struct sm_light_desc desc = lights[light];
		desc.intensity = 1.0f;
		assert_true(sm_scene_set_light(rig->scene, 0, &desc, NULL));
		assert_true(sm_scene_set_light(other, 0, &desc, NULL));
		for (size_t view = 0; view < VIEWS; view++) {
			char what[100];
			describe(what, &lights[light], views[view].name);
			check_same_visibility(rig, other, &views[view].camera, ties, what);
		}
	}
	add_dimmed_lights(rig->scene);
	add_dimmed_lights(other);
	for (size_t view = 0; view < VIEWS; view++) {
		uint8_t *one = draw_picture(rig, rig->scene, &views[view].camera);
		uint8_t *two = draw_picture(rig, other, &views[view].camera);
		size_t differing = 0;
		for (size_t i = 0; i < PICTURE_BYTES; i += 4)
			differing += memcmp(one + i, two + i, 4) != 0;
		if (differing > ties)
			fail_msg("all lights, seen from %s: %zu pixels differ", views[view].name,
				differing);
		free(one);
		free(two);
	}
}

static size_t forget_solids(struct sm_scene *scene)
{
	size_t solids = 0;
	for (size_t i = 0; i < scene->mesh_count; i++) {
		solids += scene->meshes[i].solid;
		scene->meshes[i].solid = false;
	}
	return solids;
}

/* Lights and cameras are outside and inside of solids, some of which are mirrored. */
static void back_faces_of_solids_are_not_missed(void **state)
{
	struct rig *rig = *state;
	rig_skip_nothing(rig);
	struct sm_scene *hollow = sm_scene_create();
	assert_non_null(hollow);
	add_things(rig->scene, PART_BOTH, false);
	add_things(hollow, PART_BOTH, false);
	sm_scene_set_environment(hollow, &(struct sm_environment){0});
	assert_int_equal(forget_solids(hollow), 2);
	check_same_pictures(rig, hollow, TIES);
	sm_scene_destroy(hollow);
}

static void what_is_not_solid_shows_its_back(void **state)
{
	struct rig *rig = *state;
	rig_skip_nothing(rig);
	const struct sm_camera below = {{2, -3, 4}, {0, 0, 0}, {0, 1, 0}, 30, 0, 0};
	struct visibility seen;
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_BOTH,
		&(struct pose){.scale = {1, 1, 1}});
	parts_add_light(rig->scene, &lights[0]);
	visibility_draw(&seen, rig, rig->scene, &below, WIDTH, HEIGHT);
	assert_true(visibility_at(&seen, WIDTH / 2, HEIGHT / 2) == 0.0);
	visibility_finish(&seen);
}

static void back_faces_in_built_in_scenes_are_not_missed(void **state)
{
	struct rig *rig = *state;
	rig_skip_nothing(rig);
	size_t solids = 0;
	for (size_t i = 0; builtin_name(i) != NULL; i++) {
		struct stage stage, hollow;
		load(&stage, builtin_name(i));
		load(&hollow, builtin_name(i));
		solids += forget_solids(hollow.scene);
		struct visibility one, two;
		visibility_draw(&one, rig, stage.scene, &stage.camera, WIDTH, HEIGHT);
		visibility_draw(&two, rig, hollow.scene, &stage.camera, WIDTH, HEIGHT);
		check_same(&one, &two, TIES, builtin_name(i));
		stage_finish(&hollow);
		stage_finish(&stage);
	}
	assert_true(solids >= 7);
}

static void the_order_of_objects_does_not_matter(void **state)
{
	struct rig *rig = *state;
	rig_skip_nothing(rig);
	struct sm_scene *reversed = sm_scene_create();
	assert_non_null(reversed);
	sm_scene_set_environment(reversed, &(struct sm_environment){0});
	add_things(rig->scene, PART_BOTH, false);
	add_things(reversed, PART_BOTH, true);
	check_same_pictures(rig, reversed, 0);
	sm_scene_destroy(reversed);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(parts_look_like_the_whole),
		rig_test(techniques_darken_no_farther_than_their_reach),
		rig_test(parts_look_like_the_whole_from_anywhere),
		rig_test(parts_of_built_in_scenes_look_like_the_whole),
		rig_test(parts_of_many_lights_add_up),
		rig_test(parts_of_many_lights_add_up_in_samples),
		rig_test(back_faces_of_solids_are_not_missed),
		rig_test(what_is_not_solid_shows_its_back),
		rig_test(back_faces_in_built_in_scenes_are_not_missed),
		rig_test(the_order_of_objects_does_not_matter),
	};
	return cmocka_run_group_tests_name("soft_parts", tests, NULL, NULL);
}
