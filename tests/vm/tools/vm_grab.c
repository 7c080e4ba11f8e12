/* SPDX-License-Identifier: MIT */
/* vm_grab CARD: writes what the first active CRTC's planes show to standard output, as PPM. It
 * knows dumb buffers of XRGB8888 and RGB565. */
#include <drm_fourcc.h>
#include <inttypes.h>
#include <stdio.h>
#include <sys/mman.h>
#include <xf86drm.h>

#include "card.h"

/* The framebuffer of the first plane that has one, or 0. */
static uint32_t shown_fb(int card)
{
	uint32_t fb = 0;
	drmSetClientCap(card, DRM_CLIENT_CAP_UNIVERSAL_PLANES, 1);
	drmModePlaneRes *planes = drmModeGetPlaneResources(card);
	demand(planes != NULL, "drmModeGetPlaneResources");
	for (uint32_t i = 0; i < planes->count_planes && !fb; i++) {
		drmModePlane *plane = drmModeGetPlane(card, planes->planes[i]);
		fb = plane && plane->crtc_id ? plane->fb_id : 0;
		drmModeFreePlane(plane);
	}
	drmModeFreePlaneResources(planes);
	return fb;
}

static void write_pixel(uint32_t format, const unsigned char *pixel)
{
	if (format == DRM_FORMAT_RGB565) {
		unsigned value = pixel[0] | pixel[1] << 8;
		putchar((int)((value >> 11) * 255 / 31));
		putchar((int)((value >> 5 & 63) * 255 / 63));
		putchar((int)((value & 31) * 255 / 31));
		return;
	}
	putchar(pixel[2]);
	putchar(pixel[1]);
	putchar(pixel[0]);
}

int main(int argc, char **argv)
{
	if (argc < 2) {
		fputs("usage: vm_grab CARD\n", stderr);
		return 2;
	}
	int card = card_open(argv[1]);
	drmModeFB2 *fb = drmModeGetFB2(card, shown_fb(card));
	demand(fb != NULL, "drmModeGetFB2");
	uint64_t offset;
	demand(!drmModeMapDumbBuffer(card, fb->handles[0], &offset), "drmModeMapDumbBuffer");
	size_t size = (size_t)fb->pitches[0] * fb->height;
	const unsigned char *pixels = mmap(NULL, size, PROT_READ, MAP_SHARED, card, (off_t)offset);
	demand(pixels != MAP_FAILED, "mmap");
	printf("P6\n%" PRIu32 " %" PRIu32 "\n255\n", fb->width, fb->height);
	unsigned bytes = fb->pixel_format == DRM_FORMAT_RGB565 ? 2 : 4;
	for (uint32_t y = 0; y < fb->height; y++)
		for (uint32_t x = 0; x < fb->width; x++)
			write_pixel(
				fb->pixel_format, pixels + (size_t)y * fb->pitches[0] + x * bytes);
	return ferror(stdout) || fflush(stdout) ? 1 : 0;
}
