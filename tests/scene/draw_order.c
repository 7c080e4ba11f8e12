/* SPDX-License-Identifier: MIT */
#include "scene/draw_order.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT_MAX 100

static void assert_order(const struct draw_order *order, const struct sm_scene *scene)
{
	bool seen[COUNT_MAX] = {false};
	assert_int_equal(order->count, scene->object_count);
	for (size_t i = 0; i < order->count; i++) {
		const struct draw_item *item = &order->items[i], *before = item - 1;
		size_t index = (size_t)(item->object - scene->objects);
		assert_true(index < scene->object_count && !seen[index]);
		seen[index] = true;
		assert_true(item->farthest == item->object->max[0]);
		if (i > 0)
			assert_true(before->farthest < item->farthest ||
				    (before->farthest == item->farthest &&
					    before->object < item->object));
	}
}

/* Down the x axis: w = x. Values repeat, so that some are equal. */
static void what_ends_nearer_comes_first(void **state)
{
	(void)state;
	struct object objects[COUNT_MAX] = {0};
	struct sm_scene scene = {.objects = objects};
	struct draw_order order = {0};
	mat4 down_x = {{0, 0, 0, 1}};
	unsigned int number = 1;
	for (; scene.object_count < COUNT_MAX; scene.object_count++) {
		for (size_t i = 0; i < scene.object_count; i++) {
			number = number * 1103515245 + 12345;
			objects[i].max[0] = (float)(number >> 16 & 63);
			objects[i].min[0] = objects[i].max[0] - (float)(number >> 24);
		}
		assert_true(draw_order_find(&order, &scene, down_x));
		assert_order(&order, &scene);
	}
	draw_order_finish(&order);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_ends_nearer_comes_first),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
