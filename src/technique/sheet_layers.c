/* SPDX-License-Identifier: MIT */
#include "technique/sheet_layers.h"
#include "gles/raster_grid.h"
#include "scene/edge_grid.h"

bool sheet_layers_init(
	struct sheet_layers *layers, struct gpu *gpu, GLsizei size, struct sm_error *error)
{
	layers->coarse = raster_is_coarse(raster_grid_bits(gpu));
	return target_init_shared(&layers->depth, &gpu->gl, STORAGE_LAYER_DEPTHS, size,
		GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, error);
}

void sheet_layers_finish(struct sheet_layers *layers, struct gpu *gpu)
{
	for (int i = 0; i < GATHER_LAYERS; i++)
		target_finish(&layers->of[i], &gpu->gl);
	target_finish(&layers->depth, &gpu->gl);
}

void sheet_layers_forget(struct sheet_layers *layers)
{
	layers->count = 0;
}

static void draw_sheets(struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct depth_map_redraw *redraw,
	const struct program *program)
{
	struct gl *gl = &gpu->gl;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		if (!object->casts || !depth_map_is_drawn(gpu, scene, i, frame, redraw))
			continue;
		mat4 to_clip;
		glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform, to_clip);
		gl->UniformMatrix4fv(program->uniform.object_to_clip, 1, GL_FALSE, to_clip[0]);
		struct sheet_rule rule = mesh_sheet_rule(
			&scene->meshes[object->mesh], (vec4 *)object->transform, to_clip);
		gpu_draw_sheets(gpu, &gpu->scene.meshes[object->mesh], &rule);
	}
	gl->Disable(GL_CULL_FACE);
}

static bool bind_layer(
	struct sheet_layers *layers, struct gl *gl, int layer, struct sm_error *error)
{
	struct target *target = &layers->of[layer];
	if (target->whole) {
		target_bind(target, gl);
		return true;
	}
	target_finish(target, gl);
	if (!target_init(target, gl, STORAGE_LAYERS, layers->depth.size, GL_RG32UI,
		    GL_COLOR_ATTACHMENT0, error))
		return false;
	gl->FramebufferTexture2D(
		GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, layers->depth.texture, 0);
	target_bind(target, gl);
	return true;
}

/* What is drawn anew of a layer. */
struct part {
	const struct object_watch *watch;
	const struct screen_box *box;
};

static bool draw_layer(struct sheet_layers *layers, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, int layer, const struct part *part, struct sm_error *error)
{
	/* Depth 2 as the bits of a float, behind all there is. */
	static const GLuint none[4] = {0x40000000, 0, 0, 0};
	struct gl *gl = &gpu->gl;
	uint64_t coarse = layers->coarse ? FLAG_COARSE : 0;
	struct program_key key = {PROGRAM_LAYER, coarse | (layer > 0 ? FLAG_PEEL : 0)};
	float texel = 2.0f / (float)layers->depth.size;
	const struct target *target = &layers->of[layer];
	if (!bind_layer(layers, gl, layer, error))
		return false;
	gl->DepthMask(GL_TRUE);
	target_restrict_clear(target, part->box, gl);
	gl->ClearBufferuiv(GL_COLOR, 0, none);
	gl->ClearBufferfv(GL_DEPTH, 0, &(GLfloat){1.0f});
	gl->Disable(GL_SCISSOR_TEST);
	const struct program *program = program_use(&gpu->programs, gl, key, error);
	if (program == NULL)
		return false;
	gl->Uniform2f(program->uniform.pixel_size, texel, texel);
	if (layer > 0)
		gpu_bind_texture(gpu, UNIT_FRONT_LAYER, layers->of[layer - 1].texture);
	gl->Enable(GL_DEPTH_TEST);
	gl->DepthFunc(GL_LESS);
	target_restrict(target_part(target, part->box), gl);
	const struct depth_map_redraw redraw = {
		.watch = part->watch, .reach = target_part_reach(target, part->box)};
	draw_sheets(gpu, scene, frame, &redraw, program);
	gl->Disable(GL_SCISSOR_TEST);
	return true;
}

bool sheet_layers_draw(struct sheet_layers *layers, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, int count, const struct object_watch *watch,
	const struct screen_box *changed, struct sm_error *error)
{
	const struct screen_box all = screen_box_all();
	const struct part here = {watch, changed}, everywhere = {watch, &all};
	int kept = layers->count;
	bool drawn = true;
	if (count <= kept && screen_box_is_none(changed)) {
		layers->count = count;
		return true;
	}
	layers->count = 0;
	gl_push_group(&gpu->gl, "layers");
	for (int i = 0; i < count && drawn; i++)
		if (i >= kept || !screen_box_is_none(changed))
			drawn = draw_layer(layers, gpu, scene, frame, i,
				i < kept ? &here : &everywhere, error);
	gl_pop_group(&gpu->gl);
	if (drawn)
		layers->count = count;
	/* So that a driver begins with them while edges are looked for. */
	gpu->gl.Flush();
	return drawn;
}
