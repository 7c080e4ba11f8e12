/* SPDX-License-Identifier: MIT */
#include "number.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const float troublesome[0x20] = {0.0f, -0.0f, NAN, INFINITY, -INFINITY, FLT_MAX, -FLT_MAX,
	FLT_MIN, -FLT_MIN, FLT_TRUE_MIN, -FLT_TRUE_MIN, FLT_EPSILON, 1.0f + FLT_EPSILON, 1e-30f,
	-1e-30f, 1e-10f, -1e-10f, 1e-5f, 1e3f, -1e3f, 1e6f, -1e6f, 1e10f, -1e10f, 1e15f, -1e15f,
	1e19f, -1e19f, 1e30f, -1e30f, 1.0f / 3.0f, 16777217.0f};

uint8_t take_byte(struct numbers *numbers)
{
	if (numbers->size == 0)
		return 0;
	numbers->size--;
	return *numbers->data++;
}

float take_float(struct numbers *numbers)
{
	uint8_t byte = take_byte(numbers);
	if (byte < 0x20)
		return troublesome[byte];
	if (byte < 0xf0)
		return (float)(byte - 0x80) / 16.0f;
	float value;
	uint8_t bytes[sizeof(value)];
	for (size_t i = 0; i < sizeof(value); i++)
		bytes[i] = take_byte(numbers);
	memcpy(&value, bytes, sizeof(value));
	return value;
}

void take_floats(struct numbers *numbers, float *values, size_t count)
{
	for (size_t i = 0; i < count; i++)
		values[i] = take_float(numbers);
}
