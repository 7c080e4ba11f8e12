/* SPDX-License-Identifier: MIT */
#include "ref/picture.h"
#include "base/array.h"
#include "base/error.h"
#include "ref/rows.h"
#include "ref/vector.h"
#include "scene/scene.h"
#include <stdatomic.h>
#include <stdlib.h>

/* Share of the time that the coarse samples take, roughly. */
#define COARSE_SHARE 0.2

/* A pass over the picture. */
struct pass {
	struct ref_picture *picture;
	atomic_size_t done;  /* pixels */
	size_t pixels;       /* that it works on */
	double start, share; /* of the whole */
};

bool ref_picture_init(struct ref_picture *picture, const struct reference_request *request,
	struct sm_error *error)
{
	*picture = (struct ref_picture){.request = request};
	size_t pixels = (size_t)request->width * request->height;
	if (!tracer_init(&picture->tracer, request->scene, error) ||
		!pinhole_init(&picture->pinhole, &request->camera, request->width, request->height,
			&picture->tracer, error))
		goto fail;
	lamp_init(&picture->lamp, &request->scene->lights[request->light].desc, &picture->tracer);
	picture->seen = array_zalloc(pixels, sizeof(*picture->seen));
	picture->visibility = array_alloc(pixels, sizeof(*picture->visibility));
	if (picture->seen == NULL || picture->visibility == NULL ||
		!disc_init_coarse(&picture->coarse) ||
		!disc_init_fine(&picture->fine, request->samples)) {
		error_no_memory(error);
		goto fail;
	}
	return true;
fail:
	ref_picture_finish(picture);
	return false;
}

void ref_picture_finish(struct ref_picture *picture)
{
	tracer_finish(&picture->tracer);
	disc_finish(&picture->coarse);
	disc_finish(&picture->fine);
	free(picture->seen);
	free(picture->visibility);
	*picture = (struct ref_picture){0};
}

/* What a pixel looks at, and the way from there to the light; false where it is not judged. */
static bool look(const struct ref_picture *picture, uint32_t x, uint32_t y, struct surface *surface,
	struct fan *fan)
{
	struct sight sight;
	pinhole_sight(&picture->pinhole, x, y, &sight);
	if (!tracer_see(&picture->tracer, &sight, surface) || !surface->receives)
		return false;
	vector_add(surface->point, picture->lift, surface->normal, surface->point);
	return lamp_fan(&picture->lamp, surface, fan);
}

/* By an angle of any bits. */
static void turn(struct fan *fan, uint64_t bits)
{
	double angle = (double)(bits >> 11) * 0x1p-53 * 2.0 * M_PI;
	double c = cos(angle), s = sin(angle);
	for (int i = 0; i < 3; i++) {
		double u = fan->u[i], v = fan->v[i];
		fan->u[i] = c * u + s * v;
		fan->v[i] = c * v - s * u;
	}
}

static enum seen classify(
	const struct ref_picture *picture, const struct surface *surface, const struct fan *fan)
{
	const struct disc *disc = &picture->coarse;
	/* A point needs no more than one ray. */
	uint32_t count = picture->lamp.radius > 0.0 ? disc->count : 1;
	uint32_t unblocked =
		tracer_count_free(&picture->tracer, surface, fan, disc->x, disc->y, count);
	if (unblocked == 0)
		return SEEN_DARK;
	return unblocked == count ? SEEN_LIT : SEEN_PART;
}

static void classify_row(void *data, uint32_t y)
{
	static const float visibility[] = {
		[SEEN_UNJUDGED] = NAN, [SEEN_DARK] = 0.0f, [SEEN_PART] = NAN, [SEEN_LIT] = 1.0f};
	struct pass *pass = data;
	struct ref_picture *picture = pass->picture;
	uint32_t width = picture->pinhole.width;
	size_t first = (size_t)y * width;
	for (uint32_t x = 0; x < width; x++) {
		struct surface surface;
		struct fan fan;
		enum seen seen = SEEN_UNJUDGED;
		if (look(picture, x, y, &surface, &fan)) {
			turn(&fan, scramble(first + x));
			seen = classify(picture, &surface, &fan);
		}
		picture->seen[first + x] = (uint8_t)seen;
		picture->visibility[first + x] = visibility[seen];
	}
	atomic_fetch_add(&pass->done, width);
}

/* What is missed by the coarse samples of one pixel is not by all of its neighbours. */
static bool is_near_change(const struct ref_picture *picture, uint32_t x, uint32_t y)
{
	uint32_t width = picture->pinhole.width, height = picture->pinhole.height;
	uint8_t own = picture->seen[(size_t)y * width + x];
	for (uint32_t j = y > 0 ? y - 1 : 0; j <= y + 1 && j < height; j++) {
		for (uint32_t i = x > 0 ? x - 1 : 0; i <= x + 1 && i < width; i++) {
			uint8_t seen = picture->seen[(size_t)j * width + i];
			if (seen != SEEN_UNJUDGED && seen != own)
				return true;
		}
	}
	return false;
}

static bool is_refined(const struct ref_picture *picture, uint32_t x, uint32_t y)
{
	enum seen seen = picture->seen[(size_t)y * picture->pinhole.width + x];
	return seen == SEEN_PART || (seen != SEEN_UNJUDGED && is_near_change(picture, x, y));
}

static void refine_row(void *data, uint32_t y)
{
	struct pass *pass = data;
	struct ref_picture *picture = pass->picture;
	const struct disc *disc = &picture->fine;
	uint32_t width = picture->pinhole.width;
	for (uint32_t x = 0; x < width; x++) {
		size_t pixel = (size_t)y * width + x;
		struct surface surface;
		struct fan fan;
		if (!is_refined(picture, x, y) || !look(picture, x, y, &surface, &fan))
			continue;
		uint64_t bits = scramble(pixel);
		size_t set = scramble(bits) % disc->sets * disc->count;
		turn(&fan, bits);
		uint32_t unblocked = tracer_count_free(&picture->tracer, &surface, &fan,
			disc->x + set, disc->y + set, disc->count);
		picture->visibility[pixel] = (float)unblocked / (float)disc->count;
		atomic_fetch_add(&pass->done, 1);
	}
}

static size_t count_refined(const struct ref_picture *picture)
{
	size_t count = 0;
	for (uint32_t y = 0; y < picture->pinhole.height; y++)
		for (uint32_t x = 0; x < picture->pinhole.width; x++)
			count += is_refined(picture, x, y);
	return count;
}

static void report(void *data)
{
	struct pass *pass = data;
	const struct reference_request *request = pass->picture->request;
	/* A pass without pixels is done. */
	double done =
		pass->pixels > 0 ? (double)atomic_load(&pass->done) / (double)pass->pixels : 1.0;
	if (request->progress != NULL)
		request->progress(request->progress_data, pass->start + pass->share * done);
}

static void run_pass(struct pass *pass, void (*work)(void *data, uint32_t row))
{
	const struct rows rows = {
		.count = pass->picture->pinhole.height,
		.work = work,
		.report = report,
		.data = pass,
	};
	rows_run(&rows, pass->picture->request->threads);
	report(pass);
}

void ref_picture_trace(struct ref_picture *picture)
{
	struct pass coarse = {
		.picture = picture,
		.pixels = (size_t)picture->pinhole.width * picture->pinhole.height,
		.share = COARSE_SHARE,
	};
	run_pass(&coarse, classify_row);
	struct pass fine = {
		.picture = picture,
		/* A point is seen or not. */
		.pixels = picture->lamp.radius > 0.0 ? count_refined(picture) : 0,
		.start = COARSE_SHARE,
		.share = 1.0 - COARSE_SHARE,
	};
	if (fine.pixels > 0)
		run_pass(&fine, refine_row);
	else
		report(&fine);
}
