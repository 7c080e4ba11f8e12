/* SPDX-License-Identifier: MIT */
#ifndef TESTS_GEOM_MODELS_H
#define TESTS_GEOM_MODELS_H

#include <smoothie.h>

/** Triangles to try things on. */
struct model {
	size_t vertex_count;
	float (*positions)[3];
	size_t index_count;
	uint32_t *indices;
};

void model_finish(struct model *model);
struct sm_mesh_desc model_desc(const struct model *model, const char *name);

/** Models made here; they abort when out of memory. Unless said otherwise they are closed, of unit
 *  size and seen counter-clockwise from outside. */
struct model model_tetrahedron(void);
struct model model_cube(void);
/** 8 * 4^levels triangles, each with vertices of its own. */
struct model model_sphere(unsigned levels);
/** size x size squares, open all around. */
struct model model_grid(unsigned size);
struct model model_strip(void);
/** Five triangles around one edge. */
struct model model_fan(void);
/** One-sided: somewhere two neighbours run through their edge the same way. */
struct model model_moebius(void);
/** A cube with each face there twice, the second time turned over when `turned`. */
struct model model_doubled(bool turned);
/** Triangles between random vertices, some of them with a vertex twice. */
struct model model_soup(size_t vertex_count, size_t triangle_count);

/** The model with each edge split into `parts` and each triangle, in its own plane, into as many
 *  squared. */
struct model model_split(const struct model *model, unsigned parts);

/** All meshes of a file as one, each in its own space; false if it cannot be read. */
bool model_load(struct model *model, const char *path);

/** Calls visit for a model of each kind above and for the .glb files in folder/models, if there are
 *  any. */
void models_visit(const char *folder, void (*visit)(const char *name, const struct model *model));

/** The same for spheres near the ends of what floats hold, in size and place. */
void models_visit_extremes(void (*visit)(const char *name, const struct model *model));

/** A repeatable sequence; start with any state but 0. */
uint32_t random_next(uint64_t *state);
/** In [-1, 1). */
float random_signed(uint64_t *state);

#endif
