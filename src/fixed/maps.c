/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "fixed/passes.h"
#include "fixed/span.h"
#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

void fixed_falloff_init(const struct number_model *number, uint16_t table[FIXED_FALLOFF_SIZE])
{
	for (int i = 0; i < FIXED_FALLOFF_SIZE; i++)
		table[i] = (uint16_t)number->from_real(
			0.5 - 0.5 * cos(pi * i / (FIXED_FALLOFF_SIZE - 1)));
}

static void draw_blockers(uint32_t *map, int32_t size, const struct fixed_blockers *blockers)
{
	for (size_t i = 0; i < blockers->count; i++) {
		const struct fixed_blocker *blocker = &blockers->items[i];
		struct fixed_span span = fixed_span_before(&blocker->cover);
		while (fixed_span_next(&blocker->cover, &span))
			for (int32_t x = span.left; x < span.right; x++) {
				uint32_t *texel = &map[(size_t)span.y * (size_t)size + (size_t)x];
				uint32_t depth =
					fixed_depth_of(fixed_plane_at(&blocker->depth, x, span.y));
				*texel = depth < *texel ? depth : *texel;
			}
	}
}

/* What the passes of smoothies have in common. */
struct fin_pass {
	const struct number_model *number;
	uint32_t pole;
	const uint16_t *falloff; /* NULL: linear */
	struct fixed_maps *maps;
};

/* alpha' = alpha / (1 - b/r), alpha being the share of the fin's width; the number's one or more
 * where nothing is darkened. b < r. */
static uint32_t remapped_alpha(const struct fin_pass *pass, const struct fixed_fin *fin, int32_t x,
	int32_t y, uint32_t b, uint32_t r)
{
	const struct number_model *number = pass->number;
	int32_t offset_x = fixed_plane_at(&fin->offset_x, x, y) >> FIXED_FIN_FRACTION;
	int32_t offset_y = fixed_plane_at(&fin->offset_y, x, y) >> FIXED_FIN_FRACTION;
	int32_t width = fixed_plane_at(&fin->width, x, y) >> FIXED_FIN_FRACTION;
	/* The root of what is below 2^32 is exact enough in double to be cut. */
	int32_t length = (int32_t)sqrt((double)(offset_x * offset_x + offset_y * offset_y));
	if (length >= width)
		return number->one;
	uint32_t ratio = number->ratio(r - b, pass->pole - b);
	if (ratio == 0)
		return number->one;
	return number->div(number->ratio((uint32_t)length, (uint32_t)width), ratio);
}

static void draw_fin_texel(
	const struct fin_pass *pass, const struct fixed_fin *fin, int32_t x, int32_t y)
{
	struct fixed_maps *maps = pass->maps;
	size_t at = (size_t)y * (size_t)maps->size + (size_t)x;
	uint32_t b = fixed_depth_of(fixed_plane_at(&fin->depth, x, y));
	uint32_t r = maps->casters[at];
	if (maps->receivers_only[at] < r)
		r = maps->receivers_only[at];
	if (r <= b)
		return;
	uint32_t alpha = remapped_alpha(pass, fin, x, y, b, r);
	if (alpha >= pass->number->one)
		return;
	if (pass->falloff != NULL)
		alpha = pass->falloff[pass->number->index(alpha)];
	if (b < maps->smoothie_depth[at])
		maps->smoothie_depth[at] = b;
	if (alpha < maps->smoothie_alpha[at])
		maps->smoothie_alpha[at] = (uint16_t)alpha;
}

static void draw_fins(const struct fin_pass *pass, const struct fixed_fins *fins)
{
	for (size_t i = 0; i < fins->count; i++) {
		const struct fixed_fin *fin = &fins->items[i];
		struct fixed_span span = fixed_span_before(&fin->cover);
		while (fixed_span_next(&fin->cover, &span))
			for (int32_t x = span.left; x < span.right; x++)
				draw_fin_texel(pass, fin, x, span.y);
	}
}

static bool allocate(struct fixed_maps *maps, const struct number_model *number)
{
	size_t count = (size_t)maps->size * (size_t)maps->size;
	maps->casters = array_alloc(count, sizeof(*maps->casters));
	maps->receivers_only = array_alloc(count, sizeof(*maps->receivers_only));
	maps->smoothie_depth = array_alloc(count, sizeof(*maps->smoothie_depth));
	maps->smoothie_alpha = array_alloc(count, sizeof(*maps->smoothie_alpha));
	if (maps->casters == NULL || maps->receivers_only == NULL || maps->smoothie_depth == NULL ||
		maps->smoothie_alpha == NULL)
		return false;
	for (size_t i = 0; i < count; i++) {
		maps->casters[i] = FIXED_DEPTH_CLEAR;
		maps->receivers_only[i] = FIXED_DEPTH_CLEAR;
		maps->smoothie_depth[i] = FIXED_DEPTH_CLEAR;
		maps->smoothie_alpha[i] = (uint16_t)number->one;
	}
	return true;
}

bool fixed_maps_init(
	struct fixed_maps *maps, const struct fixed_scene *scene, const struct number_model *number)
{
	uint16_t falloff[FIXED_FALLOFF_SIZE];
	*maps = (struct fixed_maps){.size = scene->map_size};
	if (!allocate(maps, number)) {
		fixed_maps_finish(maps);
		return false;
	}
	draw_blockers(maps->casters, maps->size, &scene->casters);
	draw_blockers(maps->receivers_only, maps->size, &scene->receivers_only);
	if (scene->sinusoid)
		fixed_falloff_init(number, falloff);
	const struct fin_pass pass = {.number = number,
		.pole = scene->pole,
		.falloff = scene->sinusoid ? falloff : NULL,
		.maps = maps};
	draw_fins(&pass, &scene->fins);
	return true;
}

void fixed_maps_finish(struct fixed_maps *maps)
{
	free(maps->casters);
	free(maps->receivers_only);
	free(maps->smoothie_depth);
	free(maps->smoothie_alpha);
	*maps = (struct fixed_maps){0};
}
