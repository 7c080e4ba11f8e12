/* SPDX-License-Identifier: MIT */
#include "kms_output.h"
#include "base/error.h"
#include <drm_fourcc.h>
#include <stdio.h>
#include <string.h>
#include <xf86drm.h>

void kms_connector_name(const drmModeConnector *connector, char name[KMS_NAME_SIZE])
{
	const char *type = drmModeGetConnectorTypeName(connector->connector_type);
	snprintf(name, KMS_NAME_SIZE, "%.20s-%u", type != NULL ? type : "Unknown",
		connector->connector_type_id);
}

static unsigned crtc_position(const drmModeRes *resources, uint32_t crtc)
{
	int index = 0;
	while (index < resources->count_crtcs && resources->crtcs[index] != crtc)
		index++;
	return (unsigned)index;
}

/* Those that light a monitor, as a mask. */
static uint32_t crtcs_in_use(const struct kms_device *device, const drmModeRes *resources)
{
	uint32_t used = 0;
	for (int i = 0; i < resources->count_encoders; i++) {
		drmModeEncoder *encoder = drmModeGetEncoder(device->fd, resources->encoders[i]);
		unsigned index = encoder != NULL ? crtc_position(resources, encoder->crtc_id) : 32;
		if (index < 32) /* masks have so many bits */
			used |= UINT32_C(1) << index;
		drmModeFreeEncoder(encoder);
	}
	return used;
}

bool kms_choose_crtc(const struct kms_device *device, const drmModeRes *resources,
	const drmModeConnector *connector, uint32_t *crtc, unsigned *crtc_index)
{
	uint32_t possible = 0, current = 0;
	for (int i = 0; i < connector->count_encoders; i++) {
		drmModeEncoder *encoder = drmModeGetEncoder(device->fd, connector->encoders[i]);
		if (encoder == NULL)
			continue;
		possible |= encoder->possible_crtcs;
		if (encoder->encoder_id == connector->encoder_id)
			current = encoder->crtc_id;
		drmModeFreeEncoder(encoder);
	}
	*crtc = current;
	*crtc_index = crtc_position(resources, current);
	uint32_t unused = possible & ~crtcs_in_use(device, resources);
	if (unused != 0)
		possible = unused;
	for (unsigned i = 0; *crtc == 0 && i < (unsigned)resources->count_crtcs && i < 32; i++)
		if (possible >> i & 1) {
			*crtc = resources->crtcs[i];
			*crtc_index = i;
		}
	return *crtc != 0 && *crtc_index < 32;
}

bool kms_is_lit(const struct kms_device *device, uint32_t connector, uint32_t crtc)
{
	drmModeConnector *info = drmModeGetConnectorCurrent(device->fd, connector);
	drmModeEncoder *encoder = info != NULL && info->encoder_id != 0
					  ? drmModeGetEncoder(device->fd, info->encoder_id)
					  : NULL;
	bool lit = encoder != NULL && encoder->crtc_id == crtc;
	drmModeFreeEncoder(encoder);
	drmModeFreeConnector(info);
	return lit;
}

static void find_other_connectors(
	struct kms_output *output, const struct kms_device *device, const drmModeRes *resources)
{
	for (int i = 0; i < resources->count_connectors; i++)
		if (resources->connectors[i] != output->connector &&
			output->other_connector_count < KMS_OTHER_CONNECTORS_MAX &&
			kms_is_lit(device, resources->connectors[i], output->crtc))
			output->other_connectors[output->other_connector_count++] =
				resources->connectors[i];
}

static bool is_primary(const struct kms_device *device, uint32_t plane)
{
	struct kms_plane_properties properties;
	kms_read_plane(device->fd, plane, &properties);
	return properties.type.id != 0 && properties.type.value == DRM_PLANE_TYPE_PRIMARY;
}

drmModePlane *kms_primary_plane(const struct kms_device *device, uint32_t crtc, unsigned crtc_index)
{
	drmModePlane *found = NULL;
	drmModePlaneRes *all =
		device->universal_planes ? drmModeGetPlaneResources(device->fd) : NULL;
	for (uint32_t i = 0; all != NULL && i < all->count_planes; i++) {
		drmModePlane *plane = drmModeGetPlane(device->fd, all->planes[i]);
		bool fits = plane != NULL && plane->possible_crtcs >> crtc_index & 1 &&
			    (plane->crtc_id == 0 || plane->crtc_id == crtc) &&
			    is_primary(device, plane->plane_id);
		/* The one that is on the CRTC already is its own. */
		if (fits && (found == NULL || plane->crtc_id == crtc)) {
			drmModeFreePlane(found);
			found = plane;
		} else {
			drmModeFreePlane(plane);
		}
	}
	drmModeFreePlaneResources(all);
	return found;
}

/* Cursors and overlays that an earlier program left there. */
static void find_other_planes(struct kms_output *output, const struct kms_device *device)
{
	drmModePlaneRes *all =
		device->universal_planes ? drmModeGetPlaneResources(device->fd) : NULL;
	for (uint32_t i = 0; all != NULL && i < all->count_planes; i++) {
		drmModePlane *plane = drmModeGetPlane(device->fd, all->planes[i]);
		if (plane != NULL && plane->plane_id != output->plane &&
			plane->crtc_id == output->crtc &&
			output->other_plane_count < KMS_OTHER_PLANES_MAX)
			output->other_planes[output->other_plane_count++] = plane->plane_id;
		drmModeFreePlane(plane);
	}
	drmModeFreePlaneResources(all);
}

static bool plane_has(const drmModePlane *plane, uint32_t format)
{
	/* Without universal planes every driver takes the formats that the console uses. */
	if (plane == NULL)
		return format == DRM_FORMAT_XRGB8888 || format == DRM_FORMAT_RGB565;
	for (uint32_t i = 0; i < plane->count_formats; i++)
		if (plane->formats[i] == format)
			return true;
	return false;
}

static bool choose_format(struct kms_output *output, const struct kms_wish *wish,
	const drmModePlane *plane, struct sm_error *error)
{
	char known[200] = "none that smoothie draws";
	size_t used = 0;
	output->format = NULL;
	for (size_t i = 0; pixel_format_at(i) != NULL; i++) {
		const struct pixel_format *format = pixel_format_at(i);
		if (!plane_has(plane, format->code))
			continue;
		if (output->format == NULL && (wish->format == NULL || wish->format == format))
			output->format = format;
		used += (size_t)snprintf(known + used, sizeof(known) - used, "%s%s",
			used > 0 ? ", " : "", format->name);
	}
	if (output->format != NULL)
		return true;
	if (wish->format != NULL)
		return error_set(error, SM_ERROR_INPUT, "%s does not show %s; it shows %s",
			output->name, wish->format->name, known);
	return error_set(error, SM_ERROR_MACHINE, "%s shows %s", output->name, known);
}

static void read_modifiers(struct kms_output *output, const struct kms_device *device)
{
	const struct kms_property *in_formats = &output->plane_properties.in_formats;
	drmModePropertyBlobRes *blob =
		device->modifiers && in_formats->id != 0
			? drmModeGetPropertyBlob(device->fd, (uint32_t)in_formats->value)
			: NULL;
	drmModeFormatModifierIterator iterator = {0};
	while (blob != NULL && drmModeFormatModifierBlobIterNext(blob, &iterator))
		if (iterator.fmt == output->format->code &&
			output->modifier_count < KMS_MODIFIERS_MAX)
			output->modifiers[output->modifier_count++] = iterator.mod;
	drmModeFreePropertyBlob(blob);
}

static bool find_plane(struct kms_output *output, const struct kms_device *device,
	const struct kms_wish *wish, struct sm_error *error)
{
	drmModePlane *plane = kms_primary_plane(device, output->crtc, output->crtc_index);
	if (plane == NULL && device->universal_planes)
		return error_set(
			error, SM_ERROR_MACHINE, "%s has no primary plane left", output->name);
	bool chosen = choose_format(output, wish, plane, error);
	if (plane != NULL)
		output->plane = plane->plane_id;
	drmModeFreePlane(plane);
	if (!chosen)
		return false;
	kms_read_connector(device->fd, output->connector, &output->connector_properties);
	kms_read_crtc(device->fd, output->crtc, &output->crtc_properties);
	if (output->plane != 0)
		kms_read_plane(device->fd, output->plane, &output->plane_properties);
	output->rotations = kms_rotations(device->fd, &output->plane_properties.rotation);
	read_modifiers(output, device);
	find_other_planes(output, device);
	return true;
}

static void list_modes(const drmModeConnector *connector, char *text, size_t size)
{
	size_t used = 0;
	text[0] = '\0';
	for (int i = 0; i < connector->count_modes && used < size; i++) {
		const drmModeModeInfo *mode = &connector->modes[i];
		struct refresh refresh = mode_refresh(mode);
		used += (size_t)snprintf(text + used, size - used, "%s%ux%u@%.5g",
			i > 0 ? ", " : "", mode->hdisplay, mode->vdisplay,
			(double)refresh.numerator / refresh.denominator);
	}
}

static bool choose_mode(struct kms_output *output, const struct kms_device *device,
	const struct kms_wish *wish, const drmModeConnector *connector, struct sm_error *error)
{
	static const struct mode_wish preferred;
	size_t count = (size_t)connector->count_modes;
	drmModeCrtc *crtc = drmModeGetCrtc(device->fd, output->crtc);
	const drmModeModeInfo *current =
		crtc != NULL && crtc->mode_valid && connector->encoder_id != 0 ? &crtc->mode : NULL;
	const drmModeModeInfo *mode = mode_choose(&wish->mode, connector->modes, count, current);
	if (mode == NULL && wish->any_mode)
		mode = mode_choose(&preferred, connector->modes, count, current);
	if (mode != NULL)
		output->mode = *mode;
	drmModeFreeCrtc(crtc);
	if (mode != NULL)
		return true;
	char known[300];
	list_modes(connector, known, sizeof(known));
	return error_set(
		error, SM_ERROR_INPUT, "%s has no such mode; it has %.290s", output->name, known);
}

static bool use_connector(struct kms_output *output, const struct kms_device *device,
	const drmModeRes *resources, const drmModeConnector *connector, const struct kms_wish *wish,
	struct sm_error *error)
{
	*output = (struct kms_output){.connector = connector->connector_id};
	kms_connector_name(connector, output->name);
	if (!kms_choose_crtc(device, resources, connector, &output->crtc, &output->crtc_index))
		return error_set(error, SM_ERROR_MACHINE, "%s has no CRTC left", output->name);
	find_other_connectors(output, device, resources);
	return choose_mode(output, device, wish, connector, error) &&
	       find_plane(output, device, wish, error);
}

/* Some drivers cannot tell whether there is a monitor: the user may, by naming the connector. */
static bool is_screen(
	const struct kms_device *device, const drmModeConnector *connector, bool named)
{
	struct kms_connector_properties properties;
	bool connected = connector->connection == DRM_MODE_CONNECTED ||
			 (named && connector->connection == DRM_MODE_UNKNOWNCONNECTION);
	if (!connected || connector->count_modes == 0)
		return false;
	kms_read_connector(device->fd, connector->connector_id, &properties);
	return properties.non_desktop.id == 0 || properties.non_desktop.value == 0;
}

static enum kms_search no_such_connector(
	const struct kms_wish *wish, const char *known, struct sm_error *error)
{
	error_set(
		error, SM_ERROR_INPUT, "no connector %.40s; it has %.300s", wish->connector, known);
	return KMS_UNUSABLE;
}

enum kms_search kms_output_find(struct kms_output *output, const struct kms_device *device,
	const struct kms_wish *wish, bool probe, struct sm_error *error)
{
	enum kms_search search = KMS_NO_MONITOR;
	bool known = wish->connector == NULL;
	char names[300] = "";
	drmModeRes *resources = drmModeGetResources(device->fd);
	for (int i = 0; resources != NULL && i < resources->count_connectors; i++) {
		uint32_t id = resources->connectors[i];
		drmModeConnector *connector = probe ? drmModeGetConnector(device->fd, id)
						    : drmModeGetConnectorCurrent(device->fd, id);
		char name[KMS_NAME_SIZE];
		if (connector == NULL)
			continue;
		kms_connector_name(connector, name);
		size_t used = strlen(names);
		snprintf(names + used, sizeof(names) - used, "%s%s", used > 0 ? ", " : "", name);
		bool wanted = wish->connector == NULL || strcmp(wish->connector, name) == 0;
		known = known || wanted;
		if (wanted && search == KMS_NO_MONITOR &&
			is_screen(device, connector, wish->connector != NULL))
			search = use_connector(output, device, resources, connector, wish, error)
					 ? KMS_FOUND
					 : KMS_UNUSABLE;
		drmModeFreeConnector(connector);
	}
	drmModeFreeResources(resources);
	return known || resources == NULL ? search : no_such_connector(wish, names, error);
}
