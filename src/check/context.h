/* SPDX-License-Identifier: MIT */
#ifndef CHECK_CONTEXT_H
#define CHECK_CONTEXT_H

#include "base/error.h"
#include "check/case.h"

/** Drivers that round alike. */
enum check_class {
	CHECK_LLVMPIPE,
	CHECK_SOFTPIPE,
	CHECK_ZINK,
	CHECK_SWIFTSHADER,
	CHECK_HARDWARE, /**< any other */
	CHECK_CLASS_COUNT,
};

/** By the renderer's name. */
enum check_class check_class_find(const char *renderer);
/** "llvmpipe", "softpipe", "zink", "swiftshader", "hardware". */
const char *check_class_name(enum check_class class);
/** Pixels a side of pictures, and texels a side of their shadow maps: as many as the class draws in
 *  a fair time. */
uint32_t check_class_size(enum check_class class);
uint32_t check_class_map(enum check_class class);

/** What the process of a case has. */
struct check_context {
	struct platform *platform; /**< owned; its context is current. A case may replace it, or
					leave NULL */
	const char *device;        /**< for platform_create_on() */
	bool debug;
	struct sm_driver_options driver; /**< for renderers; not owned */
	enum check_class class;
	uint32_t width, height; /**< of pictures */
	uint32_t map;           /**< texels a side of their shadow maps */
	/** What was drawn, and what must be: [height][width] shares of a light in steps of 1/65535,
	 *  rows from the top; owned, NULL: none. */
	uint16_t *drawn, *wanted;
};

/** Frees what the context owns; fine on a half-made one. */
void check_context_finish(struct check_context *context);

/** Set status and message of a result. */
void check_pass(struct check_result *result, const char *format, ...) PRINTF_LIKE(2, 3);
void check_fail(struct check_result *result, const char *format, ...) PRINTF_LIKE(2, 3);
void check_skip(struct check_result *result, const char *format, ...) PRINTF_LIKE(2, 3);

/** Counts into result->difference what of two pictures is apart by more than a tolerance, in shares
 *  of the light. */
void check_compare(struct check_result *result, const uint16_t *drawn, const uint16_t *wanted,
	size_t count, double tolerance);

#endif
