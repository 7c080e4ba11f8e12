/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "fixed/passes.h"
#include "fixed/span.h"
#include <stdlib.h>

/* Where a receiver lies on the light's screen. */
struct place {
	int32_t corner[2];    /* lower left of the four nearest texels; may be beside the map */
	uint32_t fraction[2]; /* from its centre to the next, 1/1024 */
	uint32_t depth;       /* to compare */
};

#define TEXEL_BITS 10
#define TEXEL_ONE (1 << TEXEL_BITS)

/* floor(2^bits n / d); n < d < 2^31. */
static uint32_t divide(int32_t n, int32_t d, int bits)
{
	return (uint32_t)(((uint64_t)n << bits) / (uint64_t)d);
}

static void find_texel(
	struct place *place, int axis, int32_t n, int32_t w, const struct fixed_maps *maps)
{
	const int bits = FIXED_SCREEN_BITS - TEXEL_BITS;
	uint32_t share = divide(n, w, FIXED_SCREEN_BITS);
	/* From the centre of the first texel. */
	int32_t texel = (int32_t)(share * (uint32_t)maps->size >> bits) - TEXEL_ONE / 2;
	place->corner[axis] = texel >> TEXEL_BITS;
	place->fraction[axis] = (uint32_t)texel & (TEXEL_ONE - 1);
}

/* False beside the light's screen. */
static bool find_place(struct place *place, const struct fixed_receiver *receiver, int32_t px,
	int32_t py, const struct fixed_maps *maps)
{
	int32_t w = fixed_plane_at(&receiver->w, px, py);
	int32_t x = fixed_plane_at(&receiver->x, px, py);
	int32_t y = fixed_plane_at(&receiver->y, px, py);
	int32_t z = fixed_plane_at(&receiver->z, px, py);
	if (w <= 0 || x < 0 || y < 0 || x >= w || y >= w)
		return false;
	find_texel(place, 0, x, w, maps);
	find_texel(place, 1, y, w, maps);
	uint32_t depth = FIXED_DEPTH_CLEAR, bias = (uint32_t)receiver->bias;
	if (z < w)
		depth = z <= 0 ? 0 : divide(z, w, FIXED_DEPTH_BITS);
	place->depth = depth > bias ? depth - bias : 0;
	return true;
}

static int32_t clamp(int32_t value, int32_t most)
{
	return value < 0 ? 0 : value > most ? most : value;
}

/* Behind the shadow map, else behind a smoothie, else lit. */
static uint32_t texel_visibility(const struct fixed_maps *maps, const struct number_model *number,
	const struct place *place, int dx, int dy)
{
	int32_t x = clamp(place->corner[0] + dx, maps->size - 1);
	int32_t y = clamp(place->corner[1] + dy, maps->size - 1);
	size_t at = (size_t)y * (size_t)maps->size + (size_t)x;
	if (maps->casters[at] < place->depth)
		return 0;
	return maps->smoothie_depth[at] < place->depth ? maps->smoothie_alpha[at] : number->one;
}

static uint32_t receiver_visibility(const struct fixed_receiver *receiver, int32_t x, int32_t y,
	const struct fixed_maps *maps, const struct number_model *number)
{
	struct place place;
	if (receiver->kind == FIXED_AWAY)
		return 0;
	if (receiver->kind == FIXED_LIT || !find_place(&place, receiver, x, y, maps))
		return number->one;
	uint32_t across = number->weight(place.fraction[0]);
	uint32_t up = number->weight(place.fraction[1]);
	uint32_t rows[2];
	for (int dy = 0; dy < 2; dy++)
		rows[dy] = number->lerp(texel_visibility(maps, number, &place, 0, dy),
			texel_visibility(maps, number, &place, 1, dy), across);
	return number->lerp(rows[0], rows[1], up);
}

/* Which receiver is seen where, or NONE, rows from the bottom. */
struct seen {
	int32_t width, height;
	uint32_t *depths, *receivers; /* owned */
};

#define NONE UINT32_MAX

static void seen_finish(struct seen *seen)
{
	free(seen->depths);
	free(seen->receivers);
}

static bool seen_init(struct seen *seen, int32_t width, int32_t height)
{
	size_t count = (size_t)width * (size_t)height;
	*seen = (struct seen){.width = width, .height = height};
	seen->depths = array_alloc(count, sizeof(*seen->depths));
	seen->receivers = array_alloc(count, sizeof(*seen->receivers));
	if (seen->depths == NULL || seen->receivers == NULL) {
		seen_finish(seen);
		return false;
	}
	for (size_t i = 0; i < count; i++) {
		seen->depths[i] = FIXED_DEPTH_CLEAR;
		seen->receivers[i] = NONE;
	}
	return true;
}

static void find_nearest(struct seen *seen, const struct fixed_receivers *receivers)
{
	for (size_t i = 0; i < receivers->count; i++) {
		const struct fixed_receiver *receiver = &receivers->items[i];
		struct fixed_span span = fixed_span_before(&receiver->cover);
		while (fixed_span_next(&receiver->cover, &span))
			for (int32_t x = span.left; x < span.right; x++) {
				size_t at = (size_t)span.y * (size_t)seen->width + (size_t)x;
				uint32_t depth = fixed_camera_depth_of(
					fixed_plane_at(&receiver->depth, x, span.y));
				if (depth >= seen->depths[at])
					continue;
				seen->depths[at] = depth;
				seen->receivers[at] = (uint32_t)i;
			}
	}
}

static void shade(const struct seen *seen, const struct fixed_receivers *receivers,
	const struct fixed_maps *maps, const struct number_model *number, uint16_t *values)
{
	for (int32_t y = 0; y < seen->height; y++) {
		uint16_t *row = &values[(size_t)(seen->height - 1 - y) * (size_t)seen->width];
		for (int32_t x = 0; x < seen->width; x++) {
			size_t at = (size_t)y * (size_t)seen->width + (size_t)x;
			uint32_t v = number->one;
			if (seen->receivers[at] != NONE)
				v = receiver_visibility(
					&receivers->items[seen->receivers[at]], x, y, maps, number);
			row[x] = (uint16_t)number->bytes(v);
		}
	}
}

bool fixed_draw(
	const struct fixed_scene *scene, const struct number_model *number, uint16_t *values)
{
	struct fixed_maps maps;
	struct seen seen;
	if (!fixed_maps_init(&maps, scene, number))
		return false;
	bool drawn = seen_init(&seen, scene->width, scene->height);
	if (drawn) {
		find_nearest(&seen, &scene->receivers);
		shade(&seen, &scene->receivers, &maps, number, values);
		seen_finish(&seen);
	}
	fixed_maps_finish(&maps);
	return drawn;
}
