/* SPDX-License-Identifier: MIT */
/* Formats of integers, which keep each bit. */
#include "check/gl_cases.h"
#include "check/gl_kit.h"

struct format {
	const char *name;
	GLenum internal_format;
	bool is_signed;
	int bits[4]; /* 0: no such channel */
};

static const struct format formats[] = {
	{"r8ui", GL_R8UI, false, {8}},
	{"r8i", GL_R8I, true, {8}},
	{"r16ui", GL_R16UI, false, {16}},
	{"r16i", GL_R16I, true, {16}},
	{"r32ui", GL_R32UI, false, {32}},
	{"r32i", GL_R32I, true, {32}},
	{"rg8ui", GL_RG8UI, false, {8, 8}},
	{"rg8i", GL_RG8I, true, {8, 8}},
	{"rg16ui", GL_RG16UI, false, {16, 16}},
	{"rg16i", GL_RG16I, true, {16, 16}},
	{"rg32ui", GL_RG32UI, false, {32, 32}},
	{"rg32i", GL_RG32I, true, {32, 32}},
	{"rgba8ui", GL_RGBA8UI, false, {8, 8, 8, 8}},
	{"rgba8i", GL_RGBA8I, true, {8, 8, 8, 8}},
	{"rgba16ui", GL_RGBA16UI, false, {16, 16, 16, 16}},
	{"rgba16i", GL_RGBA16I, true, {16, 16, 16, 16}},
	{"rgba32ui", GL_RGBA32UI, false, {32, 32, 32, 32}},
	{"rgba32i", GL_RGBA32I, true, {32, 32, 32, 32}},
	{"rgb10_a2ui", GL_RGB10_A2UI, false, {10, 10, 10, 2}},
};

/* Knuth's multiplier, 2^32 over the golden ratio: all bits of the index reach the high ones. */
#define MULTIPLIER 2654435769u

static const char unsigned_fragment[] =
	"uniform ivec4 lost;\n"
	"out uvec4 color;\n"
	"void main() {\n"
	"	uint texel = uint(gl_FragCoord.y) * 64u + uint(gl_FragCoord.x);\n"
	"	color = ((uvec4(0, 1, 2, 3) + 4u * texel) * 2654435769u) >> uvec4(lost);\n"
	"}\n";
static const char signed_fragment[] =
	"uniform ivec4 lost;\n"
	"out ivec4 color;\n"
	"void main() {\n"
	"	uint texel = uint(gl_FragCoord.y) * 64u + uint(gl_FragCoord.x);\n"
	"	color = ivec4((uvec4(0, 1, 2, 3) + 4u * texel) * 2654435769u) >> lost;\n"
	"}\n";

static uint32_t value(const struct format *format, size_t texel, int channel)
{
	uint32_t all = (4 * (uint32_t)texel + (uint32_t)channel) * MULTIPLIER;
	int lost = 32 - format->bits[channel];
	return format->is_signed ? (uint32_t)((int32_t)all >> lost) : all >> lost;
}

static void run_exact(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static uint32_t texels[KIT_TEXELS][4];
	const struct format *format = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	GLuint texture = kit_texture(&kit, format->internal_format);
	kit_framebuffer(&kit, texture, 0, NULL);
	GLuint program = kit_program(
		&kit, 300, NULL, format->is_signed ? signed_fragment : unsigned_fragment);
	if (!kit.failed)
		glUniform4i(glGetUniformLocation(program, "lost"), 32 - format->bits[0],
			(32 - format->bits[1]) % 32, (32 - format->bits[2]) % 32,
			(32 - format->bits[3]) % 32);
	kit_fill(&kit);
	kit_read_integers(&kit, texture, format->is_signed, texels);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++)
		for (int c = 0; c < 4 && format->bits[c] > 0; c++)
			kit_compare(result, texels[i][c], value(format, i, c), 0);
	if (kit_finish(&kit))
		kit_judge(result, "integers");
}

void gl_integer_cases(struct check_list *list)
{
	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
		check_list_add(list, run_exact, &formats[i], "integer.%s.exact", formats[i].name);
}
