/* SPDX-License-Identifier: MIT */
/* vm_hold CARD [WxH]: shows the test pattern, gives the card up to others, and keeps the pattern's
 * framebuffer alive until SIGTERM: what stood on the display before a program came. */
#include <stdio.h>
#include <xf86drm.h>

#include "card.h"

static void draw_pattern(const struct buffer *buffer, uint32_t width, uint32_t height)
{
	for (uint32_t y = 0; y < height; y++)
		for (uint32_t x = 0; x < width; x++)
			buffer->pixels[y * (buffer->pitch / 4) + x] = pattern_color(x, y);
}

int main(int argc, char **argv)
{
	if (argc < 2) {
		fputs("usage: vm_hold CARD [WxH]\n", stderr);
		return 2;
	}
	int card = card_open(argv[1]);
	struct output output = card_output(card, argc > 2 ? argv[2] : "");
	struct buffer buffer = buffer_create(card, output.mode.hdisplay, output.mode.vdisplay);
	draw_pattern(&buffer, output.mode.hdisplay, output.mode.vdisplay);
	demand(!drmModeSetCrtc(
		       card, output.crtc, buffer.fb, 0, 0, &output.connector, 1, &output.mode),
		"drmModeSetCrtc");
	demand(!drmDropMaster(card), "drmDropMaster");
	char ready[64];
	snprintf(ready, sizeof(ready), "shown: %s", output.mode.name);
	sleep_until_told(ready);
	return 0;
}
