/* SPDX-License-Identifier: MIT */
/* Colour formats as targets and textures: what becomes of a value that is written, MIN blending,
 * and filtering. Each texel of each channel has a value of its own. */
#include "check/gl_cases.h"
#include "check/gl_kit.h"
#include "platform.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum kind {
	NORMALIZED,
	FLOAT,
};

/* Bits of a channel: all of them, or those of a float's mantissa. */
struct format {
	const char *name;
	GLenum internal_format;
	enum kind kind;
	int bits[4];           /* 0: no such channel */
	const char *extension; /* that takes it for a target; NULL: core */
	const char *blending;  /* that takes blending; NULL: none */
	const char *filtering; /* that takes linear filters; NULL: core */
};

#define FLOATS "GL_EXT_color_buffer_float"
#define BLENDS "GL_EXT_float_blend"
#define FILTERS "GL_OES_texture_float_linear"

static const struct format formats[] = {
	{"r8", GL_R8, NORMALIZED, {8}, NULL, NULL, NULL},
	{"rg8", GL_RG8, NORMALIZED, {8, 8}, NULL, NULL, NULL},
	{"rgb565", GL_RGB565, NORMALIZED, {5, 6, 5}, NULL, NULL, NULL},
	{"rgba4", GL_RGBA4, NORMALIZED, {4, 4, 4, 4}, NULL, NULL, NULL},
	{"rgb8", GL_RGB8, NORMALIZED, {8, 8, 8}, NULL, NULL, NULL},
	{"rgba8", GL_RGBA8, NORMALIZED, {8, 8, 8, 8}, NULL, NULL, NULL},
	{"rgb10_a2", GL_RGB10_A2, NORMALIZED, {10, 10, 10, 2}, NULL, NULL, NULL},
	{"r16f", GL_R16F, FLOAT, {10}, FLOATS, NULL, NULL},
	{"rg16f", GL_RG16F, FLOAT, {10, 10}, FLOATS, NULL, NULL},
	{"rgba16f", GL_RGBA16F, FLOAT, {10, 10, 10, 10}, FLOATS, NULL, NULL},
	{"r11f_g11f_b10f", GL_R11F_G11F_B10F, FLOAT, {6, 6, 5}, FLOATS, NULL, NULL},
	{"r32f", GL_R32F, FLOAT, {23}, FLOATS, BLENDS, FILTERS},
	{"rg32f", GL_RG32F, FLOAT, {23, 23}, FLOATS, BLENDS, FILTERS},
	{"rgba32f", GL_RGBA32F, FLOAT, {23, 23, 23, 23}, FLOATS, BLENDS, FILTERS},
};

static const char value_fragment[] = "uniform int layer;\n"
				     "out vec4 color;\n"
				     "void main() {\n"
				     "	color = kit_value(layer);\n"
				     "}\n";
static const char least_fragment[] =
	"out vec4 color;\n"
	"void main() {\n"
	"	color = min(min(kit_value(0), kit_value(1)), min(kit_value(2), kit_value(3)));\n"
	"}\n";

static const char fetch_fragment[] = "#extension GL_EXT_shader_framebuffer_fetch : require\n"
				     "uniform int layer;\n"
				     "inout vec4 color;\n"
				     "void main() {\n"
				     "	color = min(color, kit_value(layer));\n"
				     "}\n";

#define LAYERS 4

static void use(struct kit *kit, const char *fragment)
{
	char source[1000];
	size_t head = fragment[0] == '#' ? strcspn(fragment, "\n") + 1 : 0;
	snprintf(source, sizeof(source), "%.*s%s%s", (int)head, fragment, kit_value_source,
		fragment + head);
	kit_program(kit, 300, NULL, source);
}

/* The distance of values that a channel can hold, about that value. */
static double step(const struct format *format, int channel, double value)
{
	int bits = format->bits[channel];
	if (format->kind == NORMALIZED)
		return 1 / (exp2(bits) - 1);
	/* 5 bits of exponent: no step is less than that of 2^-14. Floats have smaller ones than
	 * any value here. */
	return exp2(fmax(floor(log2(value)), -14) - bits);
}

/* A target of the format; what the driver does not claim may be skipped. */
static GLuint make_target(struct kit *kit, const struct format *format)
{
	bool claimed = format->extension == NULL || platform_has_extension(format->extension);
	GLuint texture = kit_texture(kit, format->internal_format);
	kit_framebuffer(kit, texture, 0, claimed ? NULL : format->name);
	return texture;
}

static void draw_values(struct kit *kit, int layer)
{
	use(kit, value_fragment);
	kit_set_int(kit, "layer", layer);
	kit_fill(kit);
}

static double toward_zero(double drawn, double wanted)
{
	return wanted - drawn;
}

/* A value is stored within a step of the format: either neighbour will do. */
static void run_rounding(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static float texels[KIT_TEXELS][4];
	const struct format *format = item->subject;
	struct kit kit;
	double lost = 0, count = 0;
	(void)context;
	kit_init(&kit, result);
	GLuint texture = make_target(&kit, format);
	draw_values(&kit, 0);
	kit_read(&kit, texture, texels);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		for (int c = 0; c < 4 && format->bits[c] > 0; c++) {
			double wanted = kit_value(i, c, 0), unit = step(format, c, wanted);
			kit_compare(result, texels[i][c] / unit, wanted / unit, 1);
			lost += toward_zero(texels[i][c] / unit, wanted / unit);
			count++;
		}
	if (kit_finish(&kit))
		kit_judge(result,
			lost / count > .25 ? "steps, truncated" : "steps, rounded to the nearest");
}

static void draw_layers(struct kit *kit, const char *fragment)
{
	static const GLfloat one[4] = {1, 1, 1, 1};
	if (kit->failed)
		return;
	glClearBufferfv(GL_COLOR, 0, one);
	use(kit, fragment);
	for (int layer = 0; layer < LAYERS; layer++) {
		kit_set_int(kit, "layer", layer);
		kit_fill(kit);
	}
}

static void blend_least(struct kit *kit)
{
	glEnable(GL_BLEND);
	glBlendEquation(GL_MIN);
	draw_layers(kit, value_fragment);
}

/* Formats round monotonically, so the least of what is stored is what the least is stored as. */
static void judge_least(struct kit *kit, const struct format *format, GLuint texture)
{
	static float found[KIT_TEXELS][4], computed[KIT_TEXELS][4];
	kit_read(kit, texture, found);
	texture = make_target(kit, format);
	use(kit, least_fragment);
	kit_fill(kit);
	kit_read(kit, texture, computed);
	for (size_t i = 0; !kit->failed && i < KIT_TEXELS; i++)
		for (int c = 0; c < 4 && format->bits[c] > 0; c++)
			kit_compare(kit->result, found[i][c], computed[i][c], 0);
	if (kit_finish(kit))
		kit_judge(kit->result, "the least of four layers");
}

static void run_min(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	const struct format *format = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	if (format->blending != NULL)
		kit_need_extension(&kit, format->blending);
	GLuint texture = make_target(&kit, format);
	blend_least(&kit);
	judge_least(&kit, format, texture);
}

/* Taken by the shader, of floats, which can be stored again as they were read. */
static void run_min_fetch(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	const struct format *format = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	kit_need_extension(&kit, "GL_EXT_shader_framebuffer_fetch");
	GLuint texture = make_target(&kit, format);
	draw_layers(&kit, fetch_fragment);
	judge_least(&kit, format, texture);
}

/* A colour mask keeps MIN from channels that are not written. */
static void run_min_mask(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static float texels[KIT_TEXELS][4];
	static const GLfloat zero[4] = {0, 0, 0, 0};
	const struct format *format = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	if (format->blending != NULL)
		kit_need_extension(&kit, format->blending);
	GLuint texture = make_target(&kit, format);
	glColorMask(GL_TRUE, GL_FALSE, GL_FALSE, GL_FALSE);
	blend_least(&kit);
	glColorMask(GL_FALSE, GL_TRUE, GL_TRUE, GL_TRUE);
	if (!kit.failed)
		glClearBufferfv(GL_COLOR, 0, zero);
	kit_read(&kit, texture, texels);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++) {
		double least = fmin(fmin(kit_value(i, 0, 0), kit_value(i, 0, 1)),
			fmin(kit_value(i, 0, 2), kit_value(i, 0, 3)));
		double unit = step(format, 0, least);
		kit_compare(result, texels[i][0] / unit, least / unit, 1);
		for (int c = 1; c < 4 && format->bits[c] > 0; c++)
			kit_compare(result, texels[i][c], 0, 1);
	}
	if (kit_finish(&kit))
		kit_judge(result, "steps, red alone");
}

static void run_clear(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static float texels[KIT_TEXELS][4];
	static const GLfloat color[4] = {.375f, .75f, .1875f, 1};
	const struct format *format = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	GLuint texture = make_target(&kit, format);
	if (!kit.failed)
		glClearBufferfv(GL_COLOR, 0, color);
	kit_read(&kit, texture, texels);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		for (int c = 0; c < 4 && format->bits[c] > 0; c++) {
			double unit = step(format, c, color[c]);
			kit_compare(result, texels[i][c] / unit, color[c] / unit, 1);
		}
	if (kit_finish(&kit))
		kit_judge(result, "steps of a cleared texel");
}

/* Half-way between texels a linear filter weighs them alike: ES leaves the driver 1/256 of the
 * difference. */
static void run_linear(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static const char source[] =
		"uniform sampler2D source;\n"
		"out uvec4 bits;\n"
		"void main() {\n"
		"	vec2 at = (floor(gl_FragCoord.xy) + vec2(1.0, 0.5)) / 64.0;\n"
		"	bits = floatBitsToUint(texture(source, at));\n"
		"}\n";
	static float stored[KIT_TEXELS][4], filtered[KIT_TEXELS][4];
	static uint32_t bits[KIT_TEXELS][4];
	const struct format *format = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	if (format->filtering != NULL)
		kit_need_extension(&kit, format->filtering);
	GLuint texture = make_target(&kit, format);
	draw_values(&kit, 0);
	kit_read(&kit, texture, stored);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	kit_evaluate(&kit, 300, source, bits);
	memcpy(filtered, bits, sizeof(filtered));
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++) {
		size_t right = i % KIT_SIZE < KIT_SIZE - 1 ? i + 1 : i; /* clamped to the edge */
		for (int c = 0; c < 4 && format->bits[c] > 0; c++)
			kit_compare(result, filtered[i][c], (stored[i][c] + stored[right][c]) / 2.0,
				1 / 128.0);
	}
	if (kit_finish(&kit))
		kit_judge(result, "the mean of two texels");
}

void gl_format_cases(struct check_list *list)
{
	static const struct {
		const char *name;
		check_function run;
	} checks[] = {
		{"rounding", run_rounding},
		{"min", run_min},
		{"min-mask", run_min_mask},
		{"clear", run_clear},
		{"linear", run_linear},
	};
	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++) {
		for (size_t j = 0; j < sizeof(checks) / sizeof(checks[0]); j++)
			check_list_add(list, checks[j].run, &formats[i], "format.%s.%s",
				formats[i].name, checks[j].name);
		if (formats[i].kind == FLOAT)
			check_list_add(list, run_min_fetch, &formats[i], "format.%s.min-fetch",
				formats[i].name);
	}
}
