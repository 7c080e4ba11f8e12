/* SPDX-License-Identifier: MIT */
#include "shadow_set.h"
#include "base/array.h"
#include "exact_pass.h"
#include "scene/seen_cells.h"
#include "technique/depth_map.h"
#include <stdlib.h>

#define MAP_SIZE_DEFAULT 1024
/* Border texels stay clear: a map of one or two texels a side shows no shadow. */
#define MAP_SIZE_MIN 1

/* Bits of enum technique_option that are not left at 0. */
static unsigned int options_set(const struct sm_shadow_options *options)
{
	return (options->width != 0.0f ? OPTION_WIDTH : 0) |
	       (options->falloff != SM_FALLOFF_DEFAULT ? OPTION_FALLOFF : 0) |
	       (options->passes != 0 ? OPTION_PASSES : 0) |
	       (options->precision > SM_PRECISION_FLOAT ? OPTION_PRECISION : 0) |
	       (options->sampling != SM_SAMPLING_DEFAULT ? OPTION_SAMPLING : 0);
}

static bool check_used(const struct sm_shadow_options *options, const struct technique *technique,
	struct sm_error *error)
{
	static const struct {
		const char *name;
		enum technique_option option;
	} fields[] = {
		{"width", OPTION_WIDTH},
		{"falloff", OPTION_FALLOFF},
		{"passes", OPTION_PASSES},
		{"precision", OPTION_PRECISION},
		{"sampling", OPTION_SAMPLING},
	};
	unsigned int unused = options_set(options) & ~technique->options;
	for (size_t i = 0; i < sizeof(fields) / sizeof(fields[0]); i++)
		if (unused & fields[i].option)
			return error_set(error, SM_ERROR_INPUT,
				"shadow %s does nothing with the technique \"%s\"; leave it out",
				fields[i].name, technique->name);
	return true;
}

/* Also sets the default. */
static bool check_samples(struct sm_shadow_options *options, const struct technique *technique,
	struct sm_error *error)
{
	const uint32_t *choices = technique->samples;
	char text[100] = "";
	size_t used = 0;
	if (options->samples == 0)
		options->samples = choices[0];
	if (options->samples == choices[0])
		return true;
	if (choices[0] == 0)
		return error_set(error, SM_ERROR_INPUT,
			"shadow samples does nothing with the technique \"%s\"; leave it out",
			technique->name);
	for (; *choices != 0; choices++) {
		if (options->samples == *choices)
			return true;
		used += (size_t)snprintf(
			text + used, sizeof(text) - used, "%s%u", used > 0 ? ", " : "", *choices);
	}
	return error_set(error, SM_ERROR_INPUT,
		"%u shadow samples; with the technique \"%s\" there are: %s", options->samples,
		technique->name, text);
}

static bool check_range(
	const struct sm_shadow_options *options, const struct caps *caps, struct sm_error *error)
{
	uint32_t most = (uint32_t)caps->max_texture_size;
	if (options->map_size != 0 &&
		(options->map_size < MAP_SIZE_MIN || options->map_size > most))
		return error_set(error, SM_ERROR_INPUT,
			"a shadow map of %u texels a side; with this driver it goes from %d to %u",
			options->map_size, MAP_SIZE_MIN, most);
	if (!(options->width >= 0.0f && options->width <= 1.0f))
		return error_set(error, SM_ERROR_INPUT,
			"a smoothie width of %g; it goes from 0 to 1 (0: from the light's radius)",
			(double)options->width);
	if (options->passes > 2)
		return error_set(
			error, SM_ERROR_INPUT, "%u smoothie passes; 1 or 2", options->passes);
	if (options->sampling > SM_SAMPLING_DEFERRED_SPARSE)
		return error_set(error, SM_ERROR_INPUT, "a sampling of number %d; the last is %d",
			(int)options->sampling, SM_SAMPLING_DEFERRED_SPARSE);
	return true;
}

static bool check_precision(const struct sm_shadow_options *options, struct sm_error *error)
{
	if (options->precision <= SM_PRECISION_FLOAT)
		return true;
	const char *name = sm_precision_name((size_t)options->precision - 1);
	if (name == NULL)
		return error_set(error, SM_ERROR_INPUT, "a precision of number %d; the last is %d",
			(int)options->precision, SM_PRECISION_FIXED12);
	if (options->map_size > SM_EXACT_SIZE_MAX)
		return error_set(error, SM_ERROR_INPUT,
			"a shadow map of %u texels a side; with the precision \"%s\" there are at "
			"most %d",
			options->map_size, name, SM_EXACT_SIZE_MAX);
	if (options->passes == 1)
		return error_set(error, SM_ERROR_INPUT,
			"1 smoothie pass; with the precision \"%s\" there are always 2", name);
	return true;
}

/* The first that uses all that is set, or else the first. */
static const struct technique *default_technique(const struct sm_shadow_options *options)
{
	const struct technique *technique;
	for (size_t i = 0; (technique = technique_at(i)) != NULL; i++)
		if (!(options_set(options) & ~technique->options))
			return technique;
	return technique_at(0);
}

static const struct technique *find_technique(
	const struct sm_shadow_options *options, struct sm_error *error)
{
	const char *name = options->technique;
	const struct technique *technique =
		name != NULL ? technique_find(name) : default_technique(options);
	if (technique != NULL)
		return technique;
	char names[200] = "";
	size_t used = 0;
	for (size_t i = 0; technique_at(i) != NULL && used < sizeof(names); i++)
		used += (size_t)snprintf(names + used, sizeof(names) - used, "%s%s",
			i > 0 ? ", " : "", technique_at(i)->name);
	error_set(error, SM_ERROR_INPUT, "no technique \"%s\"; there are: %s", name, names);
	return NULL;
}

bool shadow_set_init(struct shadow_set *set, const struct sm_shadow_options *options,
	const struct caps *caps, struct sm_error *error)
{
	*set = (struct shadow_set){.options = *options};
	set->technique = find_technique(options, error);
	if (set->technique == NULL || !check_used(options, set->technique, error) ||
		!check_samples(&set->options, set->technique, error) ||
		!check_range(options, caps, error) || !check_precision(options, error))
		return false;
	set->options.technique = NULL;
	if (set->options.map_size == 0)
		set->options.map_size = MAP_SIZE_DEFAULT;
	if (set->options.falloff == SM_FALLOFF_DEFAULT)
		set->options.falloff = SM_FALLOFF_LINEAR;
	if (set->options.precision == SM_PRECISION_DEFAULT)
		set->options.precision = SM_PRECISION_FLOAT;
	if (set->options.precision != SM_PRECISION_FLOAT)
		set->technique = &technique_exact;
	if (set->options.passes == 0)
		set->options.passes = set->options.precision == SM_PRECISION_FLOAT ? 1 : 2;
	return true;
}

static void shadow_destroy(struct shadow_set *set, struct gpu *gpu, struct light_shadow *shadow)
{
	if (shadow == NULL)
		return;
	if (shadow->state != NULL)
		set->technique->finish(shadow->state, gpu);
	lit_parts_finish(&shadow->lit, &gpu->gl);
	free(shadow->state);
	free(shadow);
}

void shadow_set_finish(struct shadow_set *set, struct gpu *gpu)
{
	for (size_t i = 0; i < set->count; i++)
		shadow_destroy(set, gpu, set->shadows[i]);
	free(set->shadows);
	*set = (struct shadow_set){0};
}

void shadow_set_forget(struct shadow_set *set)
{
	for (size_t i = 0; i < set->count; i++)
		if (set->shadows[i] != NULL)
			set->shadows[i]->drawn = false;
}

void shadow_set_list_memory(const struct shadow_set *set, const struct memory_list *list)
{
	memory_list_processor(list, "states of techniques", set->capacity * sizeof(*set->shadows));
	for (size_t i = 0; i < set->count; i++) {
		struct memory_list of_light = {list->sink, list->data, (uint32_t)i};
		if (set->shadows[i] == NULL)
			continue;
		memory_list_processor(&of_light, "states of techniques",
			sizeof(*set->shadows[i]) + set->technique->state_size);
		memory_list_processor(
			&of_light, "lit triangles", lit_parts_bytes(&set->shadows[i]->lit));
		if (set->technique->list_memory != NULL)
			set->technique->list_memory(set->shadows[i]->state, &of_light);
	}
}

/* Of surfaces that the technique has drawn with its map alone; what it drew before has none, and
 * where it says that nothing is darkened there is none to look up. */
static bool choose_map_flags(struct shadow_set *set, struct gpu *gpu, struct sm_error *error)
{
	struct depth_ways ways;
	if (set->technique->prepare == NULL || set->technique->soft_is_all)
		return true;
	if (!depth_ways_choose(&ways, gpu, error))
		return false;
	/* Four texels apart, as the technique has them: a sampler that blends may round otherwise.
	 */
	set->map_flags = FLAG_SHADOWED | FLAG_HARD |
			 (ways.taps_plainly ? FLAG_FOUR_FETCHES | ways.plain : FLAG_GATHER);
	return true;
}

/* Makes room for shadow number `index`, which is NULL if there was none. */
static bool reserve_shadow(struct shadow_set *set, size_t index)
{
	if (!array_reserve(
		    (void **)&set->shadows, &set->capacity, index + 1, sizeof(*set->shadows)))
		return false;
	for (; set->count <= index; set->count++)
		set->shadows[set->count] = NULL;
	return true;
}

static bool add_shadow(
	struct shadow_set *set, struct gpu *gpu, size_t index, struct sm_error *error)
{
	if (!choose_map_flags(set, gpu, error))
		return false;
	struct light_shadow *shadow = calloc(1, sizeof(*shadow));
	if (shadow == NULL)
		return error_no_memory(error);
	shadow->state = calloc(1, set->technique->state_size);
	if (shadow->state == NULL)
		error_no_memory(error);
	if (shadow->state == NULL ||
		!set->technique->init(shadow->state, gpu, &set->options, error)) {
		shadow_destroy(set, gpu, shadow);
		return false;
	}
	set->shadows[index] = shadow;
	return true;
}

/* Texels that a surface looks up around itself, and what rasterisers snap by, with some to spare.
 */
#define TEXELS_AROUND 3.0f

/* Where on the light's screen something may be looked up. Several samples of a pixel share what one
 * of them is looked up for, which may lie beside the surface. */
static void find_seen(struct screen_grid *seen, const struct shadow_set *set,
	const struct shadow_request *request, float reach)
{
	struct view_volume volume;
	float texels = TEXELS_AROUND * 2.0f / (float)set->options.map_size;
	if (request->view->multisampled) {
		screen_grid_fill(seen);
		return;
	}
	view_volume_init(&volume, request->view->world_to_clip);
	seen_cells_find(seen, request->local->scene, request->frame, &volume, reach + texels);
}

/* Whether what was left out of the shadow is in view now: then it will not be again, so that a
 * camera that moves on meets that once. seen: NULL: it is all. */
static bool lacks_casters(
	const struct object_watch *casters, struct gpu *gpu, const struct screen_grid *seen)
{
	size_t count = casters->left_out_count;
	bool lacks = count > 0 && (seen == NULL || object_watch_lacks(casters, seen));
	skip_count(&gpu->skips, SKIP_VOLUME, count, lacks ? 0 : count);
	return lacks;
}

static bool draw(const struct technique *technique, void *state, struct gpu *gpu,
	const struct shadow_request *request, struct sm_error *error)
{
	const struct sm_scene *scene = request->local->scene;
	return technique->prepare_view != NULL
		       ? technique->prepare_view(
				 state, gpu, scene, request->frame, request->view, error)
		       : technique->prepare(state, gpu, scene, request->frame, error);
}

/* The same without the casters that are beside what is seen; NULL: with all. */
static bool draw_seen(const struct technique *technique, void *state, struct gpu *gpu,
	const struct shadow_request *request, struct object_watch *casters,
	const struct screen_grid *seen, struct sm_error *error)
{
	if (casters == NULL)
		return draw(technique, state, gpu, request, error);
	casters->seen = seen;
	bool drawn = draw(technique, state, gpu, request, error);
	casters->seen = NULL;
	skip_count(&gpu->skips, SKIP_VOLUME, casters->seen_tested, casters->seen_left_out);
	return drawn;
}

/* same: what is drawn is as it would be, but for what the view that it was drawn for left out. */
static bool draw_changes(struct shadow_set *set, struct gpu *gpu, struct light_shadow *shadow,
	const struct shadow_request *request, bool same, struct sm_error *error)
{
	const struct technique *technique = set->technique;
	struct object_watch *casters = NULL;
	struct screen_grid cells, *seen = NULL;
	float reach;
	if (technique->casters != NULL)
		casters = technique->casters(shadow->state, request->frame, &reach);
	bool complete = casters == NULL || (same && casters->left_out_count == 0);
	if (!complete && !gpu->skips.off[SKIP_VOLUME]) {
		find_seen(&cells, set, request, reach);
		seen = &cells;
	}
	bool lacks = same && !complete && lacks_casters(casters, gpu, seen);
	if (skip_take(&gpu->skips, SKIP_LIGHT, same && !lacks))
		return true;
	shadow->mapped = false;
	lit_parts_forget(&shadow->lit);
	shadow->drawn = draw_seen(
		technique, shadow->state, gpu, request, casters, lacks ? NULL : seen, error);
	return shadow->drawn;
}

/* Makes the shadow's state when first it is needed. */
static struct light_shadow *take_shadow(
	struct shadow_set *set, struct gpu *gpu, size_t index, struct sm_error *error)
{
	if (!reserve_shadow(set, index)) {
		error_no_memory(error);
		return NULL;
	}
	if (set->shadows[index] == NULL && !add_shadow(set, gpu, index, error))
		return NULL;
	return set->shadows[index];
}

static struct light_shadow *prepare(struct shadow_set *set, struct gpu *gpu,
	const struct shadow_request *request, struct sm_error *error)
{
	const struct technique *technique = set->technique;
	struct light_shadow *shadow = take_shadow(set, gpu, request->index, error);
	if (shadow == NULL)
		return NULL;
	struct light_key key =
		light_key_of(technique, request->local, request->frame, request->view);
	bool changed = technique->choose != NULL &&
		       technique->choose(shadow->state, gpu, request->local->scene, request->frame);
	bool same = !changed && shadow->drawn && light_key_is_same(&shadow->key, &key);
	shadow->key = key;
	return draw_changes(set, gpu, shadow, request, same, error) ? shadow : NULL;
}

struct light_shadow *shadow_set_prepare(struct shadow_set *set, struct gpu *gpu,
	const struct shadow_request *request, struct sm_error *error)
{
	gpu->gl.light = (uint32_t)request->index;
	struct light_shadow *shadow = prepare(set, gpu, request, error);
	gpu->gl.light = SM_NONE;
	return shadow;
}

void shadow_set_leave(struct shadow_set *set, size_t index)
{
	bool there = index < set->count && set->shadows[index] != NULL;
	if (there && set->technique->leave != NULL)
		set->technique->leave(set->shadows[index]->state);
}
