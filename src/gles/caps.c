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
#undef EXTENSION
};

#define EXTENSION_COUNT (sizeof(extensions) / sizeof(extensions[0]))

/* Best first. RG16F: 11 bits at any scale; embedded GPUs blend it (V3D blends no wider float).
 * RGB10_A2 is core ES 3.0: 10 bits of depth over the light's range, 10 of alpha. */
static const struct color_format smoothie_formats[] = {
	{"RG16F", GL_RG16F},
	{"RGB10_A2", GL_RGB10_A2},
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

static bool find_smoothie_format(struct caps *caps, struct gl *gl, struct sm_error *error)
{
	for (size_t i = 0; i < sizeof(smoothie_formats) / sizeof(smoothie_formats[0]); i++) {
		struct target target;
		bool complete = target_init(&target, gl, 1, smoothie_formats[i].internal_format,
			GL_COLOR_ATTACHMENT0, NULL);
		target_finish(&target, gl);
		if (complete) {
			caps->smoothie_format = smoothie_formats[i];
			return true;
		}
		log_info("%s cannot be rendered to", smoothie_formats[i].name);
	}
	return error_set(error, SM_ERROR_MACHINE, "%s renders to neither RG16F nor RGB10_A2",
		caps->renderer);
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
	return find_smoothie_format(caps, gl, error);
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
	fact(data, "copy to a screen",
		caps->EXT_texture_sRGB_decode ? "as stored" : "decoded and encoded again");
	fact(data, "compiled programs",
		caps->program_binary_formats > 0 ? "can be kept" : "cannot be kept");
}
