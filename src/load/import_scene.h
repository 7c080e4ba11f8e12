/* SPDX-License-Identifier: MIT */
#ifndef LOAD_IMPORT_SCENE_H
#define LOAD_IMPORT_SCENE_H

#include "load/import_rig.h"
#include "load/plan.h"

/*
 * What the parts of import.c share, which turn assimp's scene into a model. They run in the child;
 * what fails has filled the model's error.
 */

struct import_material {
	float color[4];
	uint32_t image;   /**< of the model, or SM_NONE */
	unsigned channel; /**< of the texture coordinates */
	bool single_sided;
};

struct import {
	const char *path;
	bool is_gltf;
	bool is_turned; /**< by assimp, from z up to y up */
	enum plan_up up;
	struct model *model;
	const struct aiScene *scene;
	/* Working memory, of the model. */
	uint32_t *meshes;                  /* [scene->mNumMeshes]: the model's mesh, or SM_NONE */
	struct import_part *parts;         /* [model->object_count] */
	struct import_material *materials; /* [scene->mNumMaterials] */
	struct aiString *pictures;         /* [model->image_count]: what the images are called */
};

/** False, with "path: cause". */
bool import_fail(struct import *import, const char *cause);
/** The same for a model that is full. */
bool import_fail_full(struct import *import);

/** From the file's space to y up. */
void import_turn(const struct import *import, mat4 turn);

/** Base colours and their pictures; those that cannot be had are left out with a note. */
bool import_materials(struct import *import);

/** Triangles, at rest, where the scene's nodes put them, and the rig; after the materials. */
bool import_objects(struct import *import);

/** The first camera in perspective whose numbers make sense. */
void import_camera(struct import *import);
bool import_lights(struct import *import);

#endif
