/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* memfd_create() */
#include "fake_drm.h"
#include <drm.h>
#include <drm_fourcc.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#define SECOND INT64_C(1000000000)

static struct fake_drm devices[2] = {
	{.fd = -1, .far_end = -1, .memory = -1}, {.fd = -1, .far_end = -1, .memory = -1}};

struct fake_drm *fake_drm_at(size_t index)
{
	return &devices[index];
}

drmModeModeInfo fake_mode(uint16_t width, uint16_t height, uint32_t hz)
{
	drmModeModeInfo mode = {
		.hdisplay = width,
		.htotal = (uint16_t)(width + 36),
		.vdisplay = height,
		.vtotal = (uint16_t)(height + 2),
		.vrefresh = hz,
	};
	/* In kHz; 100x50 pixels at a whole rate come out even. */
	mode.clock = (uint32_t)mode.htotal * mode.vtotal * hz / 1000;
	snprintf(mode.name, sizeof(mode.name), "%ux%u", width, height);
	return mode;
}

static void give(struct fake_object *object, enum fake_property property, bool has, uint64_t value)
{
	object->has[property] = has;
	object->values[property] = value;
}

static void make_connector(struct fake_drm *drm, struct fake_object *object, size_t index)
{
	*object = (struct fake_object){20 + (uint32_t)index, DRM_MODE_OBJECT_CONNECTOR};
	give(object, FAKE_CRTC_ID, true, 0);
	give(object, FAKE_LINK_STATUS, true, 0);
	give(object, FAKE_NON_DESKTOP, true, 0);
	drm->connectors[index] = (struct fake_connector){
		.type = index == 0 ? DRM_MODE_CONNECTOR_HDMIA : DRM_MODE_CONNECTOR_DisplayPort,
		.type_id = 1,
		.plugged = index == 0,
		.modes = {fake_mode(64, 48, 60), fake_mode(32, 24, 60), fake_mode(32, 24, 75)},
		.mode_count = 3,
		.possible_crtcs = 3,
	};
	drm->connectors[index].modes[0].type = DRM_MODE_TYPE_PREFERRED;
}

static void make_crtc(const struct fake_drm *drm, struct fake_object *object, size_t index)
{
	*object = (struct fake_object){10 + (uint32_t)index, DRM_MODE_OBJECT_CRTC};
	give(object, FAKE_ACTIVE, true, 0);
	give(object, FAKE_MODE_ID, true, 0);
	give(object, FAKE_OUT_FENCE_PTR, drm->can.fences, 0);
}

static void make_plane(const struct fake_drm *drm, struct fake_object *object, size_t index)
{
	*object = (struct fake_object){40 + (uint32_t)index, DRM_MODE_OBJECT_PLANE};
	give(object, FAKE_TYPE, true, index < FAKE_CRTCS ? FAKE_PRIMARY : FAKE_OVERLAY);
	for (int i = FAKE_FB_ID; i <= FAKE_CRTC_H; i++)
		give(object, (enum fake_property)i, true, 0);
	give(object, FAKE_CRTC_ID, true, 0);
	give(object, FAKE_IN_FORMATS, drm->can.modifiers, 1);
	give(object, FAKE_ROTATION, drm->can.rotations != 0, DRM_MODE_ROTATE_0);
	give(object, FAKE_IN_FENCE_FD, drm->can.fences, UINT64_MAX);
	give(object, FAKE_FB_DAMAGE_CLIPS, drm->can.damage, 0);
}

struct fake_drm *fake_drm_init(size_t index, const struct fake_abilities *can)
{
	struct fake_drm *drm = &devices[index];
	*drm = (struct fake_drm){
		.path = index == 0 ? "/dev/dri/card0" : "/dev/dri/card1",
		.can = *can,
		.fd = -1,
		.far_end = -1,
		.last_id = FAKE_CONSOLE,
	};
	if (drm->can.formats[0] == 0)
		memcpy(drm->can.formats,
			(uint32_t[]){
				DRM_FORMAT_RGB565, DRM_FORMAT_XRGB2101010, DRM_FORMAT_XRGB8888},
			3 * sizeof(uint32_t));
	struct fake_object *object = drm->objects;
	for (size_t i = 0; i < FAKE_CONNECTORS; i++)
		make_connector(drm, object++, i);
	for (size_t i = 0; i < FAKE_CRTCS; i++)
		make_crtc(drm, object++, i);
	for (size_t i = 0; i < FAKE_PLANES; i++)
		make_plane(drm, object++, i);
	drm->memory = memfd_create("fake-drm", MFD_CLOEXEC);
	if (drm->memory < 0 || ftruncate(drm->memory, FAKE_BUFFERS * FAKE_DUMB_ROOM) != 0)
		abort();
	drm->pixels = mmap(NULL, FAKE_BUFFERS * FAKE_DUMB_ROOM, PROT_READ | PROT_WRITE, MAP_SHARED,
		drm->memory, 0);
	if (drm->pixels == MAP_FAILED)
		abort();
	return drm;
}

void fake_drm_finish(void)
{
	for (size_t i = 0; i < 2; i++) {
		struct fake_drm *drm = &devices[i];
		for (size_t crtc = 0; crtc < FAKE_CRTCS; crtc++)
			free(drm->crtcs[crtc].screen);
		if (drm->pixels != NULL)
			munmap(drm->pixels, FAKE_BUFFERS * FAKE_DUMB_ROOM);
		if (drm->path != NULL)
			close(drm->memory);
		*drm = (struct fake_drm){.fd = -1, .far_end = -1, .memory = -1};
	}
}

void fake_drm_light_console(struct fake_drm *drm)
{
	const struct fake_connector *connector = &drm->connectors[0];
	const drmModeModeInfo *mode = &connector->modes[connector->mode_count - 1];
	struct fake_object *primary = fake_primary(drm->objects, 0);
	drm->dumbs[0] = (struct fake_dumb){.used = true,
		.width = mode->hdisplay,
		.height = mode->vdisplay,
		.pitch = 4u * mode->hdisplay,
		.size = 4u * mode->hdisplay * mode->vdisplay};
	drm->framebuffers[0] = (struct fake_framebuffer){FAKE_CONSOLE, mode->hdisplay,
		mode->vdisplay, DRM_FORMAT_XRGB8888, 4u * mode->hdisplay, 0, 0};
	memset(drm->pixels, 0xc0, drm->dumbs[0].size);
	drm->objects[0].values[FAKE_CRTC_ID] = 10;
	fake_object(drm->objects, 10)->values[FAKE_ACTIVE] = 1;
	fake_object(drm->objects, 10)->values[FAKE_MODE_ID] = 1;
	primary->values[FAKE_FB_ID] = FAKE_CONSOLE;
	primary->values[FAKE_CRTC_ID] = 10;
	primary->values[FAKE_CRTC_W] = mode->hdisplay;
	primary->values[FAKE_CRTC_H] = mode->vdisplay;
	primary->values[FAKE_SRC_W] = (uint64_t)mode->hdisplay << 16;
	primary->values[FAKE_SRC_H] = (uint64_t)mode->vdisplay << 16;
	primary->values[FAKE_ROTATION] = DRM_MODE_ROTATE_0;
	drm->crtcs[0].mode = *mode;
	fake_begin_flip(drm, 0, true);
	fake_complete(drm, 0);
}

void fake_drm_steal(struct fake_drm *drm)
{
	drm->master = false;
	drm->other_master = true;
}

void fake_drm_give_back(struct fake_drm *drm)
{
	drm->other_master = false;
}

unsigned fake_drm_count(const struct fake_drm *drm)
{
	unsigned count = fake_world.mappings;
	for (size_t i = 0; i < FAKE_BUFFERS; i++) {
		count += drm->dumbs[i].open;
		count += drm->framebuffers[i].id > FAKE_CONSOLE;
	}
	for (size_t i = 0; i < FAKE_BLOBS; i++)
		count += drm->blobs[i].id != 0;
	return count;
}

int fake_drm_open(const char *path)
{
	int ends[2];
	for (size_t i = 0; i < 2; i++) {
		struct fake_drm *drm = &devices[i];
		if (drm->path == NULL || strcmp(drm->path, path) != 0 || drm->gone)
			continue;
		if (drm->fd >= 0 ||
			socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
			abort();
		drm->fd = ends[0];
		drm->far_end = ends[1];
		drm->master = !drm->other_master;
		drm->client_universal = drm->client_atomic = false;
		return drm->fd;
	}
	errno = ENOENT;
	return -1;
}

void fake_drm_close(int fd)
{
	for (size_t i = 0; i < 2; i++) {
		struct fake_drm *drm = &devices[i];
		if (drm->fd != fd)
			continue;
		drm->left += fake_drm_count(drm);
		close(drm->fd);
		close(drm->far_end);
		drm->fd = drm->far_end = -1;
		drm->master = false;
	}
}

struct fake_object *fake_object(struct fake_object *objects, uint32_t id)
{
	for (size_t i = 0; i < FAKE_OBJECTS; i++)
		if (objects[i].id == id)
			return &objects[i];
	return NULL;
}

struct fake_object *fake_primary(struct fake_object *objects, size_t crtc)
{
	return &objects[FAKE_CONNECTORS + FAKE_CRTCS + crtc];
}

struct fake_crtc *fake_crtc(struct fake_drm *drm, uint32_t id)
{
	return id >= 10 && id < 10 + FAKE_CRTCS ? &drm->crtcs[id - 10] : NULL;
}

struct fake_framebuffer *fake_framebuffer(struct fake_drm *drm, uint32_t id)
{
	for (size_t i = 0; i < FAKE_BUFFERS; i++)
		if (id != 0 && drm->framebuffers[i].id == id)
			return &drm->framebuffers[i];
	return NULL;
}

struct fake_blob *fake_blob(struct fake_drm *drm, uint32_t id)
{
	for (size_t i = 0; i < FAKE_BLOBS; i++)
		if (id != 0 && drm->blobs[i].id == id)
			return &drm->blobs[i];
	return NULL;
}

int fake_fault(struct fake_drm *drm, enum fake_step step)
{
	struct fake_fault *fault = &drm->faults[step];
	if (fault->code != 0 && fault->after > 0) {
		fault->after--;
	} else if (fault->code != 0) {
		int code = fault->code;
		if (fault->times > 0 && --fault->times == 0)
			fault->code = 0;
		return code;
	}
	drm->steps[step]++;
	return 0;
}

/* The vertical blanks of a CRTC are counted from the clock's 0. */
static int64_t period_of(const struct fake_crtc *crtc)
{
	return crtc->mode.clock > 0
		       ? INT64_C(1000000) * crtc->mode.htotal * crtc->mode.vtotal / crtc->mode.clock
		       : SECOND / 60;
}

void fake_begin_flip(struct fake_drm *drm, size_t index, bool at_once)
{
	struct fake_crtc *crtc = &drm->crtcs[index];
	int64_t period = period_of(crtc);
	crtc->pending = true;
	crtc->due = at_once || drm->can.no_blanks ? fake_world.now
						  : (fake_world.now / period + 1) * period;
}

static void send_event(struct fake_drm *drm, size_t index)
{
	struct fake_crtc *crtc = &drm->crtcs[index];
	struct drm_event_vblank event = {
		.base = {DRM_EVENT_FLIP_COMPLETE, sizeof(event)},
		.user_data = crtc->user_data,
		.tv_sec = (uint32_t)(fake_world.now / SECOND),
		.tv_usec = (uint32_t)(fake_world.now % SECOND / 1000),
		.sequence = drm->can.no_blanks ? 0 : (uint32_t)(fake_world.now / period_of(crtc)),
		.crtc_id = 10 + (uint32_t)index,
	};
	crtc->wants_event = false;
	if (drm->far_end >= 0 && send(drm->far_end, &event, sizeof(event), MSG_DONTWAIT) < 0)
		abort();
}

static void clear_screen(struct fake_crtc *crtc)
{
	free(crtc->screen);
	crtc->screen = NULL;
	crtc->shown = crtc->width = crtc->height = 0;
}

/* The monitor is sent what the clip tells of. */
static void send_pixels(struct fake_drm *drm, struct fake_crtc *crtc, uint32_t framebuffer)
{
	const struct fake_framebuffer *from = fake_framebuffer(drm, framebuffer);
	uint32_t bytes = from->format == DRM_FORMAT_RGB565 ? 2 : 4;
	struct drm_mode_rect clip = {0, 0, (int32_t)from->width, (int32_t)from->height};
	if (crtc->screen == NULL || crtc->width != from->width || crtc->height != from->height ||
		crtc->row_size != bytes * from->width) {
		clear_screen(crtc);
		crtc->width = from->width;
		crtc->height = from->height;
		crtc->row_size = bytes * from->width;
		crtc->screen = malloc((size_t)crtc->row_size * crtc->height);
		if (crtc->screen == NULL)
			abort();
	} else if (crtc->has_clip) {
		clip = crtc->clip;
	}
	const uint8_t *pixels = drm->pixels + (size_t)from->dumb * FAKE_DUMB_ROOM;
	for (int32_t y = clip.y1; y < clip.y2; y++)
		memcpy(crtc->screen + (uint32_t)y * crtc->row_size + bytes * (uint32_t)clip.x1,
			pixels + (uint32_t)y * from->pitch + bytes * (uint32_t)clip.x1,
			bytes * (uint32_t)(clip.x2 - clip.x1));
	crtc->shown = framebuffer;
}

void fake_complete(struct fake_drm *drm, size_t index)
{
	struct fake_crtc *crtc = &drm->crtcs[index];
	uint32_t framebuffer = (uint32_t)fake_primary(drm->objects, index)->values[FAKE_FB_ID];
	if (!crtc->pending)
		return;
	crtc->pending = false;
	if (framebuffer == 0)
		clear_screen(crtc);
	else
		send_pixels(drm, crtc, framebuffer);
	crtc->has_clip = false;
	if (crtc->wants_event && !drm->withholds_events)
		send_event(drm, index);
}

void fake_drm_run(int64_t now)
{
	for (size_t i = 0; i < 2; i++)
		for (size_t crtc = 0; crtc < FAKE_CRTCS; crtc++)
			if (devices[i].crtcs[crtc].pending && devices[i].crtcs[crtc].due <= now)
				fake_complete(&devices[i], crtc);
}

int64_t fake_drm_next(void)
{
	int64_t next = INT64_MAX;
	for (size_t i = 0; i < 2; i++)
		for (size_t crtc = 0; crtc < FAKE_CRTCS; crtc++)
			if (devices[i].crtcs[crtc].pending && devices[i].crtcs[crtc].due < next)
				next = devices[i].crtcs[crtc].due;
	return next;
}

/* In the place of the C library's, for libdrm too. */
__attribute__((visibility("default"))) int ioctl(int fd, unsigned long request, ...)
{
	va_list arguments;
	va_start(arguments, request);
	void *argument = va_arg(arguments, void *);
	va_end(arguments);
	for (size_t i = 0; fd >= 0 && i < 2; i++) {
		if (devices[i].fd != fd)
			continue;
		devices[i].calls++;
		int code = devices[i].gone ? ENODEV : fake_drm_call(&devices[i], request, argument);
		if (code == 0)
			return 0;
		errno = code;
		return -1;
	}
	return (int)syscall(SYS_ioctl, fd, request, argument);
}
