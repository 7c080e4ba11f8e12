/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_SEAT_H
#define PLATFORM_SEAT_H

#include <smoothie.h>

/**
 * Where device nodes come from: a seat manager (seatd or logind, through libseat), which needs no
 * root and switches virtual terminals, or else open() itself, whose seat is always active.
 */
struct seat;

/** Takes the seat of this session: seatd's, else logind's, else directly; LIBSEAT_BACKEND in the
 *  environment names another one of libseat's. Returns once it is active, after a second at most.
 *  NULL when out of memory. */
struct seat *seat_create(struct sm_error *error);
/** Closes its devices, then the seat; NULL is fine. */
void seat_destroy(struct seat *seat);

/** "seatd", "logind", "direct", or what LIBSEAT_BACKEND says. */
const char *seat_name(const struct seat *seat);

/** To poll for reading; -1: none, or its manager is gone. */
int seat_fd(const struct seat *seat);

/** Handles what the manager says, without waiting. A seat that is taken away (another virtual
 *  terminal) is given up at once: nobody may be using its devices meanwhile. Fails (MACHINE) when
 *  the manager is gone. */
bool seat_dispatch(struct seat *seat, struct sm_error *error);

/** Whether its devices may be used now. */
bool seat_is_active(const struct seat *seat);
/** How often it has become active: a change means that others may have used the devices. */
unsigned seat_activations(const struct seat *seat);

/** Opens a device node, in an active seat; returns a descriptor that belongs to the seat, or -1 and
 *  *error, which says why without the path: (INPUT) when there is no such node, (MACHINE) when it
 *  cannot be had. A manager makes a DRM node the master of its display; directly, that is left to
 *  the caller. */
int seat_open_device(struct seat *seat, const char *path, struct sm_error *error);
/** A descriptor of -1 is fine, then also without a seat. */
void seat_close_device(struct seat *seat, int fd);

#endif
