/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "base/error.h"
#include "egl.h"
#include "swapchain.h"
#include <drm_fourcc.h>
#include <errno.h>
#include <gbm.h>
#include <stdlib.h>
#include <string.h>

/* A GBM surface rotates four buffers at most. */
enum { BUFFER_COUNT = 4 };

struct gbm_swapchain {
	struct swapchain base;
	struct egl *egl; /* not owned */
	struct gbm_surface *surface;
	EGLSurface egl_surface;
	/* Those on their way to the screen or on it; bo NULL: a free entry. */
	struct {
		struct gbm_bo *bo;
		uint32_t framebuffer;
	} locked[BUFFER_COUNT];
};

/* What a buffer carries along, until GBM frees it. */
struct attachment {
	const struct kms_device *device; /* not owned */
	uint32_t framebuffer;
};

static void destroy(struct swapchain *base)
{
	struct gbm_swapchain *swapchain = (struct gbm_swapchain *)base;
	for (int i = 0; i < BUFFER_COUNT; i++)
		if (swapchain->locked[i].bo != NULL)
			gbm_surface_release_buffer(swapchain->surface, swapchain->locked[i].bo);
	egl_destroy_surface(swapchain->egl, swapchain->egl_surface);
	if (swapchain->surface != NULL)
		gbm_surface_destroy(swapchain->surface);
	free(swapchain);
}

static bool begin(struct swapchain *base, struct sm_error *error)
{
	struct gbm_swapchain *swapchain = (struct gbm_swapchain *)base;
	if (!gbm_surface_has_free_buffers(swapchain->surface))
		return error_set(error, SM_ERROR_MACHINE, "all buffers are being shown");
	return egl_use_surface(swapchain->egl, swapchain->egl_surface, error);
}

static void describe(struct gbm_bo *bo, struct kms_layout *layout)
{
	*layout = (struct kms_layout){
		.width = gbm_bo_get_width(bo),
		.height = gbm_bo_get_height(bo),
		.format = gbm_bo_get_format(bo),
		.modifier = gbm_bo_get_modifier(bo),
	};
	int planes = gbm_bo_get_plane_count(bo);
	for (int plane = 0; plane < planes && plane < 4; plane++) {
		layout->handles[plane] = gbm_bo_get_handle_for_plane(bo, plane).u32;
		layout->strides[plane] = gbm_bo_get_stride_for_plane(bo, plane);
		layout->offsets[plane] = gbm_bo_get_offset(bo, plane);
	}
}

static void detach(struct gbm_bo *bo, void *data)
{
	(void)bo;
	struct attachment *attachment = data;
	kms_remove_framebuffer(attachment->device, attachment->framebuffer);
	free(attachment);
}

/* The framebuffer of a buffer, made when it comes for the first time; 0 on failure. */
static uint32_t framebuffer_of(
	const struct gbm_swapchain *swapchain, struct gbm_bo *bo, struct sm_error *error)
{
	struct attachment *attachment = gbm_bo_get_user_data(bo);
	if (attachment != NULL)
		return attachment->framebuffer;
	struct kms_layout layout;
	describe(bo, &layout);
	uint32_t framebuffer = kms_add_framebuffer(swapchain->base.device, &layout);
	if (framebuffer == 0) {
		error_set(error, SM_ERROR_MACHINE, "its buffers cannot be shown (%s)",
			strerror(errno));
		return 0;
	}
	attachment = array_alloc(1, sizeof(*attachment));
	if (attachment == NULL) {
		kms_remove_framebuffer(swapchain->base.device, framebuffer);
		error_no_memory(error);
		return 0;
	}
	*attachment = (struct attachment){swapchain->base.device, framebuffer};
	gbm_bo_set_user_data(bo, attachment, detach);
	return framebuffer;
}

static bool end(struct swapchain *base, const uint8_t *rgba, struct kms_frame *frame,
	struct sm_error *error)
{
	(void)rgba;
	struct gbm_swapchain *swapchain = (struct gbm_swapchain *)base;
	if (!egl_swap(swapchain->egl, swapchain->egl_surface, &frame->in_fence, error))
		return false;
	struct gbm_bo *bo = gbm_surface_lock_front_buffer(swapchain->surface);
	if (bo == NULL)
		return error_set(error, SM_ERROR_MACHINE, "GBM has no buffer to show");
	frame->framebuffer = framebuffer_of(swapchain, bo, error);
	if (frame->framebuffer == 0) {
		gbm_surface_release_buffer(swapchain->surface, bo);
		return false;
	}
	/* begin() has found a free buffer, so that there is a free entry. */
	int i = 0;
	while (i < BUFFER_COUNT - 1 && swapchain->locked[i].bo != NULL)
		i++;
	swapchain->locked[i].bo = bo;
	swapchain->locked[i].framebuffer = frame->framebuffer;
	return true;
}

static void release(struct swapchain *base, uint32_t framebuffer)
{
	struct gbm_swapchain *swapchain = (struct gbm_swapchain *)base;
	for (int i = 0; i < BUFFER_COUNT; i++) {
		if (swapchain->locked[i].bo == NULL ||
			swapchain->locked[i].framebuffer != framebuffer)
			continue;
		gbm_surface_release_buffer(swapchain->surface, swapchain->locked[i].bo);
		swapchain->locked[i].bo = NULL;
	}
}

static const struct swapchain_interface gbm_interface = {
	.begin = begin,
	.end = end,
	.release = release,
	.destroy = destroy,
};

static struct gbm_surface *create_surface(struct gbm_device *gbm, const struct swapchain *base,
	const uint64_t *modifiers, size_t modifier_count)
{
	if (modifier_count > 0)
		return gbm_surface_create_with_modifiers(gbm, base->width, base->height,
			base->format->code, modifiers, (unsigned)modifier_count);
	return gbm_surface_create(gbm, base->width, base->height, base->format->code,
		GBM_BO_USE_SCANOUT | GBM_BO_USE_RENDERING);
}

struct swapchain *swapchain_create_gbm(const struct kms_device *device, struct gbm_device *gbm,
	struct egl *egl, const struct pixel_format *format, uint32_t width, uint32_t height,
	const uint64_t *modifiers, size_t modifier_count, struct sm_error *error)
{
	struct gbm_swapchain *swapchain = array_zalloc(1, sizeof(*swapchain));
	if (swapchain == NULL) {
		error_no_memory(error);
		return NULL;
	}
	swapchain->base = (struct swapchain){&gbm_interface, device, format, width, height};
	swapchain->egl = egl;
	swapchain->egl_surface = EGL_NO_SURFACE;
	swapchain->surface = create_surface(gbm, &swapchain->base, modifiers, modifier_count);
	if (swapchain->surface == NULL) {
		error_set(error, SM_ERROR_MACHINE, "GBM makes no surface of %ux%u %s (%s)", width,
			height, format->name, strerror(errno));
		goto error;
	}
	swapchain->egl_surface = egl_create_surface(egl, swapchain->surface, format->code, error);
	if (swapchain->egl_surface != EGL_NO_SURFACE)
		return &swapchain->base;

error:
	destroy(&swapchain->base);
	return NULL;
}
