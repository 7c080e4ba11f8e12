/* SPDX-License-Identifier: MIT */
#ifndef REF_DISC_H
#define REF_DISC_H

#include <stdbool.h>
#include <stdint.h>

/** Sets of points of the unit disc. */
struct disc {
	uint32_t count; /* points of a set */
	uint32_t sets;
	float *x, *y; /* [sets * count]; x owns the memory of both */
};

/** One set that tells whether a disc is seen whole, in part or not at all: of its 64 points 28 are
 *  on the rim, where an edge that clips the disc comes first. False: out of memory. */
bool disc_init_coarse(struct disc *disc);

/** Sets that measure: a random point in each cell of a grid with at least `samples` cells, 1 to
 *  2^16, brought to the disc by equal areas (Shirley & Chiu 1997). False: out of memory. */
bool disc_init_fine(struct disc *disc, uint32_t samples);

void disc_finish(struct disc *disc);

/** 64 bits that look random, of any bits (splitmix64, Steele et al. 2014). */
uint64_t scramble(uint64_t bits);

#endif
