/* SPDX-License-Identifier: MIT */
#ifndef GLES_GPU_SCENE_H
#define GLES_GPU_SCENE_H

#include "geom/clusters.h"
#include "gles/gl.h"
#include "scene/scene.h"

/** Attribute locations, the same in every program. */
enum attribute {
	ATTRIBUTE_POSITION,
	ATTRIBUTE_NORMAL,
	ATTRIBUTE_UV,
	ATTRIBUTE_OFFSET = ATTRIBUTE_NORMAL, /* fins */
	ATTRIBUTE_WIDTH = ATTRIBUTE_UV,
};

/** One mesh in GPU memory, twice: as seen, and welded, for the light's passes. */
struct gpu_mesh {
	GLuint surface, surface_vertices, surface_indices; /* vertex array, buffers */
	GLuint caster, caster_vertices, caster_indices;
	GLsizei surface_count, caster_count; /* indices */
	GLenum surface_type, caster_type;    /* of the indices: 16 bits where they fit */
	struct cluster *clusters;            /* of the surface; owned */
	size_t cluster_count;
};

/** The meshes and images of the scene that was drawn last. */
struct gpu_scene {
	uint64_t scene_id; /* 0: none */
	struct gpu_mesh *meshes;
	GLuint *images;
	size_t mesh_count, image_count;
};

/** Uploads what the scene has and this has not; another scene replaces all. Adds to *uploaded,
 *  bytes. Fails (MACHINE) for want of memory. */
bool gpu_scene_update(struct gpu_scene *gpu, struct gl *gl, const struct sm_scene *scene,
	uint64_t *uploaded, struct sm_error *error);
/** Fine on a zeroed one. */
void gpu_scene_finish(struct gpu_scene *gpu, struct gl *gl);

#endif
