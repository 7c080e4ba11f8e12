/* SPDX-License-Identifier: MIT */
#include "model/float_visibility.h"
#include "base/error.h"
#include "model/technique.h"
#include "scene/camera.h"
#include "scene/edge_grid.h"
#include "scene/penumbra.h"
#include <stdlib.h>
#include <string.h>

static const struct model_technique *const techniques[] = {&model_smoothie, &model_two_sided,
	&model_penumbra_map, &model_hard, &model_pcf, &model_pcss, &model_vsm, &model_maps,
	&model_gather};

static const struct model_technique *find_technique(const char *name)
{
	for (size_t i = 0; i < sizeof(techniques) / sizeof(techniques[0]); i++)
		if (strcmp(techniques[i]->name, name) == 0)
			return techniques[i];
	return NULL;
}

static bool is_auto(const char *name)
{
	return strcmp(name, "auto") == 0;
}

/* Whether the light's screen holds no more than casters shade: auto's does, whatever it draws. */
static bool fits_screen(const char *name)
{
	const struct model_technique *technique = find_technique(is_auto(name) ? "gather" : name);
	return technique != NULL && technique->fits;
}

/* What "auto" comes to in a first frame, or the technique itself. */
static const char *name_drawn(const char *name, const struct model_light *light)
{
	if (!is_auto(name))
		return name;
	float texels = penumbra_texels(light->scene, &light->frame, (uint32_t)light->size);
	return penumbra_shows(texels, false) ? "gather" : "hard";
}

/* A technique on its light's maps, and the camera's view. */
struct scenery {
	struct model_light light;
	const struct model_technique *technique;
	void *state;
	struct view view;
};

static uint16_t value_at(const struct scenery *scenery, int x, int y)
{
	const struct view *view = &scenery->view;
	const struct view_pixel *pixel = &view->pixels[(size_t)y * (size_t)view->width + (size_t)x];
	if (pixel->object == NULL)
		return 65535;
	struct surface surface = view_surface(view, pixel);
	double v = surface.faces_light ? 1.0 : 0.0;
	if (surface.faces_light && pixel->object->receives) {
		struct receiver receiver = receiver_of(&surface, &scenery->light);
		receiver.pixel[0] = x;
		receiver.pixel[1] = y;
		receiver.casts = pixel->object->casts;
		v = scenery->technique->visibility(scenery->state, &receiver);
	}
	return (uint16_t)floor(fmin(fmax(v, 0.0), 1.0) * 65535.0 + 0.5);
}

static bool set_up(struct scenery *scenery, const struct sm_view *view, struct sm_error *error)
{
	const struct sm_scene *scene = scenery->light.scene;
	mat4 world_to_clip;
	if (!camera_world_to_clip(
		    &view->camera, scene, view->width, view->height, world_to_clip, error))
		return false;
	scenery->view.weights_stay = scenery->technique->finds_middle &&
				     raster_is_coarse((uint32_t)scenery->light.snap_bits);
	scenery->state = calloc(1, scenery->technique->state_size);
	if (scenery->state == NULL)
		return error_no_memory(error);
	return scenery->technique->init(scenery->state, &scenery->light, error) &&
	       view_init(&scenery->view, &scenery->light, world_to_clip, (int)view->width,
		       (int)view->height, error);
}

bool model_float_visibility(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, uint32_t snap_bits, uint16_t *values,
	struct sm_error *error)
{
	struct scenery scenery = {
		.light = {.scene = scene,
			.options = *options,
			.size = (int)options->map_size,
			.snap_bits = (int)snap_bits},
	};
	const char *name = options->technique;
	const struct sm_light_desc *light = &scene->lights[view->visibility_of].desc;
	(fits_screen(name) ? light_frame_fit : light_frame_init)(
		&scenery.light.frame, light, scene);
	name = name_drawn(name, &scenery.light);
	scenery.technique = find_technique(name);
	if (scenery.technique == NULL)
		return error_set(error, SM_ERROR_INPUT, "no model of the technique \"%s\"", name);
	bool drawn = set_up(&scenery, view, error);
	for (int y = 0; drawn && y < (int)view->height; y++)
		for (int x = 0; x < (int)view->width; x++)
			*values++ = value_at(&scenery, x, (int)view->height - 1 - y);
	view_finish(&scenery.view);
	if (scenery.state != NULL)
		scenery.technique->finish(scenery.state);
	free(scenery.state);
	return drawn;
}
