/* SPDX-License-Identifier: MIT */
#ifndef GLES_CAPS_H
#define GLES_CAPS_H

#include "gles/gl.h"

/** What a driver may be able to do; caps.c has their names, and what each takes. */
enum cap {
	CAP_COLOR_BUFFER_FLOAT,
	CAP_COLOR_BUFFER_HALF_FLOAT,
	CAP_FLOAT_BLEND,
	CAP_SHADER_FRAMEBUFFER_FETCH,
	CAP_TEXTURE_FILTER_ANISOTROPIC,
	CAP_TEXTURE_SRGB_DECODE,
	CAP_TEXTURE_VIEW,
	CAP_KHR_DEBUG,
	CAP_TEXTURE_FLOAT_LINEAR,
	CAP_HIGHP_SAMPLER,
	CAP_DEPTH_FETCH,
	CAP_SHADOW_FILTER,
	CAP_TEXTURE_GATHER,
	CAP_FRAG_DEPTH_MIN,
	CAP_MIN_RG16F,
	CAP_MIN_RG32F,
	CAP_MIN_RGB10_A2,
	CAP_MIN_RGBA8,
	CAP_FETCH_RG16F,
	CAP_FETCH_R32I,
	CAP_HALF_WORDS,
	CAP_RENDER_R32F,
	CAP_RENDER_R16F,
	CAP_RENDER_RG32F,
	CAP_RENDER_RGBA16F,
	CAP_FILTER_RG32F,
	CAP_FILTER_RGBA16F,
	CAP_SLOW_BRANCH,
	CAP_LATE_WAIT,
	CAP_SLOW_UNIFORMS,
	CAP_SLOW_LOOKUPS,
	CAP_SRGB_STORED,
	CAP_FRAGMENT_IMAGES,
	CAP_COUNT,
};

/** A set of caps. */
#define CAP_BIT(name) (UINT64_C(1) << CAP_##name)

/** Whether the driver has a cap, as far as that is known. */
struct cap_finding {
	bool known, there;
	bool taken; /* away by the caller: then it is not there */
	char why[96];
};

/** What the driver says of itself, and what was found out of it. */
struct caps {
	const char *renderer, *vendor, *version, *shading_language; /* owned by the context */
	int major, minor;
	GLint max_texture_size, max_viewport[2];
	GLint program_binary_formats; /* may be 0 */
	struct cap_finding found[CAP_COUNT];
};

/** Reads version and extensions; takes away what `list` says, as sm_driver_options.caps. Fails
 *  (MACHINE) below OpenGL ES 3.0, (INPUT) on a list that cannot be read. */
bool caps_init(struct caps *caps, struct gl *gl, const char *list, struct sm_error *error);

/** NULL past the last. */
const char *cap_name(size_t index);

/** Notes that a cap is there, or is not, and why. */
void caps_note(struct caps *caps, enum cap cap, bool there, const char *format, ...)
	PRINTF_LIKE(4, 5);

/** Whether it is known without drawing that a cap is not there; notes it. */
bool caps_rule_out(struct caps *caps, enum cap cap);

/** Facts of the driver itself, as sm_renderer_describe(). */
void caps_describe(const struct caps *caps, sm_fact fact, void *data);

#endif
