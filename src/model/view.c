/* SPDX-License-Identifier: MIT */
#include "model/view.h"
#include "base/array.h"
#include "base/error.h"
#include "model/depth_map.h"
#include "model/transform.h"
#include "scene/draw_order.h"
#include <stdlib.h>

/* Of what is being drawn. */
struct drawing {
	struct view *view;
	const struct object *object;
	size_t triangle;
	bool mirrored;
};

static void keep_nearest(
	void *data, const struct raster_triangle *triangle, int x, int y, double depth)
{
	const struct drawing *drawing = data;
	const struct view *view = drawing->view;
	struct view_pixel *pixel = &view->pixels[(size_t)y * (size_t)view->width + (size_t)x];
	float rounded = model_round_depth(depth);
	if (!(rounded < pixel->depth))
		return;
	*pixel = (struct view_pixel){
		.object = drawing->object,
		.triangle = drawing->triangle,
		.front = triangle->front != drawing->mirrored,
		.depth = rounded,
	};
	raster_weights(triangle, x, y, pixel->weights);
}

static bool draw_object(struct view *view, const struct object *object, mat4 world_to_clip)
{
	const struct mesh *mesh = &view->light->scene->meshes[object->mesh];
	mat4 to_clip;
	glm_mat4_mul(world_to_clip, (vec4 *)object->transform, to_clip);
	struct raster_area area = {
		.width = view->width,
		.height = view->height,
		.max = {view->width, view->height},
		.kept = kept_faces(mesh, object, to_clip, object->single_sided),
		.snap_bits = view->light->snap_bits,
		.weights_stay = view->weights_stay,
	};
	struct drawing drawing = {
		.view = view,
		.object = object,
		.mirrored = glm_mat4_det((vec4 *)object->transform) < 0.0f,
	};
	double(*corners)[4] =
		transform_all(to_clip, (const float(*)[3])mesh->positions, mesh->vertex_count);
	if (corners == NULL)
		return false;
	for (size_t i = 0; i < mesh->index_count / 3; i++) {
		double triangle[3][4];
		drawing.triangle = i;
		pick_corners((const double(*)[4])corners, &mesh->indices[3 * i], triangle);
		raster_draw(&area, (const double(*)[4])triangle, keep_nearest, &drawing);
	}
	free(corners);
	return true;
}

bool view_init(struct view *view, const struct model_light *light, mat4 world_to_clip, int width,
	int height, struct sm_error *error)
{
	size_t count = (size_t)width * (size_t)height;
	view->light = light;
	view->width = width;
	view->height = height;
	view->pixels = array_alloc(count, sizeof(*view->pixels));
	if (view->pixels == NULL)
		return error_no_memory(error);
	for (size_t i = 0; i < count; i++)
		view->pixels[i] = (struct view_pixel){.depth = 1.0f};
	struct draw_order order = {0};
	bool drawn = draw_order_find(&order, light->scene, world_to_clip);
	for (size_t i = 0; i < order.count && drawn; i++)
		drawn = draw_object(view, order.items[i].object, world_to_clip);
	draw_order_finish(&order);
	return drawn || error_no_memory(error);
}

void view_finish(struct view *view)
{
	free(view->pixels);
	*view = (struct view){0};
}

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double product[3])
{
	for (int i = 0; i < 3; i++)
		product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* By the inverse transpose, up to a positive factor: signed cofactors. */
static void transform_normal(mat4 matrix, const float normal[3], double transformed[3])
{
	double columns[3][3], cofactors[3][3];
	for (int column = 0; column < 3; column++)
		for (int row = 0; row < 3; row++)
			columns[column][row] = matrix[column][row];
	for (int i = 0; i < 3; i++)
		cross(columns[(i + 1) % 3], columns[(i + 2) % 3], cofactors[i]);
	double sign = dot(columns[0], cofactors[0]) < 0.0 ? -1.0 : 1.0;
	for (int row = 0; row < 3; row++)
		transformed[row] =
			sign * (cofactors[0][row] * normal[0] + cofactors[1][row] * normal[1] +
				       cofactors[2][row] * normal[2]);
	double length = sqrt(dot(transformed, transformed));
	for (int row = 0; row < 3 && length > 0.0; row++)
		transformed[row] /= length;
}

/* On which side of its plane the light is, and on which the surface is seen to be: the side of its
 * interpolated normal, where its front is seen. */
static bool faces_light(const struct surface *surface, const double shading[3],
	const struct view_pixel *pixel, bool parallel)
{
	double path[3] = {0.0, 0.0, -1.0};
	for (int i = 0; i < 3 && !parallel; i++)
		path[i] = -surface->position[i];
	bool outward = (dot(surface->normal, shading) > 0.0) == pixel->front;
	double toward = dot(surface->normal, path);
	return outward ? toward > 0.0 : toward < 0.0;
}

struct surface view_surface(const struct view *view, const struct view_pixel *pixel)
{
	const struct light_frame *frame = &view->light->frame;
	const struct mesh *mesh = &view->light->scene->meshes[pixel->object->mesh];
	const uint32_t *corner = &mesh->indices[3 * pixel->triangle];
	struct surface surface = {.offset = 0.0};
	double p[3][4], sides[2][3], shading[3] = {0.0, 0.0, 0.0};
	mat4 to_light;
	glm_mat4_mul((vec4 *)frame->world_to_light, (vec4 *)pixel->object->transform, to_light);
	for (int i = 0; i < 3; i++) {
		double normal[3];
		transform_point(to_light, mesh->positions[corner[i]], p[i]);
		transform_normal(to_light, mesh->normals[corner[i]], normal);
		for (int axis = 0; axis < 3; axis++) {
			surface.position[axis] += pixel->weights[i] * p[i][axis];
			shading[axis] += pixel->weights[i] * normal[axis];
		}
	}
	for (int axis = 0; axis < 3; axis++) {
		sides[0][axis] = p[1][axis] - p[0][axis];
		sides[1][axis] = p[2][axis] - p[0][axis];
	}
	cross(sides[0], sides[1], surface.normal);
	surface.offset = dot(surface.normal, p[0]);
	surface.faces_light = faces_light(&surface, shading, pixel, frame->parallel);
	return surface;
}
