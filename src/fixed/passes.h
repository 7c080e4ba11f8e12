/* SPDX-License-Identifier: MIT */
#ifndef FIXED_PASSES_H
#define FIXED_PASSES_H

#include "fixed/number.h"
#include "fixed/scene.h"

/** What is a map's where nothing was drawn. */
#define FIXED_DEPTH_CLEAR (UINT32_C(1) << FIXED_DEPTH_BITS)

/** What the passes over the light's screen draw: [size][size] each, rows from the bottom. */
struct fixed_maps {
	int32_t size;
	uint32_t *casters, *receivers_only; /* depth; owned */
	uint32_t *smoothie_depth;           /* likewise: of the nearest fin */
	uint16_t *smoothie_alpha;           /* the least falloff(alpha'), a number; owned */
};

/** Draws them. False: out of memory. */
bool fixed_maps_init(struct fixed_maps *maps, const struct fixed_scene *scene,
	const struct number_model *number);
/** Also of zeroed ones. */
void fixed_maps_finish(struct fixed_maps *maps);

/** Draws the scene's picture of the light's visibility as every driver has to. values:
 *  [height][width], steps of 1/65535, rows from the top. False: out of memory. */
bool fixed_draw(
	const struct fixed_scene *scene, const struct number_model *number, uint16_t *values);

/** Entries of the sinusoid falloff: of alpha' = i / 1024 the number nearest to
 *  (1 - cos(pi i / 1024)) / 2 (Chan & Durand 2003, section 4). */
#define FIXED_FALLOFF_SIZE 1025
void fixed_falloff_init(const struct number_model *number, uint16_t table[FIXED_FALLOFF_SIZE]);

#endif
