/* SPDX-License-Identifier: MIT */
#include "kms_buffer.h"
#include "pixel_format.h"
#include <drm_fourcc.h>
#include <xf86drmMode.h>

static uint32_t add_with_modifier(const struct kms_device *device, const struct kms_layout *layout)
{
	uint64_t modifiers[4] = {0};
	uint32_t framebuffer = 0;
	for (int plane = 0; plane < 4; plane++)
		if (layout->handles[plane] != 0)
			modifiers[plane] = layout->modifier;
	drmModeAddFB2WithModifiers(device->fd, layout->width, layout->height, layout->format,
		layout->handles, layout->strides, layout->offsets, modifiers, &framebuffer,
		DRM_MODE_FB_MODIFIERS);
	return framebuffer;
}

/* The call of drivers from before formats had codes. */
static uint32_t add_by_depth(const struct kms_device *device, const struct kms_layout *layout)
{
	const struct pixel_format *format = pixel_format_of(layout->format);
	uint32_t framebuffer = 0;
	if (format == NULL || layout->format == DRM_FORMAT_XBGR8888)
		return 0;
	drmModeAddFB(device->fd, layout->width, layout->height, format->depth,
		(uint8_t)(8 * format->bytes), layout->strides[0], layout->handles[0], &framebuffer);
	return framebuffer;
}

uint32_t kms_add_framebuffer(const struct kms_device *device, const struct kms_layout *layout)
{
	uint32_t framebuffer = 0;
	bool has_modifier = layout->modifier != DRM_FORMAT_MOD_INVALID;
	if (has_modifier && device->modifiers)
		framebuffer = add_with_modifier(device, layout);
	/* What is not linear would be shown as if it were, unless its driver keeps the layout
	 * beside the buffer, which a modifier of its own choice means. */
	if (framebuffer == 0 && (!has_modifier || layout->modifier == DRM_FORMAT_MOD_LINEAR))
		drmModeAddFB2(device->fd, layout->width, layout->height, layout->format,
			layout->handles, layout->strides, layout->offsets, &framebuffer, 0);
	if (framebuffer == 0 && (!has_modifier || layout->modifier == DRM_FORMAT_MOD_LINEAR))
		framebuffer = add_by_depth(device, layout);
	return framebuffer;
}

void kms_remove_framebuffer(const struct kms_device *device, uint32_t framebuffer)
{
	if (framebuffer != 0)
		drmModeRmFB(device->fd, framebuffer);
}
