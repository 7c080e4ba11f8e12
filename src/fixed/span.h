/* SPDX-License-Identifier: MIT */
#ifndef FIXED_SPAN_H
#define FIXED_SPAN_H

#include "fixed/primitive.h"
#include <stdbool.h>

/** Pixels left .. right - 1 of row y. */
struct fixed_span {
	int32_t y, left, right;
};

/** For fixed_span_next() to start with. */
static inline struct fixed_span fixed_span_before(const struct fixed_cover *cover)
{
	return (struct fixed_span){.y = cover->rect[1] - 1};
}

/** On to the next row that a cover has pixels in; false: there is none. What is covered is convex:
 *  a row has one span. */
bool fixed_span_next(const struct fixed_cover *cover, struct fixed_span *span);

/** Modulo 2^32, as the plane is meant. */
static inline int32_t fixed_plane_at(const struct fixed_plane *plane, int32_t x, int32_t y)
{
	uint32_t at = (uint32_t)plane->at + (uint32_t)plane->dx * (uint32_t)x +
		      (uint32_t)plane->dy * (uint32_t)y;
	return (int32_t)at;
}

/** A depth plane's value within its range, [0, 1 << 30). */
static inline uint32_t fixed_depth_clamp(int32_t value)
{
	const int32_t most = (1 << (FIXED_DEPTH_BITS + FIXED_DEPTH_FRACTION)) - 1;
	return (uint32_t)(value < 0 ? 0 : value > most ? most : value);
}

/** Steps of window depth, below 1 << FIXED_DEPTH_BITS. */
static inline uint32_t fixed_depth_of(int32_t value)
{
	return fixed_depth_clamp(value) >> FIXED_DEPTH_FRACTION;
}

/** In the same range and order, of a camera's depth: what is left to the far plane, inversely
 *  proportional to the distance, has 18 significant bits wherever it is. Steps of equal size would
 *  leave few for all that is many times the near plane's distance away. */
static inline uint32_t fixed_camera_depth_of(int32_t value)
{
	const uint32_t bits = FIXED_DEPTH_BITS - 4;
	uint32_t left = fixed_depth_clamp(INT32_MAX) - fixed_depth_clamp(value);
	uint32_t shift = 0;
	while (left >> shift >= UINT32_C(2) << bits)
		shift++;
	return (UINT32_C(1) << FIXED_DEPTH_BITS) - 1 - ((shift << bits) + (left >> shift));
}

#endif
