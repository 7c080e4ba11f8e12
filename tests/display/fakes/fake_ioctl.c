/* SPDX-License-Identifier: MIT */
/* The kernel's calls, each as its documentation and libdrm have it (drm_mode.h, drm.h). */
#include "fake_drm.h"
#include "pixel_format.h"
#include <drm.h>
#include <drm_fourcc.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

/* Arrays are copied to those who have asked for their number before. */
static void put(uint64_t to, uint32_t *room, const void *from, size_t count, size_t size)
{
	if (to != 0 && *room >= count)
		memcpy((void *)(uintptr_t)to, from, count * size);
	*room = (uint32_t)count;
}

static int get_resources(struct fake_drm *drm, struct drm_mode_card_res *out)
{
	uint32_t connectors[FAKE_CONNECTORS], encoders[FAKE_CONNECTORS], crtcs[FAKE_CRTCS];
	size_t count = 0;
	for (uint32_t i = 0; i < FAKE_CONNECTORS; i++) {
		if (drm->connectors[i].absent)
			continue;
		connectors[count] = 20 + i;
		encoders[count++] = 30 + i;
	}
	for (uint32_t i = 0; i < FAKE_CRTCS; i++)
		crtcs[i] = 10 + i;
	put(out->connector_id_ptr, &out->count_connectors, connectors, count, sizeof(uint32_t));
	put(out->encoder_id_ptr, &out->count_encoders, encoders, count, sizeof(uint32_t));
	put(out->crtc_id_ptr, &out->count_crtcs, crtcs, FAKE_CRTCS, sizeof(uint32_t));
	out->count_fbs = 0;
	out->max_width = out->max_height = 4096;
	return 0;
}

static int get_connector(struct fake_drm *drm, struct drm_mode_get_connector *out)
{
	uint32_t index = out->connector_id - 20;
	if (index >= FAKE_CONNECTORS || drm->connectors[index].absent)
		return ENOENT;
	struct fake_connector *connector = &drm->connectors[index];
	if (out->count_modes == 0) {
		drm->probes++;
		connector->known = connector->plugged;
	}
	uint32_t encoder = 30 + index;
	out->encoder_id = drm->objects[index].values[FAKE_CRTC_ID] != 0 ? encoder : 0;
	out->connector_type = connector->type;
	out->connector_type_id = connector->type_id;
	out->connection = connector->known ? DRM_MODE_CONNECTED : DRM_MODE_DISCONNECTED;
	out->mm_width = 160;
	out->mm_height = 120;
	out->count_props = 0;
	put(out->modes_ptr, &out->count_modes, connector->modes,
		connector->known ? connector->mode_count : 0, sizeof(struct drm_mode_modeinfo));
	put(out->encoders_ptr, &out->count_encoders, &encoder, 1, sizeof(encoder));
	return 0;
}

static int get_encoder(struct fake_drm *drm, struct drm_mode_get_encoder *out)
{
	uint32_t index = out->encoder_id - 30;
	if (index >= FAKE_CONNECTORS)
		return ENOENT;
	out->crtc_id = (uint32_t)drm->objects[index].values[FAKE_CRTC_ID];
	out->possible_crtcs = drm->connectors[index].possible_crtcs;
	return 0;
}

static int get_crtc(struct fake_drm *drm, struct drm_mode_crtc *out)
{
	struct fake_crtc *crtc = fake_crtc(drm, out->crtc_id);
	if (crtc == NULL)
		return ENOENT;
	const uint64_t *plane = fake_primary(drm->objects, out->crtc_id - 10)->values;
	out->fb_id = (uint32_t)plane[FAKE_FB_ID];
	out->x = (uint32_t)(plane[FAKE_SRC_X] >> 16);
	out->y = (uint32_t)(plane[FAKE_SRC_Y] >> 16);
	out->mode_valid = fake_object(drm->objects, out->crtc_id)->values[FAKE_MODE_ID] != 0;
	if (out->mode_valid)
		memcpy(&out->mode, &crtc->mode, sizeof(out->mode));
	return 0;
}

static int get_planes(struct fake_drm *drm, struct drm_mode_get_plane_res *out)
{
	uint32_t planes[FAKE_PLANES];
	size_t count = 0;
	for (uint32_t i = drm->client_universal ? 0 : FAKE_CRTCS; i < FAKE_PLANES; i++)
		planes[count++] = 40 + i;
	put(out->plane_id_ptr, &out->count_planes, planes, count, sizeof(uint32_t));
	return 0;
}

static int get_plane(struct fake_drm *drm, struct drm_mode_get_plane *out)
{
	struct fake_object *plane = fake_object(drm->objects, out->plane_id);
	size_t count = 0;
	if (plane == NULL || plane->type != DRM_MODE_OBJECT_PLANE)
		return ENOENT;
	while (count < 4 && drm->can.formats[count] != 0)
		count++;
	out->crtc_id = (uint32_t)plane->values[FAKE_CRTC_ID];
	out->fb_id = (uint32_t)plane->values[FAKE_FB_ID];
	out->possible_crtcs = plane->id - 40 < FAKE_CRTCS ? 1u << (plane->id - 40) : 3;
	put(out->format_type_ptr, &out->count_format_types, drm->can.formats, count,
		sizeof(uint32_t));
	return 0;
}

/* Others are only for those who do atomic mode-setting. */
static bool is_told(const struct fake_drm *drm, int property)
{
	return drm->client_atomic || property == FAKE_TYPE || property == FAKE_IN_FORMATS ||
	       property == FAKE_ROTATION || property == FAKE_LINK_STATUS ||
	       property == FAKE_NON_DESKTOP;
}

static int get_properties(struct fake_drm *drm, struct drm_mode_obj_get_properties *out)
{
	const struct fake_object *object = fake_object(drm->objects, out->obj_id);
	uint32_t ids[FAKE_PROPERTIES];
	uint64_t values[FAKE_PROPERTIES];
	size_t count = 0;
	if (object == NULL || object->type != out->obj_type)
		return ENOENT;
	for (int i = 0; i < FAKE_PROPERTIES; i++) {
		if (!object->has[i] || !is_told(drm, i))
			continue;
		ids[count] = 100 + (uint32_t)i;
		values[count++] = object->values[i];
	}
	uint32_t room = out->count_props;
	put(out->prop_values_ptr, &room, values, count, sizeof(uint64_t));
	put(out->props_ptr, &out->count_props, ids, count, sizeof(uint32_t));
	return 0;
}

static int get_property(struct fake_drm *drm, struct drm_mode_get_property *out)
{
	static const char *const names[FAKE_PROPERTIES] = {"CRTC_ID", "link-status", "non-desktop",
		"ACTIVE", "MODE_ID", "OUT_FENCE_PTR", "type", "IN_FORMATS", "FB_ID", "SRC_X",
		"SRC_Y", "SRC_W", "SRC_H", "CRTC_X", "CRTC_Y", "CRTC_W", "CRTC_H", "rotation",
		"IN_FENCE_FD", "FB_DAMAGE_CLIPS"};
	struct drm_mode_property_enum bits[6];
	size_t count = 0;
	uint32_t index = out->prop_id - 100;
	if (out->prop_id < 100 || index >= FAKE_PROPERTIES)
		return ENOENT;
	memset(bits, 0, sizeof(bits));
	snprintf(out->name, sizeof(out->name), "%s", names[index]);
	out->flags = index == FAKE_ROTATION ? DRM_MODE_PROP_BITMASK : DRM_MODE_PROP_RANGE;
	for (uint32_t bit = 0; index == FAKE_ROTATION && bit < 6; bit++)
		if (drm->can.rotations >> bit & 1)
			bits[count++].value = bit;
	out->count_values = 0;
	put(out->enum_blob_ptr, &out->count_enum_blobs, bits, count, sizeof(bits[0]));
	return 0;
}

/* RGB565 linear; the others linear and in tiles. */
static int get_formats(struct fake_drm *drm, struct drm_mode_get_blob *out)
{
	struct {
		struct drm_format_modifier_blob head;
		uint32_t formats[4];
		struct drm_format_modifier modifiers[2];
	} blob = {
		.head = {FORMAT_BLOB_CURRENT, 0, 4, sizeof(blob.head), 2,
			sizeof(blob.head) + sizeof(blob.formats)},
		.modifiers = {{.formats = 7, .modifier = DRM_FORMAT_MOD_LINEAR},
			{.formats = 6, .modifier = I915_FORMAT_MOD_X_TILED}},
	};
	memcpy(blob.formats, drm->can.formats, sizeof(blob.formats));
	put(out->data, &out->length, &blob, sizeof(blob), 1);
	return 0;
}

static int get_blob(struct fake_drm *drm, struct drm_mode_get_blob *out)
{
	if (out->blob_id == 1)
		return get_formats(drm, out);
	const struct fake_blob *blob = fake_blob(drm, out->blob_id);
	if (blob == NULL)
		return ENOENT;
	put(out->data, &out->length, blob->data, blob->size, 1);
	return 0;
}

static int create_blob(struct fake_drm *drm, struct drm_mode_create_blob *in)
{
	int code = in->length > sizeof(drm->blobs[0].data) ? EINVAL
							   : fake_fault(drm, FAKE_CREATE_BLOB);
	if (code != 0)
		return code;
	for (size_t i = 0; i < FAKE_BLOBS; i++) {
		struct fake_blob *blob = &drm->blobs[i];
		if (blob->id != 0)
			continue;
		blob->id = in->blob_id = ++drm->last_id;
		blob->size = in->length;
		memcpy(blob->data, (const void *)(uintptr_t)in->data, in->length);
		return 0;
	}
	return ENOMEM;
}

static int destroy_blob(struct fake_drm *drm, const struct drm_mode_destroy_blob *in)
{
	struct fake_blob *blob = fake_blob(drm, in->blob_id);
	if (blob == NULL)
		return ENOENT;
	blob->id = 0;
	return 0;
}

static int create_dumb(struct fake_drm *drm, struct drm_mode_create_dumb *in)
{
	int code = drm->can.no_dumb ? ENOSYS : fake_fault(drm, FAKE_CREATE_DUMB);
	uint32_t pitch = (in->width * (in->bpp / 8) + 63) / 64 * 64;
	if (code != 0)
		return code;
	for (uint32_t i = 0; i < FAKE_BUFFERS; i++) {
		struct fake_dumb *dumb = &drm->dumbs[i];
		if (dumb->used || (uint64_t)pitch * in->height > FAKE_DUMB_ROOM)
			continue;
		*dumb = (struct fake_dumb){
			true, true, in->width, in->height, pitch, (uint64_t)pitch * in->height};
		/* What is not written shows. */
		memset(drm->pixels + (size_t)i * FAKE_DUMB_ROOM, 0xa5, dumb->size);
		in->handle = i + 1;
		in->pitch = pitch;
		in->size = dumb->size;
		return 0;
	}
	return ENOMEM;
}

static struct fake_dumb *dumb_of(struct fake_drm *drm, uint32_t handle)
{
	bool is_one = handle > 0 && handle <= FAKE_BUFFERS && drm->dumbs[handle - 1].open;
	return is_one ? &drm->dumbs[handle - 1] : NULL;
}

static int map_dumb(struct fake_drm *drm, struct drm_mode_map_dumb *in)
{
	if (dumb_of(drm, in->handle) == NULL)
		return ENOENT;
	in->offset = (uint64_t)(in->handle - 1) * FAKE_DUMB_ROOM;
	return fake_fault(drm, FAKE_MAP_DUMB);
}

/* Memory lasts as long as its framebuffers. */
static void forget_unused(struct fake_drm *drm)
{
	for (uint32_t i = 0; i < FAKE_BUFFERS; i++)
		drm->dumbs[i].used = drm->dumbs[i].open;
	for (size_t i = 0; i < FAKE_BUFFERS; i++)
		if (drm->framebuffers[i].id != 0)
			drm->dumbs[drm->framebuffers[i].dumb].used = true;
}

static int destroy_dumb(struct fake_drm *drm, const struct drm_mode_destroy_dumb *in)
{
	struct fake_dumb *dumb = dumb_of(drm, in->handle);
	if (dumb == NULL)
		return ENOENT;
	dumb->open = false;
	forget_unused(drm);
	return 0;
}

static int add_framebuffer(struct fake_drm *drm, const struct fake_framebuffer *framebuffer,
	uint32_t handle, uint32_t *id)
{
	const struct fake_dumb *dumb = dumb_of(drm, handle);
	const struct pixel_format *format = pixel_format_of(framebuffer->format);
	if (dumb == NULL)
		return ENOENT;
	if (format == NULL || framebuffer->pitch < framebuffer->width * format->bytes ||
		(uint64_t)framebuffer->pitch * framebuffer->height > dumb->size)
		return EINVAL;
	int code = fake_fault(drm, FAKE_ADD_FRAMEBUFFER);
	for (size_t i = 0; code == 0 && i < FAKE_BUFFERS; i++) {
		if (drm->framebuffers[i].id != 0)
			continue;
		drm->framebuffers[i] = *framebuffer;
		drm->framebuffers[i].dumb = handle - 1;
		drm->framebuffers[i].id = *id = ++drm->last_id;
		return 0;
	}
	return code != 0 ? code : ENOMEM;
}

static int add_by_depth(struct fake_drm *drm, struct drm_mode_fb_cmd *in)
{
	uint32_t format = in->depth == 16   ? DRM_FORMAT_RGB565
			  : in->depth == 30 ? DRM_FORMAT_XRGB2101010
					    : DRM_FORMAT_XRGB8888;
	if (in->bpp != (in->depth == 16 ? 16 : 32))
		return EINVAL;
	return add_framebuffer(drm,
		&(struct fake_framebuffer){0, in->width, in->height, format, in->pitch, 0, 0},
		in->handle, &in->fb_id);
}

static int add_by_format(struct fake_drm *drm, struct drm_mode_fb_cmd2 *in)
{
	if (drm->can.only_by_depth)
		return EINVAL;
	if (in->flags & DRM_MODE_FB_MODIFIERS && !drm->can.modifiers)
		return EINVAL;
	return add_framebuffer(drm,
		&(struct fake_framebuffer){0, in->width, in->height, in->pixel_format,
			in->pitches[0], 0,
			in->flags & DRM_MODE_FB_MODIFIERS ? in->modifier[0]
							  : DRM_FORMAT_MOD_INVALID},
		in->handles[0], &in->fb_id);
}

/* Sets a CRTC as the legacy calls do: with what is on its plane. */
static int set_crtc(struct fake_drm *drm, struct fake_object *next, size_t crtc)
{
	int code = fake_drm_check(drm, next);
	if (code != 0)
		return code;
	fake_complete(drm, crtc);
	memcpy(drm->objects, next, sizeof(drm->objects));
	fake_begin_flip(drm, crtc, true);
	fake_complete(drm, crtc);
	return 0;
}

static void turn_off(struct fake_object *next, size_t crtc)
{
	next[FAKE_CONNECTORS + crtc].values[FAKE_ACTIVE] = 0;
	next[FAKE_CONNECTORS + crtc].values[FAKE_MODE_ID] = 0;
	for (size_t i = 0; i < FAKE_CONNECTORS; i++)
		if (next[i].values[FAKE_CRTC_ID] == 10 + crtc)
			next[i].values[FAKE_CRTC_ID] = 0;
	for (size_t i = 0; i < FAKE_PLANES; i++) {
		uint64_t *plane = next[FAKE_CONNECTORS + FAKE_CRTCS + i].values;
		if (plane[FAKE_CRTC_ID] == 10 + crtc)
			plane[FAKE_CRTC_ID] = plane[FAKE_FB_ID] = 0;
	}
}

static int remove_framebuffer(struct fake_drm *drm, const uint32_t *id)
{
	struct fake_framebuffer *framebuffer = fake_framebuffer(drm, *id);
	if (framebuffer == NULL)
		return ENOENT;
	for (size_t crtc = 0; crtc < FAKE_CRTCS; crtc++) {
		struct fake_object next[FAKE_OBJECTS];
		fake_complete(drm, crtc);
		if (fake_primary(drm->objects, crtc)->values[FAKE_FB_ID] != *id)
			continue;
		memcpy(next, drm->objects, sizeof(next));
		turn_off(next, crtc);
		set_crtc(drm, next, crtc);
		drm->blanked++;
	}
	framebuffer->id = 0;
	forget_unused(drm);
	return 0;
}

static void fill_plane(struct fake_object *plane, const struct drm_mode_crtc *in)
{
	bool turned = plane->values[FAKE_ROTATION] & (DRM_MODE_ROTATE_90 | DRM_MODE_ROTATE_270);
	uint64_t width = in->mode.hdisplay, height = in->mode.vdisplay;
	plane->values[FAKE_FB_ID] = in->fb_id;
	plane->values[FAKE_CRTC_ID] = in->crtc_id;
	plane->values[FAKE_SRC_X] = (uint64_t)in->x << 16;
	plane->values[FAKE_SRC_Y] = (uint64_t)in->y << 16;
	plane->values[FAKE_SRC_W] = (turned ? height : width) << 16;
	plane->values[FAKE_SRC_H] = (turned ? width : height) << 16;
	plane->values[FAKE_CRTC_X] = plane->values[FAKE_CRTC_Y] = 0;
	plane->values[FAKE_CRTC_W] = width;
	plane->values[FAKE_CRTC_H] = height;
}

static int legacy_set_crtc(struct fake_drm *drm, struct drm_mode_crtc *in)
{
	struct fake_object next[FAKE_OBJECTS];
	const uint32_t *connectors = (const uint32_t *)(uintptr_t)in->set_connectors_ptr;
	struct fake_crtc *crtc = fake_crtc(drm, in->crtc_id);
	if (!drm->master)
		return EACCES;
	if (crtc == NULL)
		return ENOENT;
	memcpy(next, drm->objects, sizeof(next));
	turn_off(next, in->crtc_id - 10);
	if (!in->mode_valid) {
		int code = in->count_connectors > 0 ? EINVAL : fake_fault(drm, FAKE_SWITCH_OFF);
		return code != 0 ? code : set_crtc(drm, next, in->crtc_id - 10);
	}
	drmModeModeInfo before = crtc->mode;
	memcpy(&crtc->mode, &in->mode, sizeof(in->mode));
	for (uint32_t i = 0; i < in->count_connectors; i++) {
		struct fake_object *connector = fake_object(next, connectors[i]);
		if (connector != NULL)
			connector->values[FAKE_CRTC_ID] = in->crtc_id;
	}
	next[FAKE_CONNECTORS + in->crtc_id - 10].values[FAKE_ACTIVE] = 1;
	next[FAKE_CONNECTORS + in->crtc_id - 10].values[FAKE_MODE_ID] = 1;
	fill_plane(fake_primary(next, in->crtc_id - 10), in);
	int code = fake_drm_check(drm, next);
	if (code == 0)
		code = fake_fault(drm, FAKE_SET_MODE);
	if (code == 0)
		code = set_crtc(drm, next, in->crtc_id - 10);
	if (code != 0)
		crtc->mode = before;
	return code;
}

static int check_async(const struct fake_drm *drm, uint32_t flags)
{
	if (!(flags & DRM_MODE_PAGE_FLIP_ASYNC))
		return 0;
	return drm->can.async_flip ? 0 : EINVAL;
}

static int page_flip(struct fake_drm *drm, const struct drm_mode_crtc_page_flip *in)
{
	struct fake_object next[FAKE_OBJECTS];
	struct fake_crtc *crtc = fake_crtc(drm, in->crtc_id);
	if (!drm->master)
		return EACCES;
	if (crtc == NULL)
		return ENOENT;
	memcpy(next, drm->objects, sizeof(next));
	struct fake_object *plane = fake_primary(next, in->crtc_id - 10);
	if (plane->values[FAKE_FB_ID] == 0 || crtc->pending)
		return EBUSY;
	plane->values[FAKE_FB_ID] = in->fb_id;
	int code = check_async(drm, in->flags);
	if (code == 0)
		code = fake_drm_check(drm, next);
	if (code == 0)
		code = fake_fault(drm, FAKE_FLIP);
	if (code != 0)
		return code;
	memcpy(drm->objects, next, sizeof(next));
	crtc->wants_event = in->flags & DRM_MODE_PAGE_FLIP_EVENT;
	crtc->user_data = in->user_data;
	drm->async_flips += (in->flags & DRM_MODE_PAGE_FLIP_ASYNC) != 0;
	fake_begin_flip(drm, in->crtc_id - 10, in->flags & DRM_MODE_PAGE_FLIP_ASYNC);
	return 0;
}

static int set_plane(struct fake_drm *drm, const struct drm_mode_set_plane *in)
{
	struct fake_object *plane = fake_object(drm->objects, in->plane_id);
	if (!drm->master)
		return EACCES;
	if (plane == NULL)
		return ENOENT;
	plane->values[FAKE_FB_ID] = in->fb_id;
	plane->values[FAKE_CRTC_ID] = in->fb_id != 0 ? in->crtc_id : 0;
	return 0;
}

static int set_property(struct fake_drm *drm, const struct drm_mode_obj_set_property *in)
{
	struct fake_object next[FAKE_OBJECTS];
	memcpy(next, drm->objects, sizeof(next));
	struct fake_object *object = fake_object(next, in->obj_id);
	if (!drm->master)
		return EACCES;
	if (object == NULL || in->prop_id != 100 + FAKE_ROTATION || !object->has[FAKE_ROTATION])
		return EINVAL;
	object->values[FAKE_ROTATION] = in->value;
	int code = fake_drm_check(drm, next);
	if (code == 0)
		memcpy(drm->objects, next, sizeof(next));
	return code;
}

static int set_client_cap(struct fake_drm *drm, const struct drm_set_client_cap *in)
{
	switch (in->capability) {
	case DRM_CLIENT_CAP_UNIVERSAL_PLANES:
		drm->client_universal = !drm->can.no_universal_planes && in->value;
		return drm->can.no_universal_planes ? EINVAL : 0;
	case DRM_CLIENT_CAP_ATOMIC:
		drm->client_atomic = !drm->can.no_atomic && in->value;
		return drm->can.no_atomic ? EOPNOTSUPP : 0;
	default:
		return EINVAL;
	}
}

static int get_cap(const struct fake_drm *drm, struct drm_get_cap *out)
{
	switch (out->capability) {
	case DRM_CAP_DUMB_BUFFER:
		out->value = !drm->can.no_dumb;
		return 0;
	case DRM_CAP_ADDFB2_MODIFIERS:
		out->value = drm->can.modifiers;
		return 0;
	case DRM_CAP_ASYNC_PAGE_FLIP:
		out->value = drm->can.async_flip || drm->can.async_claim;
		return 0;
	default:
		return EINVAL;
	}
}

static int set_master(struct fake_drm *drm)
{
	if (drm->other_master)
		return EBUSY;
	drm->master = true;
	return 0;
}

static int get_version(struct drm_version *out)
{
	static const char name[] = "fake";
	if (out->name_len >= 4)
		memcpy(out->name, name, 4);
	out->name_len = 4;
	out->date_len = out->desc_len = 0;
	return 0;
}

int fake_drm_call(struct fake_drm *drm, unsigned long request, void *argument)
{
	switch (request) {
	case DRM_IOCTL_VERSION:
		return get_version(argument);
	case DRM_IOCTL_AUTH_MAGIC:
		return drm->master ? EINVAL : EACCES;
	case DRM_IOCTL_SET_MASTER:
		return set_master(drm);
	case DRM_IOCTL_GET_CAP:
		return get_cap(drm, argument);
	case DRM_IOCTL_SET_CLIENT_CAP:
		return set_client_cap(drm, argument);
	case DRM_IOCTL_MODE_GETRESOURCES:
		return get_resources(drm, argument);
	case DRM_IOCTL_MODE_GETCONNECTOR:
		return get_connector(drm, argument);
	case DRM_IOCTL_MODE_GETENCODER:
		return get_encoder(drm, argument);
	case DRM_IOCTL_MODE_GETCRTC:
		return get_crtc(drm, argument);
	case DRM_IOCTL_MODE_GETPLANERESOURCES:
		return get_planes(drm, argument);
	case DRM_IOCTL_MODE_GETPLANE:
		return get_plane(drm, argument);
	case DRM_IOCTL_MODE_OBJ_GETPROPERTIES:
		return get_properties(drm, argument);
	case DRM_IOCTL_MODE_GETPROPERTY:
		return get_property(drm, argument);
	case DRM_IOCTL_MODE_GETPROPBLOB:
		return get_blob(drm, argument);
	case DRM_IOCTL_MODE_CREATEPROPBLOB:
		return create_blob(drm, argument);
	case DRM_IOCTL_MODE_DESTROYPROPBLOB:
		return destroy_blob(drm, argument);
	case DRM_IOCTL_MODE_CREATE_DUMB:
		return create_dumb(drm, argument);
	case DRM_IOCTL_MODE_MAP_DUMB:
		return map_dumb(drm, argument);
	case DRM_IOCTL_MODE_DESTROY_DUMB:
		return destroy_dumb(drm, argument);
	case DRM_IOCTL_MODE_ADDFB:
		return add_by_depth(drm, argument);
	case DRM_IOCTL_MODE_ADDFB2:
		return add_by_format(drm, argument);
	case DRM_IOCTL_MODE_RMFB:
		return remove_framebuffer(drm, argument);
	case DRM_IOCTL_MODE_SETCRTC:
		return legacy_set_crtc(drm, argument);
	case DRM_IOCTL_MODE_PAGE_FLIP:
		return page_flip(drm, argument);
	case DRM_IOCTL_MODE_SETPLANE:
		return set_plane(drm, argument);
	case DRM_IOCTL_MODE_OBJ_SETPROPERTY:
		return set_property(drm, argument);
	case DRM_IOCTL_MODE_ATOMIC:
		return fake_drm_atomic(drm, argument);
	default:
		return ENOTTY;
	}
}
