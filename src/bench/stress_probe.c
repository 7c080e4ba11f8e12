/* SPDX-License-Identifier: MIT */
#include "bench/stress_probe.h"
#include "base/array.h"
#include "platform.h"
#include <GLES3/gl3.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Visibility before it is clamped may leave [0, 1] by this: sums of weights round. */
#define RANGE_SLACK 1e-4f

bool stress_fault_set(
	struct stress_fault *fault, enum stress_fault_kind kind, const char *format, ...)
{
	va_list args;
	if (fault->text[0] != '\0')
		return false;
	fault->kind = kind;
	va_start(args, format);
	vsnprintf(fault->text, sizeof(fault->text), format, args);
	va_end(args);
	return false;
}

void stress_picture_finish(struct stress_picture *picture)
{
	free(picture->values);
	*picture = (struct stress_picture){0};
}

/* Where the part of surface.frag begins that writes visibility. */
static const char visibility_part[] = "#elif defined(VISIBILITY)\nvoid main()";

/* What surface.frag writes as visibility, and what it writes instead, to floats: red is what was
 * not clamped, green and blue are the bytes. */
static const struct {
	const char *from, *to;
} edits[] = {
	{"\tfloat v = 1.0;\n", "\tfloat v = 1.0;\n\tfloat raw = 1.0;\n"},
	{"\tv = clamp(shadow_visibility(seen_position()), 0.0, 1.0);\n",
		"\traw = shadow_visibility(seen_position());\n\tv = clamp(raw, 0.0, 1.0);\n"},
	{"\tcolor = vec4(high, steps - 256.0 * high, 0.0, 255.0) / 255.0;\n",
		"\tcolor = vec4(raw, vec2(high, steps - 256.0 * high) / 255.0, 1.0);\n"},
};

/* An sm_get_proc has no data of its own. */
static sm_get_proc real_get_proc;
static bool edits_missing, edits_made;

/* A copy of the text with one edit in that part, or NULL where there is nothing to edit. */
static char *edit_text(const char *text, const char *from, const char *to)
{
	const char *part = strstr(text, visibility_part);
	const char *place = part != NULL ? strstr(part, from) : NULL;
	if (place == NULL)
		return NULL;
	size_t before = (size_t)(place - text), size = strlen(text) + strlen(to) + 1;
	char *edited = array_alloc(size, 1);
	if (edited != NULL)
		snprintf(edited, size, "%.*s%s%s", (int)before, text, to, place + strlen(from));
	return edited;
}

/* The surface shader with all edits, or NULL for any other text. */
static char *edit_surface(const char *text)
{
	char *edited = NULL;
	if (strstr(text, visibility_part) == NULL)
		return NULL;
	for (size_t i = 0; i < sizeof(edits) / sizeof(edits[0]); i++) {
		char *next = edit_text(i == 0 ? text : edited, edits[i].from, edits[i].to);
		free(edited);
		edited = next;
		if (next == NULL) {
			edits_missing = true;
			return NULL;
		}
	}
	edits_made = true;
	return edited;
}

static void GL_APIENTRY shader_source(
	GLuint shader, GLsizei count, const GLchar *const *strings, const GLint *lengths)
{
	PFNGLSHADERSOURCEPROC real = (PFNGLSHADERSOURCEPROC)real_get_proc("glShaderSource");
	const GLchar **copies = array_copy(strings, (size_t)count, sizeof(*strings));
	char *edited = NULL;
	for (GLsizei i = 0; i < count && copies != NULL && edited == NULL; i++) {
		edited = edit_surface(strings[i]);
		if (edited != NULL)
			copies[i] = edited;
	}
	real(shader, count, copies != NULL ? copies : strings, lengths);
	free(edited);
	free(copies);
}

static void (*edit_get_proc(const char *name))(void)
{
	return strcmp(name, "glShaderSource") == 0 ? (void (*)(void))shader_source
						   : real_get_proc(name);
}

/* Rows of a target that are read at once: 2^20 texels. */
static GLint strip_rows(GLint width)
{
	GLint rows = (1 << 20) / width;
	return rows > 0 ? rows : 1;
}

static bool is_finite(const float *value, bool halves)
{
	uint32_t bits;
	memcpy(&bits, value, sizeof(bits));
	/* Not one whose exponent is all ones. */
	if (halves)
		return (~bits & 0x7c00) != 0 && (~bits & 0x7c000000) != 0;
	return isfinite(*value);
}

#define NO_HALVES SIZE_MAX

/* Of a pass that writes the bits of floats to integers: the channel that two half floats share.
 * False: its integers are no floats. */
static bool find_halves(const char *pass, size_t *channel)
{
	static const struct {
		const char *pass;
		size_t channel;
	} written[] = {{"smoothies", 0}, {"layers", 1}};
	for (size_t i = 0; i < sizeof(written) / sizeof(written[0]); i++)
		if (strcmp(written[i].pass, pass) == 0) {
			*channel = written[i].channel;
			return true;
		}
	return false;
}

/* halves: the channel that has two, in a target that holds the bits of floats as integers. */
static void check_strip(struct stress_probe *probe, GLint y, GLint width, GLint rows,
	GLenum attachment, size_t halves, const char *pass)
{
	size_t count = 4 * (size_t)width * (size_t)rows;
	if (!array_reserve((void **)&probe->values, &probe->value_capacity, count,
		    sizeof(*probe->values))) {
		stress_fault_set(probe->fault, STRESS_FAULT_OTHER, "out of memory");
		return;
	}
	if (halves != NO_HALVES)
		glReadPixels(0, y, width, rows, GL_RGBA_INTEGER, GL_UNSIGNED_INT, probe->values);
	else
		glReadPixels(0, y, width, rows, GL_RGBA, GL_FLOAT, probe->values);
	for (size_t i = 0; i < count; i++)
		if (!is_finite(&probe->values[i], i % 4 == halves)) {
			stress_fault_set(probe->fault, STRESS_FAULT_FLOAT,
				"pass \"%s\" writes %g to channel %zu of target %u at %zu, %zu",
				pass, (double)probe->values[i], i % 4,
				attachment - GL_COLOR_ATTACHMENT0, i / 4 % (size_t)width,
				(size_t)y + i / 4 / (size_t)width);
			return;
		}
}

/* GL_NONE: there is no such attachment. */
static GLint component_type(GLenum attachment)
{
	GLint kind = GL_NONE, type = GL_NONE;
	glGetFramebufferAttachmentParameteriv(
		GL_READ_FRAMEBUFFER, attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &kind);
	if (kind != GL_NONE)
		glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, attachment,
			GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &type);
	return type;
}

bool stress_probe_check_targets(
	struct stress_probe *probe, const char *pass, struct stress_fault *fault)
{
	GLint viewport[4], bound = 0, read_buffer = GL_NONE;
	glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
	glGetIntegerv(GL_READ_BUFFER, &read_buffer);
	glGetIntegerv(GL_VIEWPORT, viewport);
	probe->fault = fault;
	/* A context without a surface has a viewport of no pixels until one is set. */
	if (bound == 0 || viewport[2] <= 0)
		return true;
	for (GLenum i = GL_COLOR_ATTACHMENT0; i < GL_COLOR_ATTACHMENT0 + 4; i++) {
		GLint type = component_type(i);
		size_t halves = NO_HALVES;
		if (type != GL_FLOAT && (type != GL_UNSIGNED_INT || !find_halves(pass, &halves)))
			continue;
		glReadBuffer(i);
		GLint rows = strip_rows(viewport[2]);
		for (GLint y = 0; y < viewport[3]; y += rows)
			check_strip(probe, y, viewport[2],
				rows < viewport[3] - y ? rows : viewport[3] - y, i, halves, pass);
	}
	if (read_buffer != (GLint)GL_NONE)
		glReadBuffer((GLenum)read_buffer);
	GLenum code = glGetError();
	if (code != GL_NO_ERROR)
		stress_fault_set(fault, STRESS_FAULT_DRAWING, "after pass \"%s\": GL error 0x%04x",
			pass, code);
	return fault->text[0] == '\0';
}

static void check_pass(void *data, const char *pass)
{
	struct stress_probe *probe = data;
	stress_probe_check_targets(probe, pass, probe->fault);
}

static void ignore_pass(void *data, const char *pass)
{
	(void)data;
	(void)pass;
}

bool stress_probe_init(struct stress_probe *probe, sm_get_proc get_proc,
	const struct sm_driver_options *driver, struct sm_error *error)
{
	*probe = (struct stress_probe){
		.floats = platform_has_extension("GL_EXT_color_buffer_float")};
	real_get_proc = get_proc;
	edits_missing = edits_made = false;
	probe->renderer =
		sm_renderer_create_with(probe->floats ? edit_get_proc : get_proc, driver, error);
	if (probe->renderer == NULL)
		return false;
	const struct sm_pass_observer observer = {
		.data = probe, .begin = ignore_pass, .end = check_pass};
	sm_renderer_set_pass_observer(probe->renderer, &observer);
	glGetIntegerv(GL_MAX_TEXTURE_SIZE, (GLint *)&probe->max_texture_size);
	probe->visibility.format = probe->floats ? GL_RGBA32F : GL_RGBA8;
	probe->picture.format = GL_RGBA8;
	return true;
}

static void framebuffer_finish(struct stress_framebuffer *target)
{
	glDeleteFramebuffers(1, &target->framebuffer);
	glDeleteRenderbuffers(2, target->buffers);
	*target = (struct stress_framebuffer){.format = target->format};
}

void stress_probe_finish(struct stress_probe *probe)
{
	framebuffer_finish(&probe->visibility);
	framebuffer_finish(&probe->picture);
	sm_renderer_destroy(probe->renderer);
	free(probe->values);
	*probe = (struct stress_probe){0};
}

static bool framebuffer_resize(struct stress_framebuffer *target, uint32_t width, uint32_t height,
	struct stress_fault *fault)
{
	const GLenum formats[2] = {target->format, GL_DEPTH_COMPONENT24};
	const GLenum attachments[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
	if (target->width == width && target->height == height)
		return true;
	framebuffer_finish(target);
	glGenFramebuffers(1, &target->framebuffer);
	glGenRenderbuffers(2, target->buffers);
	glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
	for (int i = 0; i < 2; i++) {
		glBindRenderbuffer(GL_RENDERBUFFER, target->buffers[i]);
		glRenderbufferStorage(GL_RENDERBUFFER, formats[i], (GLsizei)width, (GLsizei)height);
		glFramebufferRenderbuffer(
			GL_FRAMEBUFFER, attachments[i], GL_RENDERBUFFER, target->buffers[i]);
	}
	if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
		return stress_fault_set(
			fault, STRESS_FAULT_OTHER, "no framebuffer of %ux%u", width, height);
	target->width = width;
	target->height = height;
	return true;
}

static enum stress_fault_kind kind_of(const struct sm_error *error)
{
	if (error->status == SM_ERROR_INPUT)
		return STRESS_FAULT_INVALID;
	bool memory = strstr(error->text, "GL_OUT_OF_MEMORY") != NULL;
	return memory ? STRESS_FAULT_MEMORY : STRESS_FAULT_DRAWING;
}

static bool draw(struct stress_probe *probe, const struct stress_subject *subject,
	struct stress_framebuffer *target, uint32_t visibility_of, struct stress_fault *fault)
{
	struct sm_error error;
	fault->text[0] = '\0';
	probe->fault = fault;
	if (!framebuffer_resize(target, subject->width, subject->height, fault))
		return false;
	const struct sm_view view = {
		.camera = subject->camera,
		.framebuffer = target->framebuffer,
		.width = subject->width,
		.height = subject->height,
		.visibility_of = visibility_of,
	};
	if (!sm_renderer_set_shadows(probe->renderer, &subject->shadow, &error) ||
		!sm_renderer_draw(probe->renderer, subject->scene, &view, &error))
		return stress_fault_set(fault, kind_of(&error), "drawing fails: %s", error.text);
	bool unedited = probe->floats && visibility_of != SM_NONE && !edits_made;
	if (edits_missing || unedited)
		return stress_fault_set(fault, STRESS_FAULT_OTHER,
			"surface.frag has changed: stress_probe.c must follow it");
	return fault->text[0] == '\0';
}

/* Takes a pixel of a visibility picture apart. */
static bool read_pixel(const struct stress_probe *probe, const float rgba[4], size_t index,
	uint32_t width, float *value, struct stress_fault *fault)
{
	float raw = rgba[0], high = rgba[probe->floats ? 1 : 0], low = rgba[probe->floats ? 2 : 1];
	*value = (256.0f * 255.0f * high + 255.0f * low) / 65535.0f;
	bool valid = rgba[3] == 1.0f && *value >= 0.0f && *value <= 1.0f;
	if (probe->floats)
		valid = valid && raw >= -RANGE_SLACK && raw <= 1.0f + RANGE_SLACK;
	return valid || stress_fault_set(fault, STRESS_FAULT_PIXEL,
				"visibility at %zu, %zu is %g before, %g after it is clamped",
				index % width, index / width, (double)raw, (double)*value);
}

bool stress_probe_visibility(struct stress_probe *probe, const struct stress_subject *subject,
	uint32_t light, struct stress_picture *picture, struct stress_fault *fault)
{
	size_t count = (size_t)subject->width * subject->height;
	*picture = (struct stress_picture){.width = subject->width, .height = subject->height};
	if (!draw(probe, subject, &probe->visibility, light, fault))
		return false;
	picture->values = array_alloc(count, sizeof(*picture->values));
	float *rgba = array_alloc(count, 4 * sizeof(*rgba));
	uint8_t *bytes = (uint8_t *)rgba;
	bool ok = (picture->values != NULL && rgba != NULL) ||
		  stress_fault_set(fault, STRESS_FAULT_OTHER, "out of memory");
	if (ok)
		glReadPixels(0, 0, (GLsizei)subject->width, (GLsizei)subject->height, GL_RGBA,
			probe->floats ? GL_FLOAT : GL_UNSIGNED_BYTE, rgba);
	for (size_t i = 4 * count; i > 0 && ok && !probe->floats; i--)
		rgba[i - 1] = (float)bytes[i - 1] / 255.0f;
	for (size_t i = 0; i < count && ok; i++)
		ok = read_pixel(probe, rgba + 4 * i, i, subject->width, &picture->values[i], fault);
	free(rgba);
	return ok;
}

bool stress_probe_picture(struct stress_probe *probe, const struct stress_subject *subject,
	struct stress_fault *fault)
{
	size_t count = (size_t)subject->width * subject->height;
	if (!draw(probe, subject, &probe->picture, SM_NONE, fault))
		return false;
	uint8_t *rgba = array_alloc(count, 4);
	if (rgba == NULL)
		return stress_fault_set(fault, STRESS_FAULT_OTHER, "out of memory");
	glReadPixels(0, 0, (GLsizei)subject->width, (GLsizei)subject->height, GL_RGBA,
		GL_UNSIGNED_BYTE, rgba);
	for (size_t i = 0; i < count; i++)
		if (rgba[4 * i + 3] != 255)
			stress_fault_set(fault, STRESS_FAULT_PIXEL,
				"the picture's alpha at %zu, %zu is %u", i % subject->width,
				i / subject->width, rgba[4 * i + 3]);
	free(rgba);
	return fault->text[0] == '\0';
}
