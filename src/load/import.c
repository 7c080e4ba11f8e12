/* SPDX-License-Identifier: MIT */
#include "load/import.h"
#include "base/array.h"
#include "base/log.h"
#include "load/child.h"
#include "load/color.h"
#include "load/image.h"
#include "load/import_rig.h"
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cglm/cglm.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum {
	SECONDS = 8,
	SECONDS_PER_MIB = 1,
	MEMORY_BYTES = 1 << 30, /* for assimp, beside the model */
	TEXTURE_BYTES = 64 << 20,
};

struct material {
	float color[4];
	uint32_t image;   /* of the model, or SM_NONE */
	unsigned channel; /* of the texture coordinates */
	bool single_sided;
};

struct import {
	const char *path;
	bool is_gltf;
	bool is_turned; /* by assimp, from z up to y up */
	enum plan_up up;
	struct model *model;
	const struct aiScene *scene;
	uint32_t *meshes;           /* [scene->mNumMeshes]: the model's mesh, or SM_NONE */
	struct import_part *parts;  /* [model->object_count] */
	struct material *materials; /* [scene->mNumMaterials] */
	struct aiString *pictures;  /* [model->image_count]: what the images are called */
};

static bool fail(struct import *import, const char *cause)
{
	return error_set(&import->model->error, SM_ERROR_INPUT, "%s: %s", import->path, cause);
}

static bool fail_full(struct import *import)
{
	return fail(import, "too large a model for this machine");
}

/* ---- materials ---- */

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
	struct material *material = &import->materials[index];
	*material = (struct material){.image = SM_NONE};
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
		return fail_full(import);
	import->meshes[index] = (uint32_t)model->mesh_count++;
	return true;
}

static bool add_meshes(struct import *import)
{
	for (unsigned i = 0; i < import->scene->mNumMeshes; i++) {
		import->meshes[i] = SM_NONE;
		if (has_triangles(import->scene->mMeshes[i]) && !add_mesh(import, i))
			return false;
	}
	return true;
}

/* ---- nodes ---- */

/** assimp's matrices are row-major. */
static void copy_matrix(const struct aiMatrix4x4 *source, mat4 matrix)
{
	memcpy(matrix, source, sizeof(mat4));
	glm_mat4_transpose(matrix);
}

/** From the file's space to y up. */
static void turn_up(const struct import *import, mat4 turn)
{
	glm_mat4_identity(turn);
	if (import->up == PLAN_UP_Z && !import->is_turned)
		glm_rotate_x(turn, -GLM_PI_2f, turn);
	else if (import->up == PLAN_UP_Y && import->is_turned)
		glm_rotate_x(turn, GLM_PI_2f, turn);
}

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
	const struct material *material = &import->materials[mesh->mMaterialIndex];
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
	copy_matrix(&node->mTransformation, local);
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
		return fail(import, "without triangles");
	model->objects = model_alloc(model, count, sizeof(*model->objects));
	import->parts = model_alloc(model, count, sizeof(*import->parts));
	struct sm_mesh_desc *meshes =
		model_alloc(model, model->mesh_count + count, sizeof(*meshes));
	if (model->objects == NULL || import->parts == NULL || meshes == NULL)
		return fail_full(import);
	memcpy(meshes, model->meshes, model->mesh_count * sizeof(*meshes));
	model->meshes = meshes;
	mat4 turn;
	turn_up(import, turn);
	return add_node(import, root, turn) &&
	       (import_rig(import->scene, import->parts, turn, import->path, model) ||
		       fail_full(import));
}

static const struct aiNode *find_node(const struct aiNode *node, const char *name)
{
	if (strcmp(node->mName.data, name) == 0)
		return node;
	const struct aiNode *found = NULL;
	for (unsigned i = 0; found == NULL && i < node->mNumChildren; i++)
		found = find_node(node->mChildren[i], name);
	return found;
}

/** From the space of the node of that name, if there is one, to the model's. */
static void find_space(const struct import *import, const struct aiString *name, mat4 space)
{
	const struct aiNode *node = find_node(import->scene->mRootNode, name->data);
	glm_mat4_identity(space);
	for (; node != NULL; node = node->mParent) {
		mat4 local;
		copy_matrix(&node->mTransformation, local);
		glm_mat4_mul(local, space, space);
	}
	mat4 turn;
	turn_up(import, turn);
	glm_mat4_mul(turn, space, space);
}

static void to_point(mat4 space, const struct aiVector3D *point, float result[3])
{
	glm_mat4_mulv3(space, (vec3){point->x, point->y, point->z}, 1, result);
}

/** A direction of length 1, or 0 0 0. */
static void to_direction(mat4 space, const struct aiVector3D *direction, float result[3])
{
	glm_mat4_mulv3(space, (vec3){direction->x, direction->y, direction->z}, 0, result);
	glm_vec3_normalize(result);
}

/* ---- cameras and lights ---- */

/** Vertical field of view in degrees. assimp 5.2 makes glTF's vertical angle "horizontal" by a
 *  product with the aspect; the other formats have a true horizontal angle. */
static float vertical_fov(const struct import *import, const struct aiCamera *camera, float aspect)
{
	float fov = camera->mHorizontalFOV;
	if (!import->is_gltf)
		return glm_deg(2 * atanf(tanf(fov / 2) / aspect));
	return glm_deg(camera->mAspect > 0 ? fov / camera->mAspect : fov);
}

static bool is_usable(const struct sm_camera *camera)
{
	float values[10];
	memcpy(values, camera->eye, sizeof(camera->eye));
	memcpy(values + 3, camera->target, sizeof(camera->target));
	memcpy(values + 6, camera->up, sizeof(camera->up));
	values[9] = camera->fov;
	for (int i = 0; i < 10; i++)
		if (!isfinite(values[i]))
			return false;
	vec3 ahead, side;
	glm_vec3_sub((float *)camera->target, (float *)camera->eye, ahead);
	glm_vec3_cross(ahead, (float *)camera->up, side);
	return glm_vec3_norm2(side) > 0 && camera->fov >= 1 && camera->fov <= 170;
}

/** Takes the first camera in perspective whose numbers make sense. */
static void add_camera(struct import *import)
{
	struct model *model = import->model;
	const uint32_t height = 960;
	for (unsigned i = 0; i < import->scene->mNumCameras && !model->has_camera; i++) {
		const struct aiCamera *source = import->scene->mCameras[i];
		float aspect =
			source->mAspect > .1f && source->mAspect < 10 ? source->mAspect : 4 / 3.f;
		struct sm_camera camera = {.fov = vertical_fov(import, source, aspect)};
		/* assimp 5.2 repeats the node's translation as the position within the node. */
		struct aiVector3D position =
			import->is_gltf ? (struct aiVector3D){0} : source->mPosition;
		mat4 space;
		find_space(import, &source->mName, space);
		to_point(space, &position, camera.eye);
		to_direction(space, &source->mLookAt, camera.target);
		glm_vec3_add(camera.target, camera.eye, camera.target);
		to_direction(space, &source->mUp, camera.up);
		model->camera = camera;
		model->camera_node = import_rig_node(import->scene, source->mName.data);
		model->has_camera = source->mOrthographicWidth == 0 && is_usable(&camera);
		model->width = (uint32_t)lrintf(aspect * (float)height);
		model->height = height;
	}
}

static bool light_type(const struct aiLight *source, struct model_light *light)
{
	light->aimed = source->mType != aiLightSource_POINT;
	light->desc.type =
		source->mType == aiLightSource_DIRECTIONAL ? SM_LIGHT_DIRECTIONAL : SM_LIGHT_SPOT;
	return source->mType == aiLightSource_POINT || source->mType == aiLightSource_SPOT ||
	       source->mType == aiLightSource_DIRECTIONAL;
}

/** Cone of a spot: glTF has half angles. */
static void light_cone(
	const struct import *import, const struct aiLight *source, struct sm_light_desc *desc)
{
	float outer = source->mAngleOuterCone, inner = source->mAngleInnerCone;
	desc->angle = glm_clamp(glm_deg(import->is_gltf ? 2 * outer : outer), 1, 170);
	desc->softness = outer > 0 ? glm_clamp(1 - inner / outer, 0, 1) : 0;
}

static bool add_light(struct import *import, const struct aiLight *source)
{
	struct model_light light = {
		.node = import_rig_node(import->scene, source->mName.data),
		.desc = {.radius = NAN, .angle = NAN, .softness = .5f},
		.physical = true,
		.fade = {source->mAttenuationConstant, source->mAttenuationLinear,
			source->mAttenuationQuadratic},
	};
	struct sm_light_desc *desc = &light.desc;
	const float rgb[3] = {
		source->mColorDiffuse.r, source->mColorDiffuse.g, source->mColorDiffuse.b};
	desc->intensity = fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
	if (!light_type(source, &light) || !(desc->intensity > 0))
		return true;
	for (int i = 0; i < 3; i++)
		desc->color[i] = fmaxf(rgb[i] / desc->intensity, 0);
	mat4 space;
	find_space(import, &source->mName, space);
	to_point(space, &source->mPosition, desc->position);
	to_direction(space, &source->mDirection, desc->target);
	glm_vec3_add(desc->position, desc->target, desc->target);
	if (light.desc.type == SM_LIGHT_SPOT && light.aimed)
		light_cone(import, source, desc);
	desc->name = model_string(import->model, source->mName.data);
	import->model->lights[import->model->light_count++] = light;
	return desc->name != NULL || fail_full(import);
}

static bool add_lights(struct import *import)
{
	struct model *model = import->model;
	model->lights = model_alloc(model, import->scene->mNumLights, sizeof(*model->lights));
	bool ok = model->lights != NULL || fail_full(import);
	for (unsigned i = 0; ok && i < import->scene->mNumLights; i++)
		ok = add_light(import, import->scene->mLights[i]);
	return ok;
}

/* ---- the whole file ---- */

/** assimp's message, without what it repeats. */
static bool fail_as_assimp(struct import *import)
{
	char cause[200];
	snprintf(cause, sizeof(cause), "%s", aiGetErrorString());
	if (strncmp(cause, "No suitable reader", 18) == 0)
		return fail(import, "not a model in a format that is known");
	if (strstr(cause, "bad_alloc") != NULL)
		return fail(import, "damaged, or larger than memory allows");
	return fail(import, cause);
}

static const struct aiScene *read_scene(const char *path)
{
	/* Corners sharper than this stay sharp where a file has no normals. */
	const float smoothest_degrees = 60;
	struct aiPropertyStore *properties = aiCreatePropertyStore();
	aiSetImportPropertyFloat(
		properties, AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, smoothest_degrees);
	const struct aiScene *scene = aiImportFileExWithProperties(path,
		aiProcess_Triangulate | aiProcess_GenSmoothNormals | aiProcess_GenUVCoords |
			aiProcess_TransformUVCoords | aiProcess_FlipUVs,
		NULL, properties);
	aiReleasePropertyStore(properties);
	return scene;
}

static bool reserve(struct import *import)
{
	struct model *model = import->model;
	const struct aiScene *scene = import->scene;
	import->meshes = model_alloc(model, scene->mNumMeshes, sizeof(*import->meshes));
	import->materials = model_alloc(model, scene->mNumMaterials, sizeof(*import->materials));
	import->pictures = model_alloc(model, scene->mNumMaterials, sizeof(*import->pictures));
	model->images = model_alloc(model, scene->mNumMaterials, sizeof(*model->images));
	model->meshes = model_alloc(model, scene->mNumMeshes, sizeof(*model->meshes));
	return (import->meshes != NULL && import->materials != NULL && import->pictures != NULL &&
		       model->images != NULL && model->meshes != NULL) ||
	       fail_full(import);
}

/** Runs in the child: fills the model, which is shared, or its error. */
static bool read_model(void *data)
{
	struct import *import = data;
	import->scene = read_scene(import->path);
	if (import->scene == NULL)
		return fail_as_assimp(import);
	if (import->scene->mRootNode == NULL)
		return fail(import, "without a scene");
	if (!reserve(import))
		return false;
	for (unsigned i = 0; i < import->scene->mNumMaterials; i++)
		add_material(import, i);
	if (!add_meshes(import) || !add_objects(import))
		return false;
	add_camera(import);
	return add_lights(import);
}

static bool has_extension(const char *path, const char *const *extensions)
{
	const char *dot = strrchr(path, '.');
	for (; dot != NULL && *extensions != NULL; extensions++)
		if (strcasecmp(dot + 1, *extensions) == 0)
			return true;
	return false;
}

/** Whether a 3DS file's editor chunk starts with its mesh version, as 3D Studio writes it; the
 *  files of converters, which often keep y up, do not. */
static bool is_from_3d_studio(const char *path)
{
	enum { VERSION_CHUNK = 10, HEADER = 6, MESH_VERSION = 0x3d3e };
	uint8_t start[HEADER + VERSION_CHUNK + HEADER + 2];
	FILE *file = fopen(path, "rb");
	if (file == NULL)
		return false;
	size_t size = fread(start, 1, sizeof(start), file);
	fclose(file);
	return size == sizeof(start) && (start[size - 2] | start[size - 1] << 8) == MESH_VERSION;
}

static enum plan_up usual_up(const char *path, bool is_3ds)
{
	static const char *const z_up[] = {"stl", "3mf", "amf", "dxf", NULL};
	if (is_3ds)
		return is_from_3d_studio(path) ? PLAN_UP_Z : PLAN_UP_Y;
	return has_extension(path, z_up) ? PLAN_UP_Z : PLAN_UP_Y;
}

static bool report_end(enum child_end end, const char *path, unsigned seconds,
	const struct sm_error *reported, struct sm_error *error)
{
	switch (end) {
	case CHILD_SUCCEEDED:
		return true;
	case CHILD_SLOW:
		return error_set(error, SM_ERROR_INPUT,
			"%s: not read in %u s: damaged or too large", path, seconds);
	case CHILD_MISSING:
		return error_set(error, SM_ERROR_MACHINE, "%s: cannot start a process: %s", path,
			strerror(errno));
	case CHILD_FAILED:
		if (reported->text[0] != '\0')
			return error_set(error, reported->status, "%s", reported->text);
		break;
	case CHILD_CRASHED:
		break;
	}
	return error_set(error, SM_ERROR_INPUT, "%s: damaged: assimp fails on it", path);
}

bool import_model(const char *path, enum plan_up up, struct model *model, struct sm_error *error)
{
	static const char *const gltf[] = {"gltf", "glb", NULL}, *const max[] = {"3ds", NULL};
	struct stat status;
	if (stat(path, &status) != 0)
		return error_set(error, SM_ERROR_INPUT, "%s: %s", path, strerror(errno));
	if (!S_ISREG(status.st_mode))
		return error_set(error, SM_ERROR_INPUT, "%s: not a regular file", path);
	bool is_3ds = has_extension(path, max);
	struct import import = {
		.path = path,
		.is_gltf = has_extension(path, gltf),
		.is_turned = is_3ds,
		.up = up != PLAN_UP_AUTO ? up : usual_up(path, is_3ds),
		.model = model,
	};
	unsigned seconds = SECONDS + SECONDS_PER_MIB * (unsigned)(status.st_size >> 20);
	enum child_end end = child_run(read_model, &import, seconds, MEMORY_BYTES);
	for (const struct model_note *note = model->notes; note != NULL; note = note->next)
		log_warning("%s", note->text);
	return report_end(end, path, seconds, &model->error, error);
}
