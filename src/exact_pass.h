/* SPDX-License-Identifier: MIT */
#ifndef EXACT_PASS_H
#define EXACT_PASS_H

#include "technique/technique.h"

/** technique_smoothie in integers, for precisions other than float: a scene becomes primitives of
 *  integers on the processor (exact_scene.h), and every pixel is what src/fixed makes of them.
 *  Depths and alpha' go to targets of integers, the least of them by the depth test. */
extern const struct technique technique_exact;

#endif
