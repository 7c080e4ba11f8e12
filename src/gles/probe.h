/* SPDX-License-Identifier: MIT */
#ifndef GLES_PROBE_H
#define GLES_PROBE_H

#include "gles/gpu.h"

/** Whether the driver has a cap: found out on first use, by drawing where need be. Leaves GL's
 * state as it expects it, at its defaults, and framebuffer and viewport as they are. */
bool gpu_has(struct gpu *gpu, enum cap cap);

/** Every cap, why it is there or not. */
void probe_describe(struct gpu *gpu, sm_fact fact, void *data);

#endif
