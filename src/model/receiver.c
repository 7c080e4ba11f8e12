/* SPDX-License-Identifier: MIT */
#include "model/receiver.h"

/* The steepest receiver, against the light's rays, that is biased by all of its slope. */
#define SLOPE_MAX 50.0

/* Nearer to a spot than this share of the near plane's distance all is alike. */
#define LEAST_W 1e-3

/* On a plane window depth is linear in window x and y. With n . p = d in light space, a spot has
 * 1 / p.z = n . (x / scale, y / scale, 1) / d, and window depth K - K near / p.z. */
static void find_slope(struct receiver *receiver, const struct surface *surface,
	const struct light_frame *frame, double scale)
{
	double over, steep[2], rise = 0.0;
	for (int i = 0; i < 2; i++) {
		double by = frame->parallel ? 1.0 / ((double)frame->far - frame->near)
					    : (double)frame->pole * frame->near;
		steep[i] = -by * surface->normal[i] / scale;
		rise += fabs(steep[i]);
	}
	over = frame->parallel ? surface->normal[2] : surface->offset;
	/* A plane that the light sees edge on is as steep as is allowed. */
	double per = fmin(1.0 / fmax(fabs(over), 1e-30), receiver->limit / fmax(rise, 1e-30));
	for (int i = 0; i < 2; i++)
		receiver->slope[i] = (over < 0.0 ? -per : per) * steep[i];
}

struct receiver receiver_of(const struct surface *surface, const struct model_light *light)
{
	const struct light_frame *frame = &light->frame;
	const double *p = surface->position;
	double scale = 0.5 / frame->half_extent;
	/* Times the width of a texel, which for a spot grows with the distance: window depth
	 * flattens with its square. */
	double limit = SLOPE_MAX * 2.0 * frame->half_extent;
	struct receiver receiver = {.position = {p[0], p[1], p[2]}};
	double w = 1.0;
	if (frame->parallel) {
		double range = (double)frame->far - frame->near;
		receiver.depth = (p[2] - frame->near) / range;
		receiver.limit = limit / range;
	} else {
		w = fmax(p[2], frame->near * LEAST_W);
		receiver.depth = frame->pole * (1.0 - frame->near / w);
		receiver.limit = limit * (frame->pole - receiver.depth);
	}
	for (int i = 0; i < 2; i++)
		receiver.at[i] = p[i] * scale / w + 0.5;
	find_slope(&receiver, surface, frame, scale);
	return receiver;
}

double receiver_rise(const struct receiver *receiver)
{
	return fabs(receiver->slope[0]) + fabs(receiver->slope[1]);
}

double receiver_plane_depth(
	const struct receiver *receiver, const struct model_light *light, double reach)
{
	return receiver->depth - DEPTH_STEP - receiver_rise(receiver) * reach / light->size;
}

static double clamp(double value, double min, double max)
{
	return fmin(fmax(value, min), max);
}

double receiver_depth(
	const struct receiver *receiver, const struct model_light *light, double reach)
{
	return clamp(receiver_plane_depth(receiver, light, reach), 0.0, 1.0);
}

struct taps taps_at(const double at[2], int size)
{
	struct taps taps;
	int corner[2];
	for (int i = 0; i < 2; i++) {
		double texel = clamp(at[i] * size - 0.5, 0.0, size - 1.0);
		corner[i] = (int)fmin(floor(texel), size - 2.0);
		taps.f[i] = texel - corner[i];
	}
	for (int i = 0; i < 4; i++) {
		int right = i & 1, up = i >> 1;
		/* A map of one texel has its corner beside the map. */
		int x = corner[0] + right > 0 ? corner[0] + right : 0;
		int y = corner[1] + up > 0 ? corner[1] + up : 0;
		taps.texels[i] = (size_t)y * (size_t)size + (size_t)x;
		taps.weights[i] =
			(right ? taps.f[0] : 1.0 - taps.f[0]) * (up ? taps.f[1] : 1.0 - taps.f[1]);
	}
	return taps;
}

double model_map_compare(const struct model_map *map, const double at[2], double depth)
{
	struct taps taps = taps_at(at, map->size);
	double compared = clamp(depth, 0.0, 1.0), lit = 0.0;
	for (int i = 0; i < 4; i++)
		if (map->depths[taps.texels[i]] >= compared)
			lit += taps.weights[i];
	return lit;
}
