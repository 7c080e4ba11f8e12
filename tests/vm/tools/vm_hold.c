/* SPDX-License-Identifier: MIT */
/* vm_hold CARD [WxH]: shows the test pattern, gives the card up to others, and keeps the pattern's
 * framebuffer alive until SIGTERM: what stood on the display before a program came. */
#include <stdio.h>
#include <xf86drm.h>

#include "card.h"

int main(int argc, char **argv)
{
	if (argc < 2) {
		fputs("usage: vm_hold CARD [WxH]\n", stderr);
		return 2;
	}
	int card = card_open(argv[1]);
	struct output output = show_pattern(card, argc > 2 ? argv[2] : "");
	demand(!drmDropMaster(card), "drmDropMaster");
	char ready[64];
	snprintf(ready, sizeof(ready), "shown: %s", output.mode.name);
	sleep_until_told(ready);
	return 0;
}
