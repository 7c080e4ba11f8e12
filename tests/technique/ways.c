/* SPDX-License-Identifier: MIT */
/*
 * Every way to meet a need draws what the best one does, on every scene there is. Prints the mean
 * difference in visibility of each way on each scene: the table of docs/drivers.md.
 */
#include "load/builtin.h"
#include "load/stage.h"
#include "parts.h"
#include "platform.h"
#include "visibility.h"
#include <GLES3/gl3.h>
#include <glob.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define USES_MAX 7
#define WAYS_MAX 8

/* A technique that has the need, and how. */
struct use {
	struct sm_shadow_options shadow; /* no technique: none further */
	const char *path;                /* forced besides; may be NULL */
};

/* Mean |dv| that is allowed beside the best way: of 16F, 32F and depth; of 8 and 10 bits. */
#define FLOAT_LIMIT 0.002
#define FIXED_LIMIT 0.006

#define SMOOTHIE .technique = "smoothie"

/* By the names of needs; "copy" is that of tests/renderer/screen.c. */
static const struct {
	const char *need;
	struct use uses[USES_MAX + 1];
} cases[] = {
	{"smoothie",
		{{{SMOOTHIE}, "pairs=apart"},
			{{SMOOTHIE, .falloff = SM_FALLOFF_SINUSOID}, "pairs=apart"},
			{{SMOOTHIE, .passes = 2}}, {{.technique = "penumbra-map"}, "pairs=apart"}}},
	{"depth", {{{SMOOTHIE}}, {{SMOOTHIE}, "taps=fetch"}, {{.technique = "smoothie-two-sided"}},
			  {{.technique = "pcf"}, "comparison=fetch"}, {{.technique = "pcss"}},
			  {{.technique = "vsm"}, "moments=rg32f-fetch"},
			  {{.technique = "maps", .samples = 4}, "comparison=fetch"}}},
	{"comparison", {{{.technique = "pcf"}}, {{SMOOTHIE}}, {{.technique = "pcss"}},
			       {{.technique = "maps", .samples = 4}}}},
	{"taps", {{{SMOOTHIE}}, {{.technique = "smoothie-two-sided"}},
			 {{.technique = "pcf", .samples = 16}}}},
	{"pairs", {{{SMOOTHIE}}, {{SMOOTHIE, .falloff = SM_FALLOFF_SINUSOID}},
			  {{SMOOTHIE}, "smoothie=fetch"}, {{.technique = "penumbra-map"}}}},
	{"moments", {{{.technique = "vsm"}}}},
};

static double limit_of(const char *way)
{
	bool fixed = strcmp(way, "rgb10_a2") == 0 || strcmp(way, "rgba8") == 0;
	return fixed ? FIXED_LIMIT : FLOAT_LIMIT;
}

static size_t need_index(const char *name)
{
	size_t index = 0;
	while (sm_need_name(index) != NULL && strcmp(sm_need_name(index), name) != 0)
		index++;
	assert_non_null(sm_need_name(index));
	return index;
}

/* A renderer whose paths are forced; NULL where the driver cannot. */
static struct sm_renderer *make_renderer(const char *need, const char *way, const char *besides)
{
	char path[64];
	const char *paths[] = {path, besides};
	struct sm_driver_options options = {.paths = paths, .path_count = besides != NULL ? 2 : 1};
	struct sm_error error;
	snprintf(path, sizeof(path), "%s=%s", need, way);
	struct sm_renderer *renderer = sm_renderer_create_with(platform_get_proc, &options, &error);
	if (renderer == NULL && error.status != SM_ERROR_MACHINE)
		fail_msg("%s", error.text);
	return renderer;
}

/* What is drawn on. */
struct place {
	char name[40];
	struct stage stage;
};

/* One need's renderers, of each way and use. */
struct field {
	struct rig *rig;
	size_t need, item;
	struct sm_renderer *renderers[WAYS_MAX][USES_MAX];
	double worst[WAYS_MAX]; /* on the scene at hand; below 0: the driver cannot */
	bool differs[WAYS_MAX]; /* somewhere, by a bit; or it is the best */
	bool broken;
};

static uint32_t side;

static void draw(struct field *field, size_t way, size_t use, const struct place *place,
	struct visibility *seen)
{
	struct rig *rig = field->rig;
	struct sm_renderer *own = rig->renderer;
	struct sm_shadow_options shadow = cases[field->item].uses[use].shadow;
	shadow.map_size = 2 * side;
	rig->renderer = field->renderers[way][use];
	rig_set_shadows(rig, &shadow);
	visibility_draw(seen, rig, place->stage.scene, &place->stage.camera, side, side);
	rig->renderer = own;
}

/* All ways of one use against the first that the driver has. */
static void compare_ways(struct field *field, size_t use, const struct place *place)
{
	struct visibility best = {0};
	for (size_t way = 0; sm_way_name(field->need, way) != NULL; way++) {
		struct visibility seen;
		if (field->renderers[way][use] == NULL)
			continue;
		draw(field, way, use, place, &seen);
		if (best.values == NULL) {
			best = seen;
			field->worst[way] = 0;
			field->differs[way] = true;
			continue;
		}
		struct visibility_change change = visibility_compare(&best, &seen);
		double mean = change.mean;
		visibility_finish(&seen);
		field->differs[way] = field->differs[way] || change.differing > 0;
		if (mean > field->worst[way])
			field->worst[way] = mean;
		if (mean > limit_of(sm_way_name(field->need, way))) {
			field->broken = true;
			print_error("%s=%s, %s, on %s: mean |dv| %.5f\n", cases[field->item].need,
				sm_way_name(field->need, way),
				cases[field->item].uses[use].shadow.technique, place->name, mean);
		}
	}
	visibility_finish(&best);
}

static void check_place(struct field *field, const struct place *place)
{
	char row[400];
	size_t used = (size_t)snprintf(row, sizeof(row), "%-20.20s", place->name);
	for (size_t way = 0; way < WAYS_MAX; way++)
		field->worst[way] = -1;
	for (size_t use = 0; cases[field->item].uses[use].shadow.technique != NULL; use++)
		compare_ways(field, use, place);
	for (size_t way = 0; sm_way_name(field->need, way) != NULL; way++)
		used += field->worst[way] < 0
				? (size_t)snprintf(row + used, sizeof(row) - used, " | %11s", "-")
				: (size_t)snprintf(row + used, sizeof(row) - used, " | %11.5f",
					  field->worst[way]);
	print_message("%s\n", row);
}

static void print_head(const struct field *field)
{
	char row[400];
	size_t used = (size_t)snprintf(row, sizeof(row), "%-20s", cases[field->item].need);
	for (size_t way = 0; sm_way_name(field->need, way) != NULL; way++)
		used += (size_t)snprintf(
			row + used, sizeof(row) - used, " | %11s", sm_way_name(field->need, way));
	print_message("%s\n", row);
}

static void make_renderers(struct field *field)
{
	for (size_t use = 0; cases[field->item].uses[use].shadow.technique != NULL; use++)
		for (size_t way = 0; sm_way_name(field->need, way) != NULL; way++)
			field->renderers[way][use] = make_renderer(cases[field->item].need,
				sm_way_name(field->need, way), cases[field->item].uses[use].path);
}

static struct place places[64];
static size_t place_count;

/* Where a way rounds more coarsely some pixel tells; else it was not taken at all. */
static void check_rounding(const struct field *field, const char *need)
{
	static const struct {
		const char *need, *way;
	} coarse[] = {{"smoothie", "rgb10_a2"}, {"smoothie", "rgba8"}, {"depth", "r16f"},
		{"pairs", "words"}, {"pairs", "fused"}};
	const char *name;
	for (size_t way = 0; (name = sm_way_name(field->need, way)) != NULL; way++)
		for (size_t i = 0; i < sizeof(coarse) / sizeof(coarse[0]); i++)
			if (field->renderers[way][0] != NULL && strcmp(coarse[i].need, need) == 0 &&
				strcmp(coarse[i].way, name) == 0)
				assert_true(field->differs[way]);
}

static void check_need(struct rig *rig, const char *need)
{
	struct field field = {.rig = rig, .need = need_index(need)};
	while (strcmp(cases[field.item].need, need) != 0)
		field.item++;
	make_renderers(&field);
	print_head(&field);
	for (size_t i = 0; i < place_count; i++)
		check_place(&field, &places[i]);
	check_rounding(&field, need);
	for (size_t way = 0; way < WAYS_MAX; way++)
		for (size_t use = 0; use < USES_MAX; use++)
			sm_renderer_destroy(field.renderers[way][use]);
	assert_false(field.broken);
}

static void smoothies_of_every_way_look_alike(void **state)
{
	check_need(*state, "smoothie");
}

static void plain_depths_of_every_way_look_alike(void **state)
{
	check_need(*state, "depth");
}

static void comparisons_of_every_way_look_alike(void **state)
{
	check_need(*state, "comparison");
}

static void taps_of_every_way_look_alike(void **state)
{
	check_need(*state, "taps");
}

static void pairs_of_every_way_look_alike(void **state)
{
	check_need(*state, "pairs");
}

static void moments_of_every_way_look_alike(void **state)
{
	check_need(*state, "moments");
}

/* OpenGL ES leaves it to the driver whether a sampler blends four comparisons. */
static void comparisons_are_blended_on_every_driver(void **state)
{
	struct rig *rig = *state;
	struct sm_camera overhead = {.eye = {0, 5, 0}, .up = {0, 0, 1}, .fov = 40};
	struct visibility seen;
	uint32_t between = 0;
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES,
		&(struct pose){{4, 1, 4}, 0, {0, 0, 0}});
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_CASTS,
		&(struct pose){{0.4f, 1, 0.4f}, 20, {0, 1, 0}});
	parts_add_light(rig->scene, &(struct sm_light_desc){.position = {0, 4, 0}, .angle = 60});
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "pcf", .map_size = 64});
	visibility_draw(&seen, rig, rig->scene, &overhead, 64, 64);
	for (size_t i = 0; i < 64 * 64; i++)
		between += seen.values[i] > 0 && seen.values[i] < 65535;
	visibility_finish(&seen);
	assert_true(between > 0);
}

static void add_place(const char *source, const char *name)
{
	struct place *place = &places[place_count];
	struct sm_error error;
	assert_true(place_count < sizeof(places) / sizeof(places[0]));
	if (!stage_load(&place->stage, source, NULL, 0, &error))
		fail_msg("%s", error.text);
	snprintf(place->name, sizeof(place->name), "%s", name);
	place_count++;
}

static int load_places(void **state)
{
	(void)state;
	glob_t files;
	size_t builtin_count = 0;
	while (builtin_name(builtin_count) != NULL)
		builtin_count++;
	for (size_t i = 0; i < builtin_count; i += SCENES_STEP) {
		char source[64];
		snprintf(source, sizeof(source), "builtin:%s", builtin_name(i));
		add_place(source, builtin_name(i));
	}
	if (glob(SMOOTHIE_SHARED "/models/*.glb", 0, NULL, &files) == 0) {
		for (size_t i = 0; i < files.gl_pathc; i += SCENES_STEP)
			add_place(files.gl_pathv[i], strrchr(files.gl_pathv[i], '/') + 1);
		globfree(&files);
	}
	return 0;
}

static int unload_places(void **state)
{
	(void)state;
	for (size_t i = 0; i < place_count; i++)
		stage_finish(&places[i].stage);
	return 0;
}

/* Software that draws a pixel at a time gets fewer of them. */
static int set_up(void **state)
{
	int result = rig_setup(state);
	side = strstr((const char *)glGetString(GL_RENDERER), "softpipe") != NULL ? 128 : 256;
	return result;
}

#define ways_test(test) cmocka_unit_test_setup_teardown(test, set_up, rig_teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(comparisons_are_blended_on_every_driver),
		ways_test(smoothies_of_every_way_look_alike),
		ways_test(plain_depths_of_every_way_look_alike),
		ways_test(comparisons_of_every_way_look_alike),
		ways_test(taps_of_every_way_look_alike),
		ways_test(pairs_of_every_way_look_alike),
		ways_test(moments_of_every_way_look_alike),
	};
	return cmocka_run_group_tests(tests, load_places, unload_places);
}
