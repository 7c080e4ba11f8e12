/* SPDX-License-Identifier: MIT */
#include "technique/disc_mask.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define TURN (2.0 * 3.14159265358979323846)
/* Of the disc: half planes and sectors of them, root mean square and at most. */
#define ERROR_RMS 0.012
#define ERROR_MOST 0.06

static uint32_t table[DISC_MASK_ANGLES * DISC_MASK_DISTANCES][2];

static uint64_t mask_at(int angle, int distance)
{
	const uint32_t *words = table[distance * DISC_MASK_ANGLES + angle];
	return words[0] | (uint64_t)words[1] << 32;
}

static void test_samples_have_equal_areas(void **state)
{
	(void)state;
	uint64_t rings = 0;
	for (int i = 0; i < DISC_MASK_SAMPLES; i++) {
		double p[2];
		disc_mask_sample(i, p);
		double turn = atan2(p[1], p[0]) / TURN;
		assert_int_equal((int)floor((turn - floor(turn)) * DISC_MASK_SAMPLES), i);
		rings |= (uint64_t)1 << (int)floor((p[0] * p[0] + p[1] * p[1]) * DISC_MASK_SAMPLES);
	}
	assert_true(rings == UINT64_MAX);
}

static void test_sectors_are_runs(void **state)
{
	(void)state;
	for (int first = -DISC_MASK_SAMPLES; first <= DISC_MASK_SAMPLES; first++)
		for (int count = 0; count < DISC_MASK_SAMPLES; count++) {
			uint64_t expected = 0;
			for (int i = 0; i < count; i++)
				expected |= (uint64_t)1 << ((first + i + 2 * DISC_MASK_SAMPLES) %
							    DISC_MASK_SAMPLES);
			assert_true(disc_mask_sector(first, first + count) == expected);
		}
}

/* Share of the disc beyond a line within an angle to either side of its foot. */
static double share(double h, double half_angle)
{
	double angle = fmin(half_angle, acos(h));
	return (angle - h * h * tan(angle)) / (TURN / 2.0);
}

static void test_shares_are_near(void **state)
{
	(void)state;
	double squares = 0.0, most = 0.0;
	int count = 0;
	for (int a = 0; a < DISC_MASK_ANGLES; a++)
		for (int d = 0; d < DISC_MASK_DISTANCES; d++)
			for (int half = 1; half <= 16; half++) {
				double middle = (a + 0.5) * DISC_MASK_SAMPLES / DISC_MASK_ANGLES;
				int first = (int)ceil(middle - half - 0.5);
				uint64_t mask =
					mask_at(a, d) & disc_mask_sector(first, first + 2 * half);
				double found =
					__builtin_popcountll(mask) / (double)DISC_MASK_SAMPLES;
				double error = found - share((d + 0.5) / DISC_MASK_DISTANCES,
							       TURN * half / DISC_MASK_SAMPLES);
				squares += error * error;
				most = fmax(most, fabs(error));
				count++;
			}
	print_message("root mean square %.4f, at most %.4f\n", sqrt(squares / count), most);
	assert_true(sqrt(squares / count) < ERROR_RMS);
	assert_true(most < ERROR_MOST);
}

/* What is beyond a line is beyond all nearer ones, and never on the other side of the disc. */
static void test_masks_are_nested(void **state)
{
	(void)state;
	for (int a = 0; a < DISC_MASK_ANGLES; a++)
		for (int d = 0; d < DISC_MASK_DISTANCES; d++) {
			int opposite = (a + DISC_MASK_ANGLES / 2) % DISC_MASK_ANGLES;
			assert_true((mask_at(a, d) & mask_at(opposite, 0)) == 0);
			if (d > 0)
				assert_true((mask_at(a, d) & ~mask_at(a, d - 1)) == 0);
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_samples_have_equal_areas),
		cmocka_unit_test(test_sectors_are_runs),
		cmocka_unit_test(test_shares_are_near),
		cmocka_unit_test(test_masks_are_nested),
	};
	disc_mask_table(table);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
