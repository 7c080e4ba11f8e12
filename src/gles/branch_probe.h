/* SPDX-License-Identifier: MIT */
#ifndef GLES_BRANCH_PROBE_H
#define GLES_BRANCH_PROBE_H

#include "gles/gpu.h"

/** Notes whether the driver has CAP_SLOW_BRANCH: by timing, a few milliseconds, or as an earlier
 *  run on this driver left it in the program store. GL's state: as gpu_has(). */
void branch_probe_run(struct gpu *gpu);

#endif
