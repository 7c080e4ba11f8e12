/* SPDX-License-Identifier: MIT */
#ifndef GEOM_MESH_H
#define GEOM_MESH_H

#include "geom/caster.h"
#include <smoothie.h>

struct mesh {
	char *name; /* may be NULL */

	/* As drawn: identical vertices merged, in an order good for a vertex cache. */
	size_t vertex_count;
	float (*positions)[3]; /* [vertex_count], without negative zeros */
	float (*normals)[3];   /* unit */
	float (*uvs)[2];       /* finite; zero when the description has none */
	uint32_t *sources;     /* [vertex_count]: one of the description's that it is made of */
	size_t source_count;   /* vertices of the description */
	size_t index_count;
	uint32_t *indices;
	size_t empty_count; /* triangles left out, between fewer than three vertices */

	struct caster caster;
	bool solid; /* back faces need not be drawn from outside the box */

	float min[3], max[3]; /* box around the vertices in use */
	struct sm_mesh_stats stats;
	uint64_t version; /* of positions and normals, the scene's, which sets it */
};

/**
 * Copies and prepares what the description holds. Missing normals are the triangles' own, one a
 * corner; a normal without direction becomes the mean of the triangles around it, or +z where they
 * have none either. A uv that is not finite becomes zero. Fails (INPUT, naming the mesh) as
 * sm_scene_add_mesh() says, or for lack of memory (MACHINE).
 */
bool mesh_init(struct mesh *mesh, const struct sm_mesh_desc *desc, struct sm_error *error);
void mesh_finish(struct mesh *mesh);

/** The box that mesh_set_vertices() would give the mesh, finite where all positions are. */
void mesh_box_of(const struct mesh *mesh, const float *positions, float min[3], float max[3]);

/**
 * Moves the vertices, positions and normals as sm_scene_set_vertices() says; what mesh_init() found
 * of vertices that coincide, of windings and of parts stays. The mesh is not solid from then on:
 * how it folds is not looked into. *changed: whether anything does. Fails (INPUT) on a position
 * that is not finite, or for lack of memory (MACHINE), and changes nothing then.
 */
bool mesh_set_vertices(struct mesh *mesh, const float *positions, const float *normals,
	bool *changed, struct sm_error *error);

#endif
