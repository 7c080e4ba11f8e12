/* SPDX-License-Identifier: MIT */
/* What the light passes of a frame take in which one of 100 casters has moved, or most have, with
 * and without the skip "static", interleaved in one run. */
#include "bench/statistics.h"
#include "bench/stress_shape.h"
#include "platform.h"
#include <GLES3/gl3.h>
#include <math.h>
#include <smoothie.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define SIDE 10 /* casters along a side of the floor, a unit apart */
#define MOVING (SIDE * SIDE / 2 + SIDE / 2)
#define MAP_SIZE 1024
#define PICTURE_SIZE 64 /* of which the passes of a light are independent */
#define ROUNDS 41
#define MOST_MOVE "--most-move"
#define SPHERE_STEPS 16

/* A way to draw, and when its light passes were done; 0 until they are. */
struct contender {
	struct sm_renderer *renderer;
	double ready, times[ROUNDS]; /* ms */
};

struct bench {
	struct sm_scene *scene;
	GLuint framebuffer, buffers[2];
	struct contender all, changed;
	bool most_move;
};

/* Of all threads, since the driver may be some. */
static double now_ms(void)
{
	struct timespec now;
	glFinish();
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
	return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

static void begin_pass(void *data, const char *pass)
{
	struct contender *contender = data;
	/* The first ones of a view, however it is sampled. */
	bool of_view = strcmp(pass, "surfaces") == 0 || strcmp(pass, "parts") == 0 ||
		       strcmp(pass, "points") == 0;
	if (of_view && contender->ready == 0.0)
		contender->ready = now_ms();
}

static void end_pass(void *data, const char *pass)
{
	(void)data, (void)pass;
}

static bool add_mesh(struct sm_scene *scene, struct stress_mesh *mesh, struct sm_error *error)
{
	const struct sm_mesh_desc desc = {.positions = mesh->positions[0],
		.vertex_count = mesh->vertex_count,
		.indices = mesh->indices,
		.index_count = mesh->index_count};
	uint32_t handle;
	bool added = sm_scene_add_mesh(scene, &desc, &handle, error);
	stress_mesh_finish(mesh);
	return added;
}

static void place(float transform[16], float size, const float position[3])
{
	memset(transform, 0, 16 * sizeof(*transform));
	transform[0] = transform[5] = transform[10] = size;
	memcpy(&transform[12], position, 3 * sizeof(*position));
	transform[15] = 1.0f;
}

/* away: from the middle of its place. */
static void place_caster(float transform[16], uint32_t index, float away, float turn)
{
	const float position[3] = {(float)(index % SIDE) + away * cosf(turn), 0.5f,
		(float)(index / SIDE) + away * sinf(turn)};
	place(transform, 0.3f, position);
}

/* The meshes are square, cube and sphere. */
static bool add_objects(struct sm_scene *scene, struct sm_error *error)
{
	struct sm_object_desc desc = {
		.base_color = {1, 1, 1, 1}, .image = SM_NONE, .casts = true, .receives = true};
	uint32_t handle;
	for (uint32_t i = 0; i < SIDE * SIDE; i++) {
		desc.mesh = 1 + i % 2;
		place_caster(desc.transform, i, 0.0f, 0.0f);
		if (!sm_scene_add_object(scene, &desc, &handle, error))
			return false;
	}
	desc.mesh = 0;
	desc.casts = false;
	place(desc.transform, SIDE, (const float[3]){SIDE / 2.0f, 0.0f, SIDE / 2.0f});
	return sm_scene_add_object(scene, &desc, &handle, error);
}

static bool make_scene(struct bench *bench, struct sm_error *error)
{
	struct stress_mesh mesh;
	const struct sm_light_desc light = {.position = {SIDE, SIDE, SIDE / 2.0f},
		.target = {SIDE / 2.0f, 0, SIDE / 2.0f},
		.radius = 0.3f,
		.angle = 70,
		.color = {1, 1, 1},
		.intensity = 1};
	uint32_t handle;
	bench->scene = sm_scene_create();
	return bench->scene != NULL && stress_shape_square(&mesh, error) &&
	       add_mesh(bench->scene, &mesh, error) && stress_shape_cube(&mesh, error) &&
	       add_mesh(bench->scene, &mesh, error) &&
	       stress_shape_sphere(&mesh, SPHERE_STEPS, error) &&
	       add_mesh(bench->scene, &mesh, error) && add_objects(bench->scene, error) &&
	       sm_scene_add_light(bench->scene, &light, &handle, error);
}

static void make_target(struct bench *bench)
{
	static const GLenum formats[2] = {GL_SRGB8_ALPHA8, GL_DEPTH_COMPONENT24};
	static const GLenum attachments[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
	glGenFramebuffers(1, &bench->framebuffer);
	glGenRenderbuffers(2, bench->buffers);
	glBindFramebuffer(GL_FRAMEBUFFER, bench->framebuffer);
	for (int i = 0; i < 2; i++) {
		glBindRenderbuffer(GL_RENDERBUFFER, bench->buffers[i]);
		glRenderbufferStorage(GL_RENDERBUFFER, formats[i], PICTURE_SIZE, PICTURE_SIZE);
		glFramebufferRenderbuffer(
			GL_FRAMEBUFFER, attachments[i], GL_RENDERBUFFER, bench->buffers[i]);
	}
}

static bool make_contender(struct contender *contender, const char *skips, struct sm_error *error)
{
	const struct sm_pass_observer observer = {contender, begin_pass, end_pass};
	contender->renderer = sm_renderer_create(platform_get_proc, error);
	if (contender->renderer == NULL ||
		!sm_renderer_set_skips(contender->renderer, skips, error))
		return false;
	sm_renderer_set_pass_observer(contender->renderer, &observer);
	return true;
}

/* Draws a frame and returns what it took until surfaces were drawn; below 0 on failure. */
static double draw(struct bench *bench, struct contender *contender, struct sm_error *error)
{
	const struct sm_view view = {
		.camera = {.eye = {SIDE, SIDE, SIDE},
			.target = {SIDE / 2.0f, 0, SIDE / 2.0f},
			.up = {0, 1, 0},
			.fov = 50},
		.framebuffer = bench->framebuffer,
		.width = PICTURE_SIZE,
		.height = PICTURE_SIZE,
		.visibility_of = SM_NONE,
	};
	contender->ready = 0.0;
	double start = now_ms();
	bool drawn = sm_renderer_draw(contender->renderer, bench->scene, &view, error);
	glFinish();
	return drawn ? contender->ready - start : -1.0;
}

/* Those at the rim stay, and the light's screen and depth range with them. */
static bool moves(const struct bench *bench, uint32_t index)
{
	uint32_t column = index % SIDE, row = index / SIDE;
	bool at_rim = column == 0 || row == 0 || column == SIDE - 1 || row == SIDE - 1;
	return bench->most_move ? !at_rim : index == MOVING;
}

static bool move_casters(struct bench *bench, float turn, struct sm_error *error)
{
	float transform[16];
	for (uint32_t i = 0; i < SIDE * SIDE; i++) {
		place_caster(transform, i, 0.2f, turn);
		if (moves(bench, i) && !sm_scene_set_transform(bench->scene, i, transform, error))
			return false;
	}
	return true;
}

static bool measure(struct bench *bench, struct sm_error *error)
{
	/* The first two rounds compile all programs. */
	for (int round = -2; round < ROUNDS; round++) {
		if (!move_casters(bench, 0.3f * (float)round, error))
			return false;
		double all = draw(bench, &bench->all, error);
		double changed = draw(bench, &bench->changed, error);
		if (all < 0.0 || changed < 0.0)
			return false;
		if (round >= 0) {
			bench->all.times[round] = all;
			bench->changed.times[round] = changed;
		}
	}
	return true;
}

static bool compare(struct bench *bench, size_t technique, uint32_t samples, struct sm_error *error)
{
	const struct sm_shadow_options options = {.technique = sm_technique_name(technique),
		.map_size = MAP_SIZE,
		.samples = samples};
	if (!sm_renderer_set_shadows(bench->all.renderer, &options, error) ||
		!sm_renderer_set_shadows(bench->changed.renderer, &options, error) ||
		!measure(bench, error))
		return false;
	double all = statistics_median(bench->all.times, ROUNDS);
	double changed = statistics_median(bench->changed.times, ROUNDS);
	printf("  %-20s", options.technique);
	if (samples > 0)
		printf(" %2u samples", samples);
	printf(" all %7.2f  what changed %7.2f  ratio %.3f\n", all, changed, changed / all);
	fflush(stdout);
	return true;
}

/* With each number of samples that there are. */
static bool compare_samples(struct bench *bench, size_t technique, struct sm_error *error)
{
	uint32_t samples;
	for (size_t i = 0; (samples = sm_technique_samples(technique, i)) > 0 || i == 0; i++)
		if (!compare(bench, technique, samples, error))
			return false;
	return true;
}

static bool is_named(char *const *names, const char *technique)
{
	for (; *names != NULL; names++)
		if (strcmp(*names, technique) == 0)
			return true;
	return false;
}

/* names: of the techniques, up to NULL; none for all, with the default number of samples. */
static bool run(struct bench *bench, char *const *names, struct sm_error *error)
{
	printf("%s of %d casters moved, map %d, light passes in ms of all processors\n",
		bench->most_move ? "most" : "one", SIDE * SIDE, MAP_SIZE);
	for (size_t i = 0; sm_technique_name(i) != NULL; i++)
		if (*names == NULL ? !compare(bench, i, 0, error)
				   : is_named(names, sm_technique_name(i)) &&
					     !compare_samples(bench, i, error))
			return false;
	return true;
}

int main(int argc, char *argv[])
{
	(void)argc;
	char **names = argv + 1;
	struct bench bench = {.most_move = *names != NULL && strcmp(*names, MOST_MOVE) == 0};
	names += bench.most_move;
	struct sm_error error = {0};
	struct platform *platform = platform_create(NULL, false, &error);
	bool done = platform != NULL && make_scene(&bench, &error);
	if (done)
		make_target(&bench);
	done = done && make_contender(&bench.all, "-static", &error) &&
	       make_contender(&bench.changed, NULL, &error) && run(&bench, names, &error);
	sm_renderer_destroy(bench.all.renderer);
	sm_renderer_destroy(bench.changed.renderer);
	sm_scene_destroy(bench.scene);
	glDeleteFramebuffers(1, &bench.framebuffer);
	glDeleteRenderbuffers(2, bench.buffers);
	platform_destroy(platform);
	if (!done)
		fprintf(stderr, "bench-moving: %s\n", error.text);
	return done ? 0 : 1;
}
