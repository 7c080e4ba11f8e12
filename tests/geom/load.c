/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "models.h"
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdlib.h>
#include <string.h>

static void count_up(const struct aiScene *scene, struct model *model)
{
	for (unsigned m = 0; m < scene->mNumMeshes; m++) {
		if (scene->mMeshes[m]->mPrimitiveTypes != aiPrimitiveType_TRIANGLE)
			continue;
		model->vertex_count += scene->mMeshes[m]->mNumVertices;
		model->index_count += 3 * (size_t)scene->mMeshes[m]->mNumFaces;
	}
}

static void copy(const struct aiScene *scene, struct model *model)
{
	uint32_t base = 0;
	uint32_t *index = model->indices;
	for (unsigned m = 0; m < scene->mNumMeshes; m++) {
		const struct aiMesh *mesh = scene->mMeshes[m];
		if (mesh->mPrimitiveTypes != aiPrimitiveType_TRIANGLE)
			continue;
		memcpy(model->positions[base], mesh->mVertices,
			mesh->mNumVertices * sizeof(*model->positions));
		for (unsigned f = 0; f < mesh->mNumFaces; f++)
			for (int k = 0; k < 3; k++)
				*index++ = base + mesh->mFaces[f].mIndices[k];
		base += mesh->mNumVertices;
	}
}

bool model_load(struct model *model, const char *path)
{
	*model = (struct model){0};
	const struct aiScene *scene =
		aiImportFile(path, aiProcess_Triangulate | aiProcess_SortByPType);
	if (scene == NULL)
		return false;
	count_up(scene, model);
	model->positions = array_alloc(model->vertex_count, sizeof(*model->positions));
	model->indices = array_alloc(model->index_count, sizeof(*model->indices));
	bool ok = model->positions != NULL && model->indices != NULL;
	if (ok)
		copy(scene, model);
	else
		model_finish(model);
	aiReleaseImport(scene);
	return ok;
}
