/* SPDX-License-Identifier: MIT */
#include "kms_saved.h"
#include "base/log.h"
#include <string.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

void kms_save(
	struct kms_saved *saved, const struct kms_device *device, const struct kms_output *output)
{
	*saved = (struct kms_saved){.crtc = output->crtc, .plane = output->plane};
	drmModeCrtc *crtc = drmModeGetCrtc(device->fd, output->crtc);
	for (size_t i = 0; i < output->other_connector_count; i++)
		saved->connectors[saved->connector_count++] = output->other_connectors[i];
	if (kms_is_lit(device, output->connector, output->crtc))
		saved->connectors[saved->connector_count++] = output->connector;
	if (crtc != NULL && crtc->mode_valid && crtc->buffer_id != 0 &&
		saved->connector_count > 0) {
		saved->lit = true;
		saved->framebuffer = crtc->buffer_id;
		saved->x = crtc->x;
		saved->y = crtc->y;
		saved->mode = crtc->mode;
	}
	drmModeFreeCrtc(crtc);
	saved->rotation = output->plane_properties.rotation;
}

/* The legacy calls serve on every driver, and the kernel fills in what they leave out; all but a
 * plane's rotation, which stays, and may not suit the buffer that was there before. */
static void restore_rotation(const struct kms_saved *saved, const struct kms_device *device)
{
	struct kms_plane_properties now;
	if (saved->plane == 0 || saved->rotation.id == 0)
		return;
	kms_read_plane(device->fd, saved->plane, &now);
	if (now.rotation.value == saved->rotation.value)
		return;
	drmModeSetCrtc(device->fd, saved->crtc, 0, 0, 0, NULL, 0, NULL);
	drmModeObjectSetProperty(device->fd, saved->plane, DRM_MODE_OBJECT_PLANE,
		saved->rotation.id, saved->rotation.value);
}

void kms_restore(const struct kms_saved *saved, const struct kms_device *device)
{
	if (saved->crtc == 0)
		return;
	restore_rotation(saved, device);
	uint32_t connectors[KMS_OTHER_CONNECTORS_MAX + 1];
	memcpy(connectors, saved->connectors, sizeof(connectors));
	drmModeModeInfo mode = saved->mode;
	if (saved->lit && drmModeSetCrtc(device->fd, saved->crtc, saved->framebuffer, saved->x,
				  saved->y, connectors, (int)saved->connector_count, &mode) == 0)
		return;
	if (saved->lit)
		log_debug("what was shown before is gone");
	drmModeSetCrtc(device->fd, saved->crtc, 0, 0, 0, NULL, 0, NULL);
}
