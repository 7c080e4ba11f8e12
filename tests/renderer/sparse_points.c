/* SPDX-License-Identifier: MIT */
/* Which points are drawn for a part of a sparse picture. */
#include "sparse_pass.h"
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* A cell is of two points along each axis, the first of the picture before the picture's. */
static void points_are_those_of_all_cells(void **state)
{
	(void)state;
	for (int first = 0; first < 3 * SPARSE_SPACING; first++)
		for (int end = first + 1; end < 5 * SPARSE_SPACING; end++) {
			const struct pixel_box pixels = {first, first, end, end};
			struct pixel_box points = sparse_pass_points_in(&pixels);
			assert_int_equal(points.left, first / SPARSE_SPACING + 1);
			assert_int_equal(points.right - 1, (end - 1) / SPARSE_SPACING + 2);
			assert_int_equal(points.bottom, points.left);
			assert_int_equal(points.top, points.right);
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(points_are_those_of_all_cells),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
