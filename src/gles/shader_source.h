/* SPDX-License-Identifier: MIT */
#ifndef GLES_SHADER_SOURCE_H
#define GLES_SHADER_SOURCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** A file of shaders_es/, embedded at build. The table ends with a NULL name. */
struct shader_file {
	const char *name, *text;
};
extern const struct shader_file shader_files[];

enum program_kind {
	PROGRAM_DEPTH_MAP,
	PROGRAM_FIN,
	PROGRAM_BLUR,
	PROGRAM_TWO_SIDED_FIN,
	PROGRAM_SURFACE,
	PROGRAM_COPY,
	PROGRAM_SCREEN,
	PROGRAM_PROBE_DRAW,
	PROGRAM_PROBE_READ,
	PROGRAM_EXACT_DEPTH,
	PROGRAM_EXACT_FIN,
	PROGRAM_EXACT_SURFACE,
	PROGRAM_EXACT_COPY,
	PROGRAM_KINDS,
};

/** What a variant switches on: each bit is a #define of the name behind it (flag_names in
 *  shader_source.c). */
enum program_flag {
	FLAG_SINUSOID = 1 << 0,
	FLAG_DEPTH_ONLY = 1 << 1,
	FLAG_RECEIVER_MAP = 1 << 2,
	FLAG_LIT = 1 << 3,
	FLAG_SHADOWED = 1 << 4,
	FLAG_HARD = 1 << 5,
	FLAG_SMOOTHIE = 1 << 6,
	FLAG_SEPARATE_DEPTH = 1 << 7,
	FLAG_GATHER = 1 << 8,
	FLAG_TEXTURED = 1 << 9,
	FLAG_VISIBILITY = 1 << 10,
	FLAG_ENCODE_SRGB = 1 << 11,
	FLAG_DITHER = 1 << 12,
	FLAG_WIDEN = 1 << 13,
	FLAG_STORED = 1 << 14,
	FLAG_TWO_SIDED = 1 << 15,
	FLAG_CONE = 1 << 16,
	FLAG_BICUBIC = 1 << 17,
	FLAG_PCSS = 1 << 18,
	FLAG_MAPS = 1 << 19,
	FLAG_VSM = 1 << 20,
	FLAG_FOUR_FETCHES = 1 << 21,
	FLAG_FROM_DEPTH = 1 << 22,
	FLAG_ALPHA_DEPTH = 1 << 23,
	FLAG_FETCH = 1 << 24,
	FLAG_DEPTH_FLOAT = 1 << 25,
	FLAG_DEPTH_HALF = 1 << 26,
	FLAG_DEPTH_PACKED = 1 << 27,
	FLAG_SPLIT = 1 << 28,
	FLAG_FIXED12 = 1 << 29,
	FLAG_SEEN = 1 << 30,
};

/** The first bit that is no flag. */
#define FLAG_END (UINT32_C(1) << 31)

struct program_key {
	enum program_kind kind;
	uint32_t flags;
};

enum shader_stage { STAGE_VERTEX, STAGE_FRAGMENT };

/** Whether the renderer may ask for this variant: all of these are checked when the project is
 *  built. */
bool program_key_is_valid(struct program_key key);

/** The flags that mean something to a kind of program. */
uint32_t program_kind_flags(enum program_kind kind);

#define SHADER_PARTS_MAX 32

/** The strings that make up one stage, in order, as glShaderSource() takes them; none is owned.
 *  Returns their number. */
size_t shader_parts(
	struct program_key key, enum shader_stage stage, const char *parts[SHADER_PARTS_MAX]);

/** "surface LIT SHADOWED HARD", for messages. Returns text. */
const char *program_key_name(struct program_key key, char *text, size_t size);

#endif
