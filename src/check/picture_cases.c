/* SPDX-License-Identifier: MIT */
/* Pictures of every technique, on every scene and in every way, against the model of each: float
 * ones within a tolerance, exact ones to the bit. */
#include "base/array.h"
#include "check/cases.h"
#include "check/context.h"
#include "check/needs.h"
#include "check/pinned.h"
#include "check/tolerance.h"
#include "check/view.h"
#include "platform.h"
#include <GLES3/gl3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a case's choices are. */
enum {
	TECHNIQUE,
	SAMPLES,
	SCENE,
	NEED, /* SIZE_MAX: no way is forced */
	WAY,
};

/* As the model finds visibility: for each pixel. */
static enum sm_sampling sampling_of(size_t technique)
{
	const char *name = sm_technique_name(technique);
	bool takes = strcmp(name, "gather") == 0 || strcmp(name, "auto") == 0;
	return takes ? SM_SAMPLING_DENSE : SM_SAMPLING_DEFAULT;
}

static struct sm_shadow_options options_of(
	const struct check_case *item, const struct check_context *context)
{
	size_t technique = item->choice[TECHNIQUE];
	return (struct sm_shadow_options){
		.technique = sm_technique_name(technique),
		.samples = sm_technique_samples(technique, item->choice[SAMPLES]),
		.map_size = context->map,
		.sampling = sampling_of(technique),
	};
}

static bool has_way(const struct check_case *item)
{
	return item->choice[NEED] != SIZE_MAX;
}

#define WAY_SIZE 64

/* "NEED=WAY" of a case that has one. */
static const char *print_way(const struct check_case *item, char *text)
{
	snprintf(text, WAY_SIZE, "%s=%s", sm_need_name(item->choice[NEED]),
		sm_way_name(item->choice[NEED], item->choice[WAY]));
	return text;
}

/* A renderer in the way of the case, or NULL. */
static struct sm_renderer *make_renderer(
	const struct check_case *item, const struct check_context *context, struct sm_error *error)
{
	char way[WAY_SIZE];
	size_t count = context->driver.path_count;
	const char **paths = array_alloc(count + 1, sizeof(*paths));
	struct sm_driver_options driver = {
		.caps = context->driver.caps, .paths = paths, .path_count = count};
	if (paths == NULL) {
		error_no_memory(error);
		return NULL;
	}
	if (count > 0)
		memcpy(paths, context->driver.paths, count * sizeof(*paths));
	if (has_way(item))
		paths[driver.path_count++] = print_way(item, way);
	struct sm_renderer *renderer = sm_renderer_create_with(platform_get_proc, &driver, error);
	free(paths);
	return renderer;
}

/* A case that is drawn and modelled. */
struct subject {
	struct sm_shadow_options options;
	struct check_view view;
	struct sm_renderer *renderer;
	size_t pixels;
};

static bool subject_init(struct subject *subject, const struct check_case *item,
	struct check_context *context, struct sm_error *error)
{
	subject->pixels = (size_t)context->width * context->height;
	context->drawn = array_alloc(subject->pixels, sizeof(*context->drawn));
	context->wanted = array_alloc(subject->pixels, sizeof(*context->wanted));
	if (context->drawn == NULL || context->wanted == NULL)
		return error_no_memory(error);
	return check_view_init(&subject->view, check_scene_name(item->choice[SCENE]),
		       context->width, context->height, error) &&
	       sm_renderer_set_shadows(subject->renderer, &subject->options, error) &&
	       check_view_draw(&subject->view, subject->renderer, context->drawn, error);
}

static void subject_finish(struct subject *subject)
{
	check_view_finish(&subject->view);
	sm_renderer_destroy(subject->renderer);
}

static struct sm_view view_of(const struct subject *subject)
{
	return (struct sm_view){
		.camera = subject->view.stage.camera,
		.width = subject->view.width,
		.height = subject->view.height,
		.visibility_of = 0,
	};
}

static uint32_t subpixel_bits(void)
{
	GLint bits = 4;
	glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
	return bits < 1 ? 1 : bits > 8 ? 8 : (uint32_t)bits;
}

/* Against the model, and where that is not met, against the model of a driver that moves corners to
 * its grid of subpixels before it interpolates: the nearer of them. */
static bool judge(const struct subject *subject, const struct check_tolerance *tolerance,
	struct check_context *context, struct check_result *result, struct sm_error *error)
{
	struct sm_view view = view_of(subject);
	const struct sm_scene *scene = subject->view.stage.scene;
	uint16_t *wanted = context->wanted;
	size_t size = subject->pixels * sizeof(*wanted);
	if (!sm_model_visibility(scene, &view, &subject->options, wanted, error))
		return false;
	check_tolerance_judge(tolerance, context->drawn, wanted, subject->pixels, result);
	if (result->status == CHECK_PASS)
		return true;
	struct check_result first = *result;
	uint16_t *before = array_copy(wanted, subject->pixels, sizeof(*wanted));
	if (before == NULL)
		return error_no_memory(error);
	bool modelled = sm_model_visibility_snapped(
		scene, &view, &subject->options, subpixel_bits(), wanted, error);
	if (modelled)
		check_tolerance_judge(tolerance, context->drawn, wanted, subject->pixels, result);
	if (modelled && first.difference.failing < result->difference.failing) {
		memcpy(wanted, before, size);
		*result = first;
	}
	free(before);
	return modelled;
}

static struct check_tolerance tolerance_of(
	const struct check_case *item, const struct check_context *context)
{
	char way[WAY_SIZE];
	return check_tolerance_find(context->class, has_way(item) ? print_way(item, way) : NULL);
}

/* It cannot be drawn: for lack of something, as sm_renderer_describe() says too, or as it should
 * not be. */
static void refuse(const struct check_case *item, const struct subject *subject,
	const struct sm_error *error, struct check_result *result)
{
	if (check_lacks(subject->renderer, item->choice[TECHNIQUE]))
		check_skip(result, "%s", error->text);
	else
		check_fail(result, "%s", error->text);
}

static void run_picture(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	struct sm_error error;
	struct subject subject = {.options = options_of(item, context)};
	struct check_tolerance tolerance = tolerance_of(item, context);
	subject.renderer = make_renderer(item, context, &error);
	if (subject.renderer == NULL)
		check_skip(result, "%s", error.text);
	else if (!subject_init(&subject, item, context, &error))
		refuse(item, &subject, &error, result);
	else if (!judge(&subject, &tolerance, context, result, &error))
		check_fail(result, "%s", error.text);
	subject_finish(&subject);
}

static void judge_exact(const struct check_case *item, const struct subject *subject,
	const struct check_context *context, struct check_result *result)
{
	unsigned long long hash = pinned_hash(context->wanted, subject->pixels);
	uint64_t pin = 0;
	check_compare(result, context->drawn, context->wanted, subject->pixels, 0);
	if (result->difference.failing > 0)
		check_fail(result, "%llu of %zu pixels have other bits, off by %.3f at most",
			(unsigned long long)result->difference.failing, subject->pixels,
			result->difference.max);
	else if (!pinned_find(
			 check_scene_name(item->choice[SCENE]), subject->options.precision, &pin))
		check_fail(result, "hash %016llx; none is pinned", hash);
	else if (pin != hash)
		check_fail(result, "hash %016llx, and %016llx is pinned", hash,
			(unsigned long long)pin);
	else
		check_pass(result, "hash %016llx, as pinned", hash);
}

/* Of the size that hashes are pinned for, whatever the class. */
static void run_exact(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	struct sm_error error;
	context->width = context->height = PINNED_SIZE;
	context->map = PINNED_MAP;
	struct subject subject = {.options = options_of(item, context)};
	subject.options.technique = "smoothie";
	subject.options.sampling = SM_SAMPLING_DEFAULT;
	subject.options.precision = *(const enum sm_precision *)item->subject;
	subject.renderer = make_renderer(item, context, &error);
	bool drawn = subject.renderer != NULL && subject_init(&subject, item, context, &error);
	struct sm_view view = view_of(&subject);
	if (drawn && sm_model_visibility(subject.view.stage.scene, &view, &subject.options,
			     context->wanted, &error))
		judge_exact(item, &subject, context, result);
	else
		check_fail(result, "%s", error.text);
	subject_finish(&subject);
}

/* "smoothie", or "pcss-32" where there is a choice of samples. */
static void print_technique(size_t technique, size_t samples, char *text, size_t size)
{
	if (sm_technique_samples(technique, 0) > 0)
		snprintf(text, size, "%s-%u", sm_technique_name(technique),
			sm_technique_samples(technique, samples));
	else
		snprintf(text, size, "%s", sm_technique_name(technique));
}

static void add_picture(struct check_list *list, const size_t choice[CHECK_CHOICES])
{
	char technique[64], way[WAY_SIZE];
	struct check_case *item;
	struct check_case named = {0};
	memcpy(named.choice, choice, sizeof(named.choice));
	print_technique(choice[TECHNIQUE], choice[SAMPLES], technique, sizeof(technique));
	const char *scene = check_scene_name(choice[SCENE]);
	if (has_way(&named))
		item = check_list_add(list, run_picture, NULL, "picture.%s.float.%s.%s", technique,
			scene, print_way(&named, way));
	else
		item = check_list_add(
			list, run_picture, NULL, "picture.%s.float.%s", technique, scene);
	if (item != NULL)
		memcpy(item->choice, choice, sizeof(item->choice));
}

static void add_pictures(struct check_list *list, size_t technique, size_t samples)
{
	for (size_t scene = 0; check_scene_name(scene) != NULL; scene++) {
		add_picture(list, (size_t[CHECK_CHOICES]){technique, samples, scene, SIZE_MAX});
		for (size_t need = 0; sm_need_name(need) != NULL; need++)
			for (size_t way = 0; check_uses(technique, samples, need) &&
					     sm_way_name(need, way) != NULL;
				way++)
				add_picture(list, (size_t[CHECK_CHOICES]){
							  technique, samples, scene, need, way});
	}
}

static void add_exact(struct check_list *list, size_t scene, size_t precision)
{
	static const enum sm_precision precisions[] = {
		SM_PRECISION_FLOAT, SM_PRECISION_HALF, SM_PRECISION_FIXED12};
	struct check_case *item = check_list_add(list, run_exact, &precisions[precision],
		"exact.smoothie.%s.%s", sm_precision_name(precision), check_scene_name(scene));
	if (item != NULL)
		memcpy(item->choice, (size_t[CHECK_CHOICES]){0, 0, scene, SIZE_MAX},
			sizeof(item->choice));
}

void check_picture_cases(struct check_list *list)
{
	for (size_t technique = 0; sm_technique_name(technique) != NULL; technique++) {
		size_t samples = 0;
		do
			add_pictures(list, technique, samples++);
		while (sm_technique_samples(technique, samples) > 0);
	}
}

void check_exact_cases(struct check_list *list)
{
	/* float, the first, is not exact. */
	for (size_t precision = 1; sm_precision_name(precision) != NULL; precision++)
		for (size_t scene = 0; check_scene_name(scene) != NULL; scene++)
			add_exact(list, scene, precision);
}
