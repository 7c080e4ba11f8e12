/* SPDX-License-Identifier: MIT */
#ifndef GLES_CAPS_H
#define GLES_CAPS_H

#include "gles/gl.h"

/** A colour format that blended values can be kept in. */
struct color_format {
	const char *name;
	GLenum internal_format;
};

/** What the driver can do, and which way each need is met: the one place where that is chosen. */
struct caps {
	const char *renderer, *vendor, *version, *shading_language; /* owned by the context */
	int major, minor;
	GLint max_texture_size, max_viewport[2];
	GLint program_binary_formats;     /* may be 0 */
	bool texture_gather;              /* core in 3.1 */
	bool EXT_color_buffer_float;      /* RG32F, RG16F and the like as targets */
	bool EXT_color_buffer_half_float; /* RG16F as a target */
	bool EXT_float_blend;
	bool EXT_texture_filter_anisotropic;
	bool EXT_texture_sRGB_decode;
	bool KHR_debug;
	bool OES_texture_float_linear; /* RG32F can be filtered */
	/** For the smoothie buffer: two channels, MIN-blended. */
	struct color_format smoothie_format;
	/** For the moments of depth: two channels of float. No name where there is none. */
	struct color_format moment_format;
	bool moments_filtered; /* by the sampler */
};

/** Reads version and extensions and probes the formats. Fails (MACHINE) below OpenGL ES 3.0. */
bool caps_init(struct caps *caps, struct gl *gl, struct sm_error *error);

/** As sm_renderer_describe(). */
void caps_describe(const struct caps *caps, sm_fact fact, void *data);

#endif
