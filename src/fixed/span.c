/* SPDX-License-Identifier: MIT */
#include "fixed/span.h"

/* A sign bit where an edge leaves pixel (x, y) out. */
static int32_t outside(const struct fixed_cover *cover, int32_t x, int32_t y)
{
	int32_t any = 0;
	for (int i = 0; i < 4; i++)
		any |= fixed_plane_at(&cover->edges[i], x, y);
	return any;
}

bool fixed_span_next(const struct fixed_cover *cover, struct fixed_span *span)
{
	const int32_t *rect = cover->rect;
	while (++span->y < rect[3]) {
		int32_t x = rect[0];
		while (x < rect[2] && outside(cover, x, span->y) < 0)
			x++;
		span->left = x;
		while (x < rect[2] && outside(cover, x, span->y) >= 0)
			x++;
		span->right = x;
		if (span->left < span->right)
			return true;
	}
	return false;
}
