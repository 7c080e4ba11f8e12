/* SPDX-License-Identifier: MIT */
/* Time of whole frames, a technique against the other and against the limits of their passes,
 * interleaved in one run so that the ratios hold on a machine whose speed drifts. */
#include "base/array.h"
#include "bench/statistics.h"
#include "load/stage.h"
#include "platform.h"
#include "renderer.h"
#include "scene/camera.h"
#include "technique/depth_map.h"
#include <GLES3/gl3.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* What is timed, one after the other, in each round. */
enum contender {
	FRAME_PCF,
	FRAME_SMOOTHIE,
	FRAME_KEPT, /* likewise, but with what the light saw before */
	LIGHT_DEPTH,
	VIEW_DEPTH,
	FULL_SCREEN,
	CONTENDERS,
};

#define FRAMES 3

static const char *const contender_names[CONTENDERS] = {
	"frame with pcf",
	"frame with smoothie",
	"the same, light kept",
	"bare depth pass, light",
	"bare depth pass, camera",
	"bare full-screen pass",
};

struct options {
	uint32_t size, map, rounds;
	uint32_t only;         /* a contender alone, counted from 1; 0: all */
	const char *technique; /* instead of smoothie */
};

/* A scene, and all that draws it. */
struct bench {
	struct stage stage;
	struct sm_renderer *renderers[FRAMES]; /* of the contenders that are frames */
	struct depth_map depths[2];            /* made by renderer 0: light's size, and picture's */
	struct light_frame light, view;        /* the camera as if it were a light */
	GLuint framebuffer, buffers[2];
	double *times[CONTENDERS]; /* [rounds] ms */
	uint32_t size;
};

/* The cheapest shaded pass that has a shadow: one compared look-up a pixel. */
static const char full_screen_vertex[] =
	"#version 300 es\n"
	"out vec2 uv;\n"
	"void main() {\n"
	"	vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);\n"
	"	uv = 2.0 * corner;\n"
	"	gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);\n"
	"}\n";
static const char full_screen_fragment[] =
	"#version 300 es\n"
	"precision highp float;\n"
	"uniform highp sampler2DShadow depth_compare;\n"
	"in vec2 uv;\n"
	"out vec4 color;\n"
	"void main() { color = vec4(textureLod(depth_compare, vec3(uv, 0.5), 0.0)); }\n";

static GLuint full_screen_program(void)
{
	GLuint program = glCreateProgram();
	const struct {
		GLenum stage;
		const char *text;
	} shaders[] = {
		{GL_VERTEX_SHADER, full_screen_vertex}, {GL_FRAGMENT_SHADER, full_screen_fragment}};
	for (int i = 0; i < 2; i++) {
		GLuint shader = glCreateShader(shaders[i].stage);
		glShaderSource(shader, 1, &shaders[i].text, NULL);
		glCompileShader(shader);
		glAttachShader(program, shader);
		glDeleteShader(shader);
	}
	glLinkProgram(program);
	return program;
}

static double now_ms(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

static bool draw_frame(struct bench *bench, enum contender contender, struct sm_error *error)
{
	struct sm_view view = {
		.camera = bench->stage.camera,
		.framebuffer = bench->framebuffer,
		.width = bench->size,
		.height = bench->size,
		.visibility_of = SM_NONE,
	};
	return sm_renderer_draw(bench->renderers[contender], bench->stage.scene, &view, error);
}

/* Nothing but the casters' triangles, front and back, into a depth texture. */
static bool draw_depth(struct bench *bench, int which, struct sm_error *error)
{
	struct gpu *gpu = &bench->renderers[0]->gpu;
	const struct sm_scene *scene = bench->stage.scene;
	const struct light_frame *frame = which == 0 ? &bench->light : &bench->view;
	struct program_key key = {.kind = PROGRAM_DEPTH_MAP};
	const struct program *program = program_use(&gpu->programs, &gpu->gl, key, error);
	if (program == NULL)
		return false;
	target_bind(&bench->depths[which].target, &gpu->gl);
	glEnable(GL_DEPTH_TEST);
	glClear(GL_DEPTH_BUFFER_BIT);
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		mat4 to_clip;
		if (!object->casts)
			continue;
		glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform, to_clip);
		glUniformMatrix4fv(program->uniform.object_to_clip, 1, GL_FALSE, to_clip[0]);
		gpu_draw_caster(gpu, &gpu->scene.meshes[object->mesh]);
	}
	glBindVertexArray(0);
	return true;
}

static void draw_full_screen(struct bench *bench, GLuint program)
{
	glBindFramebuffer(GL_FRAMEBUFFER, bench->framebuffer);
	glViewport(0, 0, (GLsizei)bench->size, (GLsizei)bench->size);
	glDisable(GL_DEPTH_TEST);
	glUseProgram(program);
	glBindVertexArray(0);
	glActiveTexture(GL_TEXTURE0);
	glBindTexture(GL_TEXTURE_2D, bench->depths[0].target.texture);
	glBindSampler(0, bench->depths[0].compare);
	glDrawArrays(GL_TRIANGLES, 0, 3);
	glBindSampler(0, 0);
}

static bool draw(
	struct bench *bench, enum contender contender, GLuint program, struct sm_error *error)
{
	bool drawn = true;
	if (contender < FRAMES)
		drawn = draw_frame(bench, contender, error);
	else if (contender == FULL_SCREEN)
		draw_full_screen(bench, program);
	else
		drawn = draw_depth(bench, contender == VIEW_DEPTH, error);
	glFinish();
	return drawn;
}

static void init_target(struct bench *bench)
{
	GLsizei size = (GLsizei)bench->size;
	glGenFramebuffers(1, &bench->framebuffer);
	glGenRenderbuffers(2, bench->buffers);
	glBindFramebuffer(GL_FRAMEBUFFER, bench->framebuffer);
	glBindRenderbuffer(GL_RENDERBUFFER, bench->buffers[0]);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size, size);
	glFramebufferRenderbuffer(
		GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, bench->buffers[0]);
	glBindRenderbuffer(GL_RENDERBUFFER, bench->buffers[1]);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size, size);
	glFramebufferRenderbuffer(
		GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, bench->buffers[1]);
}

static bool bench_init(struct bench *bench, const char *source, const struct options *options,
	struct sm_error *error)
{
	*bench = (struct bench){.size = options->size};
	if (!stage_load(&bench->stage, source, NULL, 0, error))
		return false;
	if (sm_scene_light_count(bench->stage.scene) == 0)
		return error_set(error, SM_ERROR_INPUT, "%s has no light", source);
	for (int i = 0; i < FRAMES; i++) {
		struct sm_shadow_options shadow = {
			.technique = i == FRAME_PCF ? "pcf" : options->technique,
			.map_size = options->map};
		bench->renderers[i] = sm_renderer_create(platform_get_proc, error);
		if (bench->renderers[i] == NULL ||
			!sm_renderer_set_skips(bench->renderers[i],
				i == FRAME_KEPT ? NULL : "-all,+receiver", error) ||
			!sm_renderer_set_shadows(bench->renderers[i], &shadow, error))
			return false;
	}
	init_target(bench);
	light_frame_init(&bench->light, &bench->stage.scene->lights[0].desc, bench->stage.scene);
	if (!camera_world_to_clip(&bench->stage.camera, bench->stage.scene, bench->size,
		    bench->size, bench->view.world_to_clip, error) ||
		!depth_map_init(&bench->depths[0], &bench->renderers[0]->gpu, options->map,
			DEPTH_MAP_LINEAR, false, error) ||
		!depth_map_init(&bench->depths[1], &bench->renderers[0]->gpu, bench->size,
			DEPTH_MAP_LINEAR, false, error))
		return false;
	for (int i = 0; i < CONTENDERS; i++) {
		bench->times[i] = array_zalloc(options->rounds, sizeof(double));
		if (bench->times[i] == NULL)
			return error_no_memory(error);
	}
	return true;
}

static void bench_finish(struct bench *bench)
{
	glDeleteFramebuffers(1, &bench->framebuffer);
	glDeleteRenderbuffers(2, bench->buffers);
	for (int i = 0; i < CONTENDERS; i++)
		free(bench->times[i]);
	for (int i = 0; i < 2 && bench->renderers[0] != NULL; i++)
		depth_map_finish(&bench->depths[i], &bench->renderers[0]->gpu);
	for (int i = 0; i < FRAMES; i++)
		sm_renderer_destroy(bench->renderers[i]);
	stage_finish(&bench->stage);
}

static bool run_rounds(
	struct bench *bench, const struct options *options, GLuint program, struct sm_error *error)
{
	/* The first two rounds compile every variant and settle the caches. */
	for (uint32_t round = 0; round < options->rounds + 2; round++) {
		for (int i = 0; i < CONTENDERS; i++) {
			if (round >= 2 && options->only != 0 && (int)options->only != i + 1)
				continue;
			double start = now_ms();
			if (!draw(bench, i, program, error))
				return false;
			if (round >= 2)
				bench->times[i][round - 2] = now_ms() - start;
		}
	}
	return true;
}

static void report(const char *source, struct bench *bench, const struct options *options)
{
	double ms[CONTENDERS];
	struct sm_frame_stats stats;
	sm_renderer_get_stats(bench->renderers[FRAME_SMOOTHIE], &stats);
	printf("%s\n", source);
	for (int i = 0; i < CONTENDERS; i++) {
		ms[i] = statistics_median(bench->times[i], options->rounds);
		printf("  %-24s %8.2f ms\n", contender_names[i], ms[i]);
	}
	double limit = ms[LIGHT_DEPTH] + ms[VIEW_DEPTH] + ms[FULL_SCREEN];
	printf("  %-24s %8.2f ms\n", "silhouettes and fins", stats.silhouette_ms);
	printf("  smoothie / pcf: %.2f\n", ms[FRAME_SMOOTHIE] / ms[FRAME_PCF]);
	printf("  light kept / smoothie: %.2f\n", ms[FRAME_KEPT] / ms[FRAME_SMOOTHIE]);
	printf("  pcf / (both depth passes + full-screen pass): %.2f\n", ms[FRAME_PCF] / limit);
	printf("  pcf / (light's depth pass + full-screen pass): %.2f\n",
		ms[FRAME_PCF] / (ms[LIGHT_DEPTH] + ms[FULL_SCREEN]));
	fflush(stdout);
}

static bool run(const char *source, const struct options *options, struct sm_error *error)
{
	struct bench bench;
	GLuint program = full_screen_program();
	bool done = bench_init(&bench, source, options, error) &&
		    run_rounds(&bench, options, program, error);
	if (done)
		report(source, &bench, options);
	bench_finish(&bench);
	glDeleteProgram(program);
	return done;
}

static void usage(FILE *file)
{
	fputs("usage: bench-frame [-s PIXELS] [-m TEXELS] [-n ROUNDS] [-t TECHNIQUE] [SCENE...]\n"
	      "Times frames with smoothies, with a filtered map, and the passes they cannot do "
	      "without.\n"
	      "  -s  pixels a side of the picture (1024)\n"
	      "  -m  texels a side of the shadow map (1024)\n"
	      "  -n  rounds; medians are printed (15)\n"
	      "  -t  instead of smoothie\n"
	      "  -o  one of them alone, from 1, for a profiler\n",
		file);
}

static bool parse(struct options *options, int argc, char **argv)
{
	int option;
	while ((option = getopt(argc, argv, "s:m:n:o:t:h")) != -1) {
		uint32_t *value = option == 's'   ? &options->size
				  : option == 'm' ? &options->map
				  : option == 'n' ? &options->rounds
				  : option == 'o' ? &options->only
						  : NULL;
		if (option == 'h') {
			usage(stdout);
			exit(0);
		}
		if (option == 't')
			options->technique = optarg;
		else if (value == NULL || (*value = (uint32_t)strtoul(optarg, NULL, 10)) == 0)
			return false;
	}
	return true;
}

int main(int argc, char **argv)
{
	static char *defaults[] = {"builtin:primitives", SMOOTHIE_SHARED "/models/sheen-chair.glb",
		SMOOTHIE_SHARED "/models/toy-car.glb"};
	struct options options = {.size = 1024, .map = 1024, .rounds = 15, .technique = "smoothie"};
	struct sm_error error;
	if (!parse(&options, argc, argv)) {
		usage(stderr);
		return 2;
	}
	struct platform *platform = platform_create(NULL, false, &error);
	bool done = platform != NULL;
	bool given = optind < argc;
	int count = given ? argc - optind : SMOOTHIE_SHARED[0] != '\0' ? 3 : 1;
	for (int i = 0; i < count && done; i++)
		done = run(given ? argv[optind + i] : defaults[i], &options, &error);
	platform_destroy(platform);
	if (!done)
		fprintf(stderr, "bench-frame: %s\n", error.text);
	return done ? 0 : (int)error.status;
}
