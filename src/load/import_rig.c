/* SPDX-License-Identifier: MIT */
#include "load/import_rig.h"
#include <assimp/cimport.h>
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

struct rigging {
	const struct aiScene *scene;
	const struct import_part *parts;
	const char *path;
	struct model *model;
	struct rig *rig;
	const struct aiNode **sources; /* [rig->node_count]; NULL for the turn, which is first */
};

bool import_deforms(const struct aiMesh *mesh)
{
	return mesh->mNumBones > 0 || mesh->mNumAnimMeshes > 0;
}

static bool all_finite(const float *values, size_t count)
{
	for (size_t i = 0; i < count; i++)
		if (!isfinite(values[i]))
			return false;
	return true;
}

void import_matrix(const struct aiMatrix4x4 *source, mat4 matrix)
{
	memcpy(matrix, source, sizeof(mat4));
	glm_mat4_transpose(matrix);
}

/* ---- nodes ---- */

static size_t count_nodes(const struct aiNode *node)
{
	size_t count = 1;
	for (unsigned i = 0; i < node->mNumChildren; i++)
		count += count_nodes(node->mChildren[i]);
	return count;
}

static void add_node(struct rigging *rigging, const struct aiNode *node, uint32_t parent)
{
	uint32_t index = (uint32_t)rigging->rig->node_count++;
	struct rig_node *added = &rigging->rig->nodes[index];
	added->parent = parent;
	mat4 local;
	import_matrix(&node->mTransformation, local);
	memcpy(added->local, local, sizeof(added->local));
	rigging->sources[index] = node;
	for (unsigned i = 0; i < node->mNumChildren; i++)
		add_node(rigging, node->mChildren[i], index);
}

/* Counts *index up to the first node of that name; whether there is one. */
static bool find_index(const struct aiNode *node, const char *name, uint32_t *index)
{
	++*index;
	bool found = strcmp(node->mName.data, name) == 0;
	for (unsigned i = 0; !found && i < node->mNumChildren; i++)
		found = find_index(node->mChildren[i], name, index);
	return found;
}

uint32_t import_rig_node(const struct aiScene *scene, const char *name)
{
	uint32_t index = 0;
	return find_index(scene->mRootNode, name, &index) ? index : 0;
}

/** SM_NONE: there is none. */
static uint32_t find_node(const struct rigging *rigging, const char *name)
{
	for (size_t i = 1; i < rigging->rig->node_count; i++)
		if (strcmp(rigging->sources[i]->mName.data, name) == 0)
			return (uint32_t)i;
	return SM_NONE;
}

static bool add_nodes(struct rigging *rigging, mat4 turn)
{
	struct rig *rig = rigging->rig;
	struct model *model = rigging->model;
	size_t count = 1 + count_nodes(rigging->scene->mRootNode);
	rig->nodes = model_alloc(model, count, sizeof(*rig->nodes));
	rig->object_nodes = model_alloc(model, model->object_count, sizeof(*rig->object_nodes));
	rigging->sources = model_alloc(model, count, sizeof(*rigging->sources));
	if (rig->nodes == NULL || rig->object_nodes == NULL || rigging->sources == NULL)
		return false;
	rig->nodes[0].parent = SM_NONE;
	memcpy(rig->nodes[0].local, turn, sizeof(rig->nodes[0].local));
	rig->node_count = 1;
	add_node(rigging, rigging->scene->mRootNode, 0);
	/* Objects were made of the nodes in the same order. */
	uint32_t node = 1;
	for (size_t i = 0; i < model->object_count; i++) {
		while (rigging->sources[node] != rigging->parts[i].node)
			node++;
		rig->object_nodes[i] = node;
	}
	rig->object_count = model->object_count;
	return true;
}

/* ---- shapes ---- */

static const float *differences(struct model *model, const struct aiVector3D *from,
	const struct aiVector3D *to, size_t count)
{
	float *values = model_alloc(model, count, 3 * sizeof(*values));
	for (size_t i = 0; values != NULL && i < count; i++) {
		values[3 * i] = to[i].x - from[i].x;
		values[3 * i + 1] = to[i].y - from[i].y;
		values[3 * i + 2] = to[i].z - from[i].z;
	}
	return values;
}

static bool add_target(struct model *model, const struct aiMesh *mesh,
	const struct aiAnimMesh *source, struct morph_target *target)
{
	const struct aiVector3D *positions =
		source->mVertices != NULL ? source->mVertices : mesh->mVertices;
	size_t count = mesh->mNumVertices;
	bool turns = source->mNormals != NULL && mesh->mNormals != NULL;
	target->positions = differences(model, mesh->mVertices, positions, count);
	if (turns)
		target->normals = differences(model, mesh->mNormals, source->mNormals, count);
	return target->positions != NULL && (target->normals != NULL || !turns);
}

static bool add_targets(
	const struct rigging *rigging, const struct aiMesh *mesh, struct shape *shape)
{
	struct model *model = rigging->model;
	shape->targets = model_alloc(model, mesh->mNumAnimMeshes, sizeof(*shape->targets));
	float *weights = model_alloc(model, mesh->mNumAnimMeshes, sizeof(*weights));
	bool ok = shape->targets != NULL && weights != NULL;
	for (unsigned i = 0; ok && i < mesh->mNumAnimMeshes; i++) {
		const struct aiAnimMesh *source = mesh->mAnimMeshes[i];
		if (source->mNumVertices != mesh->mNumVertices) {
			model_note(model, "%s: a target of %s is left out: of another mesh",
				rigging->path, mesh->mName.data);
			continue;
		}
		weights[shape->target_count] = isfinite(source->mWeight) ? source->mWeight : 0;
		ok = add_target(model, mesh, source, &shape->targets[shape->target_count++]);
	}
	shape->weights = weights;
	return ok;
}

static bool counts(const struct aiMesh *mesh, const struct aiVertexWeight *weight)
{
	return weight->mVertexId < mesh->mNumVertices && weight->mWeight > 0 &&
	       isfinite(weight->mWeight);
}

/** Bones whose node there is, in the order of the mesh. */
static bool add_bones(const struct rigging *rigging, const struct aiMesh *mesh, struct shape *shape)
{
	shape->bones = model_alloc(rigging->model, mesh->mNumBones, sizeof(*shape->bones));
	if (shape->bones == NULL)
		return false;
	for (unsigned i = 0; i < mesh->mNumBones; i++) {
		const struct aiBone *source = mesh->mBones[i];
		struct bone *bone = &shape->bones[shape->bone_count++];
		mat4 offset;
		bone->node = find_node(rigging, source->mName.data);
		import_matrix(&source->mOffsetMatrix, offset);
		memcpy(bone->offset, offset, sizeof(bone->offset));
		if (bone->node != SM_NONE && all_finite(bone->offset, 16))
			continue;
		model_note(rigging->model, "%s: bone %s moves nothing: %s", rigging->path,
			source->mName.data, bone->node == SM_NONE ? "no such node" : "damaged");
		*bone = (struct bone){.offset = {[0] = 1, [5] = 1, [10] = 1, [15] = 1}};
	}
	return true;
}

/** Makes the weights of each vertex add up to 1. */
static void normalise(struct influence *influences, const uint32_t *first, size_t vertex_count)
{
	for (size_t v = 0; v < vertex_count; v++) {
		double sum = 0;
		for (uint32_t i = first[v]; i < first[v + 1]; i++)
			sum += influences[i].weight;
		for (uint32_t i = first[v]; i < first[v + 1]; i++)
			influences[i].weight = (float)(influences[i].weight / sum);
	}
}

/** From lists by bone to lists by vertex. */
static bool add_influences(struct model *model, const struct aiMesh *mesh, struct shape *shape)
{
	size_t count = 0, vertex_count = mesh->mNumVertices;
	uint32_t *first = model_alloc(model, vertex_count + 2, sizeof(*first));
	for (unsigned b = 0; b < mesh->mNumBones; b++)
		count += mesh->mBones[b]->mNumWeights;
	struct influence *influences = model_alloc(model, count, sizeof(*influences));
	if (first == NULL || influences == NULL || count > UINT32_MAX)
		return false;
	for (unsigned b = 0; b < mesh->mNumBones; b++) {
		const struct aiBone *bone = mesh->mBones[b];
		for (unsigned i = 0; i < bone->mNumWeights; i++)
			if (counts(mesh, &bone->mWeights[i]))
				first[bone->mWeights[i].mVertexId + 2]++;
	}
	for (size_t v = 2; v < vertex_count + 2; v++)
		first[v] += first[v - 1];
	/* first[v + 1] is where the next of v goes, and in the end where those of v + 1 start. */
	for (unsigned b = 0; b < mesh->mNumBones; b++) {
		const struct aiBone *bone = mesh->mBones[b];
		for (unsigned i = 0; i < bone->mNumWeights; i++)
			if (counts(mesh, &bone->mWeights[i]))
				influences[first[bone->mWeights[i].mVertexId + 1]++] =
					(struct influence){b, bone->mWeights[i].mWeight};
	}
	normalise(influences, first, vertex_count);
	shape->first = first;
	shape->influences = influences;
	return true;
}

static bool add_shape(struct rigging *rigging, size_t object)
{
	const struct aiMesh *mesh = rigging->parts[object].mesh;
	struct shape *shape = &rigging->rig->shapes[rigging->rig->shape_count++];
	*shape = (struct shape){
		.object = (uint32_t)object, .mesh = rigging->model->objects[object].mesh};
	return add_targets(rigging, mesh, shape) &&
	       (mesh->mNumBones == 0 || (add_bones(rigging, mesh, shape) &&
						add_influences(rigging->model, mesh, shape)));
}

static bool add_shapes(struct rigging *rigging)
{
	size_t count = 0;
	for (size_t i = 0; i < rigging->model->object_count; i++)
		count += import_deforms(rigging->parts[i].mesh);
	rigging->rig->shapes = model_alloc(rigging->model, count, sizeof(*rigging->rig->shapes));
	bool ok = rigging->rig->shapes != NULL;
	for (size_t i = 0; ok && i < rigging->model->object_count; i++)
		if (import_deforms(rigging->parts[i].mesh))
			ok = add_shape(rigging, i);
	return ok;
}

/* ---- clips ---- */

/** Room for a track's keys; false when the model is full. */
static bool open_track(struct model *model, size_t count, size_t width, struct track *track,
	float **times, float **values)
{
	*times = model_alloc(model, count, sizeof(**times));
	*values = model_alloc(model, count, width * sizeof(**values));
	*track = (struct track){count, *times, *values};
	return *times != NULL && *values != NULL;
}

static bool makes_sense(const struct track *track, size_t width)
{
	for (size_t i = 0; i < track->count; i++)
		if (!isfinite(track->times[i]) ||
			(i > 0 && track->times[i] < track->times[i - 1]) ||
			!all_finite(&track->values[width * i], width))
			return false;
	return track->count > 0;
}

static bool copy_vectors(struct model *model, const struct aiVectorKey *keys, unsigned count,
	double rate, struct track *track)
{
	float *times, *values;
	if (!open_track(model, count, 3, track, &times, &values))
		return false;
	for (unsigned i = 0; i < count; i++) {
		times[i] = (float)(keys[i].mTime / rate);
		memcpy(&values[3 * (size_t)i], &keys[i].mValue, 3 * sizeof(float));
	}
	return true;
}

static bool copy_rotations(struct model *model, const struct aiQuatKey *keys, unsigned count,
	double rate, struct track *track)
{
	float *times, *values;
	if (!open_track(model, count, 4, track, &times, &values))
		return false;
	for (unsigned i = 0; i < count; i++) {
		const struct aiQuaternion *q = &keys[i].mValue;
		versor rotation = {q->x, q->y, q->z, q->w};
		times[i] = (float)(keys[i].mTime / rate);
		glm_quat_normalize(rotation);
		memcpy(&values[4 * (size_t)i], rotation, sizeof(rotation));
	}
	return true;
}

/** Fills tracks without keys with what the node is at rest. */
static void rest_keys(const struct aiNode *node, struct aiVectorKey *position,
	struct aiQuatKey *rotation, struct aiVectorKey *scale)
{
	aiDecomposeMatrix(
		&node->mTransformation, &scale->mValue, &rotation->mValue, &position->mValue);
}

static bool copy_channel(const struct rigging *rigging, const struct aiNodeAnim *source,
	double rate, struct channel *channel)
{
	struct model *model = rigging->model;
	struct aiVectorKey position = {0}, scale = {0};
	struct aiQuatKey rotation = {0};
	rest_keys(rigging->sources[channel->node], &position, &rotation, &scale);
	unsigned positions = source->mNumPositionKeys, rotations = source->mNumRotationKeys,
		 scales = source->mNumScalingKeys;
	return copy_vectors(model, positions > 0 ? source->mPositionKeys : &position,
		       positions > 0 ? positions : 1, rate, &channel->position) &&
	       copy_rotations(model, rotations > 0 ? source->mRotationKeys : &rotation,
		       rotations > 0 ? rotations : 1, rate, &channel->rotation) &&
	       copy_vectors(model, scales > 0 ? source->mScalingKeys : &scale,
		       scales > 0 ? scales : 1, rate, &channel->scale);
}

static void extend(struct clip *clip, const struct track *track)
{
	clip->duration = fmax(clip->duration, track->times[track->count - 1]);
}

static void leave_out(
	const struct rigging *rigging, const struct clip *clip, const char *node, const char *cause)
{
	model_note(rigging->model, "%s: animation %s leaves out %s: %s", rigging->path, clip->name,
		node, cause);
}

static bool add_channel(const struct rigging *rigging, struct clip *clip,
	const struct aiNodeAnim *source, double rate)
{
	const char *name = source->mNodeName.data;
	struct channel *channel = &clip->channels[clip->channel_count];
	channel->node = find_node(rigging, name);
	if (channel->node == SM_NONE) {
		leave_out(rigging, clip, name, "no such node");
		return true;
	}
	if (!copy_channel(rigging, source, rate, channel))
		return false;
	if (!makes_sense(&channel->position, 3) || !makes_sense(&channel->rotation, 4) ||
		!makes_sense(&channel->scale, 3)) {
		leave_out(rigging, clip, name, "damaged");
		return true;
	}
	extend(clip, &channel->position);
	extend(clip, &channel->rotation);
	extend(clip, &channel->scale);
	clip->channel_count++;
	return true;
}

static bool copy_weights(struct model *model, const struct aiMeshMorphAnim *source, double rate,
	size_t width, struct track *track)
{
	float *times, *values;
	if (!open_track(model, source->mNumKeys, width, track, &times, &values))
		return false;
	for (unsigned i = 0; i < source->mNumKeys; i++) {
		const struct aiMeshMorphKey *key = &source->mKeys[i];
		times[i] = (float)(key->mTime / rate);
		for (unsigned k = 0; k < key->mNumValuesAndWeights; k++)
			if (key->mValues[k] < width)
				values[width * i + key->mValues[k]] = (float)key->mWeights[k];
	}
	return true;
}

/** Of glTF, such a channel bears the name of a node; of other formats, that of a mesh. */
static bool is_of_part(const struct aiMeshMorphAnim *source, const struct import_part *part)
{
	return strcmp(source->mName.data, part->node->mName.data) == 0 ||
	       strcmp(source->mName.data, part->mesh->mName.data) == 0;
}

static bool add_blend(const struct rigging *rigging, struct clip *clip, size_t shape,
	const struct aiMeshMorphAnim *source, double rate)
{
	size_t width = rigging->rig->shapes[shape].target_count;
	struct blend *blend = &clip->blends[clip->blend_count];
	blend->shape = (uint32_t)shape;
	if (width == 0)
		return true;
	if (!copy_weights(rigging->model, source, rate, width, &blend->weights))
		return false;
	if (makes_sense(&blend->weights, width)) {
		extend(clip, &blend->weights);
		clip->blend_count++;
	} else {
		leave_out(rigging, clip, source->mName.data, "damaged");
	}
	return true;
}

static bool add_blends(const struct rigging *rigging, struct clip *clip,
	const struct aiAnimation *source, double rate)
{
	const struct rig *rig = rigging->rig;
	size_t channels = source->mNumMorphMeshChannels;
	if (rig->shape_count == 0 || channels == 0)
		return true;
	if (channels > SIZE_MAX / rig->shape_count)
		return false;
	clip->blends =
		model_alloc(rigging->model, rig->shape_count * channels, sizeof(*clip->blends));
	bool ok = clip->blends != NULL;
	for (unsigned i = 0; ok && i < channels; i++)
		for (size_t s = 0; ok && s < rig->shape_count; s++)
			if (is_of_part(source->mMorphMeshChannels[i],
				    &rigging->parts[rig->shapes[s].object]))
				ok = add_blend(
					rigging, clip, s, source->mMorphMeshChannels[i], rate);
	return ok;
}

static bool add_clip(struct rigging *rigging, const struct aiAnimation *source)
{
	const double usual_rate = 25; /* where assimp says nothing */
	double rate = source->mTicksPerSecond > 0 ? source->mTicksPerSecond : usual_rate;
	struct clip *clip = &rigging->rig->clips[rigging->rig->clip_count++];
	*clip = (struct clip){.name = model_string(rigging->model, source->mName.data)};
	clip->channels = model_alloc(rigging->model, source->mNumChannels, sizeof(*clip->channels));
	if (clip->name == NULL || clip->channels == NULL)
		return false;
	double duration = source->mDuration / rate;
	if (isfinite(duration) && duration > 0)
		clip->duration = duration;
	for (unsigned i = 0; i < source->mNumChannels; i++)
		if (!add_channel(rigging, clip, source->mChannels[i], rate))
			return false;
	return add_blends(rigging, clip, source, rate);
}

static bool add_clips(struct rigging *rigging)
{
	const struct aiScene *scene = rigging->scene;
	rigging->rig->clips =
		model_alloc(rigging->model, scene->mNumAnimations, sizeof(*rigging->rig->clips));
	bool ok = rigging->rig->clips != NULL;
	for (unsigned i = 0; ok && i < scene->mNumAnimations; i++)
		ok = add_clip(rigging, scene->mAnimations[i]);
	return ok;
}

/* ---- the whole ---- */

static bool moves(
	const struct aiScene *scene, const struct model *model, const struct import_part *parts)
{
	for (size_t i = 0; i < model->object_count; i++)
		if (import_deforms(parts[i].mesh))
			return true;
	return scene->mNumAnimations > 0;
}

bool import_rig(const struct aiScene *scene, const struct import_part *parts, mat4 turn,
	const char *path, struct model *model)
{
	struct rigging rigging = {
		.scene = scene,
		.parts = parts,
		.path = path,
		.model = model,
		.rig = &model->rig,
	};
	return !moves(scene, model, parts) ||
	       (add_nodes(&rigging, turn) && add_shapes(&rigging) && add_clips(&rigging));
}
