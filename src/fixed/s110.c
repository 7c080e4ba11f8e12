/* SPDX-License-Identifier: MIT */
#include "fixed/s110.h"
#include <math.h>

int s110_saturate(long long steps)
{
	if (steps < S110_MIN)
		return S110_MIN;
	return steps > S110_MAX ? S110_MAX : (int)steps;
}

int s110_from_real(double x)
{
	double steps = fmin(fmax(x * S110_ONE, S110_MIN), S110_MAX);
	double below = floor(steps);
	/* Not floor(steps + .5): the sum may round up to a whole number. */
	return s110_saturate((long long)below + (steps - below >= 0.5));
}

double s110_to_real(int a)
{
	return (double)a / S110_ONE;
}

/* n / d to the nearest, halves up; d > 0. */
static int round_quotient(int n, int d)
{
	int doubled = 2 * n + d;
	int quotient = doubled / (2 * d);
	return s110_saturate(quotient - (doubled % (2 * d) < 0));
}

int s110_add(int a, int b)
{
	return s110_saturate(a + b);
}

int s110_subtract(int a, int b)
{
	return s110_saturate(a - b);
}

int s110_multiply(int a, int b)
{
	return round_quotient(a * b, S110_ONE);
}

int s110_divide(int a, int b)
{
	if (b == 0)
		return a < 0 ? S110_MIN : S110_MAX;
	return b < 0 ? round_quotient(-a * S110_ONE, -b) : round_quotient(a * S110_ONE, b);
}

int s110_lerp(int a, int b, int t)
{
	return s110_add(s110_multiply(a, s110_subtract(S110_ONE, t)), s110_multiply(b, t));
}
