/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_DISPLAY_H
#define PLATFORM_DISPLAY_H

#include <poll.h>
#include <smoothie.h>
#include <stdio.h>

/**
 * A monitor on KMS, without a windowing system: it comes and goes, changes its mode, or belongs to
 * another virtual terminal for a while. The program draws whenever there is something to draw on:
 *
 *	for (;;) {
 *		display_update();
 *		if (display_wants_frame(changed)) { display_begin(); ... display_end(); }
 *		else ppoll() on display_poll();
 *	}
 */
struct display;

/** Zero in a field: the default. */
struct display_options {
	const char *device;    /**< path of a DRM node; NULL: the first with a monitor */
	const char *connector; /**< its name; NULL: the first with a monitor */
	const char *mode;      /**< "preferred" (default), "current", "WxH" or "WxH@HZ" */
	const char *format;    /**< such as "rgb565"; NULL: the best that there is */
	unsigned rotation;     /**< degrees clockwise: 0, 90, 180, 270 */
	bool legacy;           /**< no atomic mode-setting even where the driver has it */
	bool async;            /**< flips do not wait for the vertical blank where that works */
	bool debug;            /**< a debug context */
};

/**
 * Takes a seat and looks for a monitor. Without one the display waits for the first that appears.
 * Fails (INPUT) on an option that names what is not there, (MACHINE) where no device can drive a
 * monitor or another program has it.
 */
struct display *display_create(const struct display_options *options, struct sm_error *error);

/** Waits for a frame on its way, up to a second, and shows what was there before; NULL is fine. */
void display_destroy(struct display *display);

/** What a display can be waited for with. */
#define DISPLAY_POLL_MAX 3

/** Fills fds, returns their number; *timeout: ns until display_update() has work even so. */
size_t display_poll(
	const struct display *display, struct pollfd fds[DISPLAY_POLL_MAX], int64_t *timeout);

/** Does what is due, without waiting: flips, monitors, seat. Fails (MACHINE) when the display can
 *  never show anything again, as when its GPU was removed. */
bool display_update(struct display *display, struct sm_error *error);

/** Whether a frame can be drawn now and is called for: the picture has changed, or the screen has
 *  lost it. From the first time on there is a context, which stays. */
bool display_wants_frame(const struct display *display, bool changed);

/** The picture that is wanted, and where it goes. */
struct display_target {
	uint32_t width, height; /**< of the picture, pixels */
	unsigned rotation;      /**< degrees clockwise by which to turn it onto the screen */
	uint8_t bits[3];        /**< of red, green and blue on the screen */
	bool takes_pixels;      /**< display_end() is given the screen's pixels; otherwise it is
				     framebuffer 0 */
};

/** Opens a frame, after display_wants_frame() was true. Fails (MACHINE). */
bool display_begin(struct display *display, struct display_target *target, struct sm_error *error);

/** Shows the frame from the next vertical blank on. rgba: for takes_pixels, R,G,B,A bytes of the
 *  turned picture, rows from the bottom. A frame that could not be shown is asked for again. */
bool display_end(struct display *display, const uint8_t *rgba, struct sm_error *error);

/** Instead of a frame, after display_wants_frame() was true by a change alone: what is shown is
 * right at the tick of the next frame as well. No other is wanted before that is over. */
void display_keep(struct display *display);

/** The vertical blank, counted from that of the first frame, at which the next frame will be shown
 *  if it is drawn in time. */
uint64_t display_tick(const struct display *display);

/** Vertical blanks a second, as a ratio. */
void display_get_refresh(const struct display *display, uint32_t *numerator, uint32_t *denominator);

/** Whether a monitor shows the picture, or would if the last frame were through. */
bool display_is_on(const struct display *display);

struct display_stats {
	uint64_t frames; /**< drawn */
	uint64_t flips;  /**< that came through */
	uint64_t missed; /**< vertical blanks that passed without the frame that was due */
	double overhead; /**< ms of processor time for commits, events and bookkeeping */
};

void display_get_stats(const struct display *display, struct display_stats *stats);

/** Reports device, monitor, mode and ways. */
void display_describe(const struct display *display, sm_fact fact, void *data);

/** Prints devices, or the one of that path, with connectors, modes and formats, and why each is
 *  usable or not. device: NULL for all. */
bool display_list(const char *device, FILE *file, struct sm_error *error);

#endif
