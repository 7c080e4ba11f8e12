/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_KMS_PROPERTY_H
#define PLATFORM_KMS_PROPERTY_H

#include <stddef.h>
#include <stdint.h>

/** A property of a KMS object; id 0: the driver has none of that name. */
struct kms_property {
	uint32_t id;
	uint64_t value; /* when it was read */
};

struct kms_connector_properties {
	struct kms_property crtc_id;
	struct kms_property link_status; /* 1: the link has to be set up anew */
	struct kms_property non_desktop; /* 1: a headset, not a screen */
};

struct kms_crtc_properties {
	struct kms_property active, mode_id, out_fence_ptr;
};

struct kms_plane_properties {
	struct kms_property type, in_formats;
	struct kms_property fb_id, crtc_id;
	struct kms_property src_x, src_y, src_w, src_h; /* 16.16 pixels of the buffer */
	struct kms_property crtc_x, crtc_y, crtc_w, crtc_h;
	struct kms_property rotation, in_fence_fd, fb_damage_clips;
};

/** Read the properties of one object; those that are not there stay zero. */
void kms_read_connector(int fd, uint32_t id, struct kms_connector_properties *properties);
void kms_read_crtc(int fd, uint32_t id, struct kms_crtc_properties *properties);
void kms_read_plane(int fd, uint32_t id, struct kms_plane_properties *properties);

/** The DRM_MODE_ROTATE_* bit of a rotation by 0, 90, 180 or 270 degrees clockwise. */
uint64_t kms_rotation(unsigned clockwise);

/** The DRM_MODE_ROTATE_* and _REFLECT_* bits that a plane's rotation property takes. */
uint64_t kms_rotations(int fd, const struct kms_property *rotation);

#endif
