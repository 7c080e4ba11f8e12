/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_SEAT_BACKEND_H
#define PLATFORM_SEAT_BACKEND_H

#include "seat.h"
#include <stddef.h>

/** A way to come by devices: a manager's, or open(). */
struct seat_backend {
	/** Handles what has come within timeout ms; false and errno when the manager is gone. */
	bool (*dispatch)(struct seat *seat, int timeout);
	/** Returns a descriptor and in *id the number to close it by, or -1 and errno. */
	int (*open)(struct seat *seat, const char *path, int *id);
	void (*close)(struct seat *seat, int fd, int id);
	void (*finish)(struct seat *seat);
};

struct seat_device {
	int fd, id;
};

struct seat {
	const struct seat_backend *backend;
	const char *name;
	void *manager; /* the backend's own */
	int fd;        /* -1: none */
	bool active;
	unsigned activations;
	struct seat_device *devices;
	size_t device_count, device_capacity;
};

/** Asks the managers of this machine for its seat; false, with the seat as it was, when none gives
 *  it. Chosen by the build: libseat's, or none. */
bool seat_ask_managers(struct seat *seat);

/** Notes that its devices may be used from now on. */
void seat_set_active(struct seat *seat);

#endif
