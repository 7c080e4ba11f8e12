/* SPDX-License-Identifier: MIT */
#include "model_rig.h"
#include "expect.h"
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

static struct numbers *numbers; /* of the input at hand */

static void *take_room(struct model *model, size_t count, size_t size)
{
	void *room = model_alloc(model, count, size);
	expect(room != NULL);
	return room;
}

/* From 0 to count - 1. */
static uint32_t take_index(size_t count)
{
	return take_byte(numbers) % (uint32_t)count;
}

/* What is left out else. */
static void take_finite(float *values, size_t count)
{
	take_floats(numbers, values, count);
	for (size_t i = 0; i < count; i++)
		if (!isfinite(values[i]))
			values[i] = 0;
}

static float *take_array(struct model *model, size_t count)
{
	float *values = take_room(model, count, sizeof(*values));
	take_floats(numbers, values, count);
	return values;
}

/* Of files, matrices are taken as they are. */
static void take_nodes(struct rig *rig, struct model *model)
{
	rig->node_count = 2 + take_index(RIG_NODES - 1);
	rig->nodes = take_room(model, rig->node_count, sizeof(*rig->nodes));
	for (uint32_t i = 0; i < rig->node_count; i++) {
		struct rig_node *node = &rig->nodes[i];
		*node = (struct rig_node){
			.parent = i > 0 ? take_index(i) : SM_NONE, .local = {[15] = 1}};
		for (int column = 0; column < 4; column++)
			take_floats(numbers, &node->local[4 * column], 3);
	}
	rig->object_count = model->object_count;
	rig->object_nodes = take_room(model, rig->object_count, sizeof(*rig->object_nodes));
	for (size_t i = 0; i < rig->object_count; i++)
		rig->object_nodes[i] = 1 + take_index(rig->node_count - 1);
}

static void take_targets(struct model *model, size_t vertex_count, struct shape *shape)
{
	size_t count = take_index(RIG_TARGETS + 1);
	float *weights = take_room(model, count, sizeof(*weights));
	take_finite(weights, count);
	shape->targets = take_room(model, count, sizeof(*shape->targets));
	shape->target_count = count;
	shape->weights = weights;
	for (size_t i = 0; i < count; i++) {
		bool turns = take_byte(numbers) & 1;
		shape->targets[i].positions = take_array(model, 3 * vertex_count);
		shape->targets[i].normals = turns ? take_array(model, 3 * vertex_count) : NULL;
	}
}

/* Up to three bones a vertex, whose weights add up to 1. */
static void take_influences(struct model *model, size_t vertex_count, struct shape *shape)
{
	uint32_t *first = take_room(model, vertex_count + 1, sizeof(*first));
	struct influence *influences = take_room(model, 3 * vertex_count, sizeof(*influences));
	for (size_t v = 0; v < vertex_count; v++) {
		uint32_t count = take_index(4);
		first[v + 1] = first[v] + count;
		for (uint32_t i = first[v]; i < first[v + 1]; i++)
			influences[i] =
				(struct influence){take_index(shape->bone_count), 1 / (float)count};
	}
	shape->first = first;
	shape->influences = influences;
}

static void take_bones(const struct rig *rig, struct model *model, struct shape *shape)
{
	shape->bone_count = take_index(RIG_BONES + 1);
	shape->bones = take_room(model, shape->bone_count, sizeof(*shape->bones));
	for (size_t i = 0; i < shape->bone_count; i++) {
		struct bone *bone = &shape->bones[i];
		*bone = (struct bone){.node = take_index(rig->node_count), .offset = {[15] = 1}};
		for (int column = 0; column < 4; column++)
			take_finite(&bone->offset[4 * column], 3);
	}
	if (shape->bone_count > 0)
		take_influences(model, model->meshes[shape->mesh].vertex_count, shape);
}

/* Some objects get shapes, each on a mesh of its own. */
static void take_shapes(struct rig *rig, struct model *model)
{
	uint8_t chosen = take_byte(numbers);
	rig->shapes = take_room(model, model->object_count, sizeof(*rig->shapes));
	for (uint32_t i = 0; i < model->object_count; i++) {
		struct sm_object_desc *object = &model->objects[i];
		struct shape *shape = &rig->shapes[rig->shape_count];
		if (!(chosen >> i & 1))
			continue;
		model->meshes[model->mesh_count] = model->meshes[object->mesh];
		object->mesh = (uint32_t)model->mesh_count++;
		*shape = (struct shape){.object = i, .mesh = object->mesh};
		take_targets(model, model->meshes[shape->mesh].vertex_count, shape);
		take_bones(rig, model, shape);
		rig->shape_count++;
	}
}

static void take_track(struct model *model, struct clip *clip, size_t width, struct track *track)
{
	size_t count = 1 + take_index(RIG_KEYS);
	float *times = take_room(model, count, sizeof(*times));
	float *values = take_room(model, count, width * sizeof(*values));
	take_finite(times, count);
	take_finite(values, count * width);
	for (size_t i = 1; i < count; i++)
		times[i] = fmaxf(times[i], times[i - 1]);
	clip->duration = fmax(clip->duration, times[count - 1]);
	*track = (struct track){count, times, values};
}

static void normalise(const struct track *rotation)
{
	float *values = (float *)rotation->values;
	for (size_t i = 0; i < rotation->count; i++) {
		versor turn;
		memcpy(turn, &values[4 * i], sizeof(turn));
		glm_quat_normalize(turn);
		memcpy(&values[4 * i], turn, sizeof(turn));
		for (int k = 0; k < 4; k++) /* of numbers whose squares are none */
			if (!isfinite(values[4 * i + k]))
				values[4 * i + k] = k == 3;
	}
}

static void take_channels(const struct rig *rig, struct model *model, struct clip *clip)
{
	size_t count = take_index(RIG_NODES + 1);
	clip->channels = take_room(model, count, sizeof(*clip->channels));
	for (; clip->channel_count < count; clip->channel_count++) {
		struct channel *channel = &clip->channels[clip->channel_count];
		channel->node = take_index(rig->node_count);
		take_track(model, clip, 3, &channel->position);
		take_track(model, clip, 4, &channel->rotation);
		take_track(model, clip, 3, &channel->scale);
		normalise(&channel->rotation);
	}
}

static void take_blends(const struct rig *rig, struct model *model, struct clip *clip)
{
	clip->blends = take_room(model, rig->shape_count, sizeof(*clip->blends));
	for (uint32_t i = 0; i < rig->shape_count; i++) {
		size_t width = rig->shapes[i].target_count;
		if (width == 0 || !(take_byte(numbers) & 1))
			continue;
		struct blend *blend = &clip->blends[clip->blend_count++];
		blend->shape = i;
		take_track(model, clip, width, &blend->weights);
	}
}

static void take_clips(struct rig *rig, struct model *model)
{
	static const char *const names[RIG_CLIPS] = {"a", "", "none"};
	size_t count = take_index(RIG_CLIPS + 1);
	rig->clips = take_room(model, count, sizeof(*rig->clips));
	for (; rig->clip_count < count; rig->clip_count++) {
		struct clip *clip = &rig->clips[rig->clip_count];
		clip->name = names[rig->clip_count];
		clip->duration = fabsf(take_float(numbers));
		if (!isfinite(clip->duration))
			clip->duration = 0;
		take_channels(rig, model, clip);
		take_blends(rig, model, clip);
	}
}

void take_rig(struct numbers *input, struct model *model)
{
	numbers = input;
	take_nodes(&model->rig, model);
	take_shapes(&model->rig, model);
	take_clips(&model->rig, model);
	for (size_t i = 0; i < model->light_count; i++)
		model->lights[i].node = take_index(model->rig.node_count);
	model->camera_node = take_index(model->rig.node_count);
}
