/* SPDX-License-Identifier: MIT */
#ifndef GEOM_WORD_H
#define GEOM_WORD_H

#include <stdint.h>

/** A bit for each byte that is 1, not 0. Plain C that needs no instruction of a later processor. */
static inline uint64_t word_of_bytes(const uint8_t bytes[64])
{
	uint64_t word = 0;
	for (int i = 0; i < 64; i += 8) {
		uint64_t eight = 0;
		for (int j = 0; j < 8; j++)
			eight |= (uint64_t)bytes[i + j] << 8 * j;
		/* Moves bit 8 j to bit 56 + j; no two products meet. */
		word |= (eight * UINT64_C(0x0102040810204080) >> 56) << i;
	}
	return word;
}

#endif
