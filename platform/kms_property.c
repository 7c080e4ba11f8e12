/* SPDX-License-Identifier: MIT */
#include "kms_property.h"
#include <stdlib.h>
#include <string.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

/* A property's name and where it goes. Tables are sorted by name, for bsearch(). */
struct entry {
	const char *name;
	size_t offset;
};

#define CONNECTOR(name, member)                                         \
	{                                                               \
		name, offsetof(struct kms_connector_properties, member) \
	}
#define CRTC(name, member)                                         \
	{                                                          \
		name, offsetof(struct kms_crtc_properties, member) \
	}
#define PLANE(name, member)                                         \
	{                                                           \
		name, offsetof(struct kms_plane_properties, member) \
	}

static const struct entry connector_entries[] = {
	CONNECTOR("CRTC_ID", crtc_id),
	CONNECTOR("link-status", link_status),
	CONNECTOR("non-desktop", non_desktop),
};

static const struct entry crtc_entries[] = {
	CRTC("ACTIVE", active),
	CRTC("MODE_ID", mode_id),
	CRTC("OUT_FENCE_PTR", out_fence_ptr),
};

static const struct entry plane_entries[] = {
	PLANE("CRTC_H", crtc_h),
	PLANE("CRTC_ID", crtc_id),
	PLANE("CRTC_W", crtc_w),
	PLANE("CRTC_X", crtc_x),
	PLANE("CRTC_Y", crtc_y),
	PLANE("FB_DAMAGE_CLIPS", fb_damage_clips),
	PLANE("FB_ID", fb_id),
	PLANE("IN_FENCE_FD", in_fence_fd),
	PLANE("IN_FORMATS", in_formats),
	PLANE("SRC_H", src_h),
	PLANE("SRC_W", src_w),
	PLANE("SRC_X", src_x),
	PLANE("SRC_Y", src_y),
	PLANE("rotation", rotation),
	PLANE("type", type),
};

static int compare(const void *name, const void *entry)
{
	return strcmp(name, ((const struct entry *)entry)->name);
}

static void read_properties(int fd, uint32_t id, uint32_t type, const struct entry *entries,
	size_t count, void *properties)
{
	drmModeObjectProperties *all = drmModeObjectGetProperties(fd, id, type);
	for (uint32_t i = 0; all != NULL && i < all->count_props; i++) {
		drmModePropertyRes *property = drmModeGetProperty(fd, all->props[i]);
		const struct entry *entry =
			property != NULL
				? bsearch(property->name, entries, count, sizeof(*entries), compare)
				: NULL;
		if (entry != NULL)
			memcpy((char *)properties + entry->offset,
				&(struct kms_property){property->prop_id, all->prop_values[i]},
				sizeof(struct kms_property));
		drmModeFreeProperty(property);
	}
	drmModeFreeObjectProperties(all);
}

#define COUNT(table) (sizeof(table) / sizeof((table)[0]))

void kms_read_connector(int fd, uint32_t id, struct kms_connector_properties *properties)
{
	*properties = (struct kms_connector_properties){0};
	read_properties(fd, id, DRM_MODE_OBJECT_CONNECTOR, connector_entries,
		COUNT(connector_entries), properties);
}

void kms_read_crtc(int fd, uint32_t id, struct kms_crtc_properties *properties)
{
	*properties = (struct kms_crtc_properties){0};
	read_properties(
		fd, id, DRM_MODE_OBJECT_CRTC, crtc_entries, COUNT(crtc_entries), properties);
}

void kms_read_plane(int fd, uint32_t id, struct kms_plane_properties *properties)
{
	*properties = (struct kms_plane_properties){0};
	read_properties(
		fd, id, DRM_MODE_OBJECT_PLANE, plane_entries, COUNT(plane_entries), properties);
}

uint64_t kms_rotation(unsigned clockwise)
{
	/* KMS counts them counter-clockwise. */
	static const uint64_t bits[] = {
		DRM_MODE_ROTATE_0, DRM_MODE_ROTATE_270, DRM_MODE_ROTATE_180, DRM_MODE_ROTATE_90};
	return bits[clockwise / 90 % 4];
}

uint64_t kms_rotations(int fd, const struct kms_property *rotation)
{
	uint64_t rotations = 0;
	drmModePropertyRes *property =
		rotation->id != 0 ? drmModeGetProperty(fd, rotation->id) : NULL;
	/* A bit mask's enums are the numbers of its bits. */
	for (int i = 0; property != NULL && i < property->count_enums; i++)
		if (property->enums[i].value < 64)
			rotations |= UINT64_C(1) << property->enums[i].value;
	drmModeFreeProperty(property);
	return rotations;
}
