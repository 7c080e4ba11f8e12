/* SPDX-License-Identifier: MIT */
#ifndef TEST_FIXED_RANDOM_H
#define TEST_FIXED_RANDOM_H

#include <stdint.h>

/** The same numbers everywhere; starts with any state. */
struct random {
	uint64_t state;
};

/** Below `end`. */
static inline uint32_t random_below(struct random *random, uint32_t end)
{
	/* Knuth's MMIX; its high bits. */
	random->state =
		random->state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
	return (uint32_t)((random->state >> 32) % end);
}

static inline double random_between(struct random *random, double low, double high)
{
	return low + (high - low) * (random_below(random, 1u << 31) / 2147483648.0);
}

#endif
