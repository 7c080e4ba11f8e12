/* SPDX-License-Identifier: MIT */
#include "scene/draw_order.h"
#include "base/array.h"
#include <float.h>
#include <stdlib.h>

static float farthest_of(const struct object *object, mat4 world_to_clip)
{
	float farthest = -FLT_MAX;
	for (int corner = 0; corner < 8; corner++) {
		vec4 p = {1.0f, 1.0f, 1.0f, 1.0f};
		for (int axis = 0; axis < 3; axis++)
			p[axis] = corner >> axis & 1 ? object->max[axis] : object->min[axis];
		glm_mat4_mulv(world_to_clip, p, p);
		farthest = fmaxf(farthest, p[3]);
	}
	return farthest;
}

static bool comes_after(const struct draw_item *a, const struct draw_item *b)
{
	return a->farthest != b->farthest ? a->farthest > b->farthest : a->object > b->object;
}

/* Lets items[i] sink in a heap of `count` items whose first is the last to draw. */
static void sink(struct draw_item *items, size_t i, size_t count)
{
	struct draw_item sinking = items[i];
	for (size_t child; (child = 2 * i + 1) < count; i = child) {
		if (child + 1 < count && comes_after(&items[child + 1], &items[child]))
			child++;
		if (!comes_after(&items[child], &sinking))
			break;
		items[i] = items[child];
	}
	items[i] = sinking;
}

/* Heapsort (Williams 1964), since qsort() may allocate, each frame. */
static void sort(struct draw_item *items, size_t count)
{
	for (size_t i = count / 2; i > 0; i--)
		sink(items, i - 1, count);
	for (size_t last = count; last > 1; last--) {
		struct draw_item first = items[0];
		items[0] = items[last - 1];
		items[last - 1] = first;
		sink(items, 0, last - 1);
	}
}

bool draw_order_find(struct draw_order *order, const struct sm_scene *scene, mat4 world_to_clip)
{
	if (!array_reserve((void **)&order->items, &order->capacity, scene->object_count,
		    sizeof(*order->items)))
		return false;
	order->count = scene->object_count;
	for (size_t i = 0; i < order->count; i++) {
		const struct object *object = &scene->objects[i];
		order->items[i] = (struct draw_item){object, farthest_of(object, world_to_clip)};
	}
	sort(order->items, order->count);
	return true;
}

void draw_order_finish(struct draw_order *order)
{
	free(order->items);
	*order = (struct draw_order){0};
}
