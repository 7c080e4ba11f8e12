/* SPDX-License-Identifier: MIT */
#ifndef TECHNIQUE_DISC_MASK_H
#define TECHNIQUE_DISC_MASK_H

#include <stdint.h>

/** Samples of the unit disc that stand for equal areas: one a bit of a mask. Bit i is at the angle
 *  2 pi (i + 1/2) / 64, so that a sector of the disc is a run of bits. */
#define DISC_MASK_SAMPLES 64

/** Of the table of half planes. */
#define DISC_MASK_ANGLES 128
#define DISC_MASK_DISTANCES 64

/** Where sample i of DISC_MASK_SAMPLES is. */
void disc_mask_sample(int i, double point[2]);

/**
 * Which samples lie beyond a line: entry [d * DISC_MASK_ANGLES + a] has those with
 *	x cos(t) + y sin(t) > h,  t = 2 pi (a + 1/2) / DISC_MASK_ANGLES,
 *	                          h = (d + 1/2) / DISC_MASK_DISTANCES
 * bits 0 to 31 in [0], the others in [1]: a row of a texture for each distance.
 *
 * table: [DISC_MASK_ANGLES * DISC_MASK_DISTANCES], overwritten.
 */
void disc_mask_table(uint32_t (*table)[2]);

/** Samples first <= i < end, modulo DISC_MASK_SAMPLES; none where both are equal. */
uint64_t disc_mask_sector(int first, int end);

#endif
