/* SPDX-License-Identifier: MIT */
#include "load/animation.h"
#include "base/array.h"
#include "base/error.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool matrix_invert(mat4 matrix, mat4 inverse)
{
	glm_mat4_inv(matrix, inverse);
	for (int i = 0; i < 16; i++)
		if (!isfinite(inverse[i / 4][i % 4]))
			return false;
	return true;
}

void rig_node_rest(const struct rig *rig, uint32_t node, mat4 transform)
{
	glm_mat4_identity(transform);
	for (; node < rig->node_count; node = rig->nodes[node].parent) {
		mat4 local;
		memcpy(local, rig->nodes[node].local, sizeof(local));
		glm_mat4_mul(local, transform, transform);
	}
}

/* Of any shape. */
static void find_most(const struct rig *rig, size_t *bones, size_t *targets)
{
	*bones = *targets = 0;
	for (size_t i = 0; i < rig->shape_count; i++) {
		const struct shape *shape = &rig->shapes[i];
		*bones = shape->bone_count > *bones ? shape->bone_count : *bones;
		*targets = shape->target_count > *targets ? shape->target_count : *targets;
	}
}

bool pose_init(struct pose *pose, const struct rig *rig, const struct sm_mesh_desc *meshes,
	struct sm_error *error)
{
	size_t bones, targets;
	find_most(rig, &bones, &targets);
	*pose = (struct pose){
		.transforms = array_alloc(rig->object_count, sizeof(*pose->transforms)),
		.shapes = array_zalloc(rig->shape_count, sizeof(*pose->shapes)),
		.nodes = array_alloc(rig->node_count, sizeof(*pose->nodes)),
		.bones = array_alloc(bones, sizeof(*pose->bones)),
		.weights = array_alloc(targets, sizeof(*pose->weights)),
	};
	bool ok = pose->transforms != NULL && pose->shapes != NULL && pose->nodes != NULL &&
		  pose->bones != NULL && pose->weights != NULL;
	for (size_t i = 0; ok && i < rig->shape_count; i++) {
		const struct sm_mesh_desc *mesh = &meshes[rig->shapes[i].mesh];
		struct posed_vertices *vertices = &pose->shapes[i];
		const size_t size = 3 * sizeof(float);
		vertices->positions = array_alloc(mesh->vertex_count, size);
		if (mesh->normals != NULL)
			vertices->normals = array_alloc(mesh->vertex_count, size);
		ok = vertices->positions != NULL &&
		     (vertices->normals != NULL || mesh->normals == NULL);
	}
	return ok || error_no_memory(error);
}

void pose_finish(struct pose *pose, const struct rig *rig)
{
	for (size_t i = 0; pose->shapes != NULL && i < rig->shape_count; i++) {
		free(pose->shapes[i].positions);
		free(pose->shapes[i].normals);
	}
	free(pose->transforms);
	free(pose->shapes);
	free(pose->nodes);
	free(pose->bones);
	free(pose->weights);
	*pose = (struct pose){0};
}

/* The last key that is not after a time, or the first; *share: how far the time is on the way to
 * the next. */
static size_t find_key(const struct track *track, double seconds, float *share)
{
	size_t first = 0, end = track->count;
	while (end - first > 1) {
		size_t middle = first + (end - first) / 2;
		if (track->times[middle] <= seconds)
			first = middle;
		else
			end = middle;
	}
	*share = 0;
	if (first + 1 < track->count && seconds > track->times[first]) {
		double start = track->times[first], stop = track->times[first + 1];
		*share = (float)((seconds - start) / (stop - start));
	}
	return first;
}

static void sample(const struct track *track, size_t width, double seconds, float *values)
{
	float share;
	const float *from = &track->values[width * find_key(track, seconds, &share)];
	memcpy(values, from, width * sizeof(*values));
	for (size_t i = 0; share > 0 && i < width; i++)
		values[i] += share * (from[width + i] - from[i]);
}

static void sample_rotation(const struct track *track, double seconds, versor rotation)
{
	float share;
	const float *from = &track->values[4 * find_key(track, seconds, &share)];
	memcpy(rotation, from, sizeof(versor));
	if (share > 0) {
		versor to;
		memcpy(to, from + 4, sizeof(to));
		glm_quat_slerp(rotation, to, share, rotation);
	}
	glm_quat_normalize(rotation);
}

static void channel_matrix(const struct channel *channel, double seconds, mat4 matrix)
{
	vec3 position, scale;
	versor rotation;
	mat4 turn;
	sample(&channel->position, 3, seconds, position);
	sample_rotation(&channel->rotation, seconds, rotation);
	sample(&channel->scale, 3, seconds, scale);
	glm_translate_make(matrix, position);
	glm_quat_mat4(rotation, turn);
	glm_mat4_mul(matrix, turn, matrix);
	glm_scale(matrix, scale);
}

static void find_nodes(
	struct pose *pose, const struct rig *rig, const struct clip *clip, double seconds)
{
	for (size_t i = 0; i < rig->node_count; i++)
		memcpy(pose->nodes[i], rig->nodes[i].local, sizeof(pose->nodes[i]));
	for (size_t i = 0; clip != NULL && i < clip->channel_count; i++) {
		mat4 local;
		channel_matrix(&clip->channels[i], seconds, local);
		memcpy(pose->nodes[clip->channels[i].node], local, sizeof(local));
	}
	for (size_t i = 0; i < rig->node_count; i++) {
		mat4 local, parent;
		if (rig->nodes[i].parent == SM_NONE)
			continue;
		memcpy(local, pose->nodes[i], sizeof(local));
		memcpy(parent, pose->nodes[rig->nodes[i].parent], sizeof(parent));
		glm_mat4_mul(parent, local, local);
		memcpy(pose->nodes[i], local, sizeof(local));
	}
}

static void find_transforms(struct pose *pose, const struct rig *rig)
{
	for (size_t i = 0; i < rig->object_count; i++)
		memcpy(pose->transforms[i], pose->nodes[rig->object_nodes[i]],
			sizeof(pose->transforms[i]));
	/* Bones take vertices to the model's space. */
	for (size_t i = 0; i < rig->shape_count; i++) {
		mat4 none = GLM_MAT4_IDENTITY_INIT;
		if (rig->shapes[i].first != NULL)
			memcpy(pose->transforms[rig->shapes[i].object], none, sizeof(none));
	}
}

static void find_weights(struct pose *pose, const struct rig *rig, const struct clip *clip,
	size_t index, double seconds)
{
	const struct shape *shape = &rig->shapes[index];
	/* Of a shape without targets there are none. */
	if (shape->target_count > 0)
		memcpy(pose->weights, shape->weights, shape->target_count * sizeof(*pose->weights));
	for (size_t i = 0; clip != NULL && i < clip->blend_count; i++)
		if (clip->blends[i].shape == index)
			sample(&clip->blends[i].weights, shape->target_count, seconds,
				pose->weights);
}

static void add_scaled(float *sums, const float *values, float scale, size_t count)
{
	for (size_t i = 0; i < count; i++)
		sums[i] += scale * values[i];
}

static void add_targets(const struct pose *pose, const struct shape *shape,
	const struct posed_vertices *vertices, size_t vertex_count)
{
	for (size_t i = 0; i < shape->target_count; i++) {
		const struct morph_target *target = &shape->targets[i];
		float weight = pose->weights[i];
		if (weight == 0)
			continue;
		add_scaled(vertices->positions, target->positions, weight, 3 * vertex_count);
		if (vertices->normals != NULL && target->normals != NULL)
			add_scaled(vertices->normals, target->normals, weight, 3 * vertex_count);
	}
}

static void to_rows(mat4 matrix, float rows[12])
{
	for (int row = 0; row < 3; row++)
		for (int column = 0; column < 4; column++)
			rows[4 * row + column] = matrix[column][row];
}

static void find_bones(struct pose *pose, const struct shape *shape)
{
	for (size_t i = 0; i < shape->bone_count; i++) {
		mat4 node, offset;
		memcpy(node, pose->nodes[shape->bones[i].node], sizeof(node));
		memcpy(offset, shape->bones[i].offset, sizeof(offset));
		glm_mat4_mul(node, offset, offset);
		to_rows(offset, pose->bones[i]);
	}
}

/* w: 1 for a point, 0 for a direction. */
static void transform(const float rows[12], float w, float v[3])
{
	float x = v[0], y = v[1], z = v[2];
	for (int i = 0; i < 3; i++, rows += 4)
		v[i] = rows[0] * x + rows[1] * y + rows[2] * z + rows[3] * w;
}

static void move_with_bones(const struct pose *pose, const struct rig *rig,
	const struct shape *shape, const struct posed_vertices *vertices, size_t vertex_count)
{
	mat4 node;
	float own[12];
	memcpy(node, pose->nodes[rig->object_nodes[shape->object]], sizeof(node));
	to_rows(node, own);
	for (size_t v = 0; v < vertex_count; v++) {
		float rows[12] = {0};
		for (uint32_t i = shape->first[v]; i < shape->first[v + 1]; i++)
			add_scaled(rows, pose->bones[shape->influences[i].bone],
				shape->influences[i].weight, 12);
		const float *taken = shape->first[v] < shape->first[v + 1] ? rows : own;
		transform(taken, 1, &vertices->positions[3 * v]);
		if (vertices->normals != NULL)
			transform(taken, 0, &vertices->normals[3 * v]);
	}
}

static void find_vertices(struct pose *pose, const struct rig *rig,
	const struct sm_mesh_desc *meshes, const struct clip *clip, size_t index, double seconds)
{
	const struct shape *shape = &rig->shapes[index];
	const struct sm_mesh_desc *mesh = &meshes[shape->mesh];
	const struct posed_vertices *vertices = &pose->shapes[index];
	size_t count = mesh->vertex_count, bytes = 3 * count * sizeof(float);
	memcpy(vertices->positions, mesh->positions, bytes);
	if (vertices->normals != NULL)
		memcpy(vertices->normals, mesh->normals, bytes);
	find_weights(pose, rig, clip, index, seconds);
	add_targets(pose, shape, vertices, count);
	if (shape->first == NULL)
		return;
	find_bones(pose, shape);
	move_with_bones(pose, rig, shape, vertices, count);
}

void pose_find(struct pose *pose, const struct rig *rig, const struct sm_mesh_desc *meshes,
	const struct clip *clip, double seconds)
{
	double time = clip != NULL && clip->duration > 0 ? fmod(seconds, clip->duration) : 0;
	if (time < 0)
		time += clip->duration;
	find_nodes(pose, rig, clip, time);
	find_transforms(pose, rig);
	for (size_t i = 0; i < rig->shape_count; i++)
		find_vertices(pose, rig, meshes, clip, i, time);
}
