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
	PROGRAM_LAYER,
	PROGRAM_FIN,
	PROGRAM_BLUR,
	PROGRAM_TWO_SIDED_FIN,
	PROGRAM_SURFACE,
	PROGRAM_CELLS,
	PROGRAM_KNOWN,
	PROGRAM_FIND,
	PROGRAM_COPY,
	PROGRAM_WORD,
	PROGRAM_SCREEN,
	PROGRAM_PROBE_DRAW,
	PROGRAM_PROBE_READ,
	PROGRAM_PROBE_BRANCH,
	PROGRAM_EXACT_DEPTH,
	PROGRAM_EXACT_FIN,
	PROGRAM_EXACT_SURFACE,
	PROGRAM_EXACT_COPY,
	PROGRAM_KINDS,
};

/** What a variant switches on: each bit is a #define of the name behind it (flag_names in
 *  shader_source.c). */
#define FLAG_SINUSOID (UINT64_C(1) << 0)
#define FLAG_DEPTH_ONLY (UINT64_C(1) << 1)
#define FLAG_RECEIVER_MAP (UINT64_C(1) << 2)
#define FLAG_LIT (UINT64_C(1) << 3)
#define FLAG_SHADOWED (UINT64_C(1) << 4)
#define FLAG_HARD (UINT64_C(1) << 5)
#define FLAG_SMOOTHIE (UINT64_C(1) << 6)
#define FLAG_SEPARATE_DEPTH (UINT64_C(1) << 7)
#define FLAG_GATHER (UINT64_C(1) << 8)
#define FLAG_TEXTURED (UINT64_C(1) << 9)
#define FLAG_VISIBILITY (UINT64_C(1) << 10)
#define FLAG_ENCODE_SRGB (UINT64_C(1) << 11)
#define FLAG_DITHER (UINT64_C(1) << 12)
#define FLAG_WIDEN (UINT64_C(1) << 13)
#define FLAG_STORED (UINT64_C(1) << 14)
#define FLAG_TWO_SIDED (UINT64_C(1) << 15)
#define FLAG_CONE (UINT64_C(1) << 16)
#define FLAG_BICUBIC (UINT64_C(1) << 17)
#define FLAG_PCSS (UINT64_C(1) << 18)
#define FLAG_MAPS (UINT64_C(1) << 19)
#define FLAG_VSM (UINT64_C(1) << 20)
#define FLAG_FOUR_FETCHES (UINT64_C(1) << 21)
#define FLAG_FROM_DEPTH (UINT64_C(1) << 22)
#define FLAG_ALPHA_DEPTH (UINT64_C(1) << 23)
#define FLAG_FETCH (UINT64_C(1) << 24)
#define FLAG_DEPTH_FLOAT (UINT64_C(1) << 25)
#define FLAG_DEPTH_HALF (UINT64_C(1) << 26)
#define FLAG_DEPTH_PACKED (UINT64_C(1) << 27)
#define FLAG_SPLIT (UINT64_C(1) << 28)
#define FLAG_FIXED12 (UINT64_C(1) << 29)
#define FLAG_SEEN (UINT64_C(1) << 30)
#define FLAG_EDGES (UINT64_C(1) << 31)
#define FLAG_PEEL (UINT64_C(1) << 32)
#define FLAG_POINTS (UINT64_C(1) << 33)
#define FLAG_CELLS (UINT64_C(1) << 34)
#define FLAG_RUNS (UINT64_C(1) << 35)
#define FLAG_RECEIVERS (UINT64_C(1) << 36)
#define FLAG_FOUND (UINT64_C(1) << 37)
#define FLAG_COARSE (UINT64_C(1) << 38)
#define FLAG_BEHIND (UINT64_C(1) << 39)
#define FLAG_WORDS (UINT64_C(1) << 40)
#define FLAG_TWO_LAYERS (UINT64_C(1) << 41)
#define FLAG_HOLLOWS (UINT64_C(1) << 42)
#define FLAG_SAMPLES (UINT64_C(1) << 43)
#define FLAG_FLAT_INPUTS (UINT64_C(1) << 44)
#define FLAG_FUSED (UINT64_C(1) << 45)
#define FLAG_IMAGES (UINT64_C(1) << 46)

/** The first bit that is no flag. */
#define FLAG_END (UINT64_C(1) << 47)

struct program_key {
	enum program_kind kind;
	uint64_t flags;
};

enum shader_stage { STAGE_VERTEX, STAGE_FRAGMENT };

/** Whether the renderer may ask for this variant: all of these are checked when the project is
 *  built. */
bool program_key_is_valid(struct program_key key);

/** From flags 0, valid or not, to the next variant of the kind, until there is none. */
bool program_key_next(struct program_key *key);

/** The flags that mean something to a kind of program. */
uint64_t program_kind_flags(enum program_kind kind);

/** Fins of one draw: as many as the least size that a uniform block may have, 16 KiB, holds (OpenGL
 *  ES 3.0, table 6.32). */
#define BLOCK_FINS 512

#define SHADER_PARTS_MAX 32

/** The strings that make up one stage, in order, as glShaderSource() takes them; none is owned.
 *  Returns their number. */
size_t shader_parts(
	struct program_key key, enum shader_stage stage, const char *parts[SHADER_PARTS_MAX]);

/** "surface LIT SHADOWED HARD", for messages. Returns text. */
const char *program_key_name(struct program_key key, char *text, size_t size);

#endif
