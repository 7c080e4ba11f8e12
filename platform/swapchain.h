/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_SWAPCHAIN_H
#define PLATFORM_SWAPCHAIN_H

#include "kms_buffer.h"
#include "kms_commit.h"
#include "pixel_format.h"

struct egl;
struct gbm_device;

/** The buffers that take turns on an output. */
struct swapchain {
	const struct swapchain_interface *interface;
	const struct kms_device *device; /* not owned */
	const struct pixel_format *format;
	uint32_t width, height; /* pixels of a buffer */
};

struct swapchain_interface {
	bool takes_pixels; /* swapchain_end() is given the picture: there is no framebuffer 0 */
	bool (*begin)(struct swapchain *swapchain, struct sm_error *error);
	bool (*end)(struct swapchain *swapchain, const uint8_t *rgba, struct kms_frame *frame,
		struct sm_error *error);
	void (*release)(struct swapchain *swapchain, uint32_t framebuffer);
	void (*destroy)(struct swapchain *swapchain);
};

/** Buffers of the GPU, drawn to as framebuffer 0 of egl's context. modifiers: those that the output
 *  takes; none: the driver's own choice. device, gbm and egl must outlive it. */
struct swapchain *swapchain_create_gbm(const struct kms_device *device, struct gbm_device *gbm,
	struct egl *egl, const struct pixel_format *format, uint32_t width, uint32_t height,
	const uint64_t *modifiers, size_t modifier_count, struct sm_error *error);

/** Buffers that the processor writes, which every display has, to show what was drawn elsewhere.
 *  They follow what changes from frame to frame: only that is written, and reported as damage. */
struct swapchain *swapchain_create_dumb(const struct kms_device *device,
	const struct pixel_format *format, uint32_t width, uint32_t height, struct sm_error *error);

/** Waits for nothing: fails (MACHINE) when all buffers are in use or the driver has none. */
bool swapchain_begin(struct swapchain *swapchain, struct sm_error *error);

/** Finishes the buffer begun: fills in framebuffer, size, fence and damage of *frame, which stays
 *  valid until the next swapchain_begin(). in_fence of the frame is the caller's to close.
 *  rgba: width x height pixels of R,G,B,A bytes, rows from the bottom, where the swapchain takes
 *  pixels. */
bool swapchain_end(struct swapchain *swapchain, const uint8_t *rgba, struct kms_frame *frame,
	struct sm_error *error);

/** The framebuffer is no longer shown, or could not be. 0 is fine. */
void swapchain_release(struct swapchain *swapchain, uint32_t framebuffer);

/** NULL is fine. */
void swapchain_destroy(struct swapchain *swapchain);

#endif
