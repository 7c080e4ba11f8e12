/* SPDX-License-Identifier: MIT */
#include "load/import_scene.h"
#include <assimp/scene.h>
#include <cglm/cglm.h>
#include <string.h>

/* ---- meshes ---- */

static bool has_triangles(const struct aiMesh *mesh)
{
	return mesh->mPrimitiveTypes & aiPrimitiveType_TRIANGLE && mesh->mNumVertices > 0;
}

/** u and v of assimp's texture coordinates, which have a third for volumes. */
static float *copy_uvs(struct model *model, const struct aiVector3D *vectors, size_t count)
{
	float *uvs = model_alloc(model, count, 2 * sizeof(*uvs));
	for (size_t i = 0; uvs != NULL && i < count; i++) {
		uvs[2 * i] = vectors[i].x;
		uvs[2 * i + 1] = vectors[i].y;
	}
	return uvs;
}

static float *copy_vectors(struct model *model, const struct aiVector3D *vectors, size_t count)
{
	_Static_assert(sizeof(*vectors) == 3 * sizeof(float), "assimp built with doubles");
	float *copy = model_alloc(model, count, sizeof(*vectors));
	return copy != NULL ? memcpy(copy, vectors, count * sizeof(*vectors)) : NULL;
}

static uint32_t *copy_triangles(struct model *model, const struct aiMesh *mesh, size_t *count)
{
	uint32_t *indices = model_alloc(model, mesh->mNumFaces, 3 * sizeof(*indices));
	*count = 0;
	for (unsigned i = 0; indices != NULL && i < mesh->mNumFaces; i++) {
		const struct aiFace *face = &mesh->mFaces[i];
		if (face->mNumIndices != 3)
			continue;
		memcpy(indices + *count, face->mIndices, 3 * sizeof(*indices));
		*count += 3;
	}
	return indices;
}

static bool add_mesh(struct import *import, unsigned index)
{
	struct model *model = import->model;
	const struct aiMesh *mesh = import->scene->mMeshes[index];
	struct sm_mesh_desc *desc = &model->meshes[model->mesh_count];
	desc->name = model_string(model, mesh->mName.data);
	desc->vertex_count = mesh->mNumVertices;
	desc->positions = copy_vectors(model, mesh->mVertices, mesh->mNumVertices);
	desc->indices = copy_triangles(model, mesh, &desc->index_count);
	if (mesh->mNormals != NULL)
		desc->normals = copy_vectors(model, mesh->mNormals, mesh->mNumVertices);
	const struct aiVector3D *uvs =
		mesh->mTextureCoords[import->materials[mesh->mMaterialIndex].channel];
	if (uvs != NULL)
		desc->uvs = copy_uvs(model, uvs, mesh->mNumVertices);
	if (desc->name == NULL || desc->positions == NULL || desc->indices == NULL ||
		(mesh->mNormals != NULL && desc->normals == NULL) ||
		(uvs != NULL && desc->uvs == NULL))
		return import_fail_full(import);
	import->meshes[index] = (uint32_t)model->mesh_count++;
	return true;
}

static bool add_meshes(struct import *import)
{
	struct model *model = import->model;
	size_t count = import->scene->mNumMeshes;
	import->meshes = model_alloc(model, count, sizeof(*import->meshes));
	model->meshes = model_alloc(model, count, sizeof(*model->meshes));
	if (import->meshes == NULL || model->meshes == NULL)
		return import_fail_full(import);
	for (unsigned i = 0; i < count; i++) {
		import->meshes[i] = SM_NONE;
		if (has_triangles(import->scene->mMeshes[i]) && !add_mesh(import, i))
			return false;
	}
	return true;
}

/* ---- nodes ---- */

static size_t count_objects(const struct import *import, const struct aiNode *node)
{
	size_t count = 0;
	for (unsigned i = 0; i < node->mNumMeshes; i++)
		count += import->meshes[node->mMeshes[i]] != SM_NONE;
	for (unsigned i = 0; i < node->mNumChildren; i++)
		count += count_objects(import, node->mChildren[i]);
	return count;
}

/** Whether an object has the mesh that the model has of assimp's. */
static bool is_taken(const struct import *import, unsigned index)
{
	const struct model *model = import->model;
	for (size_t i = 0; i < model->object_count; i++)
		if (model->objects[i].mesh == import->meshes[index])
			return true;
	return false;
}

static bool add_object(struct import *import, const struct aiNode *node, unsigned index, mat4 world)
{
	struct model *model = import->model;
	const struct aiMesh *mesh = import->scene->mMeshes[index];
	const struct import_material *material = &import->materials[mesh->mMaterialIndex];
	/* Vertices that move are an object's own. */
	if (import_deforms(mesh) && is_taken(import, index) && !add_mesh(import, index))
		return false;
	import->parts[model->object_count] = (struct import_part){node, mesh};
	struct sm_object_desc *object = &model->objects[model->object_count++];
	*object = (struct sm_object_desc){
		.name = model_string(model, node->mName.data),
		.mesh = import->meshes[index],
		.image = model->meshes[import->meshes[index]].uvs != NULL ? material->image
									  : SM_NONE,
		.casts = true,
		.receives = true,
		.single_sided = material->single_sided,
	};
	memcpy(object->transform, world, sizeof(object->transform));
	memcpy(object->base_color, material->color, sizeof(object->base_color));
	return true;
}

static bool add_node(struct import *import, const struct aiNode *node, mat4 parent)
{
	mat4 local, world;
	import_matrix(&node->mTransformation, local);
	glm_mat4_mul(parent, local, world);
	for (unsigned i = 0; i < node->mNumMeshes; i++)
		if (import->meshes[node->mMeshes[i]] != SM_NONE &&
			!add_object(import, node, node->mMeshes[i], world))
			return false;
	for (unsigned i = 0; i < node->mNumChildren; i++)
		if (!add_node(import, node->mChildren[i], world))
			return false;
	return true;
}

/** Room for so many objects, and for a mesh of its own for each, and all of them. */
static bool add_objects(struct import *import)
{
	struct model *model = import->model;
	const struct aiNode *root = import->scene->mRootNode;
	size_t count = count_objects(import, root);
	if (count == 0)
		return import_fail(import, "without triangles");
	model->objects = model_alloc(model, count, sizeof(*model->objects));
	import->parts = model_alloc(model, count, sizeof(*import->parts));
	struct sm_mesh_desc *meshes =
		model_alloc(model, model->mesh_count + count, sizeof(*meshes));
	if (model->objects == NULL || import->parts == NULL || meshes == NULL)
		return import_fail_full(import);
	memcpy(meshes, model->meshes, model->mesh_count * sizeof(*meshes));
	model->meshes = meshes;
	mat4 turn;
	import_turn(import, turn);
	return add_node(import, root, turn) &&
	       (import_rig(import->scene, import->parts, turn, import->path, model) ||
		       import_fail_full(import));
}

bool import_objects(struct import *import)
{
	return add_meshes(import) && add_objects(import);
}
