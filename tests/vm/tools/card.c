/* SPDX-License-Identifier: MIT */
#include "card.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <xf86drm.h>

/* A dumb buffer that is mapped; 32 bits a pixel. */
struct buffer {
	uint32_t fb, pitch;
	uint32_t *pixels;
};

void demand(int condition, const char *what)
{
	if (condition)
		return;
	fprintf(stderr, "%s: %s\n", what, strerror(errno));
	exit(1);
}

int card_open(const char *path)
{
	int card = open(path, O_RDWR | O_CLOEXEC);
	demand(card >= 0, path);
	return card;
}

static uint32_t first_crtc(int card, const drmModeRes *resources, const drmModeConnector *connector)
{
	uint32_t possible = 0;
	for (int i = 0; i < connector->count_encoders; i++) {
		drmModeEncoder *encoder = drmModeGetEncoder(card, connector->encoders[i]);
		possible |= encoder ? encoder->possible_crtcs : 0;
		drmModeFreeEncoder(encoder);
	}
	for (int i = 0; i < resources->count_crtcs; i++)
		if (possible & 1U << i)
			return resources->crtcs[i];
	return 0;
}

static const drmModeModeInfo *find_mode(const drmModeConnector *connector, const char *size)
{
	for (int i = 0; i < connector->count_modes; i++) {
		const drmModeModeInfo *mode = &connector->modes[i];
		char name[32];
		snprintf(name, sizeof(name), "%ux%u", mode->hdisplay, mode->vdisplay);
		if (*size ? !strcmp(name, size) : (mode->type & DRM_MODE_TYPE_PREFERRED) != 0)
			return mode;
	}
	return NULL;
}

static struct output find_output(int card, const char *size)
{
	struct output output = {0};
	drmModeRes *resources = drmModeGetResources(card);
	demand(resources != NULL, "drmModeGetResources");
	for (int i = 0; i < resources->count_connectors && !output.connector; i++) {
		drmModeConnector *connector = drmModeGetConnector(card, resources->connectors[i]);
		const drmModeModeInfo *mode = NULL;
		if (connector && connector->connection == DRM_MODE_CONNECTED)
			mode = find_mode(connector, size);
		if (mode)
			output = (struct output){connector->connector_id,
				first_crtc(card, resources, connector), *mode};
		drmModeFreeConnector(connector);
	}
	drmModeFreeResources(resources);
	demand(output.crtc != 0, "no monitor with that mode");
	return output;
}

static struct buffer buffer_create(int card, uint32_t width, uint32_t height)
{
	struct buffer buffer = {0};
	uint32_t handle;
	uint64_t size, offset;
	demand(!drmModeCreateDumbBuffer(card, width, height, 32, 0, &handle, &buffer.pitch, &size),
		"drmModeCreateDumbBuffer");
	demand(!drmModeAddFB(card, width, height, 24, 32, buffer.pitch, handle, &buffer.fb),
		"drmModeAddFB");
	demand(!drmModeMapDumbBuffer(card, handle, &offset), "drmModeMapDumbBuffer");
	buffer.pixels = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, card, (off_t)offset);
	demand(buffer.pixels != MAP_FAILED, "mmap");
	return buffer;
}

uint32_t pattern_color(uint32_t x, uint32_t y)
{
	uint32_t red = x & 255, green = y & 255, blue = (x >> 8) * 16 + (y >> 8) + (x & y & 15) * 8;
	return red << 16 | green << 8 | (blue & 255);
}

static void draw_pattern(const struct buffer *buffer, uint32_t width, uint32_t height)
{
	for (uint32_t y = 0; y < height; y++)
		for (uint32_t x = 0; x < width; x++)
			buffer->pixels[y * (buffer->pitch / 4) + x] = pattern_color(x, y);
}

struct output show_pattern(int card, const char *size)
{
	struct output output = find_output(card, size);
	struct buffer buffer = buffer_create(card, output.mode.hdisplay, output.mode.vdisplay);
	draw_pattern(&buffer, output.mode.hdisplay, output.mode.vdisplay);
	demand(!drmModeSetCrtc(
		       card, output.crtc, buffer.fb, 0, 0, &output.connector, 1, &output.mode),
		"drmModeSetCrtc");
	return output;
}

void sleep_until_told(const char *ready)
{
	sigset_t set;
	int signal;
	sigemptyset(&set);
	sigaddset(&set, SIGTERM);
	sigprocmask(SIG_BLOCK, &set, NULL);
	puts(ready);
	fflush(stdout);
	sigwait(&set, &signal);
}
