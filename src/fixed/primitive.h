/* SPDX-License-Identifier: MIT */
#ifndef FIXED_PRIMITIVE_H
#define FIXED_PRIMITIVE_H

#include <stddef.h>
#include <stdint.h>

/*
 * What the exact passes draw: polygons as integers, so that every processor and every driver covers
 * the same pixels with the same values. A rectangle of whole pixels is all that a rasteriser is
 * trusted with; what is inside is decided pixel by pixel by edge functions (Pineda 1988), and
 * values are planes over the screen, both in 32-bit integers. Each struct is of whole groups of
 * four integers, so that an array of them can be read as texels or attributes of that kind.
 */

/** Subpixel steps of a pixel, on which corners lie: 4 bits, which every driver has. */
#define FIXED_SUBPIXELS 16
/** Bits of depth: exact in a float and, in order, in a 24-bit depth buffer. 1 << FIXED_DEPTH_BITS
 * is depth 1. */
#define FIXED_DEPTH_BITS 21
/** Further bits that depth planes carry below those. */
#define FIXED_DEPTH_FRACTION 9
/** Of the planes of a fin's offset and width: bits below one. */
#define FIXED_FIN_FRACTION 8
/** Bits of a receiver's place on the light's screen, a share of its side. */
#define FIXED_SCREEN_BITS 20

/** at + x dx + y dy at pixel (x, y), counted from the lower left; modulo 2^32, so that only the
 *  result must fit. */
struct fixed_plane {
	int32_t at, dx, dy;
};

/** Where a convex polygon of up to four sides is: rect: left, bottom, right, top, in pixels, the
 * last two exclusive; inside it, the pixels where no edge is below 0. Unused edges are all 0. */
struct fixed_cover {
	int32_t rect[4];
	struct fixed_plane edges[4];
};

/** Of the shadow map. */
struct fixed_blocker {
	struct fixed_cover cover;
	struct fixed_plane depth; /* window depth << FIXED_DEPTH_FRACTION */
	int32_t unused;
};

/** Of a smoothie. Offset and width are in a unit of the fin's own, in which they stay below 2^14.
 */
struct fixed_fin {
	struct fixed_cover cover;
	struct fixed_plane depth;
	struct fixed_plane offset_x, offset_y, width; /* << FIXED_FIN_FRACTION */
};

enum fixed_receiver_kind {
	FIXED_AWAY, /* faces away from the light; by smooth normals it may be lit all the same */
	FIXED_LIT,  /* faces it, and receives no shadow */
	FIXED_RECEIVES,
};

/** Of the picture. Place on the light's screen and window depth there are x/w, y/w and z/w, each in
 *  [0, 1] where the light sees them; the four are in a unit of the receiver's own, in which they
 * stay below 2^30. */
struct fixed_receiver {
	struct fixed_cover cover;
	struct fixed_plane depth; /* the camera's window depth << FIXED_DEPTH_FRACTION; compared as
				    fixed_camera_depth_of() has it */
	struct fixed_plane x, y, z, w;
	int32_t bias; /* of window depth: what its slope may have in the four nearest texels, and
			 rounding */
	int32_t kind; /* enum fixed_receiver_kind */
	int32_t unused[3];
};

/** Growable arrays; zero is empty. */
struct fixed_blockers {
	struct fixed_blocker *items; /* owned */
	size_t count, capacity;
};

struct fixed_fins {
	struct fixed_fin *items; /* owned */
	size_t count, capacity;
};

struct fixed_receivers {
	struct fixed_receiver *items; /* owned */
	size_t count, capacity;
};

void fixed_blockers_finish(struct fixed_blockers *blockers);
void fixed_fins_finish(struct fixed_fins *fins);
void fixed_receivers_finish(struct fixed_receivers *receivers);

#endif
