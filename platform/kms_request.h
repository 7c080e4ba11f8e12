/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_KMS_REQUEST_H
#define PLATFORM_KMS_REQUEST_H

#include "kms_device.h"
#include "kms_property.h"

#define KMS_REQUEST_MAX 80

/** Properties to be set together or not at all. It needs no memory of its own, so that a frame
 *  allocates none: libdrm's request does. Zero is empty. */
struct kms_request {
	uint32_t objects[KMS_REQUEST_MAX], counts[KMS_REQUEST_MAX]; /* of properties each */
	uint32_t properties[KMS_REQUEST_MAX];
	uint64_t values[KMS_REQUEST_MAX];
	uint32_t object_count, property_count;
	bool failed; /* a property is missing, or there was no room */
};

/** Adds a property; those of one object come one after the other. One that the driver lacks makes
 *  the request fail. */
void kms_request_add(struct kms_request *request, uint32_t object,
	const struct kms_property *property, uint64_t value);

/** Adds a property unless the driver lacks it. */
void kms_request_add_optional(struct kms_request *request, uint32_t object,
	const struct kms_property *property, uint64_t value);

/** flags: DRM_MODE_ATOMIC_*, DRM_MODE_PAGE_FLIP_*; user_data comes with the event. A request that
 *  failed is refused. */
enum kms_result kms_request_commit(const struct kms_device *device,
	const struct kms_request *request, uint32_t flags, void *user_data);

#endif
