/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_KMS_OUTPUT_H
#define PLATFORM_KMS_OUTPUT_H

#include "kms_device.h"
#include "kms_mode.h"
#include "kms_property.h"
#include "pixel_format.h"

#define KMS_MODIFIERS_MAX 64
#define KMS_OTHER_PLANES_MAX 16
#define KMS_OTHER_CONNECTORS_MAX 7
#define KMS_NAME_SIZE 32

/** What the user wants to be shown on; zero: whatever there is. */
struct kms_wish {
	const char *connector; /* its name; NULL: the first with a monitor */
	struct mode_wish mode;
	bool any_mode;                     /* where the wanted one is missing take the preferred */
	const struct pixel_format *format; /* NULL: the best that the plane has */
};

/** A monitor and the way to it: connector, CRTC, primary plane, mode, format. */
struct kms_output {
	char name[KMS_NAME_SIZE]; /* of the connector, such as "HDMI-A-1" */
	uint32_t connector, crtc;
	uint32_t plane; /* 0: the driver tells of no primary planes */
	unsigned crtc_index;
	drmModeModeInfo mode;
	const struct pixel_format *format;
	uint64_t modifiers[KMS_MODIFIERS_MAX]; /* of the format, as far as the plane tells */
	size_t modifier_count;
	uint64_t rotations;                          /* DRM_MODE_ROTATE_* that the plane does */
	uint32_t other_planes[KMS_OTHER_PLANES_MAX]; /* on the CRTC, to be switched off */
	size_t other_plane_count;
	/* Lit by the CRTC too: few drivers can keep them so. */
	uint32_t other_connectors[KMS_OTHER_CONNECTORS_MAX];
	size_t other_connector_count;
	struct kms_connector_properties connector_properties;
	struct kms_crtc_properties crtc_properties;
	struct kms_plane_properties plane_properties;
};

enum kms_search {
	KMS_FOUND,
	KMS_NO_MONITOR, /**< none is connected where it was looked for */
	KMS_UNUSABLE,   /**< *error is filled */
};

/**
 * Looks for a monitor. probe: ask the monitors themselves, which takes up to some 100 ms, instead
 * of what the kernel knows.
 * Fails (INPUT) on a connector, mode or format that is not there, (MACHINE) where the driver has no
 * way to a connected monitor.
 */
enum kms_search kms_output_find(struct kms_output *output, const struct kms_device *device,
	const struct kms_wish *wish, bool probe, struct sm_error *error);

/** Writes a connector's name, such as "HDMI-A-1". */
void kms_connector_name(const drmModeConnector *connector, char name[KMS_NAME_SIZE]);

/** The CRTC that drives a connector now, or the first that can, best one that drives no other;
 *  false: none can. */
bool kms_choose_crtc(const struct kms_device *device, const drmModeRes *resources,
	const drmModeConnector *connector, uint32_t *crtc, unsigned *crtc_index);

/** Whether the connector is lit by the CRTC. */
bool kms_is_lit(const struct kms_device *device, uint32_t connector, uint32_t crtc);

/** The formats of a plane in the order of the driver, freed with drmModeFreePlane(); NULL without
 *  a primary plane for the CRTC. */
drmModePlane *kms_primary_plane(
	const struct kms_device *device, uint32_t crtc, unsigned crtc_index);

#endif
