/* SPDX-License-Identifier: MIT */
/* Depth: what of it is stored, which test lets what through, and the least of several as a depth
 * test finds it. */
#include "check/gl_cases.h"
#include "check/gl_kit.h"
#include <math.h>
#include <string.h>

struct format {
	const char *name;
	GLenum internal_format;
	int bits; /* 0: floats */
};

static const struct format formats[] = {
	{"d16", GL_DEPTH_COMPONENT16, 16},
	{"d24", GL_DEPTH_COMPONENT24, 24},
	{"d32f", GL_DEPTH_COMPONENT32F, 0},
	{"d24s8", GL_DEPTH24_STENCIL8, 24},
	{"d32fs8", GL_DEPTH32F_STENCIL8, 0},
};

static const char value_fragment[] = "uniform int layer;\n"
				     "void main() {\n"
				     "	gl_FragDepth = kit_value(layer).r;\n"
				     "}\n";

static void use_values(struct kit *kit)
{
	char source[1000];
	strcpy(source, kit_value_source);
	strcat(source, value_fragment);
	kit_program(kit, 300, NULL, source);
}

static GLuint make_target(struct kit *kit, const struct format *format, GLenum func)
{
	GLuint texture = kit_texture(kit, format->internal_format);
	kit_framebuffer(kit, 0, texture, NULL);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(func);
	return texture;
}

/* A fixed-point depth is within a step, since ES asks for no rounding; a float one is exact. */
static double tolerance(const struct format *format)
{
	return format->bits > 0 ? 1 / (exp2(format->bits) - 1) : 0;
}

static void run_rounding(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static float texels[KIT_TEXELS][4];
	const struct format *format = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	GLuint texture = make_target(&kit, format, GL_ALWAYS);
	use_values(&kit);
	kit_fill(&kit);
	kit_read(&kit, texture, texels);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		kit_compare(result, texels[i][0], kit_value(i, 0, 0), tolerance(format));
	if (kit_finish(&kit))
		kit_judge(result, "gl_FragDepth");
}

static void run_min(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static float texels[KIT_TEXELS][4];
	static const GLfloat one = 1;
	const struct format *format = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	GLuint texture = make_target(&kit, format, GL_LESS);
	glClearBufferfv(GL_DEPTH, 0, &one);
	use_values(&kit);
	for (int layer = 0; layer < 4; layer++) {
		kit_set_int(&kit, "layer", layer);
		kit_fill(&kit);
	}
	kit_read(&kit, texture, texels);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++) {
		double least = fmin(fmin(kit_value(i, 0, 0), kit_value(i, 0, 1)),
			fmin(kit_value(i, 0, 2), kit_value(i, 0, 3)));
		kit_compare(result, texels[i][0], least, tolerance(format));
	}
	if (kit_finish(&kit))
		kit_judge(result, "the least of four layers");
}

static void run_clear(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static float texels[KIT_TEXELS][4];
	static const GLfloat depth = .71875f;
	const struct format *format = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	GLuint texture = make_target(&kit, format, GL_LESS);
	glClearBufferfv(GL_DEPTH, 0, &depth);
	kit_read(&kit, texture, texels);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		kit_compare(result, texels[i][0], depth, tolerance(format));
	if (kit_finish(&kit))
		kit_judge(result, "a cleared texel");
}

/* A slope of depth, as triangles have it. */
static void run_slope(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static const char vertex[] =
		"void main() {\n"
		"	vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;\n"
		"	gl_Position = vec4(corner, corner.x * 0.5 + corner.y * 0.25, 1.0);\n"
		"}\n";
	static float texels[KIT_TEXELS][4];
	const struct format *format = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	GLuint texture = make_target(&kit, format, GL_ALWAYS);
	kit_program(&kit, 300, vertex, "void main() {}\n");
	kit_fill(&kit);
	kit_read(&kit, texture, texels);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++) {
		double x = (i % KIT_SIZE + .5) / KIT_SIZE * 2 - 1;
		double y = (i / KIT_SIZE + .5) / KIT_SIZE * 2 - 1;
		/* Interpolation has a few roundings of floats in [0, 1] of its own. */
		kit_compare(result, texels[i][0], (x * .5 + y * .25) / 2 + .5,
			tolerance(format) + 8 * exp2(-24));
	}
	if (kit_finish(&kit))
		kit_judge(result, "a slope");
}

/* Three thirds of the screen are nearer, as far, and farther than what is there. */
static void run_test(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static const char fragment[] =
		"out vec4 color;\n"
		"void main() {\n"
		"	int third = int(gl_FragCoord.x) * 3 / 64;\n"
		"	gl_FragDepth = third == 0 ? 0.25 : third == 1 ? 0.5 : 0.75;\n"
		"	color = vec4(1);\n"
		"}\n";
	static float texels[KIT_TEXELS][4];
	static const GLfloat depth = .5f, zero[4] = {0, 0, 0, 0};
	const struct kit_comparison *test = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	GLuint color = kit_texture(&kit, GL_RGBA8);
	/* Floats, for 24 bits have no half. */
	kit_framebuffer(&kit, color, kit_texture(&kit, GL_DEPTH_COMPONENT32F), NULL);
	glClearBufferfv(GL_COLOR, 0, zero);
	glClearBufferfv(GL_DEPTH, 0, &depth);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(test->func);
	kit_program(&kit, 300, NULL, fragment);
	kit_fill(&kit);
	kit_read(&kit, color, texels);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		kit_compare(result, texels[i][0], test->holds[i % KIT_SIZE * 3 / KIT_SIZE], 0);
	if (kit_finish(&kit))
		kit_judge(result, "which pixels are drawn");
}

/* Depth that is not to be written stays, though the test is done. */
static void run_mask(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static float texels[KIT_TEXELS][4];
	static const GLfloat depth = .5f;
	struct kit kit;
	(void)item;
	(void)context;
	kit_init(&kit, result);
	GLuint texture = make_target(&kit, &formats[2], GL_LESS);
	glClearBufferfv(GL_DEPTH, 0, &depth);
	glDepthMask(GL_FALSE);
	use_values(&kit);
	kit_fill(&kit);
	glDepthMask(GL_TRUE);
	kit_read(&kit, texture, texels);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		kit_compare(result, texels[i][0], depth, 0);
	if (kit_finish(&kit))
		kit_judge(result, "depth under a mask");
}

void gl_depth_cases(struct check_list *list)
{
	static const struct {
		const char *name;
		check_function run;
	} checks[] = {
		{"rounding", run_rounding},
		{"min", run_min},
		{"clear", run_clear},
		{"slope", run_slope},
	};
	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
		for (size_t j = 0; j < sizeof(checks) / sizeof(checks[0]); j++)
			check_list_add(list, checks[j].run, &formats[i], "depth.%s.%s",
				formats[i].name, checks[j].name);
	for (size_t i = 0; i < KIT_COMPARISONS; i++)
		check_list_add(list, run_test, &kit_comparisons[i], "depth.test.%s",
			kit_comparisons[i].name);
	check_list_add(list, run_mask, NULL, "depth.mask");
}
