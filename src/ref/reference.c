/* SPDX-License-Identifier: MIT */
#include "ref/reference.h"
#include "base/array.h"
#include "base/error.h"
#include "ref/archive.h"
#include "ref/picture.h"
#include "scene/scene.h"
#include <math.h>
#include <stdlib.h>

bool reference_is_built(void)
{
	return true;
}

static bool check(const struct reference_request *request, struct sm_error *error)
{
	if (request->width == 0 || request->height == 0 || request->width > REFERENCE_SIZE_MOST ||
		request->height > REFERENCE_SIZE_MOST)
		return error_set(error, SM_ERROR_INPUT,
			"reference: %ux%u pixels; sizes go from 1 to %d", request->width,
			request->height, REFERENCE_SIZE_MOST);
	if (request->light >= request->scene->light_count)
		return error_set(error, SM_ERROR_INPUT, "reference: no light %u; the scene has %zu",
			request->light, request->scene->light_count);
	if (request->samples > REFERENCE_SAMPLES_MOST)
		return error_set(error, SM_ERROR_INPUT, "reference: %u samples; at most %d",
			request->samples, REFERENCE_SAMPLES_MOST);
	return true;
}

/* The request with its defaults, samples being a square. */
static struct reference_request complete(const struct reference_request *request)
{
	struct reference_request whole = *request;
	uint32_t samples = request->samples > 0 ? request->samples : REFERENCE_SAMPLES;
	uint32_t side = (uint32_t)ceil(sqrt(samples));
	whole.samples = side * side;
	return whole;
}

static bool load(struct reference *reference, const struct reference_request *request,
	const struct content_id *id)
{
	size_t count = (size_t)request->width * request->height;
	reference->visibility = array_alloc(count, sizeof(*reference->visibility));
	if (reference->visibility != NULL &&
		archive_load(request->cache, id, reference->visibility, count))
		return true;
	reference_finish(reference);
	return false;
}

static bool trace(struct reference *reference, const struct reference_request *request,
	struct sm_error *error)
{
	struct ref_picture picture;
	if (!ref_picture_init(&picture, request, error))
		return false;
	ref_picture_trace(&picture);
	reference->visibility = picture.visibility;
	picture.visibility = NULL;
	ref_picture_finish(&picture);
	return true;
}

bool reference_trace(struct reference *reference, const struct reference_request *request,
	struct sm_error *error)
{
	struct content_id id;
	*reference = (struct reference){0};
	if (!check(request, error))
		return false;
	struct reference_request whole = complete(request);
	if (whole.cache != NULL)
		id = content_id_of_request(&whole);
	if (whole.cache == NULL || !load(reference, &whole, &id)) {
		if (!trace(reference, &whole, error))
			return false;
		if (whole.cache != NULL)
			archive_save(whole.cache, &id, reference->visibility,
				(size_t)whole.width * whole.height);
	}
	reference->width = whole.width;
	reference->height = whole.height;
	return true;
}

void reference_finish(struct reference *reference)
{
	if (reference == NULL)
		return;
	free(reference->visibility);
	*reference = (struct reference){0};
}
