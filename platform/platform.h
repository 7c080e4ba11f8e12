/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_H
#define PLATFORM_H

#include <smoothie.h>

/** A device with an OpenGL ES 3 context that is current and needs no window. */
struct platform;

/**
 * Opens a device and makes a context current on it, of the highest version it has (3.2 to 3.0).
 * A device counts as working once a clear has been drawn and read back.
 *
 * device: "surfaceless" (the driver chooses), the path of a DRM node (through GBM), or NULL for the
 * first that works of the render nodes, the primary nodes and surfaceless.
 * A node that is there but does not work is replaced, with a warning, by its GPU's primary node or
 * else surfaceless.
 * debug: ask for a debug context.
 * Fails (INPUT) on a device that cannot be one, (MACHINE) when none works.
 */
struct platform *platform_create(const char *device, bool debug, struct sm_error *error);

/** The same on this device and no other: a node that does not work is an error. */
struct platform *platform_create_on(const char *device, bool debug, struct sm_error *error);

/** Before anything else of EGL: sets where the drivers' messages go. */
void platform_prepare(bool debug);

/** Ends context and device; NULL is fine. */
void platform_destroy(struct platform *platform);

/** Looks a GL function up in the context; an sm_get_proc. */
void (*platform_get_proc(const char *name))(void);

/** Whether the context that is current lists an extension of GL. */
bool platform_has_extension(const char *name);

/** Reports which device is used, and its EGL. */
void platform_describe(const struct platform *platform, sm_fact fact, void *data);

#endif
