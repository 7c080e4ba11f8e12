/* SPDX-License-Identifier: MIT */
#include "kms_saved.h"
#include "base/log.h"
#include <xf86drm.h>
#include <xf86drmMode.h>

/* Whether the connector is lit by the CRTC. */
static bool is_on(const struct kms_device *device, uint32_t connector, uint32_t crtc)
{
	drmModeConnector *info = drmModeGetConnectorCurrent(device->fd, connector);
	drmModeEncoder *encoder = info != NULL && info->encoder_id != 0
					  ? drmModeGetEncoder(device->fd, info->encoder_id)
					  : NULL;
	bool on = encoder != NULL && encoder->crtc_id == crtc;
	drmModeFreeEncoder(encoder);
	drmModeFreeConnector(info);
	return on;
}

void kms_save(
	struct kms_saved *saved, const struct kms_device *device, const struct kms_output *output)
{
	*saved = (struct kms_saved){.crtc = output->crtc, .plane = output->plane};
	drmModeCrtc *crtc = drmModeGetCrtc(device->fd, output->crtc);
	if (crtc != NULL && crtc->mode_valid && crtc->buffer_id != 0 &&
		is_on(device, output->connector, output->crtc)) {
		saved->lit = true;
		saved->connector = output->connector;
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
	uint32_t connector = saved->connector;
	drmModeModeInfo mode = saved->mode;
	if (saved->lit && drmModeSetCrtc(device->fd, saved->crtc, saved->framebuffer, saved->x,
				  saved->y, &connector, 1, &mode) == 0)
		return;
	if (saved->lit)
		log_debug("what was shown before is gone");
	drmModeSetCrtc(device->fd, saved->crtc, 0, 0, 0, NULL, 0, NULL);
}
