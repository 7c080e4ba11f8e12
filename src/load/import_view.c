/* SPDX-License-Identifier: MIT */
#include "load/import_scene.h"
#include <assimp/scene.h>
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

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
		import_matrix(&node->mTransformation, local);
		glm_mat4_mul(local, space, space);
	}
	mat4 turn;
	import_turn(import, turn);
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

/* ---- cameras ---- */

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

void import_camera(struct import *import)
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

/* ---- lights ---- */

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
	return desc->name != NULL || import_fail_full(import);
}

bool import_lights(struct import *import)
{
	struct model *model = import->model;
	model->lights = model_alloc(model, import->scene->mNumLights, sizeof(*model->lights));
	bool ok = model->lights != NULL || import_fail_full(import);
	for (unsigned i = 0; ok && i < import->scene->mNumLights; i++)
		ok = add_light(import, import->scene->mLights[i]);
	return ok;
}
