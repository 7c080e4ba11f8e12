/* SPDX-License-Identifier: MIT */
/* A card, and a picture on it without any library above the kernel's. */
#ifndef SMOOTHIE_TESTS_VM_CARD_H
#define SMOOTHIE_TESTS_VM_CARD_H

#include <stddef.h>
#include <stdint.h>
#include <xf86drmMode.h>

/* A dumb buffer that is mapped; 32 bits a pixel. */
struct buffer {
	uint32_t handle, fb, pitch;
	size_t size;
	uint32_t *pixels;
};

/* The first connector with a monitor, a CRTC that it can use, and what that showed before. */
struct output {
	uint32_t connector, crtc;
	drmModeModeInfo mode;
};

/* Ends the program with a line when the condition does not hold. */
void demand(int condition, const char *what);

int card_open(const char *path);
/* The mode is the first of this size, or the preferred one for "". */
struct output card_output(int card, const char *size);
struct buffer buffer_create(int card, uint32_t width, uint32_t height);

/* The colour of the test pattern at a pixel, 0xRRGGBB: no two rows or columns are equal. */
uint32_t pattern_color(uint32_t x, uint32_t y);

/* Tells the one who started this program that it is ready, and sleeps until SIGTERM. */
void sleep_until_told(const char *ready);

#endif
