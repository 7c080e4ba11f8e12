/* SPDX-License-Identifier: MIT */
#include "gles/probe.h"
#include "gles/branch_probe.h"
#include "gles/target.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Texels a side of what is drawn. */
#define SIDE 2

/* What probe_read.frag tells of it, in its order. */
enum reading {
	READ_LEFT,         /* texel (0, 0), two channels */
	READ_RIGHT = 2,    /* texel (1, 0) */
	READ_FILTERED = 4, /* the second channel between them */
	READ_DEPTH = 5,    /* texels (0, 0) and (1, 0) */
	READ_SHADOW = 7,   /* the comparison between them */
	READ_FLOAT = 8,
	READ_GATHERED = 9,
	READ_GATHERED_SHADOW = 13,
	READ_WORD = 17,       /* texel (0, 0), the halves of an integer */
	READ_RIGHT_WORD = 19, /* texel (1, 0) */
	READINGS = 21,
};

/* No number here is near one of 8, 10 or 16 bits that stands for less than the format has: a
 * coarser one shows. Drawn over all, and then over the texels on the right: in MIN one channel
 * keeps the first, the other takes the second, and a sum or mere overwriting is neither. */
static const float first[2] = {0.3f, 0.7f}, second[2] = {0.6f, 0.45f};
static const float overwritten[2] = {0.6f, 0.45f}, minimum[2] = {0.3f, 0.45f};

/* The shadow map: all at the first depth but texel (1, 0). Compared with 1/2, that one is dark.
 * Neither is near a number of 16 bits. */
static const float depths[2] = {0.7f, 0.3f};
#define DEPTH_STEP (2.0f / 16777216.0f)

/* A map of floats, the rows from the lower one. */
static const float floats[4] = {0.12345679f, 0.23456789f, 0.34567890f, 0.45678901f};

/* Caps that are about one format of colours. */
struct color_probe {
	GLenum format;
	int channels;
	float step;     /* of the format, around these values */
	uint64_t flags; /* of PROGRAM_PROBE_DRAW */
	bool blended, filtered;
	const float *wanted; /* on the right */
};

/* Filters may weigh in steps of 1/64. */
#define FILTER_STEP (1.0f / 128.0f)
#define STEP_16F (1.0f / 2048.0f)
#define STEP_32F (1.0f / 8388608.0f)

static const struct color_probe color_probes[CAP_COUNT] = {
	[CAP_MIN_RG16F] = {GL_RG16F, 2, STEP_16F, .blended = true, .wanted = minimum},
	[CAP_MIN_RG32F] = {GL_RG32F, 2, STEP_32F, .blended = true, .wanted = minimum},
	[CAP_MIN_RGB10_A2] = {GL_RGB10_A2, 2, 1.0f / 1023.0f, .blended = true, .wanted = minimum},
	[CAP_MIN_RGBA8] = {GL_RGBA8, 2, 1.0f / 255.0f, .blended = true, .wanted = minimum},
	[CAP_FETCH_RG16F] = {GL_RG16F, 2, STEP_16F, .flags = FLAG_FETCH, .wanted = minimum},
	[CAP_FETCH_R32I] = {GL_R32I, 2, STEP_16F, .flags = FLAG_FETCH | FLAG_FUSED,
		.wanted = minimum},
	[CAP_HALF_WORDS] = {GL_RG16F, 2, STEP_16F, .wanted = overwritten},
	[CAP_RENDER_R32F] = {GL_R32F, 1, STEP_32F, .wanted = overwritten},
	[CAP_RENDER_R16F] = {GL_R16F, 1, STEP_16F, .wanted = overwritten},
	[CAP_RENDER_RG32F] = {GL_RG32F, 2, STEP_32F, .wanted = overwritten},
	[CAP_RENDER_RGBA16F] = {GL_RGBA16F, 2, STEP_16F, .wanted = overwritten},
	[CAP_FILTER_RG32F] = {GL_RG32F, 2, STEP_32F, .filtered = true, .wanted = overwritten},
	[CAP_FILTER_RGBA16F] = {GL_RGBA16F, 2, STEP_16F, .filtered = true, .wanted = overwritten},
};

#define STORED_BYTE 128

/* What is to be read. */
struct expectation {
	enum reading at;
	float wanted, step;
};

#define EXPECTATIONS_MAX 8

/* Caps that are about the shadow map and the map of floats, from every probe. */
static const struct {
	enum cap cap;
	int count;
	struct expectation expectations[EXPECTATIONS_MAX];
} common_probes[] = {
	{CAP_DEPTH_FETCH, 2, {{READ_DEPTH, 0.7f, DEPTH_STEP}, {READ_DEPTH + 1, 0.3f, DEPTH_STEP}}},
	{CAP_SHADOW_FILTER, 1, {{READ_SHADOW, 0.25f, 1.0f / 32.0f}}},
	{CAP_HIGHP_SAMPLER, 1, {{READ_FLOAT, 0.12345679f, 0.0f}}},
	{CAP_TEXTURE_GATHER, 8,
		{
			{READ_GATHERED, 0.34567890f, 0.0f},
			{READ_GATHERED + 1, 0.45678901f, 0.0f},
			{READ_GATHERED + 2, 0.23456789f, 0.0f},
			{READ_GATHERED + 3, 0.12345679f, 0.0f},
			{READ_GATHERED_SHADOW, 1.0f, 0.0f},
			{READ_GATHERED_SHADOW + 1, 1.0f, 0.0f},
			{READ_GATHERED_SHADOW + 2, 0.0f, 0.0f},
			{READ_GATHERED_SHADOW + 3, 1.0f, 0.0f},
		}},
};

/* What one probe draws, and what is read of it; zero is empty. */
struct probe {
	struct gpu *gpu;
	struct target colors, depth, bytes;
	GLuint uploaded, floats, words, compare; /* textures and a sampler */
	float values[READINGS];
};

/* Functions that draw return what went wrong, a static text, or NULL. */
static const char no_program[] = "its shader does not compile";
static const char no_target[] = "no target of this format is complete";

static void draw_triangle(struct gl *gl)
{
	gl->BindVertexArray(0);
	gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

static const struct target_area right = {1, 0, 1, SIDE}, lower_right = {1, 0, 1, 1};

/* Draws the first value over all, and the second in an area. depth_range: of the two; NULL: all. */
static const char *draw_values(
	struct gpu *gpu, uint64_t flags, const float *depth_range, struct target_area area)
{
	struct gl *gl = &gpu->gl;
	struct program_key key = {PROGRAM_PROBE_DRAW, flags};
	const struct program *program = program_use(&gpu->programs, gl, key, NULL);
	const float *values[] = {first, second};
	if (program == NULL)
		return no_program;
	for (int i = 0; i < 2; i++) {
		if (depth_range != NULL)
			gl->DepthRangef(depth_range[i], depth_range[i]);
		if (i == 1)
			target_restrict(area, gl);
		gl->Uniform4f(program->uniform.probe_value, values[i][0], values[i][1], 1.0f, 1.0f);
		draw_triangle(gl);
	}
	gl->DepthRangef(0.0f, 1.0f);
	gl->Disable(GL_SCISSOR_TEST);
	return gl_take_error(gl);
}

/* The shadow map; or by_shader, values as depths. */
static const char *draw_depth(struct probe *probe, bool by_shader)
{
	struct gl *gl = &probe->gpu->gl;
	if (!target_init(&probe->depth, gl, STORAGE_PROBES, SIDE, GL_DEPTH_COMPONENT24,
		    GL_DEPTH_ATTACHMENT, NULL))
		return no_target;
	target_bind(&probe->depth, gl);
	gl->ClearBufferfv(GL_DEPTH, 0, &(GLfloat){1.0f});
	gl->Enable(GL_DEPTH_TEST);
	const char *problem = by_shader ? draw_values(probe->gpu, FLAG_ALPHA_DEPTH, NULL, right)
					: draw_values(probe->gpu, 0, depths, lower_right);
	gl->Disable(GL_DEPTH_TEST);
	return problem;
}

static bool is_word(const struct color_probe *what)
{
	return what->format == GL_R32I;
}

static const char *draw_colors(struct probe *probe, const struct color_probe *what)
{
	struct gl *gl = &probe->gpu->gl;
	static const GLfloat white[4] = {1.0f, 1.0f, 1.0f, 1.0f};
	static const GLint white_word[4] = {0x3c003c00, 0, 0, 0}; /* of halves */
	if (what->format == 0)
		return NULL;
	if (!target_init(&probe->colors, gl, STORAGE_PROBES, SIDE, what->format,
		    GL_COLOR_ATTACHMENT0, NULL))
		return no_target;
	if (what->filtered) {
		gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
		gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	}
	target_bind(&probe->colors, gl);
	if (is_word(what))
		gl->ClearBufferiv(GL_COLOR, 0, white_word);
	else
		gl->ClearBufferfv(GL_COLOR, 0, white);
	if (what->blended)
		gl->Enable(GL_BLEND);
	gl->BlendEquation(GL_MIN);
	const char *problem = draw_values(probe->gpu, what->flags, NULL, right);
	gl->BlendEquation(GL_FUNC_ADD);
	gl->Disable(GL_BLEND);
	return problem;
}

static GLuint upload(struct gl *gl, const struct texel_format *as, const void *texels)
{
	GLuint texture = gl_create_texture(gl, STORAGE_PROBES);
	gl->ActiveTexture(GL_TEXTURE0);
	gl_fill_texture(gl, texture, as, SIDE, SIDE, texels);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	return texture;
}

static void bind_all(struct probe *probe, bool stored, bool word)
{
	static const struct texel_format stored_format = {
		GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE};
	static const struct texel_format float_format = {GL_R32F, GL_RED, GL_FLOAT};
	struct gpu *gpu = probe->gpu;
	uint8_t grey[SIDE * SIDE * 4];
	GLuint colors = word ? 0 : probe->colors.texture;
	if (stored) {
		memset(grey, STORED_BYTE, sizeof(grey));
		probe->uploaded = upload(&gpu->gl, &stored_format, grey);
		gpu_bind_stored_sampler(gpu, UNIT_SMOOTHIE);
	}
	probe->floats = upload(&gpu->gl, &float_format, floats);
	probe->compare = gpu_create_compare_sampler(gpu, GL_LINEAR);
	gpu_bind_texture(gpu, UNIT_BASE, colors);
	gpu_bind_texture(gpu, UNIT_SMOOTHIE, stored ? probe->uploaded : colors);
	gpu_bind_texture(gpu, UNIT_MOMENTS, probe->floats);
	gpu_bind_texture(gpu, UNIT_SMOOTHIE_WORDS, word ? probe->colors.texture : probe->words);
	gpu_bind_texture(gpu, UNIT_DEPTH, probe->depth.texture);
	gpu_bind_texture(gpu, UNIT_DEPTH_COMPARE, probe->depth.texture);
	gpu->gl.BindSampler(UNIT_DEPTH_COMPARE, probe->compare);
}

/* Reads values back through a pass that writes their bits. */
static const char *read_values(struct probe *probe)
{
	struct gpu *gpu = probe->gpu;
	struct gl *gl = &gpu->gl;
	uint8_t bytes[READINGS][4];
	bool gathers = !caps_rule_out(&gpu->caps, CAP_TEXTURE_GATHER) ||
		       gpu->caps.found[CAP_TEXTURE_GATHER].there;
	struct program_key key = {PROGRAM_PROBE_READ, FLAG_GATHER};
	target_bind(&probe->bytes, gl);
	if (gathers && program_use(&gpu->programs, gl, key, NULL) == NULL) {
		caps_note(&gpu->caps, CAP_TEXTURE_GATHER, false, "%s", no_program);
		gathers = false;
	}
	key.flags = 0;
	if (!gathers && program_use(&gpu->programs, gl, key, NULL) == NULL)
		return no_program;
	draw_triangle(gl);
	gl->ReadPixels(0, 0, READINGS, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
	for (int i = 0; i < READINGS; i++) {
		uint32_t bits = 0;
		for (int byte = 0; byte < 4; byte++)
			bits |= (uint32_t)bytes[i][byte] << (8 * byte);
		memcpy(&probe->values[i], &bits, sizeof(bits));
	}
	return gl_take_error(gl);
}

/* Notes whether the driver has the cap, unless that is known. */
static void judge(struct probe *probe, enum cap cap, const char *problem,
	const struct expectation *expectations, int count)
{
	struct caps *caps = &probe->gpu->caps;
	if (caps->found[cap].known || caps_rule_out(caps, cap))
		return;
	for (int i = 0; i < count && problem == NULL; i++) {
		const struct expectation *expected = &expectations[i];
		float value = probe->values[expected->at];
		/* False for NaN. */
		if (!(fabsf(value - expected->wanted) <= expected->step)) {
			caps_note(caps, cap, false, "drawn, it reads %.7g and not %.7g",
				(double)value, (double)expected->wanted);
			return;
		}
	}
	caps_note(caps, cap, problem == NULL, "%s",
		problem == NULL ? "drawn and read back" : problem);
}

static void judge_colors(struct probe *probe, enum cap cap, const char *problem)
{
	const struct color_probe *what = &color_probes[cap];
	struct expectation expectations[EXPECTATIONS_MAX];
	enum reading on_left = is_word(what) ? READ_WORD : READ_LEFT;
	enum reading on_right = is_word(what) ? READ_RIGHT_WORD : READ_RIGHT;
	int count = 0;
	for (int i = 0; i < what->channels; i++) {
		expectations[count++] =
			(struct expectation){on_left + (enum reading)i, first[i], what->step};
		expectations[count++] = (struct expectation){
			on_right + (enum reading)i, what->wanted[i], what->step};
	}
	if (what->filtered)
		expectations[count++] = (struct expectation){
			READ_FILTERED, 0.25f * first[1] + 0.75f * second[1], FILTER_STEP};
	judge(probe, cap, problem, expectations, count);
}

/* Of halves that are there as an integer as well. */
static void judge_words(struct probe *probe, const char *problem)
{
	const struct expectation expectations[] = {
		{READ_WORD, first[0], STEP_16F}, {READ_WORD + 1, first[1], STEP_16F}};
	judge(probe, CAP_HALF_WORDS,
		problem == NULL && probe->words == 0 ? "a texture has no view" : problem,
		expectations, 2);
}

static void judge_all(struct probe *probe, enum cap cap, const char *colors, const char *others)
{
	static const struct expectation stored[] = {
		{READ_FILTERED, STORED_BYTE / 255.0f, FILTER_STEP}};
	const struct expectation least[] = {
		{READ_DEPTH, first[0], DEPTH_STEP}, {READ_DEPTH + 1, first[0], DEPTH_STEP}};
	if (cap == CAP_FRAG_DEPTH_MIN) {
		judge(probe, cap, others, least, 2);
		return;
	}
	if (color_probes[cap].format == GL_RG16F)
		judge_words(probe, colors != NULL ? colors : others);
	if (cap == CAP_SRGB_STORED)
		judge(probe, cap, others, stored, 1);
	else if (color_probes[cap].format != 0)
		judge_colors(probe, cap, colors != NULL ? colors : others);
	for (size_t i = 0; i < sizeof(common_probes) / sizeof(common_probes[0]); i++)
		judge(probe, common_probes[i].cap, others, common_probes[i].expectations,
			common_probes[i].count);
}

static void draw(struct probe *probe, enum cap cap)
{
	struct gl *gl = &probe->gpu->gl;
	gl_take_error(gl);
	gpu_restore_state(probe->gpu);
	gl->Disable(GL_DITHER);
	const char *colors = draw_colors(probe, &color_probes[cap]);
	if (colors == NULL && color_probes[cap].format == GL_RG16F)
		probe->words = target_create_view(&probe->colors, gl, STORAGE_PROBES, GL_R32I);
	const char *depth = draw_depth(probe, cap == CAP_FRAG_DEPTH_MIN);
	bool complete = target_init(
		&probe->bytes, gl, STORAGE_PROBES, READINGS, GL_RGBA8, GL_COLOR_ATTACHMENT0, NULL);
	bind_all(probe, cap == CAP_SRGB_STORED, is_word(&color_probes[cap]));
	const char *read = complete ? read_values(probe) : no_target;
	gl->Enable(GL_DITHER);
	gpu_restore_state(probe->gpu);
	judge_all(probe, cap, colors, depth != NULL ? depth : read);
}

static void finish(struct probe *probe)
{
	struct gl *gl = &probe->gpu->gl;
	target_finish(&probe->colors, gl);
	target_finish(&probe->depth, gl);
	target_finish(&probe->bytes, gl);
	gl_delete_texture(gl, &probe->uploaded);
	gl_delete_texture(gl, &probe->floats);
	gl_delete_texture(gl, &probe->words);
	gl_delete_sampler(gl, &probe->compare);
}

static void draw_all(struct gpu *gpu, enum cap cap)
{
	struct probe probe = {.gpu = gpu};
	draw(&probe, cap);
	finish(&probe);
}

static void run(struct gpu *gpu, enum cap cap)
{
	struct gl *gl = &gpu->gl;
	GLint drawn, read, viewport[4];
	gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawn);
	gl->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
	gl->GetIntegerv(GL_VIEWPORT, viewport);
	if (cap == CAP_SLOW_BRANCH)
		branch_probe_run(gpu);
	else
		draw_all(gpu, cap);
	gpu_restore_state(gpu);
	gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)drawn);
	gl->BindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)read);
	gl->Viewport(viewport[0], viewport[1], viewport[2], viewport[3]);
}

static bool is_open(struct caps *caps, enum cap cap)
{
	return !caps->found[cap].known && !caps_rule_out(caps, cap);
}

/* A driver may take long to compile for a first draw: what draws no colours of its own takes along
 * the cap that is most likely asked for next. */
static enum cap companion(struct gpu *gpu, enum cap cap)
{
	bool alone = color_probes[cap].format != 0 || cap == CAP_SRGB_STORED ||
		     cap == CAP_SLOW_BRANCH || cap == CAP_FRAG_DEPTH_MIN ||
		     !is_open(&gpu->caps, CAP_MIN_RG16F);
	return alone ? cap : CAP_MIN_RG16F;
}

bool gpu_has(struct gpu *gpu, enum cap cap)
{
	if (is_open(&gpu->caps, cap))
		run(gpu, companion(gpu, cap));
	return gpu->caps.found[cap].there;
}

void probe_describe(struct gpu *gpu, sm_fact fact, void *data)
{
	for (enum cap cap = 0; cap < CAP_COUNT; cap++) {
		char key[64], value[128];
		bool there = gpu_has(gpu, cap);
		snprintf(key, sizeof(key), "cap %s", cap_name(cap));
		snprintf(value, sizeof(value), "%s: %s", there ? "yes" : "no",
			gpu->caps.found[cap].why);
		fact(data, key, value);
	}
}
