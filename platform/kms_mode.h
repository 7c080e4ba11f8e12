/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_KMS_MODE_H
#define PLATFORM_KMS_MODE_H

#include <smoothie.h>
#include <stddef.h>
#include <xf86drmMode.h>

/** Times a second, as a ratio. */
struct refresh {
	uint32_t numerator, denominator; /* > 0 */
};

/** Which mode of a monitor is wanted; zero: the one that it prefers. */
struct mode_wish {
	bool current;           /* the one that is set; where none is, the preferred one */
	uint32_t width, height; /* 0: any */
	double hz;              /* 0: the fastest of that size */
};

/** Reads "preferred", "current", "WxH" or "WxH@HZ"; false: none of these. */
bool mode_wish_parse(struct mode_wish *wish, const char *text);

/** The mode of `modes` that is wanted, or NULL. current: the one that is set, NULL: none. */
const drmModeModeInfo *mode_choose(const struct mode_wish *wish, const drmModeModeInfo *modes,
	size_t count, const drmModeModeInfo *current);

/** From the mode's own timing, which is finer than its vrefresh. */
struct refresh mode_refresh(const drmModeModeInfo *mode);

/** Whether they are the same on the wire, whatever their names and flags of preference. */
bool mode_equal(const drmModeModeInfo *a, const drmModeModeInfo *b);

#endif
