/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_KMS_BUFFER_H
#define PLATFORM_KMS_BUFFER_H

#include "kms_device.h"

/** How a buffer's pixels lie in memory. */
struct kms_layout {
	uint32_t width, height; /* pixels */
	uint32_t format;        /* DRM_FORMAT_* */
	uint64_t modifier;      /* DRM_FORMAT_MOD_INVALID: the driver's own choice */
	uint32_t handles[4], strides[4], offsets[4]; /* of the planes; 0 where there is none */
};

/** Makes a framebuffer of a buffer, with its modifier, or plainly where that is not to be had;
 *  returns 0 and errno when the driver refuses both. */
uint32_t kms_add_framebuffer(const struct kms_device *device, const struct kms_layout *layout);

/** 0 is fine. */
void kms_remove_framebuffer(const struct kms_device *device, uint32_t framebuffer);

#endif
