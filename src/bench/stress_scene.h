/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STRESS_SCENE_H
#define BENCH_STRESS_SCENE_H

#include <smoothie.h>

#define STRESS_OBJECTS_MAX 8
#define STRESS_LIGHTS_MAX 64

/** Triangles without normals. */
struct stress_mesh {
	float (*positions)[3]; /* owned */
	uint32_t *indices;     /* owned */
	size_t vertex_count, index_count;
};

/** Scaled, then turned about x, y and z in this order (degrees), then moved. */
struct stress_object {
	struct stress_mesh mesh;
	float position[3], rotation[3], scale[3];
	bool casts, receives;
};

/** All that a picture comes of, as plain numbers that can be changed one by one and written as a
 *  scene file. Zero is empty. */
struct stress_scene {
	struct stress_object objects[STRESS_OBJECTS_MAX];
	size_t object_count;
	struct sm_light_desc lights[STRESS_LIGHTS_MAX];
	size_t light_count;
	struct sm_camera camera;
	struct sm_shadow_options shadow;
	uint32_t width, height;
};

/** Fails (MACHINE) without memory, and leaves *copy empty. */
bool stress_scene_copy(
	struct stress_scene *copy, const struct stress_scene *scene, struct sm_error *error);
/** Fine on a failed copy. */
void stress_scene_finish(struct stress_scene *scene);

/** Room for a mesh, zeroed. Fails (MACHINE), and leaves it empty. */
bool stress_mesh_init(
	struct stress_mesh *mesh, size_t vertex_count, size_t index_count, struct sm_error *error);
void stress_mesh_finish(struct stress_mesh *mesh);

/** An object at the origin, unscaled, that casts and receives; takes the mesh. There must be room
 *  for one more. */
struct stress_object *stress_scene_add(struct stress_scene *scene, struct stress_mesh mesh);

/** As the renderer draws it, or NULL (INPUT, MACHINE). Destroy with sm_scene_destroy(). */
struct sm_scene *stress_scene_build(const struct stress_scene *scene, struct sm_error *error);

/** Makes every length so many times as long. */
void stress_scene_scale(struct stress_scene *scene, double factor);
/** Moves everything, the camera too. */
void stress_scene_move(struct stress_scene *scene, const double offset[3]);

#endif
