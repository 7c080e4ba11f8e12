/* SPDX-License-Identifier: MIT */
#ifndef FIXED_S110_H
#define FIXED_S110_H

/*
 * Signed s1.10 fixed point, the 12-bit `fixed` of the GeForce FX, in which Chan & Durand 2003
 * compute most of a pixel: [-2, 2) in steps of 1/1024.
 *
 * A number is an int that counts steps, from S110_MIN to S110_MAX. Results are the exact ones
 * rounded to the nearest step, halves up (towards +2), and saturate: what lies beyond the range
 * becomes its end.
 */

#define S110_ONE 1024
#define S110_MIN (-2048)
#define S110_MAX 2047

/** x is not a NaN. */
int s110_from_real(double x);
double s110_to_real(int a);

/** Any count of steps, into the range. */
int s110_saturate(long long steps);

int s110_add(int a, int b);
int s110_subtract(int a, int b);
int s110_multiply(int a, int b);
/** By zero: the end of the range that has the sign of a, which for 0 is S110_MAX. */
int s110_divide(int a, int b);
/** a (1 - t) + b t, each of the four operations rounded and saturated. */
int s110_lerp(int a, int b, int t);

#endif
