/* SPDX-License-Identifier: MIT */
/*
 * The functions of shaders_es/exact_*.glsl, on the driver that the environment chooses, against
 * those of fixed/number.h, bit for bit. test-fixed-number-gles [STRIDE]: leaves operands out, for
 * slow drivers; an odd stride keeps all low digits.
 */
#include "fixed/number.h"
#include "gles/shader_source.h"
#include "platform.h"
#include <GLES3/gl3.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A grid's columns and rows, of which a stride leaves some out. */
#define GRID_SIZE 2048u
#define READ_ROWS 64u

static uint32_t stride = 1;

/* first + x column + y row, and no more than last. */
struct span {
	uint32_t first, column, row, last;
};

struct grid {
	uint32_t rows;
	struct span a, b;
	uint32_t t;
};

typedef uint32_t (*evaluate)(const struct number_model *model, uint32_t a, uint32_t b, uint32_t t);

#define EVALUATE(name, call)                                                          \
	static uint32_t evaluate_##name(                                              \
		const struct number_model *model, uint32_t a, uint32_t b, uint32_t t) \
	{                                                                             \
		(void)b, (void)t;                                                     \
		return model->call;                                                   \
	}
EVALUATE(ratio, ratio(a, b))
EVALUATE(div, div(a, b))
EVALUATE(mul, mul(a, b))
EVALUATE(add, add(a, b))
EVALUATE(rest, rest(a))
EVALUATE(lerp, lerp(a, b, t))
EVALUATE(weight, weight(a))
EVALUATE(index, index(a))
EVALUATE(bytes, bytes(a))

enum function { RATIO, DIV, MUL, ADD, REST, LERP, WEIGHT, INDEX, BYTES, FUNCTIONS };

static const struct {
	const char *call; /* in GLSL */
	evaluate evaluate;
} functions[FUNCTIONS] = {
	[RATIO] = {"num_ratio(a, b)", evaluate_ratio},
	[DIV] = {"num_div(a, b)", evaluate_div},
	[MUL] = {"num_mul(a, b)", evaluate_mul},
	[ADD] = {"num_add(a, b)", evaluate_add},
	[REST] = {"num_rest(a)", evaluate_rest},
	[LERP] = {"num_lerp(a, b, t)", evaluate_lerp},
	[WEIGHT] = {"num_weight(a)", evaluate_weight},
	[INDEX] = {"num_index(a)", evaluate_index},
	[BYTES] = {"num_bytes(a)", evaluate_bytes},
};

/* One triangle over all of the viewport. */
static const char vertex_source[] =
	"#version 300 es\n"
	"void main()\n"
	"{\n"
	"	vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;\n"
	"	gl_Position = vec4(corner, 0.0, 1.0);\n"
	"}\n";

static const char main_source[] =
	"uniform uvec4 a_span, b_span;\n"
	"uniform uint t, stride;\n"
	"out uint result;\n"
	"uint in_span(uvec4 span, uvec2 place)\n"
	"{\n"
	"	return min(span.x + span.y * place.x + span.z * place.y, span.w);\n"
	"}\n"
	"void main()\n"
	"{\n"
	"	uvec2 place = uvec2(gl_FragCoord.xy) * stride;\n"
	"	uint a = in_span(a_span, place), b = in_span(b_span, place);\n"
	"	result = CALL;\n"
	"}\n";

static const char *shader_text(const char *name)
{
	for (const struct shader_file *file = shader_files; file->name != NULL; file++)
		if (strcmp(file->name, name) == 0)
			return file->text;
	fail_msg("there is no shader file %s", name);
	return NULL;
}

static void attach_shader(GLuint program, GLenum stage, GLsizei count, const char *const *parts)
{
	GLuint shader = glCreateShader(stage);
	glShaderSource(shader, count, parts, NULL);
	glCompileShader(shader);
	GLint fine;
	glGetShaderiv(shader, GL_COMPILE_STATUS, &fine);
	char log[1000] = "";
	glGetShaderInfoLog(shader, sizeof(log), NULL, log);
	if (!fine)
		fail_msg("%s", log);
	glAttachShader(program, shader);
	glDeleteShader(shader);
}

static GLuint make_program(const struct number_model *model, enum function function)
{
	char file[40], define[60];
	snprintf(file, sizeof(file), "exact_%s.glsl", model->name);
	snprintf(define, sizeof(define), "#define CALL %s\n", functions[function].call);
	const char *parts[] = {"#version 300 es\n", shader_text("common_precision.glsl"),
		shader_text("exact_number.glsl"), shader_text(file), define, main_source};
	GLuint program = glCreateProgram();
	attach_shader(program, GL_VERTEX_SHADER, 1, (const char *const[]){vertex_source});
	attach_shader(program, GL_FRAGMENT_SHADER, sizeof(parts) / sizeof(parts[0]), parts);
	glLinkProgram(program);
	GLint fine;
	glGetProgramiv(program, GL_LINK_STATUS, &fine);
	assert_true(fine);
	glUseProgram(program);
	return program;
}

/* Numbers 0, stride, 2 stride... below count. */
static uint32_t strided(uint32_t count)
{
	return (count + stride - 1) / stride;
}

static void set_span(GLuint program, const char *name, struct span span)
{
	glUniform4ui(
		glGetUniformLocation(program, name), span.first, span.column, span.row, span.last);
}

static void draw(GLuint program, const struct grid *grid)
{
	set_span(program, "a_span", grid->a);
	set_span(program, "b_span", grid->b);
	glUniform1ui(glGetUniformLocation(program, "t"), grid->t);
	glUniform1ui(glGetUniformLocation(program, "stride"), stride);
	glViewport(0, 0, (GLsizei)strided(GRID_SIZE), (GLsizei)strided(grid->rows));
	glDrawArrays(GL_TRIANGLES, 0, 3);
}

static uint32_t in_span(struct span span, uint32_t x, uint32_t y)
{
	uint32_t value = span.first + span.column * x + span.row * y;
	return value < span.last ? value : span.last;
}

static void compare_row(const struct number_model *model, enum function function,
	const struct grid *grid, uint32_t y, const uint32_t (*row)[4])
{
	for (uint32_t x = 0; x < GRID_SIZE; x += stride) {
		uint32_t a = in_span(grid->a, x, y), b = in_span(grid->b, x, y);
		uint32_t wanted = functions[function].evaluate(model, a, b, grid->t);
		uint32_t result = row[x / stride][0];
		if (result != wanted)
			fail_msg("%s: %s of 0x%x, 0x%x, 0x%x gives 0x%x, not 0x%x", model->name,
				functions[function].call, a, b, grid->t, result, wanted);
	}
}

static void compare(
	const struct number_model *model, enum function function, const struct grid *grid)
{
	static uint32_t pixels[READ_ROWS][GRID_SIZE][4];
	uint32_t width = strided(GRID_SIZE), height = strided(grid->rows);
	glPixelStorei(GL_PACK_ROW_LENGTH, GRID_SIZE);
	for (uint32_t bottom = 0; bottom < height; bottom += READ_ROWS) {
		uint32_t rows = height - bottom < READ_ROWS ? height - bottom : READ_ROWS;
		glReadPixels(0, (GLint)bottom, (GLsizei)width, (GLsizei)rows, GL_RGBA_INTEGER,
			GL_UNSIGNED_INT, pixels);
		for (uint32_t y = 0; y < rows; y++)
			compare_row(model, function, grid, (bottom + y) * stride,
				(const uint32_t(*)[4])pixels[y]);
	}
	assert_int_equal(glGetError(), GL_NO_ERROR);
}

static void check(const struct number_model *model, enum function function,
	const struct grid *grids, size_t count)
{
	GLuint program = make_program(model, function);
	for (size_t i = 0; i < count; i++) {
		draw(program, &grids[i]);
		compare(model, function, &grids[i]);
	}
	glDeleteProgram(program);
}

static const struct number_model *models[] = {&number_fixed12, &number_half};

#define INTEGER_LAST ((1u << 22) - 1)

/* Of small integers, and of large ones in steps. */
static void ratios_are_the_same(void **state)
{
	(void)state;
	const struct span small = {0, 1, 0, GRID_SIZE}, large = {3, 2047, 0, INTEGER_LAST};
	const struct span by_small = {1, 0, 1, GRID_SIZE};
	const struct span by_large = {1, 0, 2047, INTEGER_LAST};
	const struct grid grids[] = {
		{GRID_SIZE, small, by_small, 0},
		{GRID_SIZE, large, by_large, 0},
		{GRID_SIZE, large, by_small, 0},
		{GRID_SIZE, small, by_large, 0},
	};
	for (size_t i = 0; i < 2; i++)
		check(models[i], RATIO, grids, sizeof(grids) / sizeof(grids[0]));
}

/* All pairs of numbers. */
static void fixed12_operations_are_the_same(void **state)
{
	(void)state;
	const struct grid grid = {GRID_SIZE, {0, 1, 0, 2047}, {0, 0, 1, 2047}, 0};
	check(&number_fixed12, DIV, &grid, 1);
	check(&number_fixed12, MUL, &grid, 1);
	check(&number_fixed12, ADD, &grid, 1);
}

/* Exponent as it is stored. */
static uint32_t half_of(uint32_t exponent)
{
	return exponent << 10;
}

static void half_operations_are_the_same(void **state)
{
	(void)state;
	const uint32_t largest = number_half.largest;
	struct grid grids[21];
	size_t count = 0;
	/* All numbers with 256 others. */
	for (uint32_t first = 0; first <= largest; first += GRID_SIZE)
		grids[count++] = (struct grid){
			256, {first, 1, 0, largest}, {first / GRID_SIZE, 0, 124, largest}, 0};
	/* All digits with all others, of two exponents each, down to subnormals. */
	for (uint32_t exponent = 16; exponent < 20; exponent -= 4)
		grids[count++] = (struct grid){GRID_SIZE, {half_of(16), 1, 0, largest},
			{half_of(exponent), 0, 1, largest}, 0};
	assert_true(count <= sizeof(grids) / sizeof(grids[0]));
	check(&number_half, DIV, grids, count);
	check(&number_half, MUL, grids, count);
	check(&number_half, ADD, grids, count);
}

/* All numbers up to 1. */
static void functions_of_one_number_are_the_same(void **state)
{
	(void)state;
	for (size_t i = 0; i < 2; i++) {
		uint32_t one = models[i]->one, rows = one / GRID_SIZE + 1;
		const struct grid grid = {rows, {0, 1, GRID_SIZE, one}, {0}, 0};
		check(models[i], REST, &grid, 1);
		check(models[i], INDEX, &grid, 1);
		check(models[i], BYTES, &grid, 1);
		const struct grid weights = {1, {0, 1, 0, 1023}, {0}, 0};
		check(models[i], WEIGHT, &weights, 1);
	}
}

static void blends_are_the_same(void **state)
{
	(void)state;
	for (size_t i = 0; i < 2; i++) {
		uint32_t one = models[i]->one, step = one / GRID_SIZE + 1;
		struct grid grids[5];
		const uint32_t weights[] = {0, 1, one / 3, one - one / 16, one - 1};
		for (size_t j = 0; j < 5; j++)
			grids[j] = (struct grid){
				one / step + 1, {0, step, 0, one}, {0, 0, step, one}, weights[j]};
		check(models[i], LERP, grids, 5);
	}
}

struct canvas {
	struct platform *platform;
	GLuint buffer, framebuffer, vertices;
};

static int set_up(void **state)
{
	struct sm_error error = {0};
	static struct canvas canvas;
	*state = &canvas;
	canvas.platform = platform_create("surfaceless", true, &error);
	if (canvas.platform == NULL)
		fail_msg("%s", error.text);
	print_message("%s\n", (const char *)glGetString(GL_RENDERER));
	glGenVertexArrays(1, &canvas.vertices);
	glBindVertexArray(canvas.vertices);
	glGenRenderbuffers(1, &canvas.buffer);
	glBindRenderbuffer(GL_RENDERBUFFER, canvas.buffer);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_R32UI, GRID_SIZE, GRID_SIZE);
	glGenFramebuffers(1, &canvas.framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer);
	glFramebufferRenderbuffer(
		GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, canvas.buffer);
	assert_int_equal(glCheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
	return 0;
}

static int tear_down(void **state)
{
	struct canvas *canvas = *state;
	glDeleteFramebuffers(1, &canvas->framebuffer);
	glDeleteRenderbuffers(1, &canvas->buffer);
	glDeleteVertexArrays(1, &canvas->vertices);
	platform_destroy(canvas->platform);
	return 0;
}

int main(int argc, char **argv)
{
	if (argc > 1)
		stride = (uint32_t)strtoul(argv[1], NULL, 10);
	if (stride == 0 || stride > GRID_SIZE)
		return 2;
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(ratios_are_the_same),
		cmocka_unit_test(fixed12_operations_are_the_same),
		cmocka_unit_test(half_operations_are_the_same),
		cmocka_unit_test(functions_of_one_number_are_the_same),
		cmocka_unit_test(blends_are_the_same),
	};
	return cmocka_run_group_tests(tests, set_up, tear_down);
}
