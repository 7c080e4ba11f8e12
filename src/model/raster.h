/* SPDX-License-Identifier: MIT */
#ifndef MODEL_RASTER_H
#define MODEL_RASTER_H

#include <stdbool.h>

/** A value over a screen: at + x dx + y dy in the middle of pixel (x, y), counted from the lower
 *  left. */
struct raster_plane {
	double at, dx, dy;
};

/** A triangle as the values at its corners spread over a screen. */
struct raster_triangle {
	bool front;                     /* counter-clockwise */
	struct raster_plane depth;      /* window depth, [0, 1] */
	struct raster_plane weights[3]; /* of the corners, over w */
};

enum raster_cull { RASTER_ALL, RASTER_FRONT, RASTER_BACK };

/** Where triangles are drawn. */
struct raster_area {
	int width, height;  /* of the viewport, pixels; below 2^15 */
	int min[2], max[2]; /* pixels min <= x, y < max within it */
	enum raster_cull kept;
	int snap_bits; /* 0, or corners are first moved to multiples of 2^-bits of a pixel, 1 to
			  8, and all values with them */
	bool weights_stay, depth_stays; /* where they are: a coarse grid is made up for */
};

/** Is told each pixel that a triangle covers. */
typedef void (*raster_fragment)(
	void *data, const struct raster_triangle *triangle, int x, int y, double depth);

/**
 * Draws a triangle, from corners in clip space, as GL does: clipped by the near and far planes;
 * corners rounded to 1/256 of a pixel; the pixels whose middle is inside, or on a left or upper
 * edge. Values are those of the corners before that rounding.
 */
void raster_draw(const struct raster_area *area, const double corners[3][4],
	raster_fragment fragment, void *data);

/** What share each corner has in the surface at the middle of a pixel, in perspective. */
void raster_weights(const struct raster_triangle *triangle, int x, int y, double weights[3]);

#endif
