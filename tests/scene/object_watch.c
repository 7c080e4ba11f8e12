/* SPDX-License-Identifier: MIT */
/* Which part of a light's screen is told to have changed, and that fins which are kept are those
 * that would be found. */
#include "scene/object_watch.h"
#include "scene/fin_set.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define COUNT 6
#define MAP 128

static struct sm_object_desc cube_at(float x, bool casts)
{
	return (struct sm_object_desc){
		.transform = {0.3f, 0, 0, 0, 0, 0.3f, 0, 0, 0, 0, 0.3f, 0, x, 0, 0, 1},
		.image = SM_NONE,
		.casts = casts,
		.receives = true,
	};
}

static void move_cube(struct sm_scene *scene, uint32_t object, float x)
{
	struct sm_object_desc desc = cube_at(x, true);
	assert_true(sm_scene_set_transform(scene, object, desc.transform, NULL));
}

static const float corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1},
	{1, -1, 1}, {-1, 1, 1}, {1, 1, 1}};

static void add_cube(struct sm_scene *scene, float x, bool casts)
{
	static const uint32_t indices[] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2,
		6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
	const struct sm_mesh_desc mesh = {
		.positions = corners[0], .vertex_count = 8, .indices = indices, .index_count = 36};
	struct sm_object_desc desc = cube_at(x, casts);
	uint32_t handle;
	assert_true(sm_scene_add_mesh(scene, &mesh, &desc.mesh, NULL));
	assert_true(sm_scene_add_object(scene, &desc, &handle, NULL));
}

/* Casters in a row, and what receives alone below the last. */
static struct sm_scene *make_scene(void)
{
	struct sm_scene *scene = sm_scene_create();
	assert_non_null(scene);
	for (int i = 0; i < COUNT; i++)
		add_cube(scene, (float)i, i < COUNT - 1);
	return scene;
}

static struct light_frame frame_of(const struct sm_scene *scene, float height)
{
	const struct sm_light_desc light = {.type = SM_LIGHT_SPOT,
		.position = {2.5f, height, 0},
		.target = {2.5f, 0, 0},
		.radius = 0.5f,
		.angle = 80};
	struct light_frame frame;
	light_frame_init(&frame, &light, scene);
	return frame;
}

static bool casts(const struct object *object)
{
	return object->casts;
}

static struct screen_box look(
	struct object_watch *watch, const struct sm_scene *scene, const struct light_frame *frame)
{
	struct disc_box changed;
	assert_true(object_watch_look(watch, scene, frame, casts, &changed));
	return changed.box;
}

static struct screen_box box_of(const struct object_watch *watch, size_t index)
{
	return watch->objects[index].box.box;
}

static void test_what_changes_is_told(void **unused)
{
	(void)unused;
	struct sm_scene *scene = make_scene();
	struct light_frame frame = frame_of(scene, 9), other = frame_of(scene, 8);
	struct object_watch watch = {0};
	struct screen_box changed = look(&watch, scene, &frame), before = box_of(&watch, 1);
	assert_true(screen_box_is_all(&changed));
	changed = look(&watch, scene, &frame);
	assert_true(screen_box_is_none(&changed));

	move_cube(scene, 1, 1.5f);
	changed = look(&watch, scene, &frame);
	screen_box_add(&before, &watch.objects[1].box.box);
	assert_memory_equal(&changed, &before, sizeof(changed));
	for (size_t i = 0; i < COUNT; i++)
		assert_true(watch.objects[i].changed == (i == 1));

	move_cube(scene, COUNT - 1, 4.5f);
	changed = look(&watch, scene, &frame);
	assert_true(screen_box_is_none(&changed));

	add_cube(scene, 0.5f, true);
	changed = look(&watch, scene, &frame);
	assert_memory_equal(&changed, &watch.objects[COUNT].box.box, sizeof(changed));

	changed = look(&watch, scene, &other);
	assert_true(screen_box_is_all(&changed));
	object_watch_forget(&watch);
	changed = look(&watch, scene, &other);
	assert_true(screen_box_is_all(&changed));
	object_watch_finish(&watch);
	sm_scene_destroy(scene);
}

static size_t count_left_out(const struct object_watch *watch)
{
	size_t count = 0;
	for (size_t i = 0; i < watch->count; i++)
		count += watch->objects[i].left_out;
	assert_int_equal(count, watch->left_out_count);
	return count;
}

/* The cells of the screen's left half, or of its right one. */
static struct screen_grid half_of_screen(bool right)
{
	struct screen_grid half;
	for (int row = 0; row < SCREEN_GRID_SIZE; row++)
		half.rows[row] = right ? ~(uint64_t)0 << SCREEN_GRID_SIZE / 2
				       : ~(uint64_t)0 >> SCREEN_GRID_SIZE / 2;
	return half;
}

/* Three casters are in the half that is on the right of the row, and two in the other. */
static void test_what_is_not_seen_is_left_out_until_it_is(void **unused)
{
	(void)unused;
	struct sm_scene *scene = make_scene();
	struct light_frame frame = frame_of(scene, 9);
	struct screen_grid halves[2] = {half_of_screen(false), half_of_screen(true)};
	struct object_watch watch = {.seen = &halves[0]};
	struct screen_box changed = look(&watch, scene, &frame);
	assert_true(screen_box_is_all(&changed));
	assert_int_equal(count_left_out(&watch), 3);
	assert_int_equal(watch.seen_tested, COUNT - 1);
	assert_int_equal(watch.seen_left_out, 3);
	assert_false(object_watch_lacks(&watch, &halves[0]));
	assert_true(object_watch_lacks(&watch, &halves[1]));
	const uint32_t beside = 0, seen = COUNT - 2;
	assert_true(watch.objects[beside].left_out && !watch.objects[seen].left_out);

	/* What moves where it is not seen changes nothing. */
	move_cube(scene, beside, 0.1f);
	changed = look(&watch, scene, &frame);
	assert_true(screen_box_is_none(&changed));
	assert_true(watch.objects[beside].left_out);
	assert_int_equal(watch.seen_tested, 3);

	/* From one half to the other. */
	struct screen_box before = box_of(&watch, seen);
	move_cube(scene, seen, 0);
	changed = look(&watch, scene, &frame);
	assert_memory_equal(&changed, &before, sizeof(changed));
	assert_int_equal(count_left_out(&watch), 4);

	/* What is there stays, and what was left out comes. */
	watch.seen = &halves[1];
	changed = look(&watch, scene, &frame);
	assert_int_equal(count_left_out(&watch), 0);
	for (size_t i = 0; i < COUNT - 1; i++) {
		struct screen_box box = changed;
		assert_true(watch.objects[i].changed == (i != 3));
		screen_box_add(&box, &watch.objects[i].box.box);
		assert_true(i == 3 || memcmp(&box, &changed, sizeof(box)) == 0);
	}
	watch.seen = &halves[0];
	changed = look(&watch, scene, &frame);
	assert_true(screen_box_is_none(&changed));
	assert_int_equal(count_left_out(&watch), 0);
	assert_int_equal(watch.seen_tested, 0);
	object_watch_finish(&watch);
	sm_scene_destroy(scene);
}

/* What it throws may reach in from there. */
static void test_what_is_beside_the_screen_counts_at_its_rim(void **unused)
{
	(void)unused;
	struct sm_scene *scene = make_scene();
	struct light_frame frame = frame_of(scene, 9);
	struct screen_grid seen = {0};
	struct object_watch watch = {.seen = &seen};
	for (int sign = -1; sign <= 1; sign += 2)
		for (int right = 0; right < 2; right++) {
			move_cube(scene, 0, (float)sign * 90);
			for (int row = 0; row < SCREEN_GRID_SIZE; row++)
				seen.rows[row] = right ? (uint64_t)1 << (SCREEN_GRID_SIZE - 1) : 1;
			object_watch_forget(&watch);
			look(&watch, scene, &frame);
			bool is_right = watch.objects[0].box.box.min[0] > 1;
			assert_true(is_right || watch.objects[0].box.box.max[0] < -1);
			assert_true(watch.objects[0].left_out == (is_right != (right == 1)));
		}
	object_watch_finish(&watch);
	sm_scene_destroy(scene);
}

static void test_a_mesh_that_bends_is_told(void **unused)
{
	(void)unused;
	struct sm_scene *scene = make_scene();
	struct light_frame frame = frame_of(scene, 9);
	struct object_watch watch = {0};
	float bent[8][3];
	look(&watch, scene, &frame);
	struct screen_box before = box_of(&watch, 2);
	memcpy(bent, corners, sizeof(bent));
	bent[7][0] = 0.5f;
	assert_true(sm_scene_set_vertices(scene, scene->objects[2].mesh, bent[0], NULL, NULL));
	struct screen_box changed = look(&watch, scene, &frame);
	assert_memory_equal(&changed, &before, sizeof(changed));
	object_watch_finish(&watch);
	sm_scene_destroy(scene);
}

/* As where a scene is counted from elsewhere. */
static void test_another_place_of_the_same_version_is_told(void **unused)
{
	(void)unused;
	struct sm_scene *scene = make_scene();
	struct light_frame frame = frame_of(scene, 9);
	struct object_watch watch = {0};
	look(&watch, scene, &frame);
	scene->objects[3].transform[3][0] += 0.25f;
	struct screen_box changed = look(&watch, scene, &frame);
	assert_false(screen_box_is_none(&changed));
	assert_true(watch.objects[3].changed);
	object_watch_finish(&watch);
	sm_scene_destroy(scene);
}

static void check_update(struct fin_set *kept, const struct object_watch *watch,
	const struct sm_scene *scene, const struct light_frame *frame, struct screen_box *changed)
{
	static const struct fin_shape shape = {.share = 1, .apron = 1.5f, .both_sides = true};
	struct fin_set all = {0};
	assert_true(fin_set_find(&all, scene, frame, &shape, MAP, true));
	assert_true(fin_set_update(kept, scene, frame, &shape, MAP, true, watch, changed));
	assert_true(all.count > 0);
	assert_int_equal(kept->count, all.count);
	assert_memory_equal(kept->fins, all.fins, all.count * sizeof(*all.fins));
	fin_set_finish(&all);
}

static void test_kept_fins_are_those_that_would_be_found(void **unused)
{
	(void)unused;
	struct sm_scene *scene = make_scene();
	struct light_frame frame = frame_of(scene, 9);
	struct object_watch watch = {0};
	struct fin_set set = {0};
	for (int round = 0; round < 20; round++) {
		uint32_t moved = (uint32_t)round % (COUNT - 1);
		struct screen_box changed = look(&watch, scene, &frame);
		check_update(&set, &watch, scene, &frame, &changed);
		for (size_t i = 0; i < set.part_count && round > 0; i++)
			assert_true(set.parts[i].fresh == watch.objects[i].changed);
		/* Past the edge of the screen, at times. */
		move_cube(scene, moved, round % 7 == 3 ? 90.0f : 0.3f * (float)round);
		if (round == 12)
			add_cube(scene, 3.5f, true);
	}
	/* Where nothing has changed. */
	struct screen_box changed = look(&watch, scene, &frame);
	check_update(&set, &watch, scene, &frame, &changed);
	changed = look(&watch, scene, &frame);
	check_update(&set, &watch, scene, &frame, &changed);
	assert_true(screen_box_is_none(&changed));
	assert_int_equal(set.edge_count, 0);
	fin_set_finish(&set);
	object_watch_finish(&watch);
	sm_scene_destroy(scene);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_what_changes_is_told),
		cmocka_unit_test(test_what_is_not_seen_is_left_out_until_it_is),
		cmocka_unit_test(test_what_is_beside_the_screen_counts_at_its_rim),
		cmocka_unit_test(test_a_mesh_that_bends_is_told),
		cmocka_unit_test(test_another_place_of_the_same_version_is_told),
		cmocka_unit_test(test_kept_fins_are_those_that_would_be_found),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
