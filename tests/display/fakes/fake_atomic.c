/* SPDX-License-Identifier: MIT */
/* What the kernel checks before it sets anything, and atomic commits. */
#include "fake_drm.h"
#include <drm.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/eventfd.h>

static bool shows_format(const struct fake_drm *drm, uint32_t format)
{
	for (size_t i = 0; i < 4; i++)
		if (drm->can.formats[i] == format)
			return true;
	return false;
}

static int check_rotation(const struct fake_drm *drm, uint64_t rotation)
{
	uint64_t turns = rotation & DRM_MODE_ROTATE_MASK;
	if (turns == 0 || (turns & (turns - 1)) != 0 || (rotation & ~drm->can.rotations) != 0)
		return EINVAL;
	return drm->can.refuses_rotations && rotation != DRM_MODE_ROTATE_0 ? EINVAL : 0;
}

/* Fixed point, and no scaling. */
static int check_size(const struct fake_framebuffer *framebuffer, const uint64_t *values,
	const drmModeModeInfo *mode)
{
	uint64_t width = values[FAKE_SRC_W] >> 16, height = values[FAKE_SRC_H] >> 16;
	if ((values[FAKE_SRC_X] >> 16) + width > framebuffer->width ||
		(values[FAKE_SRC_Y] >> 16) + height > framebuffer->height)
		return ENOSPC;
	bool turned = values[FAKE_ROTATION] & (DRM_MODE_ROTATE_90 | DRM_MODE_ROTATE_270);
	if (values[FAKE_CRTC_W] != (turned ? height : width) ||
		values[FAKE_CRTC_H] != (turned ? width : height))
		return ERANGE;
	return values[FAKE_CRTC_W] == mode->hdisplay && values[FAKE_CRTC_H] == mode->vdisplay
		       ? 0
		       : EINVAL;
}

static int check_plane(
	struct fake_drm *drm, const struct fake_object *objects, const struct fake_object *plane)
{
	const uint64_t *values = plane->values;
	if ((values[FAKE_FB_ID] != 0) != (values[FAKE_CRTC_ID] != 0))
		return EINVAL;
	if (values[FAKE_FB_ID] == 0)
		return 0;
	const struct fake_framebuffer *framebuffer =
		fake_framebuffer(drm, (uint32_t)values[FAKE_FB_ID]);
	const struct fake_crtc *crtc = fake_crtc(drm, (uint32_t)values[FAKE_CRTC_ID]);
	if (framebuffer == NULL || crtc == NULL || !shows_format(drm, framebuffer->format))
		return EINVAL;
	if (objects[FAKE_CONNECTORS + (crtc - drm->crtcs)].values[FAKE_ACTIVE] == 0)
		return EINVAL;
	if (plane->has[FAKE_ROTATION] && check_rotation(drm, values[FAKE_ROTATION]) != 0)
		return EINVAL;
	return values[FAKE_TYPE] == FAKE_PRIMARY ? check_size(framebuffer, values, &crtc->mode) : 0;
}

int fake_drm_check(struct fake_drm *drm, const struct fake_object *objects)
{
	for (size_t i = 0; i < FAKE_CRTCS; i++) {
		const struct fake_object *crtc = &objects[FAKE_CONNECTORS + i];
		size_t lit = 0;
		for (size_t j = 0; j < FAKE_CONNECTORS; j++)
			lit += objects[j].values[FAKE_CRTC_ID] == crtc->id;
		if (lit > 1) /* as most drivers */
			return EINVAL;
		bool enabled = crtc->values[FAKE_MODE_ID] != 0;
		if (enabled != (lit > 0) || (crtc->values[FAKE_ACTIVE] != 0 && !enabled))
			return EINVAL;
	}
	for (size_t i = FAKE_CONNECTORS + FAKE_CRTCS; i < FAKE_OBJECTS; i++) {
		int code = check_plane(drm, objects, &objects[i]);
		if (code != 0)
			return code;
	}
	return 0;
}

static int set_property(
	struct fake_drm *drm, struct fake_object *object, uint32_t property, uint64_t value)
{
	uint32_t index = property - 100;
	if (property < 100 || index >= FAKE_PROPERTIES || !object->has[index])
		return ENOENT;
	if (index == FAKE_TYPE || index == FAKE_IN_FORMATS || index == FAKE_NON_DESKTOP)
		return EINVAL;
	if (index == FAKE_IN_FENCE_FD && fcntl((int)value, F_GETFD) < 0)
		return EINVAL;
	if (index == FAKE_MODE_ID && value != 0) {
		const struct fake_blob *blob = fake_blob(drm, (uint32_t)value);
		if (blob == NULL || blob->size != sizeof(struct drm_mode_modeinfo))
			return EINVAL;
	}
	if (index == FAKE_FB_DAMAGE_CLIPS && value != 0) {
		const struct fake_blob *blob = fake_blob(drm, (uint32_t)value);
		if (blob == NULL || blob->size != sizeof(struct drm_mode_rect))
			return EINVAL;
	}
	object->values[index] = value;
	return 0;
}

static int apply(
	struct fake_drm *drm, struct fake_object *next, const struct drm_mode_atomic *atomic)
{
	const uint32_t *ids = (const uint32_t *)(uintptr_t)atomic->objs_ptr;
	const uint32_t *counts = (const uint32_t *)(uintptr_t)atomic->count_props_ptr;
	const uint32_t *properties = (const uint32_t *)(uintptr_t)atomic->props_ptr;
	const uint64_t *values = (const uint64_t *)(uintptr_t)atomic->prop_values_ptr;
	for (uint32_t i = 0; i < atomic->count_objs; i++) {
		struct fake_object *object = fake_object(next, ids[i]);
		if (object == NULL)
			return ENOENT;
		for (uint32_t j = 0; j < counts[i]; j++) {
			int code = set_property(drm, object, *properties++, *values++);
			if (code != 0)
				return code;
		}
	}
	return 0;
}

/* Whether CRTCs or connectors change. */
static bool sets_mode(const struct fake_drm *drm, const struct fake_object *next)
{
	for (size_t i = 0; i < FAKE_CONNECTORS + FAKE_CRTCS; i++) {
		const uint64_t *now = drm->objects[i].values, *then = next[i].values;
		if (now[FAKE_CRTC_ID] != then[FAKE_CRTC_ID] ||
			now[FAKE_LINK_STATUS] != then[FAKE_LINK_STATUS] ||
			now[FAKE_ACTIVE] != then[FAKE_ACTIVE] ||
			now[FAKE_MODE_ID] != then[FAKE_MODE_ID])
			return true;
	}
	return false;
}

static void take_modes(struct fake_drm *drm, const struct fake_object *next)
{
	for (size_t i = 0; i < FAKE_CRTCS; i++) {
		const struct fake_blob *blob =
			fake_blob(drm, (uint32_t)next[FAKE_CONNECTORS + i].values[FAKE_MODE_ID]);
		if (blob != NULL)
			memcpy(&drm->crtcs[i].mode, blob->data, blob->size);
	}
}

/* Which CRTC a request is about: ours sets one at a time. */
static size_t crtc_of(const struct fake_object *now, const struct fake_object *next)
{
	for (size_t i = 0; i < FAKE_CRTCS; i++)
		if (memcmp(&now[FAKE_CONNECTORS + i], &next[FAKE_CONNECTORS + i], sizeof(*now)) !=
				0 ||
			memcmp(&now[FAKE_CONNECTORS + FAKE_CRTCS + i],
				&next[FAKE_CONNECTORS + FAKE_CRTCS + i], sizeof(*now)) != 0)
			return i;
	return 0;
}

/* Fences and clips hold for one commit. */
static void use_once(struct fake_drm *drm, struct fake_object *next, size_t crtc)
{
	struct fake_object *plane = fake_primary(next, crtc), *pipe = &next[FAKE_CONNECTORS + crtc];
	const struct fake_blob *clip =
		fake_blob(drm, (uint32_t)plane->values[FAKE_FB_DAMAGE_CLIPS]);
	drm->crtcs[crtc].has_clip = clip != NULL;
	if (clip != NULL)
		memcpy(&drm->crtcs[crtc].clip, clip->data, clip->size);
	drm->last_had_in_fence = (int)plane->values[FAKE_IN_FENCE_FD] >= 0;
	if (pipe->values[FAKE_OUT_FENCE_PTR] != 0)
		*(int32_t *)(uintptr_t)pipe->values[FAKE_OUT_FENCE_PTR] = eventfd(1, EFD_CLOEXEC);
	pipe->values[FAKE_OUT_FENCE_PTR] = plane->values[FAKE_FB_DAMAGE_CLIPS] = 0;
	plane->values[FAKE_IN_FENCE_FD] = UINT64_MAX;
}

static int check_commit(struct fake_drm *drm, const struct fake_object *next,
	const struct drm_mode_atomic *atomic, size_t crtc)
{
	bool lit = next[FAKE_CONNECTORS + crtc].values[FAKE_ACTIVE] != 0;
	if (sets_mode(drm, next) && !(atomic->flags & DRM_MODE_ATOMIC_ALLOW_MODESET))
		return EINVAL;
	if (!lit && atomic->flags & DRM_MODE_PAGE_FLIP_EVENT)
		return EINVAL;
	if (drm->crtcs[crtc].pending && atomic->flags & DRM_MODE_ATOMIC_NONBLOCK)
		return EBUSY;
	enum fake_step step = !(atomic->flags & DRM_MODE_ATOMIC_ALLOW_MODESET) ? FAKE_FLIP
			      : lit                                            ? FAKE_SET_MODE
									       : FAKE_SWITCH_OFF;
	return fake_fault(drm, step);
}

int fake_drm_atomic(struct fake_drm *drm, struct drm_mode_atomic *atomic)
{
	struct fake_object next[FAKE_OBJECTS];
	drmModeModeInfo modes[FAKE_CRTCS];
	if (!drm->client_atomic)
		return EOPNOTSUPP;
	if (!drm->master)
		return EACCES;
	memcpy(next, drm->objects, sizeof(next));
	for (size_t i = 0; i < FAKE_CRTCS; i++)
		modes[i] = drm->crtcs[i].mode;
	int code = apply(drm, next, atomic);
	if (code != 0)
		return code;
	size_t crtc = crtc_of(drm->objects, next);
	take_modes(drm, next);
	code = fake_drm_check(drm, next);
	if (code == 0)
		code = check_commit(drm, next, atomic, crtc);
	if (code != 0) {
		for (size_t i = 0; i < FAKE_CRTCS; i++)
			drm->crtcs[i].mode = modes[i];
		return code;
	}
	fake_complete(drm, crtc);
	use_once(drm, next, crtc);
	memcpy(drm->objects, next, sizeof(next));
	bool waits = !(atomic->flags & DRM_MODE_ATOMIC_NONBLOCK);
	drm->crtcs[crtc].wants_event = atomic->flags & DRM_MODE_PAGE_FLIP_EVENT;
	drm->crtcs[crtc].user_data = atomic->user_data;
	fake_begin_flip(drm, crtc, waits);
	if (waits)
		fake_complete(drm, crtc);
	return 0;
}
