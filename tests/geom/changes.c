/* SPDX-License-Identifier: MIT */
#include "changes.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct model model_inverted(struct model model)
{
	for (size_t i = 0; i < model.index_count; i += 3) {
		uint32_t swap = model.indices[i];
		model.indices[i] = model.indices[i + 1];
		model.indices[i + 1] = swap;
	}
	return model;
}

struct model model_opened(struct model model)
{
	model.index_count -= 3;
	memmove(model.indices, model.indices + 3, model.index_count * sizeof(*model.indices));
	return model;
}

struct model model_scaled(struct model model, float scale)
{
	for (size_t v = 0; v < model.vertex_count; v++)
		for (int axis = 0; axis < 3; axis++)
			model.positions[v][axis] *= scale;
	return model;
}

struct model model_moved(struct model model, float by)
{
	const float along[3] = {1.0f, -0.7f, 0.3f};
	for (size_t v = 0; v < model.vertex_count; v++)
		for (int axis = 0; axis < 3; axis++)
			model.positions[v][axis] += by * along[axis];
	return model;
}

struct model model_joined(struct model a, struct model b)
{
	struct model both = {
		.vertex_count = a.vertex_count + b.vertex_count,
		.index_count = a.index_count + b.index_count,
	};
	both.positions = malloc(both.vertex_count * sizeof(*both.positions));
	both.indices = malloc(both.index_count * sizeof(*both.indices));
	if (both.positions == NULL || both.indices == NULL)
		abort();
	memcpy(both.positions, a.positions, a.vertex_count * sizeof(*a.positions));
	memcpy(both.positions + a.vertex_count, b.positions, b.vertex_count * sizeof(*b.positions));
	memcpy(both.indices, a.indices, a.index_count * sizeof(*a.indices));
	for (size_t i = 0; i < b.index_count; i++)
		both.indices[a.index_count + i] = b.indices[i] + (uint32_t)a.vertex_count;
	model_finish(&a);
	model_finish(&b);
	return both;
}

struct model model_torus(void)
{
	const uint32_t around = 24, across = 12;
	const float turn = 6.2831853f;
	struct model model = {.vertex_count = around * across, .index_count = 6 * around * across};
	model.positions = malloc(model.vertex_count * sizeof(*model.positions));
	model.indices = malloc(model.index_count * sizeof(*model.indices));
	if (model.positions == NULL || model.indices == NULL)
		abort();
	uint32_t *index = model.indices;
	for (uint32_t i = 0; i < around; i++) {
		for (uint32_t j = 0; j < across; j++, index += 6) {
			uint32_t row = i * across, next_row = (i + 1) % around * across;
			uint32_t a = row + j, b = next_row + j;
			uint32_t c = next_row + (j + 1) % across, d = row + (j + 1) % across;
			float u = turn * (float)i / (float)around;
			float v = turn * (float)j / (float)across;
			float radius = 1.0f + 0.4f * cosf(v);
			memcpy(model.positions[a],
				(float[3]){radius * cosf(u), radius * sinf(u), 0.4f * sinf(v)},
				sizeof(model.positions[a]));
			memcpy(index, (uint32_t[]){a, b, c, a, c, d}, 6 * sizeof(*index));
		}
	}
	return model;
}
