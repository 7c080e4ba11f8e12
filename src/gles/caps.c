/* SPDX-License-Identifier: MIT */
#include "gles/caps.h"
#include "gles/texture_unit.h"
#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static_assert(CAP_COUNT <= 64, "sets of caps are words");

/* A cap is an extension, or a limit, or known by the driver's name, or else it is found out by a
 * probe (probe.c), which takes a version and one cap of each set. */
struct cap_info {
	const char *name;
	const char *extension; /* NULL: none */
	int version;           /* 10 * major + minor: has the extension in it; a probe takes it */
	uint64_t any, also;    /* sets of caps; 0: nothing is taken */
};

#define EXTENSION(text) .name = #text, .extension = "GL_" #text
#define FLOAT_TARGETS CAP_BIT(COLOR_BUFFER_FLOAT)
#define HALF_TARGETS (CAP_BIT(COLOR_BUFFER_FLOAT) | CAP_BIT(COLOR_BUFFER_HALF_FLOAT))

static const struct cap_info infos[CAP_COUNT] = {
	[CAP_COLOR_BUFFER_FLOAT] = {EXTENSION(EXT_color_buffer_float), .version = 32},
	[CAP_COLOR_BUFFER_HALF_FLOAT] = {EXTENSION(EXT_color_buffer_half_float)},
	[CAP_FLOAT_BLEND] = {EXTENSION(EXT_float_blend)},
	[CAP_SHADER_FRAMEBUFFER_FETCH] = {EXTENSION(EXT_shader_framebuffer_fetch)},
	[CAP_TEXTURE_FILTER_ANISOTROPIC] = {EXTENSION(EXT_texture_filter_anisotropic)},
	[CAP_TEXTURE_SRGB_DECODE] = {EXTENSION(EXT_texture_sRGB_decode)},
	[CAP_TEXTURE_VIEW] = {EXTENSION(EXT_texture_view)},
	[CAP_KHR_DEBUG] = {EXTENSION(KHR_debug)},
	[CAP_TEXTURE_FLOAT_LINEAR] = {EXTENSION(OES_texture_float_linear)},
	/* 24 bits of a texel, and all of a float. */
	[CAP_HIGHP_SAMPLER] = {.name = "highp_sampler"},
	[CAP_DEPTH_FETCH] = {.name = "depth_fetch"},
	/* Four comparisons are blended by the sampler: OpenGL ES leaves that to the driver. */
	[CAP_SHADOW_FILTER] = {.name = "shadow_filter"},
	[CAP_TEXTURE_GATHER] = {.name = "texture_gather", .version = 31},
	/* The least gl_FragDepth is kept. */
	[CAP_FRAG_DEPTH_MIN] = {.name = "frag_depth_min"},
	[CAP_MIN_RG16F] = {.name = "min_rg16f", .any = HALF_TARGETS},
	[CAP_MIN_RG32F] = {.name = "min_rg32f", .any = FLOAT_TARGETS, .also = CAP_BIT(FLOAT_BLEND)},
	[CAP_MIN_RGB10_A2] = {.name = "min_rgb10_a2"},
	[CAP_MIN_RGBA8] = {.name = "min_rgba8"},
	[CAP_FETCH_RG16F] = {.name = "fetch_rg16f",
		.any = HALF_TARGETS,
		.also = CAP_BIT(SHADER_FRAMEBUFFER_FETCH)},
	[CAP_FETCH_R32I] = {.name = "fetch_r32i",
		.version = 31,
		.also = CAP_BIT(SHADER_FRAMEBUFFER_FETCH)},
	/* The halves of an RG16F texel, as one 32-bit integer. */
	[CAP_HALF_WORDS] = {.name = "half_words",
		.version = 31,
		.any = HALF_TARGETS,
		.also = CAP_BIT(TEXTURE_VIEW)},
	[CAP_RENDER_R32F] = {.name = "render_r32f", .any = FLOAT_TARGETS},
	[CAP_RENDER_R16F] = {.name = "render_r16f", .any = HALF_TARGETS},
	[CAP_RENDER_RG32F] = {.name = "render_rg32f", .any = FLOAT_TARGETS},
	[CAP_RENDER_RGBA16F] = {.name = "render_rgba16f", .any = HALF_TARGETS},
	[CAP_FILTER_RG32F] = {.name = "filter_rg32f",
		.any = FLOAT_TARGETS,
		.also = CAP_BIT(TEXTURE_FLOAT_LINEAR)},
	[CAP_FILTER_RGBA16F] = {.name = "filter_rgba16f", .any = HALF_TARGETS},
	/* Pixels that a branch passes over take as long as those that it does not. */
	[CAP_SLOW_BRANCH] = {.name = "slow_branch"},
	/* In the midst of a pass, at the first texture that another has drawn, the driver ends what
	 * is drawn until then and waits for all of it. */
	[CAP_LATE_WAIT] = {.name = "late_wait"},
	[CAP_SLOW_UNIFORMS] = {.name = "slow_uniforms"},
	[CAP_SLOW_LOOKUPS] = {.name = "slow_lookups"},
	[CAP_SRGB_STORED] = {.name = "srgb_stored", .any = CAP_BIT(TEXTURE_SRGB_DECODE)},
	/* OpenGL ES 3.1 leaves it to the driver how many fragment shaders have. */
	[CAP_FRAGMENT_IMAGES] = {.name = "fragment_images", .version = 31},
};

const char *cap_name(size_t index)
{
	return index < CAP_COUNT ? infos[index].name : NULL;
}

void caps_note(struct caps *caps, enum cap cap, bool there, const char *format, ...)
{
	struct cap_finding *finding = &caps->found[cap];
	va_list args;
	finding->known = true;
	finding->there = there;
	va_start(args, format);
	vsnprintf(finding->why, sizeof(finding->why), format, args);
	va_end(args);
}

static bool has_version(const struct caps *caps, int version)
{
	return 10 * caps->major + caps->minor >= version;
}

static bool has_one(const struct caps *caps, uint64_t set)
{
	bool there = set == 0;
	for (size_t i = 0; i < CAP_COUNT; i++)
		there = there || (set >> i & 1 && caps->found[i].there);
	return there;
}

/* "EXT_color_buffer_float or EXT_color_buffer_half_float" */
static const char *list_set(uint64_t set, char *text, size_t size)
{
	size_t used = 0;
	for (size_t i = 0; i < CAP_COUNT && used < size; i++)
		if (set >> i & 1)
			used += (size_t)snprintf(text + used, size - used, "%s%s",
				used > 0 ? " or " : "", infos[i].name);
	return text;
}

bool caps_rule_out(struct caps *caps, enum cap cap)
{
	const struct cap_info *info = &infos[cap];
	char text[80];
	uint64_t lacking = !has_one(caps, info->any)    ? info->any
			   : !has_one(caps, info->also) ? info->also
							: 0;
	if (caps->found[cap].taken)
		caps_note(caps, cap, false, "taken away");
	else if (!has_version(caps, info->version))
		caps_note(caps, cap, false, "OpenGL ES %d.%d", caps->major, caps->minor);
	else if (lacking != 0)
		caps_note(caps, cap, false, "without %s", list_set(lacking, text, sizeof(text)));
	return caps->found[cap].known;
}

/* "-name" or "+name", `length` characters. */
static bool override_one(struct caps *caps, const char *item, size_t length, struct sm_error *error)
{
	char names[700] = "";
	size_t used = 0;
	if (length == 0 || (item[0] != '-' && item[0] != '+'))
		return error_set(error, SM_ERROR_INPUT,
			"caps \"%.*s\": a list such as -name,+name is wanted",
			(int)(length < 40 ? length : 40), item);
	for (size_t i = 0; i < CAP_COUNT; i++) {
		if (strlen(infos[i].name) == length - 1 &&
			strncmp(infos[i].name, item + 1, length - 1) == 0) {
			caps->found[i].taken = item[0] == '-';
			return true;
		}
		if (used < sizeof(names))
			used += (size_t)snprintf(
				names + used, sizeof(names) - used, " %s", infos[i].name);
	}
	return error_set(error, SM_ERROR_INPUT, "no cap \"%.*s\"; there are:%s",
		(int)(length < 41 ? length - 1 : 40), item + 1, names);
}

static bool override(struct caps *caps, const char *list, struct sm_error *error)
{
	for (size_t length; list != NULL; list = list[length] == ',' ? list + length + 1 : NULL) {
		length = strcspn(list, ",");
		if (!override_one(caps, list, length, error))
			return false;
	}
	return true;
}

static bool is_listed(struct gl *gl, const char *extension)
{
	GLint count = 0;
	gl->GetIntegerv(GL_NUM_EXTENSIONS, &count);
	for (GLint i = 0; i < count; i++) {
		const char *name = (const char *)gl->GetStringi(GL_EXTENSIONS, (GLuint)i);
		if (name != NULL && strcmp(name, extension) == 0)
			return true;
	}
	return false;
}

static void find_extensions(struct caps *caps, struct gl *gl)
{
	for (enum cap cap = 0; cap < CAP_COUNT; cap++) {
		const struct cap_info *info = &infos[cap];
		if (info->extension == NULL)
			continue;
		if (caps->found[cap].taken)
			caps_note(caps, cap, false, "taken away");
		else if (is_listed(gl, info->extension))
			caps_note(caps, cap, true, "extension");
		else if (info->version > 0 && has_version(caps, info->version))
			caps_note(caps, cap, true, "OpenGL ES %d.%d", caps->major, caps->minor);
		else
			caps_note(caps, cap, false, "no such extension");
	}
}

/* What takes a clock to see, and is the same wherever the driver runs. */
static void find_habits(struct caps *caps)
{
	static const char name[] = "llvmpipe";
	static const enum cap habits[] = {CAP_LATE_WAIT, CAP_SLOW_UNIFORMS, CAP_SLOW_LOOKUPS};
	bool is_it = caps->renderer != NULL && strncmp(caps->renderer, name, strlen(name)) == 0;
	for (size_t i = 0; i < sizeof(habits) / sizeof(habits[0]); i++)
		if (!caps->found[habits[i]].taken)
			caps_note(caps, habits[i], is_it, "%s", is_it ? name : "another driver");
}

static void find_images(struct caps *caps, struct gl *gl)
{
	GLint count = 0;
	if (caps_rule_out(caps, CAP_FRAGMENT_IMAGES))
		return;
	gl->GetIntegerv(GL_MAX_FRAGMENT_IMAGE_UNIFORMS, &count);
	caps_note(caps, CAP_FRAGMENT_IMAGES, count >= IMAGE_COUNT && gl->BindImageTexture != NULL,
		"%d of them", count);
}

bool caps_init(struct caps *caps, struct gl *gl, const char *list, struct sm_error *error)
{
	*caps = (struct caps){
		.renderer = (const char *)gl->GetString(GL_RENDERER),
		.vendor = (const char *)gl->GetString(GL_VENDOR),
		.version = (const char *)gl->GetString(GL_VERSION),
		.shading_language = (const char *)gl->GetString(GL_SHADING_LANGUAGE_VERSION),
	};
	if (caps->version == NULL)
		return error_set(error, SM_ERROR_MACHINE, "no OpenGL ES context is current");
	if (sscanf(caps->version, "OpenGL ES %d.%d", &caps->major, &caps->minor) != 2 ||
		caps->major < 3)
		return error_set(error, SM_ERROR_MACHINE,
			"OpenGL ES 3.0 or later is needed; the driver offers %s", caps->version);
	gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &caps->max_texture_size);
	gl->GetIntegerv(GL_MAX_VIEWPORT_DIMS, caps->max_viewport);
	gl->GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &caps->program_binary_formats);
	if (!override(caps, list, error))
		return false;
	find_extensions(caps, gl);
	find_habits(caps);
	find_images(caps, gl);
	return true;
}

void caps_describe(const struct caps *caps, sm_fact fact, void *data)
{
	char text[64];
	fact(data, "renderer", caps->renderer);
	fact(data, "vendor", caps->vendor);
	fact(data, "version", caps->version);
	fact(data, "shading language", caps->shading_language);
	snprintf(text, sizeof(text), "%d", caps->max_texture_size);
	fact(data, "max texture size", text);
	snprintf(text, sizeof(text), "%dx%d", caps->max_viewport[0], caps->max_viewport[1]);
	fact(data, "max viewport", text);
	fact(data, "compiled programs",
		caps->program_binary_formats > 0 ? "can be kept" : "cannot be kept");
}
