/* SPDX-License-Identifier: MIT */
#ifndef GLES_TEXTURE_UNIT_H
#define GLES_TEXTURE_UNIT_H

/** Which unit each sampler reads, in every program. ES 3.0 has 16 of them. */
enum texture_unit {
	UNIT_BASE,
	UNIT_DEPTH_COMPARE, /* through a comparing sampler object */
	UNIT_DEPTH,         /* the same texture, read plainly */
	UNIT_RECEIVER,
	UNIT_SMOOTHIE,
	UNIT_SMOOTHIE_DEPTH,
	UNIT_FALLOFF,
	UNIT_FINS,
	UNIT_DEPTH_LAYERS, /* of an array; through a comparing sampler object */
	UNIT_MOMENTS,
	UNIT_PLAIN_LAYERS, /* as UNIT_DEPTH_LAYERS, read plainly */
	UNIT_PRIMITIVES,
	UNIT_VISIBILITY,
	UNIT_VISIBILITY_DEPTH,
	UNIT_COUNT,
	/* No program reads both. */
	UNIT_EDGE_TILES = UNIT_RECEIVER,
	UNIT_EDGE_RUNS = UNIT_PLAIN_LAYERS,
	UNIT_EDGES = UNIT_FINS,
	UNIT_FRONT_LAYER = UNIT_SMOOTHIE,
	UNIT_SECOND_LAYER = UNIT_SMOOTHIE_DEPTH,
	UNIT_THIRD_LAYER = UNIT_FALLOFF,
	UNIT_DISC_MASKS = UNIT_PRIMITIVES,
	UNIT_POINTS = UNIT_MOMENTS,
	UNIT_CELLS = UNIT_VISIBILITY,
	UNIT_SMOOTHIE_WORDS = UNIT_FINS,
};

/** Which unit each image is at: shaders say the same. OpenGL ES 3.1 has four at least. */
enum image_unit {
	IMAGE_EDGE_RUNS,
	IMAGE_EDGES,
	IMAGE_COUNT,
};

#endif
