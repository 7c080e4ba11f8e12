/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_NODE_H
#define PLATFORM_NODE_H

#include <smoothie.h>

struct gbm_device;

/** A DRM node opened through GBM. */
struct node {
	int fd; /* -1: closed */
	struct gbm_device *gbm;
};

/** Opens the DRM node at path; debug: lets the driver's loader speak on stderr.
 *  Fails (INPUT) when it is no such node, (MACHINE) when it does not serve. */
bool node_init(struct node *node, const char *path, bool debug, struct sm_error *error);

/** A GBM device on an open node, or NULL; debug: as above. End it with gbm_device_destroy(), before
 *  the node is closed. */
struct gbm_device *node_create_gbm(int fd, bool debug);

/** Writes the path of the primary node beside a render node; false when there is none. */
bool node_primary(const char *path, char *primary, size_t size);

/** Closes whatever init has opened. */
void node_finish(struct node *node);

#endif
