/* SPDX-License-Identifier: MIT */
/* Look-ups: which texels they find, in which order, and with what weight. Texels are numbered from
 * the first row on, in red; green holds the numbers from the last on. */
#include "check/gl_cases.h"
#include "check/gl_kit.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

struct look_up {
	const char *name;
	int version;            /* of GLSL ES */
	const char *expression; /* a vec4, of `source`, the pixel `p`, and its centre `at` */
	/* Column, row and number of the pixel; NAN: it may find anything. */
	double (*truth)(int x, int y, int channel);
	GLint wrap;       /* 0: to the edge */
	bool linear;      /* of a texture that floats can be filtered in */
	double tolerance; /* 0: exact */
};

#define LAST (KIT_SIZE - 1)

static int clamp(int value)
{
	return value < 0 ? 0 : value > LAST ? LAST : value;
}

static double number(int x, int y)
{
	return clamp(y) * KIT_SIZE + clamp(x);
}

static double same(int x, int y, int channel)
{
	(void)channel;
	return number(x, y);
}

static double inside(int x, int y)
{
	return x < 0 || y < 0 || x > LAST || y > LAST ? NAN : number(x, y);
}

static double fetch_offset(int x, int y, int channel)
{
	(void)channel;
	return inside(x + 3, y - 2);
}

static double offset(int x, int y, int channel)
{
	(void)channel;
	return number(x - 1, y + 2);
}

/* OpenGL ES 3.1, 8.14.1: i0 j1, i1 j1, i1 j0, i0 j0. */
static const int gathered[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};

static double gather(int x, int y, int channel)
{
	return number(x + gathered[channel][0], y + gathered[channel][1]);
}

static double gather_green(int x, int y, int channel)
{
	return KIT_TEXELS - 1 - gather(x, y, channel);
}

static double gather_offset(int x, int y, int channel)
{
	return gather(x + 2, y - 3, channel);
}

/* Pixels see three copies of the texture. */
static double clamped(int x, int y, int channel)
{
	(void)channel;
	return number(3 * x - KIT_SIZE, 3 * y - KIT_SIZE);
}

static double repeated(int x, int y, int channel)
{
	(void)channel;
	return number(3 * x % KIT_SIZE, 3 * y % KIT_SIZE);
}

static int mirror(int value)
{
	int copy = value / KIT_SIZE, at = value % KIT_SIZE;
	return copy % 2 == 1 ? at : LAST - at;
}

static double mirrored(int x, int y, int channel)
{
	(void)channel;
	return number(mirror(3 * x), mirror(3 * y));
}

static double between_columns(int x, int y, int channel)
{
	(void)y;
	(void)channel;
	return fmin(x + .25, LAST);
}

static double between_rows(int x, int y, int channel)
{
	(void)x;
	(void)channel;
	return fmin(y + .75, LAST);
}

static double size_of(int x, int y, int channel)
{
	(void)x;
	(void)y;
	return channel < 2 ? KIT_SIZE : 0;
}

/* ES asks for no number of bits of a filter's weights; GPUs have 8. */
#define WEIGHT (1 / 128.0)

static const struct look_up look_ups[] = {
	{"fetch", 300, "texelFetch(source, p, 0).rrrr", same, 0, false, 0},
	{"fetch-offset", 300, "texelFetchOffset(source, p, 0, ivec2(3, -2)).rrrr", fetch_offset, 0,
		false, 0},
	{"nearest", 300, "texture(source, at).rrrr", same, 0, false, 0},
	{"nearest-low", 300, "texture(source, at - 0.49 / 64.0).rrrr", same, 0, false, 0},
	{"nearest-high", 300, "texture(source, at + 0.49 / 64.0).rrrr", same, 0, false, 0},
	{"level", 300, "textureLod(source, at, 0.0).rrrr", same, 0, false, 0},
	{"offset", 300, "textureOffset(source, at, ivec2(-1, 2)).rrrr", offset, 0, false, 0},
	{"gather", 310, "textureGather(source, at + 0.5 / 64.0)", gather, 0, false, 0},
	{"gather-green", 310, "textureGather(source, at + 0.5 / 64.0, 1)", gather_green, 0, false,
		0},
	{"gather-offset", 310, "textureGatherOffset(source, at + 0.5 / 64.0, ivec2(2, -3))",
		gather_offset, 0, false, 0},
	{"clamp", 300, "texture(source, (vec2(3 * p - 64) + 0.5) / 64.0).rrrr", clamped, 0, false,
		0},
	{"repeat", 300, "texture(source, (vec2(3 * p - 64) + 0.5) / 64.0).rrrr", repeated,
		GL_REPEAT, false, 0},
	{"mirror", 300, "texture(source, (vec2(3 * p - 64) + 0.5) / 64.0).rrrr", mirrored,
		GL_MIRRORED_REPEAT, false, 0},
	{"linear-columns", 300, "texture(source, at + vec2(0.25 / 64.0, 0.0)).rrrr",
		between_columns, 0, true, WEIGHT},
	{"linear-rows", 300, "texture(source, at + vec2(0.0, 0.75 / 64.0)).gggg", between_rows, 0,
		true, WEIGHT},
	{"size", 300, "vec4(textureSize(source, 0), 0, 0)", size_of, 0, false, 0},
};

/* Numbers of texels, or for filters, whose sums are to be within 16 bits, of column and row. */
static void upload(struct kit *kit, bool filtered)
{
	static float texels[KIT_TEXELS][2];
	if (kit->failed)
		return;
	for (int i = 0; i < KIT_TEXELS; i++) {
		texels[i][0] = (float)(filtered ? i % KIT_SIZE : i);
		texels[i][1] = (float)(filtered ? i / KIT_SIZE : KIT_TEXELS - 1 - i);
	}
	kit_texture(kit, filtered ? GL_RG16F : GL_RG32F);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, KIT_SIZE, KIT_SIZE, GL_RG, GL_FLOAT, texels);
}

static void set_up(struct kit *kit, const struct look_up *look_up)
{
	upload(kit, look_up->linear);
	if (look_up->wrap != 0) {
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, look_up->wrap);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, look_up->wrap);
	}
	if (look_up->linear) {
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	}
}

static void run_look_up(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static uint32_t bits[KIT_TEXELS][4];
	static float found[KIT_TEXELS][4];
	const struct look_up *look_up = item->subject;
	char source[500];
	struct kit kit;
	(void)context;
	snprintf(source, sizeof(source),
		"uniform sampler2D source;\n"
		"out uvec4 bits;\n"
		"void main() {\n"
		"	ivec2 p = ivec2(gl_FragCoord.xy);\n"
		"	vec2 at = gl_FragCoord.xy / 64.0;\n"
		"	bits = floatBitsToUint(%s);\n"
		"}\n",
		look_up->expression);
	kit_init(&kit, result);
	kit_need_version(&kit, look_up->version / 10);
	set_up(&kit, look_up);
	kit_evaluate(&kit, look_up->version, source, bits);
	memcpy(found, bits, sizeof(found));
	for (int i = 0; !kit.failed && i < KIT_TEXELS; i++)
		for (int c = 0; c < 4; c++) {
			double truth = look_up->truth(i % KIT_SIZE, i / KIT_SIZE, c);
			if (!isnan(truth))
				kit_compare(result, found[i][c], truth, look_up->tolerance);
		}
	if (kit_finish(&kit))
		kit_judge(result, look_up->linear ? "texels" : "numbers of texels");
}

void gl_texture_cases(struct check_list *list)
{
	for (size_t i = 0; i < sizeof(look_ups) / sizeof(look_ups[0]); i++)
		check_list_add(list, run_look_up, &look_ups[i], "texture.%s", look_ups[i].name);
}
