/* SPDX-License-Identifier: MIT */
#include "load/color.h"
#include <math.h>

float color_linear(float srgb)
{
	return srgb <= .04045f ? srgb / 12.92f : powf((srgb + .055f) / 1.055f, 2.4f);
}
