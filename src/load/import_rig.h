/* SPDX-License-Identifier: MIT */
#ifndef LOAD_IMPORT_RIG_H
#define LOAD_IMPORT_RIG_H

#include "load/model.h"
#include <assimp/scene.h>
#include <cglm/cglm.h>

/** What an object of the model was made of. */
struct import_part {
	const struct aiNode *node;
	const struct aiMesh *mesh;
};

/** assimp's matrices are row-major. */
void import_matrix(const struct aiMatrix4x4 *source, mat4 matrix);

/** Whether its vertices may move: it has bones or targets. Such a mesh must not be shared between
 *  objects. */
bool import_deforms(const struct aiMesh *mesh);

/** The rig's node for the first node of that name; 0, which stands still, if there is none. */
uint32_t import_rig_node(const struct aiScene *scene, const char *name);

/**
 * Fills the model's rig from a scene that has animations, or meshes with bones or targets; from
 * another it stays empty. A channel whose numbers make no sense, or whose node is missing, is left
 * out with a note.
 *
 * parts: [model->object_count]; turn: from the scene's space to the model's. False:
 * the model is full.
 */
bool import_rig(const struct aiScene *scene, const struct import_part *parts, mat4 turn,
	const char *path, struct model *model);

#endif
