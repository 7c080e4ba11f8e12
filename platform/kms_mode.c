/* SPDX-License-Identifier: MIT */
#include "kms_mode.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Names round what timing gives: 59.94 Hz is asked for as 59.94, 59.9 or 60. */
static const double hz_tolerance = 0.5;

static bool parse_side(const char **text, uint32_t *side)
{
	char *end;
	if (**text < '1' || **text > '9')
		return false;
	unsigned long value = strtoul(*text, &end, 10);
	/* The fields of a mode have 16 bits. */
	*side = (uint32_t)value;
	*text = end;
	return value <= UINT16_MAX;
}

bool mode_wish_parse(struct mode_wish *wish, const char *text)
{
	*wish = (struct mode_wish){.current = strcmp(text, "current") == 0};
	if (wish->current || strcmp(text, "preferred") == 0)
		return true;
	if (!parse_side(&text, &wish->width) || *text++ != 'x' || !parse_side(&text, &wish->height))
		return false;
	if (*text == '\0')
		return true;
	char *end;
	if (*text++ != '@' || *text < '0' || *text > '9')
		return false;
	wish->hz = strtod(text, &end);
	return *end == '\0' && wish->hz > 0 && wish->hz <= 1000;
}

struct refresh mode_refresh(const drmModeModeInfo *mode)
{
	uint32_t pixels = (uint32_t)mode->htotal * mode->vtotal;
	/* Virtual displays may leave the timing out. */
	if (mode->clock == 0 || pixels == 0 || mode->clock > UINT32_MAX / 2000)
		return (struct refresh){mode->vrefresh > 0 ? mode->vrefresh : 60, 1};
	struct refresh refresh = {mode->clock * 1000, pixels};
	if (mode->flags & DRM_MODE_FLAG_INTERLACE)
		refresh.numerator *= 2;
	if (mode->flags & DRM_MODE_FLAG_DBLSCAN && pixels <= UINT32_MAX / 2)
		refresh.denominator *= 2;
	return refresh;
}

static double hz_of(const drmModeModeInfo *mode)
{
	struct refresh refresh = mode_refresh(mode);
	return (double)refresh.numerator / refresh.denominator; /* > 0, says mode_refresh() */
}

/* The wanted size at the nearest rate within tolerance, or at the highest. */
static const drmModeModeInfo *choose_size(
	const struct mode_wish *wish, const drmModeModeInfo *modes, size_t count)
{
	const drmModeModeInfo *best = NULL;
	for (size_t i = 0; i < count; i++) {
		const drmModeModeInfo *mode = &modes[i];
		if (mode->hdisplay != wish->width || mode->vdisplay != wish->height)
			continue;
		if (wish->hz == 0 ? best == NULL || hz_of(mode) > hz_of(best)
				  : fabs(hz_of(mode) - wish->hz) <= hz_tolerance &&
					    (best == NULL || fabs(hz_of(mode) - wish->hz) <
								     fabs(hz_of(best) - wish->hz)))
			best = mode;
	}
	return best;
}

const drmModeModeInfo *mode_choose(const struct mode_wish *wish, const drmModeModeInfo *modes,
	size_t count, const drmModeModeInfo *current)
{
	if (wish->current && current != NULL)
		return current;
	if (wish->width > 0)
		return choose_size(wish, modes, count);
	for (size_t i = 0; i < count; i++)
		if (modes[i].type & DRM_MODE_TYPE_PREFERRED)
			return &modes[i];
	/* The kernel sorts them from the largest. */
	return count > 0 ? &modes[0] : NULL;
}

bool mode_equal(const drmModeModeInfo *a, const drmModeModeInfo *b)
{
	return a->clock == b->clock && a->flags == b->flags &&
	       memcmp(&a->hdisplay, &b->hdisplay,
		       offsetof(drmModeModeInfo, vrefresh) - offsetof(drmModeModeInfo, hdisplay)) ==
		       0;
}
