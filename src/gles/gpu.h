/* SPDX-License-Identifier: MIT */
#ifndef GLES_GPU_H
#define GLES_GPU_H

#include "base/workers.h"
#include "gles/gpu_scene.h"
#include "gles/program.h"
#include "gles/skip.h"
#include "gles/texture_unit.h"
#include "gles/way.h"

/** What every pass works with: the context's functions and abilities, programs, the scene's
 *  geometry, and the counters of the frame. */
struct gpu {
	struct gl gl;
	struct caps caps;
	struct ways ways;
	struct program_cache programs;
	struct gpu_scene scene;
	GLuint quad_indices; /* 0 1 2, 0 2 3 for each quad */
	size_t quad_capacity;
	GLuint stored_sampler; /* reads sRGB texels as they are stored; made on first use */
	uint32_t raster_bits;  /* see raster_grid.h; 0 until it is asked for */
	bool flat_inputs;      /* surfaces have them */
	struct sm_frame_stats stats;
	struct skips skips;
	struct workers workers; /* share the search of large meshes, or find edges aside */
	uint64_t failures;      /* frames that failed: nobody knows what they left in textures */
};

/** Fails as sm_renderer_create_with(). */
bool gpu_init(struct gpu *gpu, sm_get_proc get_proc, const struct sm_driver_options *options,
	struct sm_error *error);
/** Fine on a half-made one. */
void gpu_finish(struct gpu *gpu);

/**
 * Before an object's triangles are drawn: which way they are wound (a mirroring transform turns
 * that), and whether back faces are left out, as they are of a solid that lies wholly beyond the
 * near plane, and if `single_sided` anyway. to_clip: object to clip space.
 */
void gpu_set_faces(
	struct gpu *gpu, const struct mesh *mesh, mat4 transform, mat4 to_clip, bool single_sided);

/** Draws clusters of a mesh as seen, with the program in use. */
void gpu_draw_surface(
	struct gpu *gpu, const struct gpu_mesh *mesh, size_t first_cluster, size_t cluster_count);

/** Draws triangles of a mesh as seen by other indices, of 32 bits, in a buffer. */
void gpu_draw_indices(
	struct gpu *gpu, const struct gpu_mesh *mesh, GLuint buffer, size_t first, size_t count);

/** Draws a mesh as a caster. */
void gpu_draw_caster(struct gpu *gpu, const struct gpu_mesh *mesh);

/** Draws the sheets of a caster that count under the rule: of those that do on one side the
 *  triangles that face, of the others all. Sets which faces are drawn. */
void gpu_draw_sheets(struct gpu *gpu, const struct gpu_mesh *mesh, const struct sheet_rule *rule);

/** Draws quads of the bound vertex array, four vertices each, whatever their number; fails
 *  (MACHINE) for want of memory. */
bool gpu_draw_quads(struct gpu *gpu, size_t quad_count, struct sm_error *error);

void gpu_bind_texture(struct gpu *gpu, enum texture_unit unit, GLuint texture);
/** The same with an array. */
void gpu_bind_layers(struct gpu *gpu, enum texture_unit unit, GLuint texture);

/** A sampler that compares (LEQUAL), clamped to the edge, for the caller to delete. filter:
 * GL_NEAREST or GL_LINEAR. */
GLuint gpu_create_compare_sampler(struct gpu *gpu, GLint filter);

/** Has a unit's sRGB texels read as they are stored. Takes EXT_texture_sRGB_decode. */
void gpu_bind_stored_sampler(struct gpu *gpu, enum texture_unit unit);

/** Draws one triangle over the whole viewport, with the program in use (copy.vert) and `texture`
 *  as its base texture. */
void gpu_fill_viewport(struct gpu *gpu, GLuint texture);
/** The same triangle, at half the depth, under what tests are on. */
void gpu_fill_tested(struct gpu *gpu);

/** Sets GL's state to what sm_renderer_draw() promises to leave. */
void gpu_restore_state(struct gpu *gpu);

#endif
