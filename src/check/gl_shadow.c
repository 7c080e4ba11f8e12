/* SPDX-License-Identifier: MIT */
/* Look-ups that compare: what sampler2DShadow says at each function, at the ends of the range, and
 * of four texels at a time. */
#include "check/gl_cases.h"
#include "check/gl_kit.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct format {
	const char *name;
	GLenum internal_format;
} formats[] = {
	{"d16", GL_DEPTH_COMPONENT16},
	{"d24", GL_DEPTH_COMPONENT24},
	{"d32f", GL_DEPTH_COMPONENT32F},
};

/* Depths that every format holds: steps of 1/8, and both ends. */
static const char depth_fragment[] = "void main() {\n"
				     "	ivec2 p = ivec2(gl_FragCoord.xy);\n"
				     "	int step = (p.x * 5 + p.y * 3 + p.x * p.y) & 7;\n"
				     "	gl_FragDepth = step == 7 ? 1.0 : float(step) / 8.0;\n"
				     "}\n";

static double depth_at(size_t texel)
{
	int x = (int)(texel % KIT_SIZE), y = (int)(texel / KIT_SIZE);
	int step = (x * 5 + y * 3 + x * y) & 7;
	return step == 7 ? 1 : step / 8.0;
}

static size_t neighbour(size_t texel, size_t dx, size_t dy)
{
	size_t x = texel % KIT_SIZE + dx, y = texel / KIT_SIZE + dy;
	x = x < KIT_SIZE ? x : KIT_SIZE - 1;
	y = y < KIT_SIZE ? y : KIT_SIZE - 1;
	return y * KIT_SIZE + x;
}

static void make_map(struct kit *kit, GLenum internal_format, GLint func, GLint filter)
{
	GLuint texture = kit_texture(kit, internal_format);
	kit_framebuffer(kit, 0, texture, NULL);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(GL_ALWAYS);
	kit_program(kit, 300, NULL, depth_fragment);
	kit_fill(kit);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, func);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
}

/* Evaluates a vec4, of `map` and the pixel's centre `at`. */
static void evaluate(struct kit *kit, int version, const char *expression, float (*found)[4])
{
	static uint32_t bits[KIT_TEXELS][4];
	char source[500];
	snprintf(source, sizeof(source),
		"uniform sampler2DShadow map;\n"
		"out uvec4 bits;\n"
		"void main() {\n"
		"	vec2 at = gl_FragCoord.xy / 64.0;\n"
		"	bits = floatBitsToUint(%s);\n"
		"}\n",
		expression);
	kit_evaluate(kit, version, source, bits);
	memcpy(found, bits, sizeof(bits));
}

/* Against a depth that fixed point has: 0.5 is none of D24's, so that equality takes floats. */
static void run_function(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static float found[KIT_TEXELS][4];
	const struct kit_comparison *function = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	make_map(&kit, GL_DEPTH_COMPONENT32F, (GLint)function->func, GL_NEAREST);
	evaluate(&kit, 300, "vec4(texture(map, vec3(at, 0.5)))", found);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++) {
		double depth = depth_at(i);
		int order = .5 < depth ? 0 : .5 > depth ? 2 : 1;
		kit_compare(result, found[i][0], function->holds[order], 0);
	}
	if (kit_finish(&kit))
		kit_judge(result, "comparisons");
}

static double passes(double reference, size_t texel)
{
	return reference <= depth_at(texel);
}

/* References that no depth is near to, and the ends of the range. */
static const struct reference {
	const char *name, *text;
	double value; /* clamped, as fixed-point formats do */
} references[] = {
	{"middle", "0.3", .3},
	{"zero", "0.0", 0},
	{"one", "1.0", 1},
	{"beyond", "1.5", 1},
	{"below", "-0.5", 0},
};

static void run_reference(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static float found[KIT_TEXELS][4];
	const struct format *format = item->subject;
	const struct reference *reference = &references[item->choice[0]];
	char expression[100];
	struct kit kit;
	(void)context;
	snprintf(expression, sizeof(expression), "vec4(texture(map, vec3(at, %s)))",
		reference->text);
	kit_init(&kit, result);
	make_map(&kit, format->internal_format, GL_LEQUAL, GL_NEAREST);
	evaluate(&kit, 300, expression, found);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		kit_compare(result, found[i][0], passes(reference->value, i), 0);
	if (kit_finish(&kit))
		kit_judge(result, "comparisons");
}

/* At a quarter of a texel's side the weights are 9, 3, 3 and 1 of 16. ES leaves it to the driver
 * whether it blends comparisons: one that does not is held to what all four agree on. */
static double blend(size_t texel, bool blended, double found)
{
	double near = passes(.3, texel), across = passes(.3, neighbour(texel, 1, 0));
	double up = passes(.3, neighbour(texel, 0, 1)), far = passes(.3, neighbour(texel, 1, 1));
	if (blended)
		return (9 * near + 3 * across + 3 * up + far) / 16;
	return near == across && near == up && near == far ? near : found >= .5;
}

static void run_linear(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static float found[KIT_TEXELS][4];
	const struct format *format = item->subject;
	struct kit kit;
	bool blended = false;
	(void)context;
	kit_init(&kit, result);
	make_map(&kit, format->internal_format, GL_LEQUAL, GL_LINEAR);
	evaluate(&kit, 300, "vec4(texture(map, vec3(at + 0.25 / 64.0, 0.3)))", found);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		blended = blended || (found[i][0] > 0 && found[i][0] < 1);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		kit_compare(result, found[i][0], blend(i, blended, found[i][0]), 1 / 128.0);
	if (kit_finish(&kit))
		kit_judge(
			result, blended ? "four comparisons, blended" : "comparisons, not blended");
}

static void run_gather(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static const size_t order[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
	static float found[KIT_TEXELS][4];
	const struct format *format = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	kit_need_version(&kit, 31);
	make_map(&kit, format->internal_format, GL_LEQUAL, GL_LINEAR);
	evaluate(&kit, 310, "textureGather(map, at + 0.5 / 64.0, 0.3)", found);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		for (int c = 0; c < 4; c++)
			kit_compare(result, found[i][c],
				passes(.3, neighbour(i, order[c][0], order[c][1])), 0);
	if (kit_finish(&kit))
		kit_judge(result, "four comparisons");
}

void gl_shadow_cases(struct check_list *list)
{
	for (size_t i = 0; i < KIT_COMPARISONS; i++)
		check_list_add(list, run_function, &kit_comparisons[i], "shadow.func.%s",
			kit_comparisons[i].name);
	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++) {
		for (size_t j = 0; j < sizeof(references) / sizeof(references[0]); j++) {
			/* Floats are not clamped. */
			if (j >= 3 && formats[i].internal_format == GL_DEPTH_COMPONENT32F)
				continue;
			struct check_case *item = check_list_add(list, run_reference, &formats[i],
				"shadow.%s.%s", formats[i].name, references[j].name);
			if (item != NULL)
				item->choice[0] = j;
		}
		check_list_add(list, run_linear, &formats[i], "shadow.%s.linear", formats[i].name);
		check_list_add(list, run_gather, &formats[i], "shadow.%s.gather", formats[i].name);
	}
}
