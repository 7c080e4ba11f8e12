/* SPDX-License-Identifier: MIT */
/* Arithmetic of fragment shaders, in highp: floats as near as GLSL ES 3.20, section 4.7.1, asks,
 * integers to the bit; and whether a driver keeps less where less is asked. */
#include "check/gl_cases.h"
#include "check/gl_kit.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* A function of two floats. */
struct operation {
	const char *name, *expression; /* of a and b */
	double (*truth)(double a, double b);
	double ulps; /* of the truth, that it may be off; 0: exact */
	double absolute;
};

static double add(double a, double b)
{
	return a + b;
}

static double subtract(double a, double b)
{
	return a - b;
}

static double multiply(double a, double b)
{
	return a * b;
}

static double divide(double a, double b)
{
	return a / b;
}

static double inverse(double a, double b)
{
	(void)b;
	return 1 / a;
}

static double root(double a, double b)
{
	(void)b;
	return sqrt(a);
}

static double inverse_root(double a, double b)
{
	(void)b;
	return 1 / sqrt(a);
}

static double power_of_two(double a, double b)
{
	(void)b;
	return exp2(a / 16);
}

static double logarithm(double a, double b)
{
	(void)b;
	return log2(a + 2);
}

static double whole(double a, double b)
{
	(void)b;
	return floor(a - 8);
}

static double part(double a, double b)
{
	(void)b;
	return a - floor(a);
}

static double toward_zero(double a, double b)
{
	(void)b;
	return trunc(a - 8);
}

static double sign_of(double a, double b)
{
	return a > b ? 1 : a < b ? -1 : 0;
}

static double at_least(double a, double b)
{
	return a < b ? 0 : 1;
}

static double clamped(double a, double b)
{
	(void)b;
	return fmin(fmax(a, 2), 9);
}

static double cosine(double a, double b)
{
	(void)b;
	return cos(a / 16 * 3.140625);
}

/* a and b are 1/16 to 16. */
static const struct operation operations[] = {
	/* Correctly rounded, either way. */
	{"add", "a + b", add, 1, 0},
	{"subtract", "a - b", subtract, 1, 0},
	{"multiply", "a * b", multiply, 1, 0},
	{"divide", "a / b", divide, 2.5, 0},
	{"inverse", "1.0 / a", inverse, 2.5, 0},
	/* As 1 / inversesqrt(). */
	{"sqrt", "sqrt(a)", root, 5, 0},
	{"inversesqrt", "inversesqrt(a)", inverse_root, 2, 0},
	/* 3 + 2 |x| */
	{"exp2", "exp2(a / 16.0)", power_of_two, 5, 0},
	{"log2", "log2(a + 2.0)", logarithm, 3, 0},
	{"floor", "floor(a - 8.0)", whole, 0, 0},
	{"fract", "fract(a)", part, 0, 0},
	{"trunc", "trunc(a - 8.0)", toward_zero, 0, 0},
	{"min", "min(a, b)", fmin, 0, 0},
	{"max", "max(a, b)", fmax, 0, 0},
	{"clamp", "clamp(a, 2.0, 9.0)", clamped, 0, 0},
	{"sign", "sign(a - b)", sign_of, 0, 0},
	{"step", "step(b, a)", at_least, 0, 0},
	{"to-int", "float(int(a - 8.0))", toward_zero, 0, 0},
	{"cos", "cos(a / 16.0 * 3.140625)", cosine, 0, 0x1p-11},
};

/* Rounds to float as a store does, so that the truth is of the very operands. */
static float operand(size_t texel, int channel)
{
	return (float)exp2(kit_value(texel, channel, 0) * 8 - 4);
}

static double unit_of(const struct operation *operation, double truth)
{
	if (operation->ulps == 0 || truth == 0)
		return 1;
	return exp2(floor(log2(fabs(truth))) - 23);
}

static void upload_operands(struct kit *kit)
{
	static float texels[KIT_TEXELS][4];
	if (kit->failed)
		return;
	for (size_t i = 0; i < KIT_TEXELS; i++)
		for (int c = 0; c < 4; c++)
			texels[i][c] = operand(i, c);
	kit_texture(kit, GL_RGBA32F);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, KIT_SIZE, KIT_SIZE, GL_RGBA, GL_FLOAT, texels);
}

static void run_operation(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static uint32_t bits[KIT_TEXELS][4];
	const struct operation *operation = item->subject;
	char source[500];
	struct kit kit;
	(void)context;
	snprintf(source, sizeof(source),
		"uniform sampler2D operands;\n"
		"out uvec4 bits;\n"
		"void main() {\n"
		"	vec4 given = texelFetch(operands, ivec2(gl_FragCoord.xy), 0);\n"
		"	float a = given.r, b = given.g;\n"
		"	bits = uvec4(floatBitsToUint(%s));\n"
		"}\n",
		operation->expression);
	kit_init(&kit, result);
	upload_operands(&kit);
	kit_evaluate(&kit, 300, source, bits);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++) {
		float drawn;
		memcpy(&drawn, &bits[i][0], sizeof(drawn));
		double truth = operation->truth(operand(i, 0), operand(i, 1));
		double unit = unit_of(operation, truth);
		/* The truth itself is between floats. */
		kit_compare(
			result, drawn / unit, truth / unit, operation->ulps + operation->absolute);
	}
	if (kit_finish(&kit))
		kit_judge(result, operation->ulps > 0 ? "last places" : "values");
}

/* A function of two integers, u and v unsigned, or i and j the same bits signed. */
struct integer_operation {
	const char *name, *expression;
	uint32_t (*truth)(uint32_t u, uint32_t v);
};

static uint32_t int_add(uint32_t u, uint32_t v)
{
	return u + v;
}

static uint32_t int_multiply(uint32_t u, uint32_t v)
{
	return u * v;
}

static uint32_t uint_divide(uint32_t u, uint32_t v)
{
	return u / ((v & 0xffff) + 1);
}

static uint32_t uint_modulo(uint32_t u, uint32_t v)
{
	return u % ((v & 0xffff) + 1);
}

static uint32_t int_divide(uint32_t u, uint32_t v)
{
	return (uint32_t)((int32_t)u / (int32_t)((v & 0xffff) + 1));
}

static uint32_t shift_left(uint32_t u, uint32_t v)
{
	return u << (v & 31);
}

static uint32_t uint_shift_right(uint32_t u, uint32_t v)
{
	return u >> (v & 31);
}

static uint32_t int_shift_right(uint32_t u, uint32_t v)
{
	return (uint32_t)((int32_t)u >> (v & 31));
}

static uint32_t logic(uint32_t u, uint32_t v)
{
	return (u & v) ^ (~u | v);
}

static uint32_t int_less(uint32_t u, uint32_t v)
{
	return (int32_t)u < (int32_t)v;
}

static uint32_t uint_less(uint32_t u, uint32_t v)
{
	return u < v;
}

static uint32_t int_clamp(uint32_t u, uint32_t v)
{
	int32_t i = (int32_t)u;
	(void)v;
	return (uint32_t)(i < -2048 ? -2048 : i > 2047 ? 2047 : i);
}

/* 24 bits: what a float has. */
static uint32_t int_to_float(uint32_t u, uint32_t v)
{
	(void)v;
	return u & 0xffffff;
}

static const struct integer_operation integer_operations[] = {
	{"int-add", "uint(i + j)", int_add},
	{"uint-add", "u + v", int_add},
	{"int-multiply", "uint(i * j)", int_multiply},
	{"uint-multiply", "u * v", int_multiply},
	{"uint-divide", "u / ((v & 65535u) + 1u)", uint_divide},
	{"uint-modulo", "u % ((v & 65535u) + 1u)", uint_modulo},
	{"int-divide", "uint(i / ((j & 65535) + 1))", int_divide},
	{"shift-left", "u << (v & 31u)", shift_left},
	{"uint-shift-right", "u >> (v & 31u)", uint_shift_right},
	{"int-shift-right", "uint(i >> (j & 31))", int_shift_right},
	{"logic", "(u & v) ^ (~u | v)", logic},
	{"int-less", "i < j ? 1u : 0u", int_less},
	{"uint-less", "u < v ? 1u : 0u", uint_less},
	{"int-clamp", "uint(clamp(i, -2048, 2047))", int_clamp},
	{"float-of-int", "uint(int(float(i & 16777215)))", int_to_float},
};

static uint32_t integer_operand(size_t texel, int channel)
{
	uint32_t bits = (4 * (uint32_t)texel + (uint32_t)channel + 1) * 2654435769u;
	/* Small ones as well, of either sign. */
	return (uint32_t)((int32_t)bits >> (texel % 4 * 8));
}

static void run_integer_operation(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static uint32_t operands[KIT_TEXELS][4], bits[KIT_TEXELS][4];
	const struct integer_operation *operation = item->subject;
	char source[500];
	struct kit kit;
	(void)context;
	snprintf(source, sizeof(source),
		"uniform usampler2D operands;\n"
		"out uvec4 bits;\n"
		"void main() {\n"
		"	uvec4 given = texelFetch(operands, ivec2(gl_FragCoord.xy), 0);\n"
		"	uint u = given.r, v = given.g;\n"
		"	int i = int(u), j = int(v);\n"
		"	bits = uvec4(%s);\n"
		"}\n",
		operation->expression);
	for (size_t i = 0; i < KIT_TEXELS; i++)
		for (int c = 0; c < 4; c++)
			operands[i][c] = integer_operand(i, c);
	kit_init(&kit, result);
	kit_texture(&kit, GL_RGBA32UI);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, KIT_SIZE, KIT_SIZE, GL_RGBA_INTEGER,
		GL_UNSIGNED_INT, operands);
	kit_evaluate(&kit, 300, source, bits);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		kit_compare(
			result, bits[i][0], operation->truth(operands[i][0], operands[i][1]), 0);
	if (kit_finish(&kit))
		kit_judge(result, "integers");
}

/* How exact a sampler of floats is at each precision. GLSL ES allows the lower two to lose digits.
 */
static const struct sampling {
	const char *precision;
	bool may_lose;
} samplings[] = {
	{"lowp", true},
	{"mediump", true},
	{"highp", false},
};

static void run_sampler(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static uint32_t bits[KIT_TEXELS][4];
	static float texels[KIT_TEXELS];
	const struct sampling *sampling = item->subject;
	char source[500];
	struct kit kit;
	double most = 0;
	(void)context;
	snprintf(source, sizeof(source),
		"uniform %s sampler2D source;\n"
		"out uvec4 bits;\n"
		"void main() {\n"
		"	bits = uvec4(floatBitsToUint(\n"
		"		texture(source, gl_FragCoord.xy / 64.0).r));\n"
		"}\n",
		sampling->precision);
	for (size_t i = 0; i < KIT_TEXELS; i++)
		texels[i] = operand(i, 0);
	kit_init(&kit, result);
	kit_texture(&kit, GL_R32F);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, KIT_SIZE, KIT_SIZE, GL_RED, GL_FLOAT, texels);
	kit_evaluate(&kit, 300, source, bits);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++) {
		float drawn;
		memcpy(&drawn, &bits[i][0], sizeof(drawn));
		most = fmax(most, fabs(drawn - texels[i]) / texels[i]);
	}
	if (!kit_finish(&kit))
		return;
	if (most == 0)
		check_pass(result, "a %s sampler keeps 32 bits", sampling->precision);
	else if (sampling->may_lose)
		check_pass(result, "a %s sampler keeps %.0f bits of a float's 24",
			sampling->precision, floor(-log2(most)));
	else
		check_fail(result, "a highp sampler of R32F loses digits: off by %.3g of the value",
			most);
}

/* What integers of mediump hold; 16 bits must do. */
static void run_mediump_int(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static const char source[] = "out uvec4 bits;\n"
				     "void main() {\n"
				     "	mediump int side = int(gl_FragCoord.x) + 300;\n"
				     "	mediump int square = side * side;\n"
				     "	bits = uvec4(uint(square));\n"
				     "}\n";
	static uint32_t bits[KIT_TEXELS][4];
	struct kit kit;
	bool whole = true;
	(void)item;
	(void)context;
	kit_init(&kit, result);
	kit_evaluate(&kit, 300, source, bits);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++) {
		uint32_t side = (uint32_t)(i % KIT_SIZE) + 300, truth = side * side;
		whole = whole && bits[i][0] == truth;
		kit_compare(result, bits[i][0] & 0xffff, truth & 0xffff, 0);
	}
	if (kit_finish(&kit))
		kit_judge(result,
			whole ? "mediump integers of 32 bits" : "mediump integers of 16 bits");
}

void gl_shader_cases(struct check_list *list)
{
	for (size_t i = 0; i < sizeof(operations) / sizeof(operations[0]); i++)
		check_list_add(list, run_operation, &operations[i], "precision.highp.%s",
			operations[i].name);
	for (size_t i = 0; i < sizeof(integer_operations) / sizeof(integer_operations[0]); i++)
		check_list_add(list, run_integer_operation, &integer_operations[i],
			"precision.highp.%s", integer_operations[i].name);
	for (size_t i = 0; i < sizeof(samplings) / sizeof(samplings[0]); i++)
		check_list_add(list, run_sampler, &samplings[i], "precision.%s.sampler",
			samplings[i].precision);
	check_list_add(list, run_mediump_int, NULL, "precision.mediump.int");
}
