/* SPDX-License-Identifier: MIT */
#ifndef GLES_RASTER_GRID_H
#define GLES_RASTER_GRID_H

#include "gles/gpu.h"

/** Bits of a texel that the finest grid has which corners of triangles are taken to be moved to. */
#define RASTER_BITS_MAX 11

/** Bits of a texel that the driver's raster grid has, 1 to RASTER_BITS_MAX, found by drawing once
 *  for all: GL_SUBPIXEL_BITS is what a driver has at least, 4 on some that have 8 or no grid at
 *  all. Leaves the framebuffer and the viewport as they are, and textures unbound at unit 0. */
uint32_t raster_grid_bits(struct gpu *gpu);

#endif
