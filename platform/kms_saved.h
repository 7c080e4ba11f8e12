/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_KMS_SAVED_H
#define PLATFORM_KMS_SAVED_H

#include "kms_output.h"

/** What a CRTC showed before; zero: nothing was saved. */
struct kms_saved {
	uint32_t crtc;
	uint32_t connectors[KMS_OTHER_CONNECTORS_MAX + 1]; /* that were lit */
	size_t connector_count;
	uint32_t framebuffer, x, y;
	drmModeModeInfo mode;
	bool lit;
	uint32_t plane;
	struct kms_property rotation;
};

/** Remembers what is on the output's CRTC. */
void kms_save(
	struct kms_saved *saved, const struct kms_device *device, const struct kms_output *output);

/** Shows it again; where that is gone by now, the CRTC goes dark, and the kernel's console takes
 *  over when the device is closed. Fine on a zeroed one. */
void kms_restore(const struct kms_saved *saved, const struct kms_device *device);

#endif
