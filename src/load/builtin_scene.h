/* SPDX-License-Identifier: MIT */
#ifndef LOAD_BUILTIN_SCENE_H
#define LOAD_BUILTIN_SCENE_H

#include "load/model.h"

/*
 * What builtin_build() chooses from. Scenes fill an empty model, or fail when it is full.
 *
 * The first six are the study scenes with which the shadows are judged against ray-traced truth:
 * square pictures, lit by a disc whose radius is .03 of its distance.
 */
bool builtin_cylinder(struct model *model);
bool builtin_boxes(struct model *model);
bool builtin_fence(struct model *model);
bool builtin_knot(struct model *model);
bool builtin_urchin(struct model *model);
bool builtin_debris(struct model *model);

/* The same shapes of another number of triangles, within 2 % from 20,000 on. The debris is one
 * object, its slabs the smaller the more there are. triangles: BUILTIN_TRIANGLES_MIN to _MAX. */
bool builtin_sized_knot(struct model *model, uint32_t triangles);
bool builtin_sized_urchin(struct model *model, uint32_t triangles);
bool builtin_sized_debris(struct model *model, uint32_t triangles);

/** A still life of the solids below, 9,388 triangles. */
bool builtin_primitives(struct model *model);

/** Adds a light that a scene brings along. */
bool builtin_add_light(struct model *model, const struct sm_light_desc *light);

/* Solids: one object of a model with room for it, standing on y = 0 in a cube of side 1 about the
 * y axis; NULL when the model is full. */
struct sm_object_desc *builtin_cube(struct model *model);
struct sm_object_desc *builtin_sphere(struct model *model);
struct sm_object_desc *builtin_icosahedron(struct model *model);
struct sm_object_desc *builtin_pillar(struct model *model);
struct sm_object_desc *builtin_cone(struct model *model);
struct sm_object_desc *builtin_torus(struct model *model);
struct sm_object_desc *builtin_vase(struct model *model);

#endif
