/* SPDX-License-Identifier: MIT */
#include "load/import.h"
#include "base/log.h"
#include "load/child.h"
#include "load/gltf.h"
#include "load/import_scene.h"
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cglm/cglm.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum {
	SECONDS = 8,
	SECONDS_PER_MIB = 1,
	MEMORY_BYTES = 1 << 30, /* for assimp, beside the model */
};

bool import_fail(struct import *import, const char *cause)
{
	return error_set(&import->model->error, SM_ERROR_INPUT, "%s: %s", import->path, cause);
}

bool import_fail_full(struct import *import)
{
	return import_fail(import, "too large a model for this machine");
}

void import_turn(const struct import *import, mat4 turn)
{
	glm_mat4_identity(turn);
	if (import->up == PLAN_UP_Z && !import->is_turned)
		glm_rotate_x(turn, -GLM_PI_2f, turn);
	else if (import->up == PLAN_UP_Y && import->is_turned)
		glm_rotate_x(turn, GLM_PI_2f, turn);
}

/** assimp's message, without what it repeats. */
static bool fail_as_assimp(struct import *import)
{
	char cause[200];
	snprintf(cause, sizeof(cause), "%s", aiGetErrorString());
	if (strncmp(cause, "No suitable reader", 18) == 0)
		return import_fail(import, "not a model in a format that is known");
	if (strstr(cause, "bad_alloc") != NULL)
		return import_fail(import, "damaged, or larger than memory allows");
	return import_fail(import, cause);
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

/** Runs in the child: fills the model, which is shared, or its error. */
static bool read_model(void *data)
{
	struct import *import = data;
	import->scene = read_scene(import->path);
	if (import->scene == NULL)
		return fail_as_assimp(import);
	if (import->scene->mRootNode == NULL)
		return import_fail(import, "without a scene");
	if (!import_materials(import) || !import_objects(import))
		return false;
	if (import->is_gltf && import->scene->mNumAnimations > 0 && gltf_has_curves(import->path))
		model_note(import->model,
			"%s: steps and cubic splines of animations become straight lines",
			import->path);
	import_camera(import);
	return import_lights(import);
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
