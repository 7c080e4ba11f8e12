/* SPDX-License-Identifier: MIT */
#include "kms_commit.h"
#include <errno.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

static enum kms_result result_of(int code)
{
	return code == 0 ? KMS_DONE : kms_result_of(errno);
}

static enum kms_result set_mode(const struct kms_device *device, const struct kms_output *output,
	const struct kms_frame *frame, void *user_data)
{
	(void)user_data;
	uint32_t connector = output->connector;
	drmModeModeInfo mode = output->mode;
	if (frame->out_fence != NULL)
		*frame->out_fence = -1;
	for (size_t i = 0; i < output->other_plane_count; i++)
		drmModeSetPlane(
			device->fd, output->other_planes[i], 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
	return result_of(drmModeSetCrtc(
		device->fd, output->crtc, frame->framebuffer, 0, 0, &connector, 1, &mode));
}

static enum kms_result flip(const struct kms_device *device, const struct kms_output *output,
	const struct kms_frame *frame, bool async, void *user_data)
{
	uint32_t flags = DRM_MODE_PAGE_FLIP_EVENT | (async ? DRM_MODE_PAGE_FLIP_ASYNC : 0);
	if (frame->out_fence != NULL)
		*frame->out_fence = -1;
	return result_of(
		drmModePageFlip(device->fd, output->crtc, frame->framebuffer, flags, user_data));
}

static enum kms_result switch_off(const struct kms_device *device, const struct kms_output *output)
{
	return result_of(drmModeSetCrtc(device->fd, output->crtc, 0, 0, 0, NULL, 0, NULL));
}

const struct kms_interface kms_legacy = {
	.name = "legacy",
	.set_mode = set_mode,
	.flip = flip,
	.switch_off = switch_off,
};
