/* SPDX-License-Identifier: MIT */
#include "check/gl_kit.h"
#include "platform.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char header[] = "precision highp float;\n"
			     "precision highp int;\n"
			     "precision highp sampler2D;\n"
			     "precision highp isampler2D;\n"
			     "precision highp usampler2D;\n"
			     "precision highp sampler2DArray;\n"
			     "precision highp sampler2DShadow;\n";

static const char screen_vertex[] = "uniform float z;\n"
				    "void main() {\n"
				    "	vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);\n"
				    "	gl_Position = vec4(corner * 4.0 - 1.0, z, 1.0);\n"
				    "}\n";

/* 40503 is odd: no two multiples of it are the same modulo 65536. */
const struct kit_comparison kit_comparisons[KIT_COMPARISONS] = {
	{"never", GL_NEVER, {false, false, false}},
	{"less", GL_LESS, {true, false, false}},
	{"equal", GL_EQUAL, {false, true, false}},
	{"lequal", GL_LEQUAL, {true, true, false}},
	{"greater", GL_GREATER, {false, false, true}},
	{"notequal", GL_NOTEQUAL, {true, false, true}},
	{"gequal", GL_GEQUAL, {false, true, true}},
	{"always", GL_ALWAYS, {true, true, true}},
};

const char kit_value_source[] =
	"vec4 kit_value(int layer) {\n"
	"	uint texel = uint(gl_FragCoord.y) * 64u + uint(gl_FragCoord.x);\n"
	"	uvec4 index = uvec4(0, 1, 2, 3) + 4u * texel + 16384u * uint(layer);\n"
	"	return vec4(index * 40503u & 65535u) / 65536.0;\n"
	"}\n";

float kit_value(size_t texel, int channel, int layer)
{
	uint32_t index = (uint32_t)channel + 4 * (uint32_t)texel + 16384 * (uint32_t)layer;
	return (float)(index * 40503 & 65535) / 65536.0f;
}

void kit_init(struct kit *kit, struct check_result *result)
{
	*kit = (struct kit){.result = result};
	glGenVertexArrays(1, &kit->vertex_array);
	glBindVertexArray(kit->vertex_array);
	glDisable(GL_DITHER);
}

bool kit_finish(struct kit *kit)
{
	GLenum code = glGetError();
	if (code != GL_NO_ERROR && !kit->failed) {
		check_fail(kit->result, "GL has error 0x%04x", code);
		kit->failed = true;
	}
	glDeleteTextures((GLsizei)kit->texture_count, kit->textures);
	glDeleteFramebuffers((GLsizei)kit->framebuffer_count, kit->framebuffers);
	for (size_t i = 0; i < kit->program_count; i++)
		glDeleteProgram(kit->programs[i]);
	glDeleteVertexArrays(1, &kit->vertex_array);
	return !kit->failed;
}

int kit_version(void)
{
	GLint major = 0, minor = 0;
	glGetIntegerv(GL_MAJOR_VERSION, &major);
	glGetIntegerv(GL_MINOR_VERSION, &minor);
	return 10 * major + minor;
}

void kit_need_version(struct kit *kit, int version)
{
	if (kit->failed || kit_version() >= version)
		return;
	check_skip(kit->result, "OpenGL ES %d.%d is needed", version / 10, version % 10);
	kit->failed = true;
}

void kit_need_extension(struct kit *kit, const char *name)
{
	if (kit->failed || platform_has_extension(name))
		return;
	check_skip(kit->result, "%s is needed", name);
	kit->failed = true;
}

GLuint kit_texture(struct kit *kit, GLenum internal_format)
{
	GLuint texture = 0;
	if (kit->failed || kit->texture_count == KIT_NAMES)
		return 0;
	glGenTextures(1, &texture);
	kit->textures[kit->texture_count++] = texture;
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexStorage2D(GL_TEXTURE_2D, 1, internal_format, KIT_SIZE, KIT_SIZE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	return texture;
}

GLuint kit_framebuffer(struct kit *kit, GLuint color, GLuint depth, const char *name)
{
	GLuint framebuffer = 0;
	if (kit->failed || kit->framebuffer_count == KIT_NAMES)
		return 0;
	glGenFramebuffers(1, &framebuffer);
	kit->framebuffers[kit->framebuffer_count++] = framebuffer;
	glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color, 0);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
	glViewport(0, 0, KIT_SIZE, KIT_SIZE);
	GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
	if (status == GL_FRAMEBUFFER_COMPLETE)
		return framebuffer;
	if (name != NULL)
		check_skip(kit->result, "%s cannot be rendered to (status 0x%04x)", name, status);
	else
		check_fail(kit->result, "the framebuffer is not complete (status 0x%04x)", status);
	kit->failed = true;
	return 0;
}

static void compile(struct kit *kit, GLuint program, GLenum stage, int version, const char *source)
{
	char first[32];
	GLint compiled = GL_FALSE;
	snprintf(first, sizeof(first), "#version %d es\n", version);
	/* What it takes must stand before all else. */
	size_t head = strncmp(source, "#extension", 10) == 0 ? strcspn(source, "\n") + 1 : 0;
	GLuint shader = glCreateShader(stage);
	glShaderSource(shader, 4, (const char *[]){first, source, header, source + head},
		(GLint[]){-1, (GLint)head, -1, -1});
	glCompileShader(shader);
	glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
	if (!compiled && !kit->failed) {
		char log[200] = "";
		glGetShaderInfoLog(shader, sizeof(log), NULL, log);
		check_fail(kit->result, "a shader does not compile: %s", log);
		kit->failed = true;
	}
	glAttachShader(program, shader);
	glDeleteShader(shader); /* with the program */
}

GLuint kit_program(struct kit *kit, int version, const char *vertex, const char *fragment)
{
	GLint linked = GL_FALSE;
	if (kit->failed || kit->program_count == KIT_NAMES)
		return 0;
	GLuint program = glCreateProgram();
	kit->programs[kit->program_count++] = program;
	compile(kit, program, GL_VERTEX_SHADER, version, vertex != NULL ? vertex : screen_vertex);
	compile(kit, program, GL_FRAGMENT_SHADER, version, fragment);
	glLinkProgram(program);
	glGetProgramiv(program, GL_LINK_STATUS, &linked);
	if (!linked && !kit->failed) {
		char log[200] = "";
		glGetProgramInfoLog(program, sizeof(log), NULL, log);
		check_fail(kit->result, "a program does not link: %s", log);
		kit->failed = true;
	}
	if (!kit->failed)
		glUseProgram(program);
	return program;
}

static GLint find_uniform(const char *name)
{
	GLint program = 0;
	glGetIntegerv(GL_CURRENT_PROGRAM, &program);
	return glGetUniformLocation((GLuint)program, name);
}

void kit_set_int(struct kit *kit, const char *uniform, GLint value)
{
	if (!kit->failed)
		glUniform1i(find_uniform(uniform), value);
}

void kit_set_float(struct kit *kit, const char *uniform, GLfloat value)
{
	if (!kit->failed)
		glUniform1f(find_uniform(uniform), value);
}

void kit_draw(struct kit *kit, GLsizei vertices)
{
	if (!kit->failed)
		glDrawArrays(GL_TRIANGLES, 0, vertices);
}

void kit_fill(struct kit *kit)
{
	kit_draw(kit, 3);
}

/* Leaves the state of blending, depth and scissor alone that a case has set: it is off here. */
static void draw_plainly(struct kit *kit)
{
	glDisable(GL_BLEND);
	glDisable(GL_DEPTH_TEST);
	glDisable(GL_SCISSOR_TEST);
	glDisable(GL_CULL_FACE);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	kit_fill(kit);
}

void kit_evaluate(struct kit *kit, int version, const char *fragment, uint32_t (*texels)[4])
{
	GLint texture = 0;
	if (kit->failed)
		return;
	glGetIntegerv(GL_TEXTURE_BINDING_2D, &texture);
	GLuint target = kit_texture(kit, GL_RGBA32UI);
	glBindTexture(GL_TEXTURE_2D, (GLuint)texture);
	kit_framebuffer(kit, target, 0, NULL);
	kit_program(kit, version, NULL, fragment);
	draw_plainly(kit);
	glReadPixels(0, 0, KIT_SIZE, KIT_SIZE, GL_RGBA_INTEGER, GL_UNSIGNED_INT, texels);
}

static void fetch(struct kit *kit, GLuint texture, const char *fragment, uint32_t (*texels)[4])
{
	if (kit->failed)
		return;
	glBindTexture(GL_TEXTURE_2D, texture);
	kit_evaluate(kit, 300, fragment, texels);
}

void kit_read(struct kit *kit, GLuint texture, float (*texels)[4])
{
	static const char source[] =
		"uniform sampler2D source;\n"
		"out uvec4 bits;\n"
		"void main() {\n"
		"	bits = floatBitsToUint(texelFetch(source, ivec2(gl_FragCoord.xy), 0));\n"
		"}\n";
	static uint32_t words[KIT_TEXELS][4];
	fetch(kit, texture, source, words);
	memcpy(texels, words, sizeof(words));
}

void kit_read_integers(struct kit *kit, GLuint texture, bool is_signed, uint32_t (*texels)[4])
{
	static const char signed_source[] =
		"uniform isampler2D source;\n"
		"out uvec4 bits;\n"
		"void main() {\n"
		"	bits = uvec4(texelFetch(source, ivec2(gl_FragCoord.xy), 0));\n"
		"}\n";
	static const char unsigned_source[] =
		"uniform usampler2D source;\n"
		"out uvec4 bits;\n"
		"void main() {\n"
		"	bits = texelFetch(source, ivec2(gl_FragCoord.xy), 0);\n"
		"}\n";
	fetch(kit, texture, is_signed ? signed_source : unsigned_source, texels);
}

void kit_compare(struct check_result *result, double drawn, double wanted, double tolerance)
{
	struct check_difference *difference = &result->difference;
	double off = fabs(drawn - wanted);
	/* NaN is off by any measure. */
	off = isnan(off) ? INFINITY : off;
	difference->pixels++;
	difference->tolerance = tolerance;
	difference->failing += off > tolerance;
	difference->mean += off;
	difference->max = fmax(difference->max, off);
}

void kit_judge(struct check_result *result, const char *what)
{
	struct check_difference *difference = &result->difference;
	unsigned long long failing = difference->failing, pixels = difference->pixels;
	if (difference->pixels > 0)
		difference->mean /= (double)difference->pixels;
	if (pixels == 0)
		check_fail(result, "%s: nothing was compared", what);
	else if (failing > difference->budget)
		check_fail(result, "%s: %llu of %llu off by more than %.3g, at most %.3g", what,
			failing, pixels, difference->tolerance, difference->max);
	else
		check_pass(result, "%s: off by %.3g at most, %.3g is allowed", what,
			difference->max, difference->tolerance);
}
