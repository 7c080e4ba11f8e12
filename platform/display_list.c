/* SPDX-License-Identifier: MIT */
#include "display_state.h"
#include "node.h"
#include <gbm.h>
#include <glob.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

static const char *connection_name(drmModeConnection connection)
{
	return connection == DRM_MODE_CONNECTED      ? "connected"
	       : connection == DRM_MODE_DISCONNECTED ? "no monitor"
						     : "unknown";
}

static void list_modes(FILE *file, const drmModeConnector *connector)
{
	for (int i = 0; i < connector->count_modes; i++) {
		const drmModeModeInfo *mode = &connector->modes[i];
		struct refresh refresh = mode_refresh(mode);
		fprintf(file, "    mode %ux%u@%.5g%s\n", mode->hdisplay, mode->vdisplay,
			(double)refresh.numerator / refresh.denominator,
			mode->type & DRM_MODE_TYPE_PREFERRED ? " (preferred)" : "");
	}
}

static void list_formats(FILE *file, const drmModePlane *plane)
{
	fputs("    formats", file);
	size_t used = 0;
	for (uint32_t i = 0; plane != NULL && i < plane->count_formats; i++) {
		const struct pixel_format *format = pixel_format_of(plane->formats[i]);
		if (format != NULL && ++used > 0)
			fprintf(file, " %s", format->name);
	}
	fputs(plane == NULL ? " not told\n"
		: used == 0 ? " none that smoothie draws\n"
			    : "\n",
		file);
}

static void list_connector(FILE *file, const struct kms_device *device, const drmModeRes *resources,
	const drmModeConnector *connector)
{
	char name[KMS_NAME_SIZE];
	uint32_t crtc;
	unsigned index;
	kms_connector_name(connector, name);
	fprintf(file, "  %s: %s", name, connection_name(connector->connection));
	if (!kms_choose_crtc(device, resources, connector, &crtc, &index)) {
		fputs(", not usable: no CRTC can drive it\n", file);
		return;
	}
	drmModePlane *plane = kms_primary_plane(device, crtc, index);
	if (plane == NULL && device->universal_planes)
		fputs(", not usable: no primary plane is left for it\n", file);
	else if (connector->connection == DRM_MODE_CONNECTED)
		fprintf(file, ", %ux%u mm, usable\n", connector->mmWidth, connector->mmHeight);
	else
		fputs(", will be used when there is one\n", file);
	list_modes(file, connector);
	list_formats(file, plane);
	drmModeFreePlane(plane);
}

static void list_connectors(FILE *file, const struct kms_device *device)
{
	drmModeRes *resources = drmModeGetResources(device->fd);
	for (int i = 0; resources != NULL && i < resources->count_connectors; i++) {
		drmModeConnector *connector =
			drmModeGetConnector(device->fd, resources->connectors[i]);
		if (connector != NULL)
			list_connector(file, device, resources, connector);
		drmModeFreeConnector(connector);
	}
	drmModeFreeResources(resources);
}

static void list_ways(FILE *file, const struct kms_device *device)
{
	struct gbm_device *gbm = node_create_gbm(device->fd, false);
	fprintf(file, "  mode-setting %s, buffers%s%s%s, flips %s\n",
		device->atomic ? "atomic" : "legacy", gbm != NULL ? " GBM" : "",
		device->dumb ? " dumb" : "", device->modifiers ? ", modifiers" : "",
		device->async_flip ? "with and without vsync" : "with vsync");
	if (gbm != NULL)
		gbm_device_destroy(gbm);
}

static void list_open_device(FILE *file, const char *path, int fd)
{
	struct kms_device device;
	struct sm_error why;
	drmVersion *version = drmGetVersion(fd);
	fprintf(file, "%s: %s", path, version != NULL ? version->name : "no DRM node");
	if (version == NULL) {
		fputs(", not usable\n", file);
	} else if (!kms_device_init(&device, fd, false, &why)) {
		fprintf(file, ", not usable: %s\n", why.text);
	} else {
		bool ours = kms_device_take(&device) == KMS_DONE;
		fputs(ours ? ", usable\n" : ", in use by another program\n", file);
		list_ways(file, &device);
		list_connectors(file, &device);
	}
	drmFreeVersion(version);
}

static void list_device(FILE *file, const char *path, struct seat *seat)
{
	struct sm_error why;
	int fd = seat_open_device(seat, path, &why);
	if (fd < 0) {
		fprintf(file, "%s: not usable: %s\n", path, why.text);
		return;
	}
	list_open_device(file, path, fd);
	seat_close_device(seat, fd);
}

static bool list_all(FILE *file, struct seat *seat, struct sm_error *error)
{
	glob_t nodes = {0};
	bool found = glob(DISPLAY_DEVICES, 0, NULL, &nodes) == 0;
	if (!found)
		display_no_device(error);
	for (size_t i = 0; found && i < nodes.gl_pathc; i++)
		list_device(file, nodes.gl_pathv[i], seat);
	globfree(&nodes);
	return found;
}

bool display_list(const char *device, FILE *file, struct sm_error *error)
{
	struct seat *seat = seat_create(error);
	if (seat == NULL)
		return false;
	bool listed = device != NULL || list_all(file, seat, error);
	if (device != NULL)
		list_device(file, device, seat);
	seat_destroy(seat);
	return listed;
}
