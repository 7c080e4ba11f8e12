/* SPDX-License-Identifier: MIT */
#ifndef TESTS_DISPLAY_FAKE_WORLD_H
#define TESTS_DISPLAY_FAKE_WORLD_H

#include "hotplug.h"
#include <poll.h>
#include <stdbool.h>
#include <stdint.h>

/*
 * What stands around a display: a clock that runs only while someone waits, a seat, hotplug events.
 * The fakes take the place of the platform's seat and hotplug, and of poll(), clock_gettime(),
 * mmap() and glob() in what is linked into the test; the rest of the platform is the real one.
 */
struct fake_world {
	int64_t now; /* ns of the monotonic clock */
	bool seat_active;
	unsigned seat_activations;
	bool seat_lost; /* its manager is gone */
	bool no_news;   /* hotplug events do not come */
	enum hotplug_news news;
	unsigned mappings; /* of dumb buffers, that are there */
};

extern struct fake_world fake_world;

/** The beginning: an active seat, no news, no devices. */
void fake_world_reset(void);
/** A monitor came or went: an event says so. */
void fake_world_tell(void);
/** Lets time pass, and what is due happen. */
void fake_world_wait(int64_t nanoseconds);
/** poll(): waiting takes as long as it takes until something happens, at once. */
int fake_world_poll(struct pollfd *fds, nfds_t count, int64_t nanoseconds);

#endif
