/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const struct {
	size_t count, size;
} overflowing[] = {
	{SIZE_MAX, 2}, {2, SIZE_MAX}, {SIZE_MAX / 2 + 1, 2}, /* wraps to 0 */
	{SIZE_MAX / 4 + 2, 4},                               /* wraps to 4 */
	{(size_t)PTRDIFF_MAX + 1, 1},                        /* more than any object */
};

#define OVERFLOWING_COUNT (sizeof(overflowing) / sizeof(overflowing[0]))

static void sizes_that_overflow_allocate_nothing(void **state)
{
	(void)state;
	for (size_t i = 0; i < OVERFLOWING_COUNT; i++) {
		assert_null(array_alloc(overflowing[i].count, overflowing[i].size));
		assert_null(array_zalloc(overflowing[i].count, overflowing[i].size));
		assert_null(array_copy("", overflowing[i].count, overflowing[i].size));
	}
}

static void nothing_is_allocated_as_something(void **state)
{
	(void)state;
	static const size_t sizes[][2] = {{0, 0}, {0, 8}, {8, 0}};
	for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
		void *all[] = {
			array_alloc(sizes[i][0], sizes[i][1]),
			array_zalloc(sizes[i][0], sizes[i][1]),
			array_copy(NULL, sizes[i][0], sizes[i][1]),
		};
		for (size_t j = 0; j < sizeof(all) / sizeof(all[0]); j++) {
			assert_non_null(all[j]);
			free(all[j]);
		}
	}
}

static void zalloc_zeroes_and_copy_copies(void **state)
{
	(void)state;
	static const uint16_t source[3] = {1, 2, 3}, zero[3];
	uint16_t *copy = array_copy(source, 3, sizeof(*source));
	uint16_t *zeroed = array_zalloc(3, sizeof(*source));
	assert_memory_equal(copy, source, sizeof(source));
	assert_memory_equal(zeroed, zero, sizeof(zero));
	free(copy);
	free(zeroed);
}

static void reserve_keeps_what_is_there_and_grows_by_half(void **state)
{
	(void)state;
	void *items = NULL;
	size_t capacity = 0, moves = 0;
	for (size_t count = 0; count < 1000; count++) {
		size_t before = capacity;
		assert_true(array_reserve(&items, &capacity, count + 1, sizeof(size_t)));
		assert_true(capacity > count);
		moves += capacity != before;
		((size_t *)items)[count] = count;
	}
	for (size_t i = 0; i < 1000; i++)
		assert_int_equal(((size_t *)items)[i], i);
	/* 1.5^18 > 1000, and one for each of the sizes 1 and 2, whose half is 0 or 1. */
	assert_true(moves <= 20);
	free(items);
}

static void reserve_that_overflows_changes_nothing(void **state)
{
	(void)state;
	for (size_t i = 0; i < OVERFLOWING_COUNT; i++) {
		size_t capacity = 1;
		void *items = malloc(1), *before = items;
		assert_false(array_reserve(
			&items, &capacity, overflowing[i].count, overflowing[i].size));
		assert_ptr_equal(items, before);
		assert_int_equal(capacity, 1);
		free(items);
	}
}

static void reserve_of_what_there_is_does_nothing(void **state)
{
	(void)state;
	void *items = NULL;
	size_t capacity = 4;
	assert_true(array_reserve(&items, &capacity, 4, SIZE_MAX));
	assert_null(items);
	assert_int_equal(capacity, 4);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(sizes_that_overflow_allocate_nothing),
		cmocka_unit_test(nothing_is_allocated_as_something),
		cmocka_unit_test(zalloc_zeroes_and_copy_copies),
		cmocka_unit_test(reserve_keeps_what_is_there_and_grows_by_half),
		cmocka_unit_test(reserve_that_overflows_changes_nothing),
		cmocka_unit_test(reserve_of_what_there_is_does_nothing),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
