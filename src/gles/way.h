/* SPDX-License-Identifier: MIT */
#ifndef GLES_WAY_H
#define GLES_WAY_H

#include "gles/caps.h"

/** What techniques need of a driver and can get in several ways: the indices of the one table of
 *  these (way.c). */
enum driver_need {
	DRIVER_SMOOTHIE,
	DRIVER_DEPTH,
	DRIVER_COMPARISON,
	DRIVER_TAPS,
	DRIVER_PAIRS,
	DRIVER_MOMENTS,
	DRIVER_COPY,
	DRIVER_BRANCH,
	DRIVER_PASSES,
	DRIVER_CONSTANTS,
	DRIVER_TABLES,
	DRIVER_NEEDS,
};

/* The ways of each, best first. */
enum smoothie_way {
	SMOOTHIE_RG16F,
	SMOOTHIE_RG32F,
	SMOOTHIE_RGB10_A2,
	SMOOTHIE_RGBA8,
	SMOOTHIE_DEPTH_TEST,
	SMOOTHIE_FETCH,
};
enum depth_way { DEPTH_TEXTURE, DEPTH_R32F, DEPTH_R16F, DEPTH_RGBA8 };
enum comparison_way { COMPARISON_SAMPLER, COMPARISON_GATHER, COMPARISON_FETCH };
enum pairs_way { PAIRS_FUSED, PAIRS_WORDS, PAIRS_APART };
enum taps_way { TAPS_GATHER, TAPS_FETCH };
enum moments_way { MOMENTS_RG32F, MOMENTS_RG32F_FETCH, MOMENTS_RGBA16F, MOMENTS_RGBA16F_FETCH };
enum copy_way { COPY_STORED, COPY_ENCODE };
enum branch_way { BRANCH_EARLY_DEPTH, BRANCH_SHADER };
enum passes_way { PASSES_FINISHED, PASSES_QUEUED };
enum constants_way { CONSTANTS_FLAT, CONSTANTS_UNIFORMS };
enum tables_way { TABLES_IMAGES, TABLES_TEXTURES };

/** One way to meet a need. */
struct driver_way {
	const char *name;
	const char *summary;
	uint64_t caps; /* all that it takes: CAP_BIT()s */
	GLenum format; /* of what is drawn into; 0: nothing is */
	uint64_t pays; /* caps without which it works, but another way is better */
};

/** Which way is forced, and which was chosen, of each need: the way's index + 1; 0: none. */
struct ways {
	uint8_t forced[DRIVER_NEEDS], chosen[DRIVER_NEEDS];
};

struct gpu;

/** Takes sm_driver_options.paths. Fails (INPUT) on what is none, (MACHINE) on a way that the driver
 *  lacks a cap for. */
bool ways_force(
	struct gpu *gpu, const char *const *paths, size_t path_count, struct sm_error *error);

/** The way that a need is met in, chosen on first use: its index. Fails (MACHINE), with -1, where
 *  the driver has none. */
int way_choose(struct gpu *gpu, enum driver_need need, struct sm_error *error);

/** The entry of the table; NULL past the last. */
const struct driver_way *way_at(enum driver_need need, size_t index);

/** NULL past the last. */
const char *need_name(size_t index);

/** Every need, the way that it is met in, and why in none of the better ones. */
void ways_describe(struct gpu *gpu, sm_fact fact, void *data);

#endif
