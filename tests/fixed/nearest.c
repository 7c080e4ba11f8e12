/* SPDX-License-Identifier: MIT */
#include "nearest.h"
#include <math.h>

double nearest_half(double x)
{
	int exponent;
	frexp(x, &exponent);
	/* Of the last of 11 digits; subnormals end with theirs. */
	int last = exponent - 11 > -24 ? exponent - 11 : -24;
	/* Both scalings are exact: a double reaches much further down. */
	double rounded = ldexp(rint(ldexp(x, -last)), last);
	return copysign(fmin(fabs(rounded), 65504.0), x);
}

double value_of_half(uint16_t bits)
{
	int exponent = bits >> 10 & 31;
	double fraction = (bits & 1023) / 1024.0;
	double magnitude =
		exponent == 0 ? ldexp(fraction, -14) : ldexp(1.0 + fraction, exponent - 15);
	return bits & 0x8000 ? -magnitude : magnitude;
}

bool is_same(double a, double b)
{
	return a == b && !signbit(a) == !signbit(b);
}
