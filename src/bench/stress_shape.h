/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STRESS_SHAPE_H
#define BENCH_STRESS_SHAPE_H

#include "bench/stress_scene.h"

/* What stress scenes are made of. Each fails (MACHINE) without memory and leaves the mesh empty. */

/** One triangle, (0, 0, -1) (-1, 0, 1) (1, 0, 1), facing +y. */
bool stress_shape_triangle(struct stress_mesh *mesh, struct sm_error *error);
/** x, z in [-1, 1] at y = 0, facing +y. */
bool stress_shape_square(struct stress_mesh *mesh, struct sm_error *error);
/** The same square as a fan around a corner, with two triangles `aspect` times as long as wide. */
bool stress_shape_slivers(struct stress_mesh *mesh, double aspect, struct sm_error *error);
/** [-1, 1]^3 */
bool stress_shape_cube(struct stress_mesh *mesh, struct sm_error *error);
/** Of radius 1, closed: 4 steps (steps - 1) triangles with an area, and 4 steps without, at the
 *  poles. */
bool stress_shape_sphere(struct stress_mesh *mesh, uint32_t steps, struct sm_error *error);

/** Adds further triangles of vertices that are there; `corners` holds three indices each. */
bool stress_shape_extend(struct stress_mesh *mesh, const uint32_t *corners, size_t index_count,
	struct sm_error *error);

#endif
