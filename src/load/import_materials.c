/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "load/color.h"
#include "load/image.h"
#include "load/import_scene.h"
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXTURE_BYTES = 64 << 20 };

/** glTF's base colour is linear; the diffuse colour of older formats was chosen on a screen. */
static void base_color(const struct aiMaterial *material, float color[4])
{
	struct aiColor4D value = {1, 1, 1, 1};
	bool is_linear = aiGetMaterialColor(material, AI_MATKEY_BASE_COLOR, &value) == AI_SUCCESS;
	if (!is_linear)
		aiGetMaterialColor(material, AI_MATKEY_COLOR_DIFFUSE, &value);
	const float rgb[3] = {value.r, value.g, value.b};
	for (int i = 0; i < 3; i++)
		color[i] = is_linear ? rgb[i] : color_linear(fmaxf(rgb[i], 0));
	color[3] = 1;
}

/** Only glTF says so; models of other formats often show their backs. */
static bool is_single_sided(const struct import *import, const struct aiMaterial *material)
{
	int two_sided = 1;
	aiGetMaterialIntegerArray(material, AI_MATKEY_TWOSIDED, &two_sided, NULL);
	return import->is_gltf && !two_sided;
}

/** A picture's file beside the model: its path there, or failing that its bare name. */
static FILE *open_picture(const struct import *import, const char *name)
{
	char path[4096], cleaned[1024];
	const char *slash = strrchr(import->path, '/');
	int folder = slash != NULL ? (int)(slash - import->path) + 1 : 0;
	snprintf(cleaned, sizeof(cleaned), "%s", name);
	for (char *c = cleaned; *c != '\0'; c++)
		*c = *c == '\\' ? '/' : *c;
	snprintf(path, sizeof(path), "%.*s%s", cleaned[0] == '/' ? 0 : folder, import->path,
		cleaned);
	FILE *file = fopen(path, "rb");
	const char *bare = strrchr(cleaned, '/');
	if (file != NULL || bare == NULL)
		return file;
	snprintf(path, sizeof(path), "%.*s%s", folder, import->path, bare + 1);
	return fopen(path, "rb");
}

static const char *read_picture(struct import *import, const char *name, struct model_image *image)
{
	const char *problem = "not found";
	FILE *file = open_picture(import, name);
	if (file == NULL)
		return problem;
	uint8_t *bytes = array_alloc(TEXTURE_BYTES, 1);
	size_t size = bytes != NULL ? fread(bytes, 1, TEXTURE_BYTES, file) : 0;
	problem = size < TEXTURE_BYTES ? image_decode(import->model, bytes, size, image)
				       : "larger than 64 MiB";
	free(bytes);
	fclose(file);
	return problem;
}

/** Texels that the model file holds unpacked. */
static const char *copy_texels(
	struct model *model, const struct aiTexture *texture, struct model_image *image)
{
	uint8_t *rgba = image_alloc(model, texture->mWidth, texture->mHeight);
	if (rgba == NULL)
		return "too large";
	for (size_t i = 0; i < (size_t)texture->mWidth * texture->mHeight; i++) {
		const struct aiTexel *texel = &texture->pcData[i];
		memcpy(rgba + 4 * i, (uint8_t[4]){texel->r, texel->g, texel->b, texel->a}, 4);
	}
	*image = (struct model_image){texture->mWidth, texture->mHeight, rgba};
	return NULL;
}

/** The texture inside the model file of that name or, as "*N", number. */
static const struct aiTexture *find_embedded(const struct aiScene *scene, const char *name)
{
	if (name[0] == '*') {
		unsigned long index = strtoul(name + 1, NULL, 10);
		return index < scene->mNumTextures ? scene->mTextures[index] : NULL;
	}
	for (unsigned i = 0; i < scene->mNumTextures; i++)
		if (strcmp(scene->mTextures[i]->mFilename.data, name) == 0)
			return scene->mTextures[i];
	return NULL;
}

static const char *load_picture(struct import *import, const char *name, struct model_image *image)
{
	const struct aiTexture *texture = find_embedded(import->scene, name);
	if (texture == NULL)
		return read_picture(import, name, image);
	if (texture->mHeight == 0) /* then the width is the size of a packed file */
		return image_decode(import->model, texture->pcData, texture->mWidth, image);
	return copy_texels(import->model, texture, image);
}

/** The model's image of that name, loaded when first asked for; SM_NONE if it cannot be used. */
static uint32_t add_image(struct import *import, const struct aiString *name)
{
	struct model *model = import->model;
	size_t i = 0;
	while (i < model->image_count && strcmp(import->pictures[i].data, name->data) != 0)
		i++;
	if (i < model->image_count)
		return (uint32_t)i;
	const char *problem = load_picture(import, name->data, &model->images[i]);
	if (problem != NULL) {
		model_note(
			model, "%s: texture %s is left out: %s", import->path, name->data, problem);
		return SM_NONE;
	}
	import->pictures[i] = *name;
	return (uint32_t)model->image_count++;
}

static void add_material(struct import *import, unsigned index)
{
	static const enum aiTextureType types[] = {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE};
	const struct aiMaterial *source = import->scene->mMaterials[index];
	struct import_material *material = &import->materials[index];
	*material = (struct import_material){.image = SM_NONE};
	base_color(source, material->color);
	material->single_sided = is_single_sided(import, source);
	for (size_t k = 0; k < 2 && material->image == SM_NONE; k++) {
		struct aiString name;
		unsigned channel = 0;
		if (aiGetMaterialTexture(source, types[k], 0, &name, NULL, &channel, NULL, NULL,
			    NULL, NULL) != AI_SUCCESS)
			continue;
		material->image = add_image(import, &name);
		material->channel = channel < AI_MAX_NUMBER_OF_TEXTURECOORDS ? channel : 0;
	}
}

bool import_materials(struct import *import)
{
	struct model *model = import->model;
	size_t count = import->scene->mNumMaterials;
	import->materials = model_alloc(model, count, sizeof(*import->materials));
	import->pictures = model_alloc(model, count, sizeof(*import->pictures));
	model->images = model_alloc(model, count, sizeof(*model->images));
	if (import->materials == NULL || import->pictures == NULL || model->images == NULL)
		return import_fail_full(import);
	for (unsigned i = 0; i < count; i++)
		add_material(import, i);
	return true;
}
