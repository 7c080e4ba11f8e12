/* SPDX-License-Identifier: MIT */
/* What frames cost in which there is little to do, against the frames that they are to be as cheap
 * as, interleaved in one run so that the ratios hold on a machine whose speed drifts. */
#include "base/array.h"
#include "bench/statistics.h"
#include "load/stage.h"
#include "platform.h"
#include "scene/camera.h"
#include "surface_pass.h"
#include <GLES3/gl3.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define LIGHTS 8
#define ROUNDS_MAX 101
#define WARM_MAX 10000
#define SHARE_NEAR 0.05 /* of the picture, near a penumbra */
#define NEAR_PIXELS 2

struct options {
	uint32_t size, map, rounds, warm;
	const char *technique, *figure;
	bool plain; /* the framebuffer is not sRGB */
};

/* A scene and what draws it. */
struct player {
	struct stage stage;
	struct sm_renderer *renderer;
	double times[ROUNDS_MAX], walls[ROUNDS_MAX]; /* of all processors, and by the clock; ms */
};

struct bench {
	const struct options *options;
	const char *source;
	GLuint framebuffer, buffers[2];
};

static double read_ms(clockid_t clock)
{
	struct timespec now;
	clock_gettime(clock, &now);
	return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

/* Of all threads, since the driver may be some. */
static double now_ms(void)
{
	glFinish();
	return read_ms(CLOCK_PROCESS_CPUTIME_ID);
}

static void init_target(struct bench *bench)
{
	const GLenum formats[2] = {
		bench->options->plain ? GL_RGBA8 : GL_SRGB8_ALPHA8, GL_DEPTH_COMPONENT24};
	static const GLenum attachments[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
	GLsizei size = (GLsizei)bench->options->size;
	glGenFramebuffers(1, &bench->framebuffer);
	glGenRenderbuffers(2, bench->buffers);
	glBindFramebuffer(GL_FRAMEBUFFER, bench->framebuffer);
	for (int i = 0; i < 2; i++) {
		glBindRenderbuffer(GL_RENDERBUFFER, bench->buffers[i]);
		glRenderbufferStorage(GL_RENDERBUFFER, formats[i], size, size);
		glFramebufferRenderbuffer(
			GL_FRAMEBUFFER, attachments[i], GL_RENDERBUFFER, bench->buffers[i]);
	}
}

static void player_finish(struct player *player)
{
	sm_renderer_destroy(player->renderer);
	stage_finish(&player->stage);
}

static bool player_init(const struct bench *bench, struct player *player, const char *technique,
	struct sm_error *error)
{
	const struct sm_shadow_options shadow = {
		.technique = technique, .map_size = bench->options->map};
	*player = (struct player){0};
	if (!stage_load(&player->stage, bench->source, NULL, 0, error))
		return false;
	if (sm_scene_light_count(player->stage.scene) == 0)
		return error_set(error, SM_ERROR_INPUT, "%s has no light", bench->source);
	stage_set_size(&player->stage, bench->options->size, bench->options->size);
	player->renderer = sm_renderer_create(platform_get_proc, error);
	return player->renderer != NULL &&
	       sm_renderer_set_shadows(player->renderer, &shadow, error);
}

/* Of the round: the camera goes to and fro a bit. */
static struct sm_view view_of(const struct bench *bench, const struct player *player, int round)
{
	struct sm_view view = {
		.camera = player->stage.camera,
		.framebuffer = bench->framebuffer,
		.width = bench->options->size,
		.height = bench->options->size,
		.visibility_of = SM_NONE,
	};
	float step = 0.002f * (float)(round & 7);
	for (int axis = 0; axis < 3; axis++)
		view.camera.eye[axis] += step * (view.camera.target[axis] - view.camera.eye[axis]);
	return view;
}

static bool draw(
	const struct bench *bench, struct player *player, int round, struct sm_error *error)
{
	struct sm_view view = view_of(bench, player, round);
	return sm_renderer_draw(player->renderer, player->stage.scene, &view, error);
}

/* How long a frame took; below 0 on failure. */
static double time_frame(
	const struct bench *bench, struct player *player, int round, struct sm_error *error)
{
	double start = now_ms();
	bool drawn = draw(bench, player, round, error);
	double ms = now_ms() - start;
	return drawn ? ms : -1.0;
}

/* The median over rounds of one player's times over another's. */
static double ratio_of(const struct bench *bench, const double *times, const double *over)
{
	double ratios[ROUNDS_MAX];
	for (uint32_t i = 0; i < bench->options->rounds; i++)
		ratios[i] = times[i] / over[i];
	return statistics_median(ratios, bench->options->rounds);
}

/* Times both players, frame by frame; the first rounds, which are not, compile all programs. */
static bool time_pair(const struct bench *bench, struct player *players, struct sm_error *error)
{
	for (int round = -(int)bench->options->warm; round < (int)bench->options->rounds; round++) {
		for (int i = 0; i < 2; i++) {
			/* Neither is always the one that comes after the other. */
			struct player *player = &players[(i + round) & 1];
			double start = read_ms(CLOCK_MONOTONIC);
			double ms = time_frame(bench, player, round, error);
			if (ms < 0.0)
				return false;
			if (round < 0)
				continue;
			player->times[round] = ms;
			player->walls[round] = read_ms(CLOCK_MONOTONIC) - start;
		}
	}
	return true;
}

/* Prints what the players take, with light passes in every frame and with a camera alone that
 * moves. */
static bool compare(const struct bench *bench, struct player *players, struct sm_error *error)
{
	static const struct {
		const char *name, *skips;
	} ways[] = {{"all drawn", "-light,-static,-points"},
		{"camera moves", "+light,+static,+points"}};
	for (int i = 0; i < 2; i++) {
		for (int j = 0; j < 2; j++)
			if (!sm_renderer_set_skips(players[j].renderer, ways[i].skips, error))
				return false;
		if (!time_pair(bench, players, error))
			return false;
		double ratio = ratio_of(bench, players[0].times, players[1].times);
		double wall = ratio_of(bench, players[0].walls, players[1].walls);
		printf("  %s %.2f / %.2f ms = %.3f (wall %.3f)", ways[i].name,
			statistics_median(players[0].times, bench->options->rounds),
			statistics_median(players[1].times, bench->options->rounds), ratio, wall);
	}
	return true;
}

/* The surfaces alone, with textures that are there. */
static bool draw_surfaces(
	const struct bench *bench, struct player *player, int round, struct sm_error *error)
{
	struct sm_renderer *renderer = player->renderer;
	struct sm_view view = view_of(bench, player, round);
	const struct shadowed_light *light = &renderer->lights[0];
	mat4 world_to_clip;
	if (!camera_world_to_clip(&view.camera, renderer->local.scene, view.width, view.height,
		    world_to_clip, error))
		return false;
	struct surface_pass pass = {.renderer = renderer,
		.scene = renderer->local.scene,
		.world_to_clip = world_to_clip,
		.width = view.width,
		.height = view.height,
		.light = &renderer->local.scene->lights[0].desc,
		.frame = &light->frame,
		.shadow = light->shadow,
		.first = true};
	glBindFramebuffer(GL_FRAMEBUFFER, view.framebuffer);
	glViewport(0, 0, (GLsizei)view.width, (GLsizei)view.height);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(GL_LESS);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	bool drawn = surface_pass_draw(&pass, error);
	gpu_restore_state(&renderer->gpu);
	return drawn;
}

/* A camera that moves, against the same view once more and against surfaces that are drawn without
 * asking whether their textures are current. */
static bool figure_view(const struct bench *bench, struct sm_error *error)
{
	struct player player;
	double ready[ROUNDS_MAX], bare[ROUNDS_MAX];
	bool done = player_init(bench, &player, bench->options->technique, error);
	for (int round = -(int)bench->options->warm; round < (int)bench->options->rounds && done;
		round++) {
		double moved = time_frame(bench, &player, round, error);
		double again = time_frame(bench, &player, round, error);
		double start = now_ms();
		done = moved >= 0.0 && again >= 0.0 && draw_surfaces(bench, &player, round, error);
		if (round < 0)
			continue;
		bare[round] = now_ms() - start;
		ready[round] = again;
		player.times[round] = moved;
	}
	if (done)
		printf("  moved / drawn again %.3f  moved / bare surfaces %.3f  (%.2f ms)",
			ratio_of(bench, player.times, ready), ratio_of(bench, player.times, bare),
			statistics_median(player.times, bench->options->rounds));
	player_finish(&player);
	return done;
}

/* Lights behind the camera that shine away from what it sees; the one in view comes last. */
static bool add_lights(struct player *player, struct sm_error *error)
{
	const struct sm_camera *camera = &player->stage.camera;
	struct sm_light_desc desc = {
		.radius = 0.1f, .angle = 60, .softness = 0.1f, .color = {1, 1, 1}, .intensity = 1};
	const struct sm_light_desc seen = player->stage.scene->lights[0].desc;
	uint32_t light;
	for (int i = 0; i < LIGHTS - 1; i++) {
		for (int axis = 0; axis < 3; axis++) {
			float back = camera->eye[axis] - camera->target[axis];
			desc.position[axis] = camera->eye[axis] + 0.1f * (float)i * back;
			desc.target[axis] = desc.position[axis] + back;
		}
		if (i == 0 ? !sm_scene_set_light(player->stage.scene, 0, &desc, error)
			   : !sm_scene_add_light(player->stage.scene, &desc, &light, error))
			return false;
	}
	return sm_scene_add_light(player->stage.scene, &seen, &light, error);
}

/* Eight lights, of which one is in the view, against that one. */
static bool figure_lights(const struct bench *bench, struct sm_error *error)
{
	struct player players[2] = {0};
	bool done = player_init(bench, &players[0], bench->options->technique, error) &&
		    player_init(bench, &players[1], bench->options->technique, error) &&
		    add_lights(&players[0], error) && compare(bench, players, error);
	player_finish(&players[0]);
	player_finish(&players[1]);
	return done;
}

/* Whether a pixel's visibility, of which the bytes are high and low, is between none and all. */
static bool is_soft(const uint8_t *pixel)
{
	uint32_t value = 256u * pixel[0] + pixel[1];
	return value > 0 && value < 65535;
}

/* The share of the picture that is in a penumbra of the first light, or next to one. */
static bool find_share(
	const struct bench *bench, struct player *player, double *share, struct sm_error *error)
{
	int size = (int)bench->options->size;
	struct sm_view view = view_of(bench, player, 0);
	uint8_t *pixels = array_zalloc((size_t)size * (size_t)size, 4);
	uint8_t *near = array_zalloc((size_t)size * (size_t)size, 1);
	view.visibility_of = 0;
	bool done = pixels != NULL && near != NULL
			    ? sm_renderer_draw(player->renderer, player->stage.scene, &view, error)
			    : error_set(error, SM_ERROR_MACHINE, "memory");
	size_t count = 0;
	if (done)
		glReadPixels(0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
	for (int i = 0; i < size * size && done; i++) {
		if (!is_soft(&pixels[4 * i]))
			continue;
		for (int y = -NEAR_PIXELS; y <= NEAR_PIXELS; y++)
			for (int x = -NEAR_PIXELS; x <= NEAR_PIXELS; x++) {
				int column = i % size + x, row = i / size + y;
				if (column >= 0 && column < size && row >= 0 && row < size)
					near[row * size + column] = 1;
			}
	}
	for (int i = 0; i < size * size && done; i++)
		count += near[i];
	*share = (double)count / ((double)size * size);
	free(pixels);
	free(near);
	return done;
}

static bool set_radius(struct player *player, float radius, struct sm_error *error)
{
	struct sm_light_desc desc = player->stage.scene->lights[0].desc;
	desc.radius = radius;
	return sm_scene_set_light(player->stage.scene, 0, &desc, error);
}

/* Gives the light a radius with which the share is what it is to be, or as near as none brings it.
 */
static bool set_share(
	const struct bench *bench, struct player *players, double *share, struct sm_error *error)
{
	float low = 0.0f, high = 2.0f * players[0].stage.scene->lights[0].desc.radius;
	bool done = true;
	for (int step = 0; step < 10 && done; step++) {
		float radius = 0.5f * (low + high);
		done = set_radius(&players[0], radius, error) &&
		       set_radius(&players[1], radius, error) &&
		       find_share(bench, &players[0], share, error);
		*(*share < SHARE_NEAR ? &low : &high) = radius;
	}
	return done;
}

/* Few pixels near a penumbra, against hard shadows. */
static bool figure_penumbra(const struct bench *bench, struct sm_error *error)
{
	struct player players[2] = {0};
	double share = 0.0;
	bool done = player_init(bench, &players[0], bench->options->technique, error) &&
		    player_init(bench, &players[1], "hard", error) &&
		    set_share(bench, players, &share, error) && compare(bench, players, error);
	if (done)
		printf("  (%.1f %% near)", 100.0 * share);
	player_finish(&players[0]);
	player_finish(&players[1]);
	return done;
}

static const struct {
	const char *name, *title;
	bool (*run)(const struct bench *bench, struct sm_error *error);
} figures[] = {
	{"view", "the camera alone moves, against textures that are there", figure_view},
	{"lights", "eight lights, one in the view, against one light", figure_lights},
	{"penumbra", "5 % of the pixels near a penumbra, against hard shadows", figure_penumbra},
};

static void usage(FILE *file)
{
	fputs("usage: bench-figures [-f FIGURE] [-s PIXELS] [-m TEXELS] [-n ROUNDS] [-w ROUNDS] "
	      "[-t TECHNIQUE] [SCENE...]\n"
	      "Times, of all processors and by the clock, frames in which there is little to do.\n"
	      "  -f  view, lights or penumbra; all\n"
	      "  -s  pixels a side of the picture (1024)\n"
	      "  -m  texels a side of the shadow map (1024)\n"
	      "  -n  rounds, up to 101; medians are printed (15)\n"
	      "  -w  rounds before these (2); some hundred: until lit triangles are found\n"
	      "  -t  technique (smoothie)\n"
	      "  -p  into a framebuffer that is not sRGB\n",
		file);
}

static bool parse(struct options *options, int argc, char **argv)
{
	int option;
	while ((option = getopt(argc, argv, "f:s:m:n:w:t:ph")) != -1) {
		uint32_t *value = option == 's'   ? &options->size
				  : option == 'm' ? &options->map
				  : option == 'n' ? &options->rounds
				  : option == 'w' ? &options->warm
						  : NULL;
		if (option == 'h') {
			usage(stdout);
			exit(0);
		}
		if (option == 'p')
			options->plain = true;
		else if (option == 't' || option == 'f')
			*(option == 't' ? &options->technique : &options->figure) = optarg;
		else if (value == NULL || (*value = (uint32_t)strtoul(optarg, NULL, 10)) == 0)
			return false;
	}
	return options->rounds <= ROUNDS_MAX && options->warm <= WARM_MAX && options->size <= 4096;
}

static bool run(const struct options *options, char **scenes, int count, struct sm_error *error)
{
	struct bench bench = {.options = options};
	bool done = true;
	init_target(&bench);
	for (size_t i = 0; i < sizeof(figures) / sizeof(figures[0]) && done; i++) {
		if (options->figure != NULL && strcmp(options->figure, figures[i].name) != 0)
			continue;
		printf("%s (%s)\n", figures[i].title, options->technique);
		for (int scene = 0; scene < count && done; scene++) {
			const char *slash = strrchr(scenes[scene], '/');
			bench.source = scenes[scene];
			printf("  %-20s", slash != NULL ? slash + 1 : scenes[scene]);
			done = figures[i].run(&bench, error);
			putchar('\n');
			fflush(stdout);
		}
	}
	glDeleteFramebuffers(1, &bench.framebuffer);
	glDeleteRenderbuffers(2, bench.buffers);
	return done;
}

int main(int argc, char **argv)
{
#define MODEL(name) SMOOTHIE_SHARED "/models/" name ".glb"
	static char *defaults[] = {"builtin:primitives", MODEL("antique-camera"), MODEL("corset"),
		MODEL("ferris-wheel"), MODEL("low-poly-farm"), MODEL("motorcycle"),
		MODEL("shaderball"), MODEL("sheen-chair"), MODEL("ship-light"), MODEL("spot"),
		MODEL("toy-car")};
	struct options options = {
		.size = 1024, .map = 1024, .rounds = 15, .warm = 2, .technique = "smoothie"};
	struct sm_error error = {0};
	if (!parse(&options, argc, argv)) {
		usage(stderr);
		return 2;
	}
	int known = SMOOTHIE_SHARED[0] != '\0' ? (int)(sizeof(defaults) / sizeof(defaults[0])) : 1;
	bool given = optind < argc;
	struct platform *platform = platform_create(NULL, false, &error);
	bool done = platform != NULL && run(&options, given ? argv + optind : defaults,
						given ? argc - optind : known, &error);
	platform_destroy(platform);
	if (!done)
		fprintf(stderr, "bench-figures: %s\n", error.text);
	return done ? 0 : (int)error.status;
}
