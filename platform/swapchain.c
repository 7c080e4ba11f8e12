/* SPDX-License-Identifier: MIT */
#include "swapchain.h"
#include <stddef.h>

bool swapchain_begin(struct swapchain *swapchain, struct sm_error *error)
{
	return swapchain->interface->begin(swapchain, error);
}

bool swapchain_end(struct swapchain *swapchain, const uint8_t *rgba, struct kms_frame *frame,
	struct sm_error *error)
{
	*frame = (struct kms_frame){
		.width = swapchain->width, .height = swapchain->height, .in_fence = -1};
	return swapchain->interface->end(swapchain, rgba, frame, error);
}

void swapchain_release(struct swapchain *swapchain, uint32_t framebuffer)
{
	if (swapchain != NULL && framebuffer != 0)
		swapchain->interface->release(swapchain, framebuffer);
}

void swapchain_destroy(struct swapchain *swapchain)
{
	if (swapchain != NULL)
		swapchain->interface->destroy(swapchain);
}
