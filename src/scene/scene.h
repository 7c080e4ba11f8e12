/* SPDX-License-Identifier: MIT */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include "geom/mesh.h"
#include "geom/sheets.h"
#include <cglm/cglm.h>
#include <smoothie.h>

struct image {
	uint32_t width, height;
	uint8_t *rgba; /* sRGB, owned */
};

struct object {
	char *name; /* may be NULL; owned */
	uint32_t mesh, image;
	mat4 transform;
	vec3 base_color;
	bool casts, receives, single_sided;
	vec3 min, max;    /* world space */
	uint64_t version; /* of all of the above but the name, and of the mesh's vertices */
};

struct light {
	char *name;                /* may be NULL; owned */
	struct sm_light_desc desc; /* its name points to the one above */
	uint64_t version;          /* of all but the name */
};

struct sm_scene {
	uint64_t id; /* unique in the process, never 0 */
	struct mesh *meshes;
	struct image *images;
	struct object *objects;
	struct light *lights;
	size_t mesh_count, image_count, object_count, light_count;
	size_t mesh_capacity, image_capacity, object_capacity, light_capacity;
	struct sm_environment environment;
	uint64_t version;
};

/** The scene's next version, for what in it changes now: what is made of parts of a scene is made
 *  anew where one of them has a greater version than before. Never 0. */
uint64_t scene_next_version(struct sm_scene *scene);

/** Sets min and max from mesh and transform. */
void object_update_bounds(const struct sm_scene *scene, struct object *object);

/** Whether nothing that the mesh shows with its back is ever in front: it is solid, and all of its
 *  box beyond the near plane. */
bool mesh_hides_back(const struct mesh *mesh, mat4 to_clip);

/** Whether all of the mesh's box is beyond the near plane. */
bool mesh_beyond_near(const struct mesh *mesh, mat4 to_clip);

/** Which of the caster's triangles count for a light: those of closed parts on one side, unless the
 *  near plane might cut the mesh open. transform: of the object; to_clip: object to the light's
 *  clip space. */
struct sheet_rule mesh_sheet_rule(const struct mesh *mesh, mat4 transform, mat4 to_clip);

#endif
