/* SPDX-License-Identifier: MIT */
#ifndef TESTS_FUZZ_STAGE_CHECK_H
#define TESTS_FUZZ_STAGE_CHECK_H

#include "load/stage.h"

/** What holds of a stage that was loaded, at any size and time. */
void expect_sound_stage(struct stage *stage);

#endif
