/* SPDX-License-Identifier: MIT */
#include "technique/depth_map.h"
#include "technique/disc.h"

/* Heckbert & Herf 1997, Agrawala et al. 2000: in their plain form. The layers are many times a
 * shadow map's memory. OpenGL ES 3.0 has at least 256 of them. */
struct maps {
	struct target layers;
	struct target plain; /* depths as colours, where they are read without comparing; or zero */
	GLuint compare;      /* sampler: LEQUAL */
	struct object_watch watch; /* on casters, that some may be left out */
	struct disc disc;
	uint64_t write, surface_flags;
};

static bool maps_init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	struct maps *maps = state;
	struct depth_ways ways;
	if (!depth_ways_choose(&ways, gpu, error))
		return false;
	disc_init(&maps->disc, options->samples);
	maps->surface_flags = FLAG_MAPS | ways.compare;
	if (!target_init_layers(&maps->layers, &gpu->gl, STORAGE_SHADOW_MAPS,
		    (GLsizei)options->map_size, maps->disc.count, GL_DEPTH_COMPONENT24,
		    GL_DEPTH_ATTACHMENT, error))
		return false;
	maps->compare = depth_map_create_sampler(gpu, DEPTH_MAP_LINEAR);
	if (!ways.compares_plainly || ways.format == 0)
		return true;
	maps->write = ways.write;
	return target_init_layers(&maps->plain, &gpu->gl, STORAGE_PLAIN_DEPTHS, maps->layers.size,
		maps->disc.count, ways.format, GL_COLOR_ATTACHMENT0, error);
}

static void maps_finish(void *state, struct gpu *gpu)
{
	struct maps *maps = state;
	object_watch_finish(&maps->watch);
	gl_delete_sampler(&gpu->gl, &maps->compare);
	target_finish(&maps->plain, &gpu->gl);
	target_finish(&maps->layers, &gpu->gl);
}

static void bind_layer(const struct maps *maps, struct gl *gl, GLint layer)
{
	if (maps->plain.texture == 0) {
		target_bind_layer(&maps->layers, gl, layer);
		return;
	}
	target_bind_layer(&maps->plain, gl, layer);
	gl->FramebufferTextureLayer(
		GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, maps->layers.texture, 0, layer);
}

static bool maps_prepare(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	struct maps *maps = state;
	struct screen_box changed; /* all */
	bool drawn = true;
	object_watch_forget(&maps->watch);
	if (!depth_map_look_at_casters(&maps->watch, scene, frame, &changed, error))
		return false;
	gl_push_group(&gpu->gl, "shadow maps");
	for (GLsizei i = 0; i < maps->disc.count && drawn; i++) {
		struct light_frame sheared = disc_frame(frame, maps->disc.points[i]);
		bind_layer(maps, &gpu->gl, i);
		drawn = depth_map_fill(gpu, scene, &sheared, &maps->watch, maps->write,
			target_inside(&maps->layers), error);
	}
	gl_pop_group(&gpu->gl);
	return drawn;
}

static uint64_t maps_surface_flags(const void *state)
{
	const struct maps *maps = state;
	return maps->surface_flags;
}

/* From the near plane to the far one. */
static float maps_reach(const void *state, const struct light_frame *frame)
{
	(void)state;
	return 2.0f * disc_scale(frame);
}

static struct object_watch *maps_casters(void *state, const struct light_frame *frame, float *reach)
{
	struct maps *maps = state;
	*reach = maps_reach(state, frame);
	return &maps->watch;
}

static void maps_list_memory(const void *state, const struct memory_list *list)
{
	const struct maps *maps = state;
	object_watch_list_memory(&maps->watch, list);
}

static void maps_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	const struct maps *maps = state;
	bool colors = maps->plain.texture != 0;
	gpu_bind_layers(gpu, UNIT_DEPTH_LAYERS, maps->layers.texture);
	gpu_bind_layers(
		gpu, UNIT_PLAIN_LAYERS, colors ? maps->plain.texture : maps->layers.texture);
	gpu->gl.BindSampler(UNIT_DEPTH_LAYERS, maps->compare);
	depth_map_set_receiver(gpu, maps->layers.size, DEPTH_MAP_LINEAR, frame, program);
	disc_bind(&maps->disc, gpu, frame, program);
}

const struct technique technique_maps = {
	.name = "maps",
	.summary = "shadow maps of many points of the light, averaged (Heckbert & Herf 1997)",
	.samples = {16, 4, 64},
	.state_size = sizeof(struct maps),
	.init = maps_init,
	.finish = maps_finish,
	.prepare = maps_prepare,
	.surface_flags = maps_surface_flags,
	.reach = maps_reach,
	.casters = maps_casters,
	.list_memory = maps_list_memory,
	.bind = maps_bind,
};
