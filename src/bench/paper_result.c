/* SPDX-License-Identifier: MIT */
#include "bench/paper_result.h"

const uint32_t paper_maps[PAPER_MAPS] = {256, 512, 1024};
const double paper_widths[PAPER_WIDTHS] = {.02, .05, .1, .2};
const char *const paper_technique_names[PAPER_TECHNIQUES] = {"hard", "smoothie", "bicubic"};
