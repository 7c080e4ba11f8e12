/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_KMS_COMMIT_H
#define PLATFORM_KMS_COMMIT_H

#include "kms_output.h"

struct rect {
	uint32_t x, y, width, height; /* pixels from the top left */
};

/** A buffer to be shown on an output. */
struct kms_frame {
	uint32_t framebuffer, width, height;
	unsigned rotation;         /* degrees clockwise by which the plane turns it */
	int in_fence;              /* signalled when the buffer is drawn; -1: it is */
	int *out_fence;            /* gets a fence for when the frame is shown, or -1; NULL: none */
	const struct rect *damage; /* what differs from the frame before; NULL: all */
};

/** A way to tell the kernel what to show: by atomic commits, or by the calls from before. */
struct kms_interface {
	const char *name;
	bool set_mode_sends_event; /* as each flip does */
	/** Sets the output's mode with a first frame. */
	enum kms_result (*set_mode)(const struct kms_device *device,
		const struct kms_output *output, const struct kms_frame *frame, void *user_data);
	/** Shows a frame from the next vertical blank on, or at once where async. */
	enum kms_result (*flip)(const struct kms_device *device, const struct kms_output *output,
		const struct kms_frame *frame, bool async, void *user_data);
	/** Turns the output off. */
	enum kms_result (*switch_off)(
		const struct kms_device *device, const struct kms_output *output);
};

extern const struct kms_interface kms_atomic;
extern const struct kms_interface kms_legacy;

#endif
