/* SPDX-License-Identifier: MIT */
#include "gles/caps.h"
#include "base/log.h"
#include "gles/target.h"
#include <stdio.h>
#include <string.h>

static const struct {
	const char *name;
	size_t offset;
} extensions[] = {
#define EXTENSION(name)                                  \
	{                                                \
		"GL_" #name, offsetof(struct caps, name) \
	}
	EXTENSION(EXT_color_buffer_float),
	EXTENSION(EXT_color_buffer_half_float),
	EXTENSION(EXT_float_blend),
	EXTENSION(EXT_texture_filter_anisotropic),
	EXTENSION(EXT_texture_sRGB_decode),
	EXTENSION(KHR_debug),
	EXTENSION(OES_texture_float_linear),
#undef EXTENSION
};

#define EXTENSION_COUNT (sizeof(extensions) / sizeof(extensions[0]))

/* Best first. RG16F: 11 bits at any scale; embedded GPUs blend it (V3D blends no wider float).
 * RGB10_A2 is core ES 3.0: 10 bits of depth over the light's range, 10 of alpha. */
static const struct color_format smoothie_formats[] = {
	{"RG16F", GL_RG16F},
	{"RGB10_A2", GL_RGB10_A2},
};

/* Best first. The square of a depth takes twice its digits: 16 bits tell no two depths apart that
 * are nearer than a hundredth of the light's range. */
static const struct color_format moment_formats[] = {
	{"RG32F", GL_RG32F},
	{"RG16F", GL_RG16F},
};

static void find_extensions(struct caps *caps, struct gl *gl)
{
	GLint count = 0;
	gl->GetIntegerv(GL_NUM_EXTENSIONS, &count);
	for (GLint i = 0; i < count; i++) {
		const char *name = (const char *)gl->GetStringi(GL_EXTENSIONS, (GLuint)i);
		for (size_t j = 0; name != NULL && j < EXTENSION_COUNT; j++)
			if (strcmp(name, extensions[j].name) == 0)
				*(bool *)((char *)caps + extensions[j].offset) = true;
	}
}

/* The first of the formats that can be rendered to; NULL if none can. */
static const struct color_format *find_format(
	struct gl *gl, const struct color_format *formats, size_t count)
{
	for (size_t i = 0; i < count; i++) {
		struct target target;
		bool complete = target_init(
			&target, gl, 1, formats[i].internal_format, GL_COLOR_ATTACHMENT0, NULL);
		target_finish(&target, gl);
		if (complete)
			return &formats[i];
		log_info("%s cannot be rendered to", formats[i].name);
	}
	return NULL;
}

#define FIND_FORMAT(gl, formats) find_format(gl, formats, sizeof(formats) / sizeof((formats)[0]))

static bool find_formats(struct caps *caps, struct gl *gl, struct sm_error *error)
{
	const struct color_format *smoothie = FIND_FORMAT(gl, smoothie_formats);
	const struct color_format *moments = FIND_FORMAT(gl, moment_formats);
	if (smoothie == NULL)
		return error_set(error, SM_ERROR_MACHINE,
			"%s renders to neither RG16F nor RGB10_A2", caps->renderer);
	caps->smoothie_format = *smoothie;
	if (moments != NULL)
		caps->moment_format = *moments;
	caps->moments_filtered =
		caps->OES_texture_float_linear || caps->moment_format.internal_format == GL_RG16F;
	return true;
}

bool caps_init(struct caps *caps, struct gl *gl, struct sm_error *error)
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
	caps->texture_gather = caps->major > 3 || caps->minor >= 1;
	gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &caps->max_texture_size);
	gl->GetIntegerv(GL_MAX_VIEWPORT_DIMS, caps->max_viewport);
	gl->GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &caps->program_binary_formats);
	find_extensions(caps, gl);
	return find_formats(caps, gl, error);
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
	for (size_t i = 0; i < EXTENSION_COUNT; i++) {
		bool there = *(const bool *)((const char *)caps + extensions[i].offset);
		fact(data, extensions[i].name, there ? "yes" : "no");
	}
	fact(data, "shadow map", "DEPTH_COMPONENT24, compared by sampler2DShadow");
	fact(data, "four texels", caps->texture_gather ? "textureGather" : "four fetches");
	fact(data, "linear depth", "from the depth texture, by near and far");
	snprintf(text, sizeof(text), "MIN blend in %s", caps->smoothie_format.name);
	fact(data, "smoothie buffer", text);
	if (caps->moment_format.name != NULL)
		snprintf(text, sizeof(text), "%s, %s", caps->moment_format.name,
			caps->moments_filtered ? "filtered" : "four fetches");
	fact(data, "moments of depth", caps->moment_format.name != NULL ? text : "none: no vsm");
	fact(data, "copy to a screen",
		caps->EXT_texture_sRGB_decode ? "as stored" : "decoded and encoded again");
	fact(data, "compiled programs",
		caps->program_binary_formats > 0 ? "can be kept" : "cannot be kept");
}
