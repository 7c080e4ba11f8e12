/* SPDX-License-Identifier: MIT */
/* What assimp may hand over of nodes, bones, targets and animations: what comes out of it poses.
 *	build-fuzz/tests/fuzz/fuzz-rig FOUND tests/fuzz/corpus/rig
 */
#include "expect.h"
#include "load/import_scene.h"
#include "number.h"
#include <assimp/scene.h>
#include <stdlib.h>
#include <string.h>

/* At most, of each. */
enum { CHILDREN = 2, DEPTH = 3, MESHES = 2, VERTICES = 7, PARTS = 3, KEYS = 3, PIECES = 400 };

static struct numbers numbers; /* of the input at hand */
static void *pieces[PIECES];   /* of the scene, each of its exact size; owned */
static size_t piece_count;

/* Zeroed; when no more pieces can be kept, of nothing. */
static void *take_room(unsigned *count, size_t size)
{
	if (piece_count == PIECES)
		*count = 0;
	if (*count == 0)
		return NULL;
	void *piece = calloc(*count, size);
	expect(piece != NULL);
	pieces[piece_count++] = piece;
	return piece;
}

static unsigned take_count(unsigned most)
{
	return take_byte(&numbers) % (most + 1);
}

/* Few names, so that things are often called alike. */
static void take_name(struct aiString *name)
{
	name->length = 1;
	name->data[0] = (char)('a' + take_byte(&numbers) % 6);
	name->data[1] = '\0';
}

static struct aiVector3D take_vector(void)
{
	struct aiVector3D vector;
	vector.x = take_float(&numbers);
	vector.y = take_float(&numbers);
	vector.z = take_float(&numbers);
	return vector;
}

static struct aiVector3D *take_vectors(unsigned count)
{
	struct aiVector3D *vectors = take_room(&count, sizeof(*vectors));
	for (unsigned i = 0; i < count; i++)
		vectors[i] = take_vector();
	return vectors;
}

/* Of three axes and a place; or the identity, which is what most nodes have. */
static void take_matrix(struct aiMatrix4x4 *matrix)
{
	float *values = (float *)matrix;
	bool plain = take_byte(&numbers) & 1;
	for (int i = 0; i < 16; i++)
		values[i] = i % 5 == 0;
	if (!plain)
		take_floats(&numbers, values, 12);
}

/* ---- what assimp makes of a file ---- */

static struct aiNode *take_node(struct aiNode *parent, unsigned mesh_count, int depth)
{
	unsigned one = 1;
	struct aiNode *node = take_room(&one, sizeof(*node));
	if (node == NULL)
		return NULL;
	take_name(&node->mName);
	take_matrix(&node->mTransformation);
	node->mParent = parent;
	node->mNumMeshes = take_count(mesh_count);
	node->mMeshes = take_room(&node->mNumMeshes, sizeof(*node->mMeshes));
	for (unsigned i = 0; i < node->mNumMeshes; i++)
		node->mMeshes[i] = take_count(mesh_count - 1);
	unsigned children = depth < DEPTH ? take_count(CHILDREN) : 0;
	node->mChildren = take_room(&children, sizeof(struct aiNode *));
	for (unsigned i = 0; i < children; i++) {
		struct aiNode *child = take_node(node, mesh_count, depth + 1);
		if (child != NULL)
			node->mChildren[node->mNumChildren++] = child;
	}
	return node;
}

/* Bones of vertices that there are not, as assimp checks for some formats alone. */
static void take_bones(struct aiMesh *mesh)
{
	unsigned count = take_count(PARTS), one = 1;
	mesh->mBones = take_room(&count, sizeof(struct aiBone *));
	for (unsigned i = 0; i < count; i++) {
		struct aiBone *bone = take_room(&one, sizeof(*bone));
		if (bone == NULL)
			return;
		mesh->mBones[mesh->mNumBones++] = bone;
		take_name(&bone->mName);
		take_matrix(&bone->mOffsetMatrix);
		bone->mNumWeights = take_count(VERTICES);
		bone->mWeights = take_room(&bone->mNumWeights, sizeof(*bone->mWeights));
		for (unsigned k = 0; k < bone->mNumWeights; k++) {
			bone->mWeights[k].mVertexId = take_byte(&numbers);
			bone->mWeights[k].mWeight = take_float(&numbers);
		}
	}
}

static void take_targets(struct aiMesh *mesh)
{
	unsigned count = take_count(PARTS), one = 1;
	mesh->mAnimMeshes = take_room(&count, sizeof(struct aiAnimMesh *));
	for (unsigned i = 0; i < count; i++) {
		struct aiAnimMesh *target = take_room(&one, sizeof(*target));
		if (target == NULL)
			return;
		uint8_t flags = take_byte(&numbers);
		mesh->mAnimMeshes[mesh->mNumAnimMeshes++] = target;
		target->mNumVertices = flags & 1 ? take_count(VERTICES) : mesh->mNumVertices;
		target->mWeight = take_float(&numbers);
		if (flags & 2)
			target->mVertices = take_vectors(target->mNumVertices);
		if (flags & 4)
			target->mNormals = take_vectors(target->mNumVertices);
	}
}

static void take_mesh(struct aiMesh *mesh)
{
	unsigned faces = 1 + take_count(PARTS), corners = 3;
	take_name(&mesh->mName);
	mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
	mesh->mNumVertices = 1 + take_count(VERTICES - 1);
	mesh->mVertices = take_vectors(mesh->mNumVertices);
	if (mesh->mVertices == NULL)
		mesh->mNumVertices = 0;
	if (take_byte(&numbers) & 1)
		mesh->mNormals = take_vectors(mesh->mNumVertices);
	mesh->mFaces = take_room(&faces, sizeof(*mesh->mFaces));
	mesh->mNumFaces = faces;
	for (unsigned i = 0; i < faces; i++) {
		mesh->mFaces[i].mIndices = take_room(&corners, sizeof(unsigned));
		mesh->mFaces[i].mNumIndices = corners;
		for (unsigned k = 0; k < corners; k++)
			mesh->mFaces[i].mIndices[k] = take_count(VERTICES);
	}
	take_bones(mesh);
	take_targets(mesh);
}

static struct aiVectorKey *take_vector_keys(unsigned *count)
{
	*count = take_count(KEYS);
	struct aiVectorKey *keys = take_room(count, sizeof(*keys));
	for (unsigned i = 0; i < *count; i++) {
		keys[i].mTime = (double)take_float(&numbers);
		keys[i].mValue = take_vector();
	}
	return keys;
}

static struct aiNodeAnim *take_channel(void)
{
	unsigned one = 1;
	struct aiNodeAnim *channel = take_room(&one, sizeof(*channel));
	if (channel == NULL)
		return NULL;
	take_name(&channel->mNodeName);
	channel->mPositionKeys = take_vector_keys(&channel->mNumPositionKeys);
	channel->mScalingKeys = take_vector_keys(&channel->mNumScalingKeys);
	channel->mNumRotationKeys = take_count(KEYS);
	channel->mRotationKeys =
		take_room(&channel->mNumRotationKeys, sizeof(*channel->mRotationKeys));
	for (unsigned i = 0; i < channel->mNumRotationKeys; i++) {
		struct aiQuatKey *key = &channel->mRotationKeys[i];
		key->mTime = (double)take_float(&numbers);
		key->mValue.w = take_float(&numbers);
		key->mValue.x = take_float(&numbers);
		key->mValue.y = take_float(&numbers);
		key->mValue.z = take_float(&numbers);
	}
	return channel;
}

static void take_morph_key(struct aiMeshMorphKey *key)
{
	unsigned count = take_count(PARTS);
	key->mTime = (double)take_float(&numbers);
	key->mValues = take_room(&count, sizeof(*key->mValues));
	key->mWeights = take_room(&count, sizeof(*key->mWeights));
	key->mNumValuesAndWeights = count;
	for (unsigned i = 0; i < count; i++) {
		key->mValues[i] = take_byte(&numbers);
		key->mWeights[i] = (double)take_float(&numbers);
	}
}

static struct aiMeshMorphAnim *take_morph(void)
{
	unsigned one = 1;
	struct aiMeshMorphAnim *morph = take_room(&one, sizeof(*morph));
	if (morph == NULL)
		return NULL;
	take_name(&morph->mName);
	morph->mNumKeys = take_count(KEYS);
	morph->mKeys = take_room(&morph->mNumKeys, sizeof(*morph->mKeys));
	for (unsigned i = 0; i < morph->mNumKeys; i++)
		take_morph_key(&morph->mKeys[i]);
	return morph;
}

static void take_animation(struct aiAnimation *animation)
{
	take_name(&animation->mName);
	animation->mDuration = (double)take_float(&numbers);
	animation->mTicksPerSecond = (double)take_float(&numbers);
	unsigned channels = take_count(PARTS), morphs = take_count(PARTS);
	animation->mChannels = take_room(&channels, sizeof(struct aiNodeAnim *));
	for (unsigned i = 0; i < channels; i++) {
		struct aiNodeAnim *channel = take_channel();
		if (channel != NULL)
			animation->mChannels[animation->mNumChannels++] = channel;
	}
	animation->mMorphMeshChannels = take_room(&morphs, sizeof(struct aiMeshMorphAnim *));
	for (unsigned i = 0; i < morphs; i++) {
		struct aiMeshMorphAnim *morph = take_morph();
		if (morph != NULL)
			animation->mMorphMeshChannels[animation->mNumMorphMeshChannels++] = morph;
	}
}

static void take_scene(struct aiScene *scene)
{
	unsigned meshes = 1 + take_count(MESHES - 1), animations = take_count(PARTS), one = 1;
	scene->mMeshes = take_room(&meshes, sizeof(struct aiMesh *));
	for (unsigned i = 0; i < meshes; i++) {
		struct aiMesh *mesh = take_room(&one, sizeof(*mesh));
		expect(mesh != NULL);
		take_mesh(mesh);
		scene->mMeshes[scene->mNumMeshes++] = mesh;
	}
	scene->mRootNode = take_node(NULL, meshes, 0);
	scene->mAnimations = take_room(&animations, sizeof(struct aiAnimation *));
	for (unsigned i = 0; i < animations; i++) {
		struct aiAnimation *animation = take_room(&one, sizeof(*animation));
		if (animation == NULL)
			return;
		take_animation(animation);
		scene->mAnimations[scene->mNumAnimations++] = animation;
	}
}

/* ---- what becomes of it ---- */

static void check_rig(const struct model *model)
{
	static const double times[] = {0, 0.5, 1, -1e9, 1e300};
	const struct rig *rig = &model->rig;
	struct pose pose;
	expect(pose_init(&pose, rig, model->meshes, NULL));
	for (size_t clip = 0; clip <= rig->clip_count; clip++)
		for (size_t i = 0; i < sizeof(times) / sizeof(*times); i++)
			pose_find(&pose, rig, model->meshes,
				clip < rig->clip_count ? &rig->clips[clip] : NULL, times[i]);
	pose_finish(&pose, rig);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct aiScene scene = {0};
	struct import_material material = {.image = SM_NONE};
	struct model *model = model_create(NULL);
	struct import import = {
		.path = "fuzz", .model = model, .scene = &scene, .materials = &material};
	expect(model != NULL);
	numbers = (struct numbers){data, size};
	take_scene(&scene);
	if (scene.mRootNode != NULL && import_objects(&import)) {
		if (model->rig.node_count > 0)
			check_rig(model);
	} else if (scene.mRootNode != NULL) {
		expect_clear_error(&model->error);
	}
	model_destroy(model);
	while (piece_count > 0)
		free(pieces[--piece_count]);
	return 0;
}
