/* SPDX-License-Identifier: MIT */
#ifndef CHECK_TOLERANCE_H
#define CHECK_TOLERANCE_H

#include "check/context.h"

/** How far a picture of 256 pixels a side may be from its model, in shares of the light. */
struct check_tolerance {
	double pixel; /**< of a pixel */
	double share; /**< of the pixels that may be off by more */
	double mean;  /**< of all pixels' |difference| */
};

/** Of a class of drivers, with a way "NEED=WAY", or NULL where no way is forced. */
struct check_tolerance check_tolerance_find(enum check_class class, const char *way);

/** Compares by it, and sets status, difference and a message that names the tolerance. Counts: of
 *  pixels. */
void check_tolerance_judge(const struct check_tolerance *tolerance, const uint16_t *drawn,
	const uint16_t *wanted, size_t count, struct check_result *result);

#endif
