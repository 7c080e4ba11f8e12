/* SPDX-License-Identifier: MIT */
#include "edge.h"
#include "parts.h"
#include "ref/vector.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* The plate's edge runs along z at x = 0. All lengths are multiples of 1/8, so that scenes moved by
 * 2^20 are the same to the last bit. */
#define PLATE_HEIGHT 4.0
static const double lamp[3] = {1, 8, -1}, aim[3] = {0, 0, 0};
static const double eye[3] = {2, 3, 5}, target[3] = {0.5, 0, 0};
#define FOV 45.0

static void put(const struct edge *edge, const double point[3], float placed[3])
{
	for (int i = 0; i < 3; i++)
		placed[i] = (float)(point[i] * edge->scale + (i == 0 ? edge->shift : 0.0));
}

static uint32_t add_square(
	struct edge *edge, uint32_t mesh, unsigned int role, double half, const double middle[3])
{
	float size = (float)(half * edge->scale);
	struct pose pose = {.scale = {size, size, size}};
	put(edge, middle, pose.position);
	return parts_add_object(edge->scene, mesh, role, &pose);
}

void edge_init(struct edge *edge, enum sm_light_type type, float radius, double scale, double shift)
{
	*edge = (struct edge){.scene = sm_scene_create(), .scale = scale, .shift = shift};
	assert_non_null(edge->scene);
	uint32_t mesh = parts_add_square(edge->scene);
	add_square(edge, mesh, PART_BOTH, 64, (double[3]){0, 0, 0});
	edge->plate = add_square(edge, mesh, PART_BOTH, 32, (double[3]){-32, PLATE_HEIGHT, 0});
	edge->light = (struct sm_light_desc){
		.type = type, .radius = (float)(radius * scale), .angle = 160};
	put(edge, lamp, edge->light.position);
	put(edge, aim, edge->light.target);
	parts_add_light(edge->scene, &edge->light);
	edge->request = (struct reference_request){
		.scene = edge->scene,
		.camera = {.up = {0, 1, 0}, .fov = FOV},
		.width = EDGE_WIDTH,
		.height = EDGE_HEIGHT,
	};
	put(edge, eye, edge->request.camera.eye);
	put(edge, target, edge->request.camera.target);
}

void edge_finish(struct edge *edge)
{
	sm_scene_destroy(edge->scene);
}

void edge_trace(struct reference *reference, const struct edge *edge)
{
	struct sm_error error;
	if (!reference_trace(reference, &edge->request, &error))
		fail_msg("%s", error.text);
}

static void find_ground(uint32_t x, uint32_t y, double ground[3])
{
	double axis[3], right[3], up[3], ray[3], half = tan(FOV * M_PI / 360);
	vector_subtract(target, eye, axis);
	vector_normalise(axis);
	vector_cross(axis, (double[3]){0, 1, 0}, right);
	vector_normalise(right);
	vector_cross(right, axis, up);
	vector_add(axis, half * EDGE_WIDTH / EDGE_HEIGHT * (2 * (x + .5) / EDGE_WIDTH - 1), right,
		ray);
	vector_add(ray, half * (1 - 2 * (y + .5) / EDGE_HEIGHT), up, ray);
	assert_true(ray[1] < 0);
	vector_add(eye, eye[1] / -ray[1], ray, ground);
}

/*
 * The plane through the point and the edge cuts the light's disc in a straight line: at s radii
 * from its middle, s > 0 where more than half is seen. A circular segment is
 * (acos s - s sqrt(1 - s^2)) / pi of its disc.
 */
double edge_visibility(const struct edge *edge, uint32_t x, uint32_t y)
{
	const double edge_point[3] = {0, PLATE_HEIGHT, 0}, along[3] = {0, 0, 1};
	double ground[3], path[3], arm[3], normal[3], radius = edge->light.radius / edge->scale;
	find_ground(x, y, ground);
	vector_subtract(lamp, edge->light.type == SM_LIGHT_SPOT ? ground : aim, path);
	vector_subtract(edge_point, ground, arm);
	/* Towards the side where there is no plate. */
	vector_cross(arm, along, normal);
	double across = vector_dot(normal, path) / vector_length(path);
	double in_disc = sqrt(vector_dot(normal, normal) - across * across);
	double s = vector_dot(normal, path) / (radius * in_disc);
	if (s >= 1)
		return 1;
	return s <= -1 ? 0 : 1 - (acos(s) - s * sqrt(1 - s * s)) / M_PI;
}

double edge_error(const struct edge *edge, const struct reference *reference, uint32_t *count)
{
	double sum = 0;
	*count = 0;
	for (uint32_t y = 0; y < EDGE_HEIGHT; y++) {
		for (uint32_t x = 0; x < EDGE_WIDTH; x++) {
			double v = edge_visibility(edge, x, y);
			double found = reference->visibility[y * EDGE_WIDTH + x];
			if (v > 0 && v < 1) {
				sum += (found - v) * (found - v);
				++*count;
			} else if (found != v) {
				fail_msg("pixel %u, %u sees %g, not %g", x, y, found, v);
			}
		}
	}
	assert_true(*count > 0);
	return sqrt(sum / *count);
}
