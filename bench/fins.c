/* SPDX-License-Identifier: MIT */
/* What it takes to hand fins over and make quads of them: as the renderer does, as records of which
 * the vertex shader makes quads, and as vertices that the processor makes. Interleaved in one run;
 * the target is so small that fragments hardly count. */
#include "base/error.h"
#include "bench/statistics.h"
#include "load/stage.h"
#include "platform.h"
#include "renderer.h"
#include "technique/fin_stream.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define MAP_SIZE 1024 /* that fins are found for */
#define TARGET_SIZE 16
#define ROUNDS 101

enum way { RECORDS, VERTICES, WAYS };

struct bench {
	struct stage stage;
	struct sm_renderer *renderer;
	struct fin_stream fins;
	struct upload_ring ring; /* of vertices */
	GLuint array;            /* of them */
	struct fin_vertex *vertices;
	struct target target;
	struct program programs[WAYS];
};

static const char vertex[] = "#version 300 es\n"
			     "layout(location = 0) in vec3 position;\n"
			     "layout(location = 1) in vec3 offset_width;\n"
			     "out vec2 fin_offset; out float fin_width;\n"
			     "void main() { gl_Position = vec4(position, 1.0);\n"
			     "	fin_offset = offset_width.xy; fin_width = offset_width.z; }\n";
static const char fragment[] =
	"#version 300 es\n"
	"precision highp float; in vec2 fin_offset; in float fin_width; out vec4 alpha;\n"
	"void main() { alpha = vec4(length(fin_offset) / abs(fin_width)); }\n";

static void attach(struct gl *gl, GLuint program, GLenum stage, size_t count, const char **parts)
{
	GLuint shader = gl->CreateShader(stage);
	gl->ShaderSource(shader, (GLsizei)count, parts, NULL);
	gl->CompileShader(shader);
	gl->AttachShader(program, shader);
	gl->DeleteShader(shader);
}

static void make_program(struct gl *gl, struct program *program, size_t count, const char **parts)
{
	program->name = gl->CreateProgram();
	attach(gl, program->name, GL_VERTEX_SHADER, count, parts);
	attach(gl, program->name, GL_FRAGMENT_SHADER, 1, (const char *[]){fragment});
	gl->LinkProgram(program->name);
	program->uniform.fin_law = gl->GetUniformLocation(program->name, "fin_law");
	program->uniform.fin_quads = gl->GetUniformLocation(program->name, "fin_quads");
	program->uniform.both_sides = gl->GetUniformLocation(program->name, "both_sides");
}

static bool draw_vertices(struct bench *bench, struct sm_error *error)
{
	struct gpu *gpu = &bench->renderer->gpu;
	const GLsizei size = sizeof(*bench->vertices);
	size_t count = 0;
	for (size_t i = 0; i < bench->fins.set.count; i++)
		count += fin_set_expand(&bench->fins.set, i, bench->vertices + count);
	gpu->gl.BindVertexArray(bench->array);
	upload_ring_turn(
		&bench->ring, &gpu->gl, STORAGE_FINS, GL_ARRAY_BUFFER, count * (size_t)size);
	gpu->gl.BufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)count * size, bench->vertices);
	for (GLuint i = 0; i < 2; i++) {
		const void *at = (const void *)(i * offsetof(struct fin_vertex, offset));
		gpu->gl.EnableVertexAttribArray(i);
		gpu->gl.VertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, size, at);
	}
	return gpu_draw_quads(gpu, count / 4, error);
}

/* Of all threads, since the driver may be some. */
static double now_ms(struct gl *gl)
{
	struct timespec now;
	gl->Finish();
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
	return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

static bool draw(struct bench *bench, enum way way, double *time, struct sm_error *error)
{
	struct gpu *gpu = &bench->renderer->gpu;
	const struct program *program = &bench->programs[way];
	const struct screen_box all = screen_box_all();
	target_bind(&bench->target, &gpu->gl);
	gpu->gl.UseProgram(program->name);
	double start = now_ms(&gpu->gl);
	bool drawn = way == VERTICES
			     ? draw_vertices(bench, error)
			     : fin_stream_upload(&bench->fins, gpu, &bench->target, &all, error) &&
				       fin_stream_draw(&bench->fins, gpu, program, error);
	*time = now_ms(&gpu->gl) - start;
	return drawn;
}

static bool measure(struct bench *bench, const struct fin_shape *shape, struct sm_error *error)
{
	struct fin_set *set = &bench->fins.set;
	struct light_frame frame;
	double times[WAYS][ROUNDS];
	light_frame_init(&frame, &bench->stage.scene->lights[0].desc, bench->stage.scene);
	if (!fin_set_find(set, bench->stage.scene, &frame, shape, MAP_SIZE, true))
		return error_no_memory(error);
	size_t vertices = 4 * fin_set_quads(set);
	bench->vertices = malloc((vertices + 1) * sizeof(*bench->vertices));
	bool drawn = bench->vertices != NULL || error_no_memory(error);
	/* The first round compiles, and is overwritten. */
	for (int round = -1; round < ROUNDS && drawn; round++)
		for (int way = 0; way < WAYS && drawn; way++)
			drawn = draw(bench, way, &times[way][abs(round)], error);
	free(bench->vertices);
	double edges = (double)set->edge_count;
	if (drawn)
		printf("  %-10s  records %6.1f %8.3f   vertices %6.1f %8.3f\n",
			shape->both_sides ? "both sides" : "outside",
			(double)(set->count * sizeof(struct fin)) / edges,
			statistics_median(times[RECORDS], ROUNDS),
			(double)(vertices * sizeof(struct fin_vertex)) / edges,
			statistics_median(times[VERTICES], ROUNDS));
	return drawn;
}

static bool run(struct bench *bench, const char *source, struct sm_error *error)
{
	static const struct fin_shape outside = {.share = SMOOTHIE_WIDTH_SHARE};
	static const struct fin_shape both = {.share = 1.0f, .apron = 1.5f, .both_sides = true};
	const char *records[SHADER_PARTS_MAX], *plain = vertex;
	const struct program_key key = {.kind = PROGRAM_FIN};
	struct gpu *gpu = &bench->renderer->gpu;
	fin_stream_init(&bench->fins, gpu);
	bench->array = gl_create_vertex_array(&gpu->gl);
	make_program(&gpu->gl, &bench->programs[RECORDS], shader_parts(key, STAGE_VERTEX, records),
		records);
	make_program(&gpu->gl, &bench->programs[VERTICES], 1, &plain);
	printf("%s: bytes an edge, and ms\n", source);
	return target_init(&bench->target, &gpu->gl, STORAGE_SMOOTHIES, TARGET_SIZE, GL_RGBA8,
		       GL_COLOR_ATTACHMENT0, error) &&
	       stage_load(&bench->stage, source, NULL, 0, error) &&
	       measure(bench, &outside, error) && measure(bench, &both, error);
}

static void finish(struct bench *bench)
{
	struct gpu *gpu = &bench->renderer->gpu;
	stage_finish(&bench->stage);
	target_finish(&bench->target, &gpu->gl);
	upload_ring_finish(&bench->ring, &gpu->gl);
	fin_stream_finish(&bench->fins, gpu);
	gl_delete_vertex_array(&gpu->gl, &bench->array);
	for (int way = 0; way < WAYS; way++)
		gpu->gl.DeleteProgram(bench->programs[way].name);
	sm_renderer_destroy(bench->renderer);
}

int main(int argc, char *argv[])
{
	struct bench bench = {0};
	struct sm_error error = {0};
	struct platform *platform = platform_create(NULL, false, &error);
	if (platform != NULL)
		bench.renderer = sm_renderer_create(platform_get_proc, &error);
	bool done = bench.renderer != NULL &&
		    run(&bench, argc > 1 ? argv[1] : "builtin:urchin", &error);
	if (bench.renderer != NULL)
		finish(&bench);
	platform_destroy(platform);
	if (!done)
		fprintf(stderr, "bench-fins: %s\n", error.text);
	return done ? 0 : 1;
}
