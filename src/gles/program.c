/* SPDX-License-Identifier: MIT */
#include "gles/program.h"
#include "base/array.h"
#include "base/log.h"
#include "gles/gpu_scene.h"
#include "gles/texture_unit.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void log_numbered_source(const char *const *parts, size_t count)
{
	int number = 1;
	for (size_t i = 0; i < count; i++) {
		for (const char *line = parts[i]; *line != '\0';) {
			int length = (int)strcspn(line, "\n");
			log_error("%4d  %.*s", number++, length, line);
			line += length + (line[length] == '\n');
		}
	}
}

static GLuint compile(
	struct gl *gl, struct program_key key, enum shader_stage stage, struct sm_error *error)
{
	const char *parts[SHADER_PARTS_MAX];
	size_t count = shader_parts(key, stage, parts);
	GLuint shader =
		gl->CreateShader(stage == STAGE_VERTEX ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
	gl->ShaderSource(shader, (GLsizei)count, parts, NULL);
	gl->CompileShader(shader);
	GLint compiled = GL_FALSE;
	gl->GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
	if (compiled)
		return shader;
	char name[320], info[1000] = "";
	gl->GetShaderInfoLog(shader, sizeof(info), NULL, info);
	log_numbered_source(parts, count);
	log_error("%s", info);
	error_set(error, SM_ERROR_MACHINE, "the driver does not compile the %s shader of \"%s\"",
		stage == STAGE_VERTEX ? "vertex" : "fragment",
		program_key_name(key, name, sizeof(name)));
	gl->DeleteShader(shader);
	return 0;
}

static void bind_attributes(struct gl *gl, GLuint name)
{
	gl->BindAttribLocation(name, ATTRIBUTE_POSITION, "position");
	gl->BindAttribLocation(name, ATTRIBUTE_NORMAL, "normal");
	gl->BindAttribLocation(name, ATTRIBUTE_UV, "uv");
}

static bool link_program(struct gl *gl, GLuint name, struct program_key key, struct sm_error *error)
{
	GLuint vertex = compile(gl, key, STAGE_VERTEX, error);
	GLuint fragment = vertex != 0 ? compile(gl, key, STAGE_FRAGMENT, error) : 0;
	GLint linked = GL_FALSE;
	if (fragment != 0) {
		gl->AttachShader(name, vertex);
		gl->AttachShader(name, fragment);
		bind_attributes(gl, name);
		gl->LinkProgram(name);
		gl->GetProgramiv(name, GL_LINK_STATUS, &linked);
		if (!linked) {
			char text[400], info[1000] = "";
			gl->GetProgramInfoLog(name, sizeof(info), NULL, info);
			log_error("%s", info);
			error_set(error, SM_ERROR_MACHINE, "the driver does not link \"%s\"",
				program_key_name(key, text, sizeof(text)));
		}
	}
	gl->DeleteShader(vertex);
	gl->DeleteShader(fragment);
	return linked;
}

/* Samplers never change their unit. */
static void set_samplers(struct gl *gl, const struct program *program)
{
	gl->UseProgram(program->name);
	gl->Uniform1i(program->uniform.base_texture, UNIT_BASE);
	gl->Uniform1i(program->uniform.depth_compare, UNIT_DEPTH_COMPARE);
	gl->Uniform1i(program->uniform.depth_map, UNIT_DEPTH);
	gl->Uniform1i(program->uniform.receiver_map, UNIT_RECEIVER);
	gl->Uniform1i(program->uniform.smoothie_map, UNIT_SMOOTHIE);
	gl->Uniform1i(program->uniform.smoothie_words, UNIT_SMOOTHIE_WORDS);
	gl->Uniform1i(program->uniform.smoothie_depth, UNIT_SMOOTHIE_DEPTH);
	gl->Uniform1i(program->uniform.falloff, UNIT_FALLOFF);
	gl->Uniform1i(program->uniform.fin_map, UNIT_FINS);
	gl->Uniform1i(program->uniform.depth_layers, UNIT_DEPTH_LAYERS);
	gl->Uniform1i(program->uniform.moment_map, UNIT_MOMENTS);
	gl->Uniform1i(program->uniform.plain_layers, UNIT_PLAIN_LAYERS);
	gl->Uniform1i(program->uniform.primitives, UNIT_PRIMITIVES);
	gl->Uniform1i(program->uniform.visibility_map, UNIT_VISIBILITY);
	gl->Uniform1i(program->uniform.visibility_depth, UNIT_VISIBILITY_DEPTH);
	gl->Uniform1i(program->uniform.edge_tiles, UNIT_EDGE_TILES);
	gl->Uniform1i(program->uniform.edge_runs, UNIT_EDGE_RUNS);
	gl->Uniform1i(program->uniform.edge_map, UNIT_EDGES);
	gl->Uniform1i(program->uniform.front_layer, UNIT_FRONT_LAYER);
	gl->Uniform1i(program->uniform.second_layer, UNIT_SECOND_LAYER);
	gl->Uniform1i(program->uniform.third_layer, UNIT_THIRD_LAYER);
	gl->Uniform1i(program->uniform.disc_masks, UNIT_DISC_MASKS);
	gl->Uniform1i(program->uniform.point_map, UNIT_POINTS);
	gl->Uniform1i(program->uniform.cell_map, UNIT_CELLS);
}

/* From the caller's store if it can be. */
static bool make_program(struct program_cache *cache, struct gl *gl, GLuint name,
	struct program_key key, struct sm_error *error)
{
	if (program_binary_load(&cache->binaries, gl, name, key)) {
		cache->loaded++;
		return true;
	}
	program_binary_announce(&cache->binaries, gl, name);
	if (!link_program(gl, name, key, error))
		return false;
	cache->compiled++;
	program_binary_save(&cache->binaries, gl, name, key);
	return true;
}

static struct program *program_create(
	struct program_cache *cache, struct gl *gl, struct program_key key, struct sm_error *error)
{
	struct program *program = calloc(1, sizeof(*program));
	if (program == NULL) {
		error_no_memory(error);
		return NULL;
	}
	program->key = key;
	program->name = gl_create_program(gl);
	if (!make_program(cache, gl, program->name, key, error)) {
		gl_delete_program(gl, &program->name);
		free(program);
		return NULL;
	}
#define UNIFORM_LOCATION(member) \
	program->uniform.member = gl->GetUniformLocation(program->name, #member);
	UNIFORMS(UNIFORM_LOCATION)
#undef UNIFORM_LOCATION
	set_samplers(gl, program);
	return program;
}

const struct program *program_use(
	struct program_cache *cache, struct gl *gl, struct program_key key, struct sm_error *error)
{
	for (size_t i = 0; i < cache->count; i++) {
		struct program *program = cache->programs[i];
		if (program->key.kind == key.kind && program->key.flags == key.flags) {
			gl->UseProgram(program->name);
			return program;
		}
	}
	if (!array_reserve((void **)&cache->programs, &cache->capacity, cache->count + 1,
		    sizeof(struct program *))) {
		error_no_memory(error);
		return NULL;
	}
	struct program *program = program_create(cache, gl, key, error);
	if (program != NULL)
		cache->programs[cache->count++] = program;
	return program;
}

void program_cache_finish(struct program_cache *cache, struct gl *gl)
{
	for (size_t i = 0; i < cache->count; i++) {
		gl_delete_program(gl, &cache->programs[i]->name);
		free(cache->programs[i]);
	}
	free(cache->programs);
	*cache = (struct program_cache){0};
}
