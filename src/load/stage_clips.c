/* SPDX-License-Identifier: MIT */
#include "load/stage_clips.h"
#include "base/array.h"
#include "load/actor.h"
#include <stdlib.h>
#include <string.h>

static void count_shapes(struct stage_clips *clips, const struct rig *rig)
{
	for (size_t i = 0; i < rig->shape_count; i++) {
		clips->skins += rig->shapes[i].bone_count > 0;
		clips->bones += rig->shapes[i].bone_count;
		clips->targets += rig->shapes[i].target_count;
	}
}

static bool add_clip(
	struct stage_clips *clips, const char *object, const struct rig *rig, size_t number)
{
	const struct clip *source = &rig->clips[number];
	struct stage_clip *clip = &clips->clips[clips->clip_count++];
	*clip = (struct stage_clip){
		.object = strdup(object),
		.name = strdup(source->name),
		.number = number,
		.seconds = source->duration,
		.nodes = source->channel_count,
		.morphs = source->blend_count,
	};
	return clip->object != NULL && clip->name != NULL;
}

bool stage_clips_init(struct stage_clips *clips, const struct plan *plan,
	const struct actor *actors, struct sm_error *error)
{
	size_t count = 0;
	*clips = (struct stage_clips){0};
	for (size_t i = 0; i < plan->object_count; i++)
		count += actors[i].model->rig.clip_count;
	clips->clips = array_zalloc(count, sizeof(*clips->clips));
	bool ok = clips->clips != NULL;
	for (size_t i = 0; ok && i < plan->object_count; i++) {
		const struct rig *rig = &actors[i].model->rig;
		count_shapes(clips, rig);
		for (size_t k = 0; ok && k < rig->clip_count; k++)
			ok = add_clip(clips, plan->objects[i].name, rig, k);
	}
	return ok || error_no_memory(error);
}

void stage_clips_finish(struct stage_clips *clips)
{
	for (size_t i = 0; i < clips->clip_count; i++) {
		free(clips->clips[i].object);
		free(clips->clips[i].name);
	}
	free(clips->clips);
	*clips = (struct stage_clips){0};
}
