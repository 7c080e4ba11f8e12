/* SPDX-License-Identifier: MIT */
#ifndef TESTS_FUZZ_MODEL_RIG_H
#define TESTS_FUZZ_MODEL_RIG_H

#include "load/model.h"
#include "number.h"

/** At most. */
enum { RIG_NODES = 6, RIG_TARGETS = 3, RIG_BONES = 4, RIG_CLIPS = 3, RIG_KEYS = 4 };

/** Gives a model with meshes and objects a rig, of what the importer would let through; the model
 *  has room for a further mesh of each object. */
void take_rig(struct numbers *numbers, struct model *model);

#endif
