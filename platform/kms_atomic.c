/* SPDX-License-Identifier: MIT */
#include "kms_commit.h"
#include "kms_request.h"
#include <errno.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

static void add_plane(
	struct kms_request *request, const struct kms_output *output, const struct kms_frame *frame)
{
	const struct kms_plane_properties *plane = &output->plane_properties;
	uint32_t id = output->plane;
	kms_request_add(request, id, &plane->fb_id, frame->framebuffer);
	kms_request_add(request, id, &plane->crtc_id, output->crtc);
	kms_request_add(request, id, &plane->src_x, 0);
	kms_request_add(request, id, &plane->src_y, 0);
	kms_request_add(request, id, &plane->src_w, (uint64_t)frame->width << 16);
	kms_request_add(request, id, &plane->src_h, (uint64_t)frame->height << 16);
	kms_request_add(request, id, &plane->crtc_x, 0);
	kms_request_add(request, id, &plane->crtc_y, 0);
	kms_request_add(request, id, &plane->crtc_w, output->mode.hdisplay);
	kms_request_add(request, id, &plane->crtc_h, output->mode.vdisplay);
	kms_request_add_optional(request, id, &plane->rotation, kms_rotation(frame->rotation));
}

/* Properties have the same id on all objects of a kind. */
static void add_other_connectors(struct kms_request *request, const struct kms_output *output)
{
	for (size_t i = 0; i < output->other_connector_count; i++)
		kms_request_add(request, output->other_connectors[i],
			&output->connector_properties.crtc_id, 0);
}

static void add_other_planes(struct kms_request *request, const struct kms_output *output)
{
	const struct kms_plane_properties *plane = &output->plane_properties;
	for (size_t i = 0; i < output->other_plane_count; i++) {
		kms_request_add(request, output->other_planes[i], &plane->fb_id, 0);
		kms_request_add(request, output->other_planes[i], &plane->crtc_id, 0);
	}
}

/* The kernel waits for the fence, instead of us. */
static void add_fences(
	struct kms_request *request, const struct kms_output *output, const struct kms_frame *frame)
{
	if (frame->in_fence >= 0)
		kms_request_add_optional(request, output->plane,
			&output->plane_properties.in_fence_fd, (uint64_t)frame->in_fence);
	if (frame->out_fence == NULL)
		return;
	*frame->out_fence = -1;
	kms_request_add_optional(request, output->crtc, &output->crtc_properties.out_fence_ptr,
		(uintptr_t)frame->out_fence);
}

static enum kms_result set_mode(const struct kms_device *device, const struct kms_output *output,
	const struct kms_frame *frame, void *user_data)
{
	struct kms_request request = {0};
	uint32_t mode;
	int code =
		drmModeCreatePropertyBlob(device->fd, &output->mode, sizeof(output->mode), &mode);
	if (code != 0)
		return kms_result_of(code);
	kms_request_add(
		&request, output->connector, &output->connector_properties.crtc_id, output->crtc);
	kms_request_add_optional(
		&request, output->connector, &output->connector_properties.link_status, 0);
	add_other_connectors(&request, output);
	kms_request_add(&request, output->crtc, &output->crtc_properties.mode_id, mode);
	kms_request_add(&request, output->crtc, &output->crtc_properties.active, 1);
	add_plane(&request, output, frame);
	add_other_planes(&request, output);
	add_fences(&request, output, frame);
	enum kms_result result = kms_request_commit(device, &request,
		DRM_MODE_ATOMIC_ALLOW_MODESET | DRM_MODE_PAGE_FLIP_EVENT, user_data);
	code = errno;
	drmModeDestroyPropertyBlob(device->fd, mode);
	errno = code;
	return result;
}

/* A clip of the frame, as a blob; 0: none, which means all of it. */
static uint32_t make_damage(
	const struct kms_device *device, const struct kms_output *output, const struct rect *damage)
{
	uint32_t blob = 0;
	if (damage == NULL || output->plane_properties.fb_damage_clips.id == 0)
		return 0;
	struct drm_mode_rect clip = {(int32_t)damage->x, (int32_t)damage->y,
		(int32_t)(damage->x + damage->width), (int32_t)(damage->y + damage->height)};
	drmModeCreatePropertyBlob(device->fd, &clip, sizeof(clip), &blob);
	return blob;
}

static enum kms_result flip(const struct kms_device *device, const struct kms_output *output,
	const struct kms_frame *frame, bool async, void *user_data)
{
	/* Kernels take flips that do not wait through this call alone before 6.8. */
	if (async)
		return kms_legacy.flip(device, output, frame, true, user_data);
	struct kms_request request = {0};
	const struct kms_plane_properties *plane = &output->plane_properties;
	uint32_t damage = make_damage(device, output, frame->damage);
	kms_request_add(&request, output->plane, &plane->fb_id, frame->framebuffer);
	kms_request_add_optional(&request, output->plane, &plane->fb_damage_clips, damage);
	add_fences(&request, output, frame);
	enum kms_result result = kms_request_commit(
		device, &request, DRM_MODE_ATOMIC_NONBLOCK | DRM_MODE_PAGE_FLIP_EVENT, user_data);
	int code = errno;
	if (damage != 0)
		drmModeDestroyPropertyBlob(device->fd, damage);
	errno = code;
	return result;
}

static enum kms_result switch_off(const struct kms_device *device, const struct kms_output *output)
{
	struct kms_request request = {0};
	kms_request_add(&request, output->connector, &output->connector_properties.crtc_id, 0);
	kms_request_add(&request, output->crtc, &output->crtc_properties.mode_id, 0);
	kms_request_add(&request, output->crtc, &output->crtc_properties.active, 0);
	kms_request_add(&request, output->plane, &output->plane_properties.fb_id, 0);
	kms_request_add(&request, output->plane, &output->plane_properties.crtc_id, 0);
	return kms_request_commit(device, &request, DRM_MODE_ATOMIC_ALLOW_MODESET, NULL);
}

const struct kms_interface kms_atomic = {
	.name = "atomic",
	.set_mode_sends_event = true,
	.set_mode = set_mode,
	.flip = flip,
	.switch_off = switch_off,
};
