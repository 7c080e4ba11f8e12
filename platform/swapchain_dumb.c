/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "base/error.h"
#include "swapchain.h"
#include <drm_fourcc.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

enum { BUFFER_COUNT = 2 };

struct buffer {
	uint32_t handle, pitch, framebuffer;
	uint64_t size;
	uint8_t *pixels; /* mapped; NULL: not yet */
	uint64_t frame;  /* that it holds, counted from 1; 0: none */
	bool busy;       /* shown, or about to be */
};

struct dumb_swapchain {
	struct swapchain base;
	struct buffer buffers[BUFFER_COUNT];
	struct buffer *drawing; /* between begin and end */
	/* Buffers may lie in memory that is slow to read: the last frame is kept for comparison. */
	uint8_t *last, *row;  /* [height][row_size], [row_size] */
	uint64_t *row_frames; /* [height]: the frame since which a row is as it is */
	size_t row_size;
	uint64_t frame;
	struct rect damage;
	bool last_shown; /* what differs from it differs from the screen */
};

static bool fail(struct sm_error *error, const char *what)
{
	return error_set(error, SM_ERROR_MACHINE, "%s fails (%s)", what, strerror(errno));
}

static bool map(const struct kms_device *device, struct buffer *buffer, struct sm_error *error)
{
	uint64_t offset;
	if (drmModeMapDumbBuffer(device->fd, buffer->handle, &offset) != 0)
		return fail(error, "mapping a dumb buffer");
	void *pixels = mmap(
		NULL, buffer->size, PROT_READ | PROT_WRITE, MAP_SHARED, device->fd, (off_t)offset);
	if (pixels == MAP_FAILED)
		return fail(error, "mapping a dumb buffer");
	buffer->pixels = pixels;
	return true;
}

static bool buffer_init(struct buffer *buffer, const struct swapchain *base, struct sm_error *error)
{
	const struct pixel_format *format = base->format;
	if (drmModeCreateDumbBuffer(base->device->fd, base->width, base->height, 8u * format->bytes,
		    0, &buffer->handle, &buffer->pitch, &buffer->size) != 0)
		return fail(error, "making a dumb buffer");
	struct kms_layout layout = {
		.width = base->width,
		.height = base->height,
		.format = format->code,
		.modifier = DRM_FORMAT_MOD_INVALID,
		.handles = {buffer->handle},
		.strides = {buffer->pitch},
	};
	buffer->framebuffer = kms_add_framebuffer(base->device, &layout);
	if (buffer->framebuffer == 0)
		return fail(error, "making a framebuffer of a dumb buffer");
	return map(base->device, buffer, error);
}

static void buffer_finish(struct buffer *buffer, const struct kms_device *device)
{
	kms_remove_framebuffer(device, buffer->framebuffer);
	if (buffer->pixels != NULL)
		munmap(buffer->pixels, buffer->size);
	if (buffer->handle != 0)
		drmModeDestroyDumbBuffer(device->fd, buffer->handle);
}

static void destroy(struct swapchain *base)
{
	struct dumb_swapchain *swapchain = (struct dumb_swapchain *)base;
	for (int i = 0; i < BUFFER_COUNT; i++)
		buffer_finish(&swapchain->buffers[i], base->device);
	free(swapchain->last);
	free(swapchain->row);
	free(swapchain->row_frames);
	free(swapchain);
}

static bool begin(struct swapchain *base, struct sm_error *error)
{
	struct dumb_swapchain *swapchain = (struct dumb_swapchain *)base;
	swapchain->drawing = NULL;
	for (int i = 0; i < BUFFER_COUNT; i++)
		if (!swapchain->buffers[i].busy)
			swapchain->drawing = &swapchain->buffers[i];
	return swapchain->drawing != NULL ||
	       error_set(error, SM_ERROR_MACHINE, "all buffers are being shown");
}

/* Grows the damage around the bytes in which the new row differs from the last frame's. */
static void note_change(struct dumb_swapchain *swapchain, uint32_t y, const uint8_t *last)
{
	size_t bytes = swapchain->base.format->bytes;
	size_t first = 0, end = swapchain->row_size;
	while (swapchain->row[first] == last[first])
		first++;
	while (swapchain->row[end - 1] == last[end - 1])
		end--;
	uint32_t left = (uint32_t)(first / bytes), right = (uint32_t)((end + bytes - 1) / bytes);
	struct rect *damage = &swapchain->damage;
	if (damage->width == 0) {
		*damage = (struct rect){left, y, right - left, 1};
		return;
	}
	uint32_t damage_right = damage->x + damage->width;
	damage->x = left < damage->x ? left : damage->x;
	damage->width = (right > damage_right ? right : damage_right) - damage->x;
	damage->height = y + 1 - damage->y;
}

static void write_row(struct dumb_swapchain *swapchain, uint32_t y, const uint8_t *rgba)
{
	struct buffer *buffer = swapchain->drawing;
	uint8_t *last = swapchain->last + y * swapchain->row_size;
	pixel_format_pack(swapchain->base.format, rgba, swapchain->base.width, swapchain->row);
	if (swapchain->frame == 1 || memcmp(swapchain->row, last, swapchain->row_size) != 0) {
		if (swapchain->frame > 1)
			note_change(swapchain, y, last);
		memcpy(last, swapchain->row, swapchain->row_size);
		swapchain->row_frames[y] = swapchain->frame;
	}
	if (swapchain->row_frames[y] > buffer->frame)
		memcpy(buffer->pixels + (size_t)y * buffer->pitch, last, swapchain->row_size);
}

static bool end(struct swapchain *base, const uint8_t *rgba, struct kms_frame *frame,
	struct sm_error *error)
{
	(void)error;
	struct dumb_swapchain *swapchain = (struct dumb_swapchain *)base;
	struct buffer *buffer = swapchain->drawing;
	swapchain->frame++;
	swapchain->damage = (struct rect){0};
	for (uint32_t y = 0; y < base->height; y++)
		write_row(swapchain, y, rgba + (size_t)(base->height - 1 - y) * base->width * 4);
	buffer->frame = swapchain->frame;
	buffer->busy = true;
	frame->framebuffer = buffer->framebuffer;
	/* A clip without area could be taken for all: the smallest says "next to nothing". */
	if (swapchain->damage.width == 0)
		swapchain->damage = (struct rect){0, 0, 1, 1};
	frame->damage = swapchain->last_shown ? &swapchain->damage : NULL;
	swapchain->last_shown = true;
	return true;
}

static void release(struct swapchain *base, uint32_t framebuffer)
{
	struct dumb_swapchain *swapchain = (struct dumb_swapchain *)base;
	for (int i = 0; i < BUFFER_COUNT; i++) {
		struct buffer *buffer = &swapchain->buffers[i];
		if (buffer->framebuffer != framebuffer)
			continue;
		buffer->busy = false;
		/* The screen has the frame before, whose differences are no longer known. */
		if (buffer->frame == swapchain->frame)
			swapchain->last_shown = false;
	}
}

static const struct swapchain_interface dumb_interface = {
	.takes_pixels = true,
	.begin = begin,
	.end = end,
	.release = release,
	.destroy = destroy,
};

struct swapchain *swapchain_create_dumb(const struct kms_device *device,
	const struct pixel_format *format, uint32_t width, uint32_t height, struct sm_error *error)
{
	struct dumb_swapchain *swapchain = array_zalloc(1, sizeof(*swapchain));
	if (swapchain == NULL) {
		error_no_memory(error);
		return NULL;
	}
	swapchain->base = (struct swapchain){&dumb_interface, device, format, width, height};
	swapchain->row_size = (size_t)width * format->bytes;
	swapchain->row = array_alloc(width, format->bytes);
	swapchain->last = array_alloc(height, swapchain->row_size);
	swapchain->row_frames = array_zalloc(height, sizeof(*swapchain->row_frames));
	bool made =
		swapchain->row != NULL && swapchain->last != NULL && swapchain->row_frames != NULL;
	if (!made)
		error_no_memory(error);
	for (int i = 0; made && i < BUFFER_COUNT; i++)
		made = buffer_init(&swapchain->buffers[i], &swapchain->base, error);
	if (made)
		return &swapchain->base;
	destroy(&swapchain->base);
	return NULL;
}
