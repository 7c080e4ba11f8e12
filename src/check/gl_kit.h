/* SPDX-License-Identifier: MIT */
#ifndef CHECK_GL_KIT_H
#define CHECK_GL_KIT_H

#include "check/context.h"
#include <GLES3/gl3.h>

/** Texels a side of what the GL cases draw. */
#define KIT_SIZE 64
#define KIT_TEXELS (KIT_SIZE * KIT_SIZE)

#define KIT_NAMES 12

/**
 * What a GL case draws with: it owns GL objects, and fails once. After that the functions below do
 * nothing and return 0, so that a case asks at its end alone.
 */
struct kit {
	struct check_result *result; /* not owned */
	bool failed;                 /* *result says why; it may be a skip */
	GLuint vertex_array, sampler;
	GLuint textures[KIT_NAMES], framebuffers[KIT_NAMES], programs[KIT_NAMES];
	size_t texture_count, framebuffer_count, program_count;
};

void kit_init(struct kit *kit, struct check_result *result);
/** Deletes what it owns. True: nothing failed, and GL has no error; *result is the caller's to
 *  fill. */
bool kit_finish(struct kit *kit);

/** Of the context: 31 for OpenGL ES 3.1. */
int kit_version(void);
/** Skips unless the context has that version or extension. */
void kit_need_version(struct kit *kit, int version);
void kit_need_extension(struct kit *kit, const char *name);

/** A texture of KIT_SIZE texels a side, unfiltered, clamped to the edge, with one level. */
GLuint kit_texture(struct kit *kit, GLenum internal_format);

/** A framebuffer of textures, 0 for none; it is bound, with its viewport. `name`: of the format
 * that may be no target, which is skipped; NULL: it must be one. */
GLuint kit_framebuffer(struct kit *kit, GLuint color, GLuint depth, const char *name);

/** A program in use. vertex: main() of a shader, or NULL for one that fills the screen with three
 *  vertices of depth `uniform float z` (NDC). fragment: all behind the header, which has highp
 *  everywhere. version: 300 or 310, of GLSL ES. */
GLuint kit_program(struct kit *kit, int version, const char *vertex, const char *fragment);
void kit_set_int(struct kit *kit, const char *uniform, GLint value);
void kit_set_float(struct kit *kit, const char *uniform, GLfloat value);

/** Draws triangles of the program in use. */
void kit_draw(struct kit *kit, GLsizei vertices);
/** kit_draw() of the screen. */
void kit_fill(struct kit *kit);

/** For fragment shaders: vec4 kit_value(int layer) of a pixel, all of layers 0 to 3 different
 *  multiples of 1/65536 in [0, 1). */
extern const char kit_value_source[];
float kit_value(size_t texel, int channel, int layer);

/** Reads all texels of a texture, with texelFetch(): float bits as unsigned integers, which every
 *  driver draws and reads back unchanged. Rows from the bottom. */
void kit_read(struct kit *kit, GLuint texture, float (*texels)[4]);
/** Reads a texture of a format of integers; is_signed: of int. */
void kit_read_integers(struct kit *kit, GLuint texture, bool is_signed, uint32_t (*texels)[4]);
/** Draws a shader whose main() sets `uvec4 bits`, its sources bound, and reads that. */
void kit_evaluate(struct kit *kit, int version, const char *fragment, uint32_t (*texels)[4]);

/** A function that compares depths, and whether it holds for a reference, or a fragment, that is
 *  nearer than what is there, as far, and farther (OpenGL ES 3.0, table 3.22). */
struct kit_comparison {
	const char *name;
	GLenum func;
	bool holds[3];
};

#define KIT_COMPARISONS 8
extern const struct kit_comparison kit_comparisons[KIT_COMPARISONS];

/** Counts into result->difference what is off by more than a tolerance. */
void kit_compare(struct check_result *result, double drawn, double wanted, double tolerance);
/** When all is compared: a pass if nothing failed, and else a failure; the message starts with
 *  `what`. */
void kit_judge(struct check_result *result, const char *what);

#endif
