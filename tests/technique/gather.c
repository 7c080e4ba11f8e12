/* SPDX-License-Identifier: MIT */
/* Penumbrae from silhouette edges. */
#include "parts.h"
#include "renderer.h"
#include "scene/edge_grid.h"
#include "scene/light.h"
#include "strip.h"
#include "visibility.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 128

/* Looks down on the ground, y = 0, of which it sees |x|, |z| < HALF. */
#define HALF 1.6076952
static const struct sm_camera overhead = {.eye = {0, 6, 0}, .up = {0, 0, -1}, .fov = 30};

static const struct sm_light_desc sun = {
	.type = SM_LIGHT_DIRECTIONAL, .position = {4, 5, 0}, .radius = 0.32f};
static const struct sm_light_desc lamp = {.position = {4, 5, 0}, .radius = 0.3f, .angle = 60};

/* A slab long in z, one above the ground, whose shadow falls to the left of it. */
static void add_slab(struct rig *rig)
{
	parts_add_object(rig->scene, parts_add_cube(rig->scene), PART_BOTH,
		&(struct pose){{0.5f, 0.05f, 3}, 0, {0, 1, 0}});
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES,
		&(struct pose){{4, 1, 4}, 0, {0, 0, 0}});
}

/* Blocks in a row, one behind the other as the light sees them, that turn more and more. */
static void add_blocks(struct rig *rig, int count)
{
	uint32_t cube = parts_add_cube(rig->scene);
	for (int i = 0; i < count; i++)
		parts_add_object(rig->scene, cube, PART_BOTH,
			&(struct pose){{0.2f, 0.1f, 0.3f}, 20.0f * (float)i,
				{-0.2f * (float)(i % 5), 0.25f + 0.3f * (float)(i / 5), 0}});
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES,
		&(struct pose){{4, 1, 4}, 0, {0, 0, 0}});
}

static struct visibility draw(struct rig *rig, const char *technique, uint32_t map_size)
{
	struct visibility seen;
	rig_set_shadows(
		rig, &(struct sm_shadow_options){.technique = technique, .map_size = map_size});
	visibility_draw(&seen, rig, rig->scene, &overhead, SIZE, SIZE);
	return seen;
}

static void assert_same(const struct visibility *a, const struct visibility *b)
{
	assert_int_equal(visibility_compare(a, b).differing, 0);
}

static void a_point_makes_hard_shadows(void **state)
{
	struct rig *rig = *state;
	static const uint32_t sizes[] = {0, 300, 1024};
	struct sm_light_desc point = lamp;
	point.radius = 0;
	add_blocks(rig, 10);
	parts_add_light(rig->scene, &point);
	for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
		struct visibility gather = draw(rig, "gather", sizes[i]);
		struct visibility hard = draw(rig, "hard", sizes[i]);
		assert_same(&gather, &hard);
		visibility_finish(&gather);
		visibility_finish(&hard);
	}
}

/* What is seen of the sun's disc from (x, 0), left of the slab's shadow: the part on one side of
 * the slab's upper left edge. */
static double sun_beside_slab(double x)
{
	double length = sqrt(41.0), d[2] = {4 / length, 5 / length}, e[2] = {-0.5 - x, 1.05};
	double off = (e[0] * d[1] - e[1] * d[0]) / (e[0] * d[0] + e[1] * d[1]);
	double s = fmax(-1, fmin(off / (0.32 / length), 1));
	return 1 - (acos(s) - s * sqrt(1 - s * s)) / M_PI;
}

/* What is expected is of the ideal edge, which is moved to its grid, by half a step at most along
 * each axis of the screen. Where the disc is widest, through its middle, its share
 * changes by 2/pi of the way in radii. The rest is arithmetic. */
static double limit_beside_slab(const struct rig *rig, uint32_t map_size)
{
	struct light_frame frame;
	uint32_t bits = rig->renderer->gpu.raster_bits;
	bits += edge_finer_bits(bits);
	light_frame_fit(&frame, &sun, rig->scene);
	double step = 2 * (double)frame.half_extent / (double)(map_size << bits);
	double radius = 1.05 * 0.32 / 5; /* of the disc as seen from the ground */
	return 1e-4 + 2 / M_PI * M_SQRT1_2 * step / radius;
}

static void a_straight_edge_cuts_the_disc(void **state)
{
	struct rig *rig = *state;
	add_slab(rig);
	parts_add_light(rig->scene, &sun);
	struct visibility seen = draw(rig, "gather", 512);
	double limit = limit_beside_slab(rig, 512), worst = 0;
	int partly = 0;
	for (uint32_t x = 0; x < SIZE / 4; x++) {
		double at = ((x + 0.5) / SIZE * 2 - 1) * HALF;
		double expected = sun_beside_slab(at);
		double found = visibility_at(&seen, x, SIZE / 2);
		worst = fmax(worst, fabs(found - expected));
		partly += expected > 0 && expected < 1;
	}
	print_message("off by %g, and by %g at most\n", worst, limit);
	assert_true(worst < limit);
	assert_true(partly >= 4);
	visibility_finish(&seen);
}

static void map_sizes_make_no_difference(void **state)
{
	struct rig *rig = *state;
	static const uint32_t sizes[] = {129, 333, 1024};
	add_blocks(rig, 10);
	parts_add_light(rig->scene, &lamp);
	struct visibility usual = draw(rig, "gather", 512);
	for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
		struct visibility other = draw(rig, "gather", sizes[i]);
		struct visibility_change change = visibility_compare(&usual, &other);
		print_message("%u texels: mean %g, off %g\n", sizes[i], change.mean, change.off);
		assert_true(change.mean < 0.002 && change.off < 0.01);
		visibility_finish(&other);
	}
	visibility_finish(&usual);
}

static void lights_do_not_disturb_each_other(void **state)
{
	struct rig *rig = *state;
	add_blocks(rig, 10);
	uint32_t light = parts_add_light(rig->scene, &sun);
	struct visibility alone = draw(rig, "gather", 512);
	parts_add_light(rig->scene, &lamp);
	struct sm_light_desc point = lamp;
	point.radius = 0;
	parts_add_light(rig->scene, &point);
	struct visibility among = draw(rig, "gather", 512);
	assert_int_equal(light, 0);
	assert_same(&alone, &among);
	visibility_finish(&alone);
	visibility_finish(&among);
}

/* A light may become a point and a disc again. */
static void a_radius_may_change(void **state)
{
	struct rig *rig = *state;
	struct sm_error error;
	struct sm_light_desc changed = lamp;
	add_blocks(rig, 5);
	uint32_t light = parts_add_light(rig->scene, &lamp);
	struct visibility first = draw(rig, "gather", 512), between, again;
	changed.radius = 0;
	assert_true(sm_scene_set_light(rig->scene, light, &changed, &error));
	visibility_draw(&between, rig, rig->scene, &overhead, SIZE, SIZE);
	assert_true(visibility_compare(&first, &between).off > 0.01);
	assert_true(sm_scene_set_light(rig->scene, light, &lamp, &error));
	visibility_draw(&again, rig, rig->scene, &overhead, SIZE, SIZE);
	assert_same(&first, &again);
	visibility_finish(&first);
	visibility_finish(&between);
	visibility_finish(&again);
}

static void add_list_bytes(void *data, const struct sm_memory_part *part)
{
	uint64_t *sum = data;
	if (part->kind == SM_MEMORY_GL && strcmp(part->owner, "edge lists") == 0)
		*sum += part->bytes;
}

static uint64_t list_bytes(const struct rig *rig)
{
	uint64_t sum = 0;
	sm_renderer_list_memory(rig->renderer, rig->scene, add_list_bytes, &sum);
	return sum;
}

/* As little as before there was one, but for the tiles. */
static void edges_that_are_gone_take_no_memory(void **state)
{
	struct rig *rig = *state;
	add_blocks(rig, 5);
	uint32_t light = parts_add_light(rig->scene, &lamp);
	struct sm_light_desc away = lamp;
	away.target[0] = 100;
	uint64_t bytes[4];
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "gather"});
	for (int i = 0; i < 4; i++) {
		const struct sm_light_desc *desc = i % 2 == 0 ? &away : &lamp;
		struct visibility seen;
		assert_true(sm_scene_set_light(rig->scene, light, desc, NULL));
		visibility_draw(&seen, rig, rig->scene, &overhead, SIZE, SIZE);
		visibility_finish(&seen);
		bytes[i] = list_bytes(rig);
	}
	assert_true(bytes[1] > bytes[0]);
	assert_int_equal(bytes[2], bytes[0]);
	assert_int_equal(bytes[3], bytes[1]);
}

static void count_warnings(void *data, enum sm_log_level level, const char *line)
{
	(void)line;
	*(int *)data += level == SM_LOG_WARNING;
}

/* Each of very many edges is before the disc everywhere: more than the lists have room for. */
static void too_many_edges_are_left_out(void **state)
{
	struct rig *rig = *state;
	struct sm_light_desc wide = lamp;
	wide.radius = 3;
	uint32_t sphere = parts_add_sphere(rig->scene, 64);
	for (int i = 0; i < 36; i++)
		parts_add_object(rig->scene, sphere, PART_BOTH,
			&(struct pose){{0.1f, 0.1f, 0.1f}, 0,
				{0.12f * (float)(i % 6) - 0.3f, 1, 0.12f * (float)(i / 6) - 0.3f}});
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES,
		&(struct pose){{4, 1, 4}, 0, {0, 0, 0}});
	parts_add_light(rig->scene, &wide);
	int warnings = 0;
	rig_skip_nothing(rig);
	sm_set_log(count_warnings, &warnings);
	struct visibility seen = draw(rig, "gather", 512), again;
	struct sm_frame_stats stats;
	sm_renderer_get_stats(rig->renderer, &stats);
	assert_true(stats.edges_left_out > 0);
	visibility_draw(&again, rig, rig->scene, &overhead, SIZE, SIZE);
	sm_set_log(NULL, NULL);
	assert_int_equal(warnings, 1); /* not one a frame */
	assert_same(&seen, &again);
	visibility_finish(&again);
	double shadow = visibility_at(&seen, SIZE / 4, SIZE / 2);
	print_message("%g in the shadow\n", shadow);
	assert_true(shadow > 0.5 && shadow < 0.95);
	visibility_finish(&seen);
}

/* Blocks whose edges take longer to list, each for most tiles, than to draw. */
static void edges_are_the_same_whoever_finds_them(void **state)
{
	struct rig *rig = *state;
	struct sm_light_desc wide = lamp;
	wide.radius = 3;
	parts_add_small_blocks(rig->scene, PART_CASTS);
	parts_add_light(rig->scene, &wide);
	rig_skip_nothing(rig);
	sm_renderer_set_threads(rig->renderer, 1);
	struct visibility alone = draw(rig, "gather", 512), aside;
	sm_renderer_set_threads(rig->renderer, 2);
	for (int frame = 0; frame < 5; frame++) {
		visibility_draw(&aside, rig, rig->scene, &overhead, SIZE, SIZE);
		assert_same(&alone, &aside);
		visibility_finish(&aside);
	}
	visibility_finish(&alone);
}

static void assert_dark_strip(struct rig *rig, const struct strip_profile *profile)
{
	strip_add(rig->scene, profile);
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "gather"});
	uint32_t lit = 0;
	for (int i = 0; i < 20; i++) {
		struct sm_camera camera = strip_camera(-0.72f + 0.004f * (float)i);
		struct visibility seen;
		visibility_draw(&seen, rig, rig->scene, &camera, SIZE, SIZE);
		for (uint32_t at = 0; at < SIZE * SIZE; at++)
			lit += seen.values[at] > 65535 / 10;
		visibility_finish(&seen);
	}
	print_message("%u pixels lit\n", lit);
	assert_int_equal(lit, 0);
}

static void what_matches_is_not_always_the_own_sheet(void **state)
{
	assert_dark_strip(*state, &strip_level);
}

static void a_bent_sheets_edge_is_its_own(void **state)
{
	assert_dark_strip(*state, &strip_bent);
}

static void a_falling_sheets_edge_is_its_own(void **state)
{
	assert_dark_strip(*state, &strip_falling);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(a_point_makes_hard_shadows),
		rig_test(a_straight_edge_cuts_the_disc),
		rig_test(map_sizes_make_no_difference),
		rig_test(lights_do_not_disturb_each_other),
		rig_test(a_radius_may_change),
		rig_test(edges_that_are_gone_take_no_memory),
		rig_test(what_matches_is_not_always_the_own_sheet),
		rig_test(a_bent_sheets_edge_is_its_own),
		rig_test(a_falling_sheets_edge_is_its_own),
		rig_test(too_many_edges_are_left_out),
		rig_test(edges_are_the_same_whoever_finds_them),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
