/* SPDX-License-Identifier: MIT */
#include "kms_device.h"
#include "base/error.h"
#include <errno.h>
#include <stdlib.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

enum kms_result kms_result_of(int code)
{
	switch (abs(code)) {
	case 0:
		return KMS_DONE;
	case EBUSY:
	case EAGAIN:
		return KMS_BUSY;
	case EACCES:
	case EPERM:
		return KMS_NO_MASTER;
	case ENODEV:
	case ENXIO:
		return KMS_GONE;
	case EINVAL:
	case ENOENT:
	case ENOSPC:
	case ENOSYS:
	case ENOTSUP:
	case ERANGE:
		return KMS_REFUSED;
	default:
		return KMS_FAILED;
	}
}

static bool has_cap(int fd, uint64_t cap)
{
	uint64_t value = 0;
	return drmGetCap(fd, cap, &value) == 0 && value != 0;
}

/* Render nodes and drivers without a display have no resources. */
static bool drives_display(int fd, struct sm_error *error)
{
	drmModeRes *resources = drmModeGetResources(fd);
	bool drives =
		resources != NULL && resources->count_crtcs > 0 && resources->count_connectors > 0;
	drmModeFreeResources(resources);
	return drives || error_set(error, SM_ERROR_MACHINE, "it drives no display");
}

bool kms_device_init(struct kms_device *device, int fd, bool legacy, struct sm_error *error)
{
	*device = (struct kms_device){.fd = fd};
	if (!drives_display(fd, error))
		return false;
	device->universal_planes = drmSetClientCap(fd, DRM_CLIENT_CAP_UNIVERSAL_PLANES, 1) == 0;
	device->atomic = !legacy && device->universal_planes &&
			 drmSetClientCap(fd, DRM_CLIENT_CAP_ATOMIC, 1) == 0;
	device->modifiers = has_cap(fd, DRM_CAP_ADDFB2_MODIFIERS);
	device->dumb = has_cap(fd, DRM_CAP_DUMB_BUFFER);
	device->async_flip = has_cap(fd, DRM_CAP_ASYNC_PAGE_FLIP);
	return true;
}

enum kms_result kms_device_take(const struct kms_device *device)
{
	if (drmIsMaster(device->fd) || drmSetMaster(device->fd) == 0)
		return KMS_DONE;
	/* EBUSY, EINVAL: there is another master. EACCES: the kernel lets root alone ask. */
	return errno == ENODEV ? KMS_GONE : KMS_NO_MASTER;
}
