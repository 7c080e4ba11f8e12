/* SPDX-License-Identifier: MIT */
#ifndef LOAD_COLOR_H
#define LOAD_COLOR_H

/** Linear value of an sRGB one, both in [0, 1] (IEC 61966-2-1). */
float color_linear(float srgb);

#endif
