/* SPDX-License-Identifier: MIT */
#include "model/fins.h"
#include "model/raster.h"

/* A triangle of a fin as it is drawn. */
struct drawing {
	const struct fin_vertex *corners[3];
	void (*draw)(void *data, const struct fin_texel *texel);
	void *data;
};

static void draw_texel(
	void *data, const struct raster_triangle *triangle, int x, int y, double depth)
{
	const struct drawing *drawing = data;
	struct fin_texel texel = {.x = x, .y = y, .depth = depth};
	double weights[3];
	raster_weights(triangle, x, y, weights);
	for (int i = 0; i < 3; i++) {
		const struct fin_vertex *corner = drawing->corners[i];
		texel.offset[0] += weights[i] * corner->offset[0];
		texel.offset[1] += weights[i] * corner->offset[1];
		texel.width += weights[i] * corner->width;
	}
	drawing->draw(drawing->data, &texel);
}

static void draw_quad(const struct raster_area *area, const struct fin_vertex quad[4],
	void (*draw)(void *data, const struct fin_texel *texel), void *data)
{
	static const size_t halves[2][3] = {{0, 1, 2}, {0, 2, 3}};
	for (size_t half = 0; half < 2; half++) {
		struct drawing drawing = {.draw = draw, .data = data};
		double clip[3][4];
		for (int i = 0; i < 3; i++) {
			drawing.corners[i] = &quad[halves[half][i]];
			for (int axis = 0; axis < 3; axis++)
				clip[i][axis] = drawing.corners[i]->position[axis];
			clip[i][3] = 1.0;
		}
		raster_draw(area, (const double(*)[4])clip, draw_texel, &drawing);
	}
}

void fins_draw(const struct fin_set *fins, const struct model_light *light,
	void (*draw)(void *data, const struct fin_texel *texel), void *data)
{
	struct raster_area area = model_map_area(light);
	struct fin_vertex vertices[FIN_VERTICES_MAX];
	for (size_t i = 0; i < fins->count; i++) {
		size_t count = fin_set_expand(fins, i, vertices);
		for (size_t first = 0; first < count; first += 4)
			draw_quad(&area, vertices + first, draw, data);
	}
}
