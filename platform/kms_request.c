/* SPDX-License-Identifier: MIT */
#include "kms_request.h"
#include <errno.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

void kms_request_add(struct kms_request *request, uint32_t object,
	const struct kms_property *property, uint64_t value)
{
	if (property->id == 0 || request->property_count == KMS_REQUEST_MAX) {
		request->failed = true;
		return;
	}
	if (request->object_count == 0 || request->objects[request->object_count - 1] != object)
		request->objects[request->object_count++] = object;
	request->counts[request->object_count - 1]++;
	request->properties[request->property_count] = property->id;
	request->values[request->property_count++] = value;
}

void kms_request_add_optional(struct kms_request *request, uint32_t object,
	const struct kms_property *property, uint64_t value)
{
	if (property->id != 0)
		kms_request_add(request, object, property, value);
}

enum kms_result kms_request_commit(const struct kms_device *device,
	const struct kms_request *request, uint32_t flags, void *user_data)
{
	if (request->failed) {
		errno = EINVAL;
		return KMS_REFUSED;
	}
	struct drm_mode_atomic atomic = {
		.flags = flags,
		.count_objs = request->object_count,
		.objs_ptr = (uintptr_t)request->objects,
		.count_props_ptr = (uintptr_t)request->counts,
		.props_ptr = (uintptr_t)request->properties,
		.prop_values_ptr = (uintptr_t)request->values,
		.user_data = (uintptr_t)user_data,
	};
	return drmIoctl(device->fd, DRM_IOCTL_MODE_ATOMIC, &atomic) == 0 ? KMS_DONE
									 : kms_result_of(errno);
}
