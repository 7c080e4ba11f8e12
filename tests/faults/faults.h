/* SPDX-License-Identifier: MIT */
#ifndef TESTS_FAULTS_FAULTS_H
#define TESTS_FAULTS_FAULTS_H

#include <EGL/egl.h>
#include <GLES3/gl3.h>
#include <stdbool.h>

/** What a preloaded library does to the driver below it. */
enum fault {
	FAULT_NONE,
	FAULT_MIN_IS_ADD,
	FAULT_DEPTH_FUNC_IGNORED,
	FAULT_R16F_TRUNCATED,
	FAULT_TEXEL_OFF_BY_ONE,
	FAULT_FLOAT_TARGET_8_BIT,
	FAULT_FLOAT_TARGET_REFUSED,
};

/** That of $GL_FAULT; ends the program if there is no such fault. */
enum fault fault_seeded(void);

#define EXPORT __attribute__((visibility("default")))

/** The function that a program without the library would get. */
void (*real_function(const char *name))(void);
#define REAL(upper, name) ((PFNGL##upper##PROC)real_function(#name))

/** A shader's source, in parts as glShaderSource() takes them, that looks up the texel to the right
 *  of the one asked for; the caller frees it. */
char *shift_look_ups(GLsizei count, const GLchar *const *strings, const GLint *lengths);

#endif
