/* SPDX-License-Identifier: MIT */
/* A card, and a picture on it without any library above the kernel's. */
#ifndef SMOOTHIE_TESTS_VM_CARD_H
#define SMOOTHIE_TESTS_VM_CARD_H

#include <stdint.h>
#include <xf86drmMode.h>

/* A connector with a monitor, a CRTC that it can use, and its mode. */
struct output {
	uint32_t connector, crtc;
	drmModeModeInfo mode;
};

/* Ends the program with a line when the condition does not hold. */
void demand(int condition, const char *what);

int card_open(const char *path);
/* Shows the test pattern on the first monitor, in its first mode of this size or, for "", in the
 * preferred one, until the card is closed. */
struct output show_pattern(int card, const char *size);

/* The colour of the test pattern at a pixel, 0xRRGGBB: no two rows or columns are equal. */
uint32_t pattern_color(uint32_t x, uint32_t y);

/* Tells the one who started this program that it is ready, and sleeps until SIGTERM. */
void sleep_until_told(const char *ready);

#endif
