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
};

/** As seen: 32 bytes, interleaved. */
struct surface_vertex {
	float position[3], normal[3], uv[2];
};

/** One mesh in GPU memory, twice: as seen, and welded, for the light's passes. */
struct gpu_mesh {
	GLuint surface, surface_vertices, surface_indices; /* vertex array, buffers */
	GLuint caster, caster_vertices, caster_indices;
	GLsizei surface_count, caster_count; /* indices */
	GLenum surface_type, caster_type;    /* of the indices: 16 bits where they fit */
	struct cluster *clusters;            /* of the surface; owned */
	float *rises;                        /* of its vertices, see geom/averted.h; owned */
	size_t cluster_count, vertex_count;
	uint64_t version; /* of the scene's mesh whose vertices these are */
};

/** The meshes and images of the scene that was drawn last. */
struct gpu_scene {
	uint64_t scene_id; /* 0: none */
	struct gpu_mesh *meshes;
	GLuint *images;
	size_t mesh_count, image_count;
	size_t mesh_capacity, image_capacity;
	/* Working memory, kept so that a mesh that moves allocates once; owned. */
	struct surface_vertex *vertices;
	size_t vertex_capacity;
};

/** Uploads what the scene has and this has not, and vertices that have moved since; another scene
 * replaces all. Adds to *uploaded, bytes. Fails (MACHINE) for want of memory. */
bool gpu_scene_update(struct gpu_scene *gpu, struct gl *gl, const struct sm_scene *scene,
	uint64_t *uploaded, struct sm_error *error);
/** Fine on a zeroed one. */
void gpu_scene_finish(struct gpu_scene *gpu, struct gl *gl);

#endif
