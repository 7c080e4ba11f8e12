/* SPDX-License-Identifier: MIT */
/* What lights reach and screens miss, against many points of random boxes. */
#include "scene/light_reach.h"
#include "scene/camera.h"
#include "scene/fin_set.h"
#include "scene/seen_cells.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define ROUNDS 3000
#define BOXES 3
#define POINTS 400 /* of a box */
#define MAP 128

static uint32_t state;

/* xorshift (Marsaglia 2003). */
static float between(float low, float high)
{
	state ^= state << 13;
	state ^= state >> 17;
	state ^= state << 5;
	return low + (high - low) * (float)(state >> 8) / (float)(1 << 24);
}

static void random_point(float half, vec3 point)
{
	for (int axis = 0; axis < 3; axis++)
		point[axis] = between(-half, half);
}

/* [-1, 1]^3 */
static uint32_t add_cube(struct sm_scene *scene)
{
	static const uint32_t indices[] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2,
		6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
	float positions[8][3];
	uint32_t mesh;
	for (int i = 0; i < 8; i++)
		for (int axis = 0; axis < 3; axis++)
			positions[i][axis] = i >> axis & 1 ? 1 : -1;
	struct sm_mesh_desc desc = {.positions = positions[0],
		.vertex_count = 8,
		.indices = indices,
		.index_count = 36};
	assert_true(sm_scene_add_mesh(scene, &desc, &mesh, NULL));
	return mesh;
}

/* The first is flat at times, as a floor is. */
static struct sm_scene *random_scene(void)
{
	struct sm_scene *scene = sm_scene_create();
	assert_non_null(scene);
	uint32_t mesh = add_cube(scene), handle;
	for (int i = 0; i < BOXES; i++) {
		struct sm_object_desc object = {
			.mesh = mesh, .image = SM_NONE, .casts = true, .receives = true};
		vec3 size, place;
		random_point(i == 0 ? 6 : 1, size);
		random_point(i == 0 ? 1 : 4, place);
		if (i == 0)
			size[1] *= between(-1, 1) < 0 ? 0 : 0.1f;
		for (int axis = 0; axis < 3; axis++) {
			object.transform[5 * axis] = size[axis];
			object.transform[12 + axis] = place[axis];
			object.base_color[axis] = 1;
		}
		object.transform[15] = 1;
		assert_true(sm_scene_add_object(scene, &object, &handle, NULL));
	}
	return scene;
}

static struct sm_light_desc random_light(void)
{
	struct sm_light_desc light = {.type = SM_LIGHT_SPOT,
		.radius = between(0, 1) < 0.3f ? 0 : between(0, 1),
		.angle = between(5, 160),
		.color = {1, 0.5f, 0.25f},
		.intensity = between(0, 2)};
	if (between(0, 1) < 0.2f)
		light.type = SM_LIGHT_DIRECTIONAL;
	random_point(6, light.position);
	random_point(3, light.target);
	return light;
}

static void random_view(const struct sm_scene *scene, mat4 world_to_clip)
{
	struct sm_camera camera = {.up = {0.1f, 1, 0.2f}, .fov = between(10, 120)};
	random_point(6, camera.eye);
	random_point(3, camera.target);
	assert_true(camera_world_to_clip(&camera, scene, 4, 3, world_to_clip, NULL));
}

/* A point of a box, in the world. */
static void point_of(const struct object *object, vec3 point)
{
	for (int axis = 0; axis < 3; axis++)
		point[axis] = between(object->min[axis], object->max[axis]);
}

static bool is_on_screen(mat4 world_to_clip, vec3 point)
{
	vec4 p = {point[0], point[1], point[2], 1};
	glm_mat4_mulv(world_to_clip, p, p);
	return p[3] > 0 && fabsf(p[0]) <= p[3] && fabsf(p[1]) <= p[3] && fabsf(p[2]) <= p[3];
}

/* What a white surface that faces the light gets, at most. */
static float light_at(const struct sm_light_desc *light, vec3 point)
{
	vec3 path, axis;
	glm_vec3_sub(point, (float *)light->position, path);
	glm_vec3_sub((float *)light->target, (float *)light->position, axis);
	if (light->type == SM_LIGHT_DIRECTIONAL)
		return light->intensity;
	float cosine = glm_vec3_dot(path, axis) / (glm_vec3_norm(path) * glm_vec3_norm(axis));
	bool inside = cosine > cosf(glm_rad(light->angle) / 2);
	return inside ? light->intensity * glm_vec3_norm2(axis) / glm_vec3_norm2(path) : 0;
}

static float brightest_point(
	const struct sm_light_desc *light, const struct sm_scene *scene, mat4 world_to_clip)
{
	float most = 0;
	for (int i = 0; i < BOXES * POINTS; i++) {
		vec3 point;
		point_of(&scene->objects[i % BOXES], point);
		if (is_on_screen(world_to_clip, point))
			most = fmaxf(most, light_at(light, point));
	}
	return most;
}

static void test_no_point_is_brighter_than_the_bound(void **unused)
{
	(void)unused;
	int dark = 0, found = 0;
	state = 0x1234567;
	for (int round = 0; round < ROUNDS; round++) {
		struct sm_scene *scene = random_scene();
		struct sm_light_desc light = random_light();
		struct light_frame frame;
		struct view_volume volume;
		mat4 world_to_clip;
		random_view(scene, world_to_clip);
		light_frame_init(&frame, &light, scene);
		view_volume_init(&volume, world_to_clip);
		float bound = light_brightest(&light, &frame, scene, &volume, INFINITY);
		float most = brightest_point(&light, scene, world_to_clip);
		if (!(bound >= most))
			fail_msg("round %d: %g, above %g", round, (double)most, (double)bound);
		dark += most == 0;
		found += bound == 0;
		float enough = light_brightest(&light, &frame, scene, &volume, 1e-3f);
		assert_true((enough >= 1e-3f) == (bound >= 1e-3f));
		sm_scene_destroy(scene);
	}
	print_message("%d of %d are dark, found of %d\n", dark, ROUNDS, found);
	/* Points are few, and cones are made flat: not all that seems dark is. */
	assert_true(dark > ROUNDS / 10 && found > dark * 3 / 4 && found < dark);
}

static void test_nothing_that_misses_a_screen_is_on_it(void **unused)
{
	(void)unused;
	int misses = 0, absent = 0;
	state = 0x7654321;
	for (int round = 0; round < ROUNDS; round++) {
		struct sm_scene *scene = random_scene();
		struct object *object = &scene->objects[1];
		mat4 world_to_clip;
		bool there = false;
		random_view(scene, world_to_clip);
		for (int i = 0; i < POINTS; i++) {
			vec3 point;
			point_of(object, point);
			there = there || is_on_screen(world_to_clip, point);
		}
		bool missing = mesh_misses_screen(
			&scene->meshes[0], object->transform, world_to_clip, 0, true);
		assert_false(there && missing);
		misses += missing;
		absent += !there;
		sm_scene_destroy(scene);
	}
	print_message("%d of %d are absent, found of %d\n", absent, ROUNDS, misses);
	assert_true(absent > ROUNDS / 10 && misses > absent * 3 / 4 && misses < ROUNDS);
}

static bool is_in_screen_box(const struct screen_box *box, mat4 world_to_clip, vec3 point)
{
	vec4 p = {point[0], point[1], point[2], 1};
	glm_mat4_mulv(world_to_clip, p, p);
	return p[0] / p[3] >= box->min[0] && p[0] / p[3] <= box->max[0] &&
	       p[1] / p[3] >= box->min[1] && p[1] / p[3] <= box->max[1];
}

static void test_what_a_screen_shows_is_in_its_box(void **unused)
{
	(void)unused;
	int whole = 0, inside = 0;
	state = 0x2718281;
	for (int round = 0; round < ROUNDS; round++) {
		struct sm_scene *scene = random_scene();
		struct object *object = &scene->objects[1];
		struct screen_box box;
		mat4 world_to_clip;
		random_view(scene, world_to_clip);
		mesh_screen_box(&scene->meshes[0], object->transform, world_to_clip, &box);
		for (int i = 0; i < POINTS; i++) {
			vec3 point;
			point_of(object, point);
			if (is_on_screen(world_to_clip, point))
				assert_true(is_in_screen_box(&box, world_to_clip, point));
		}
		whole += screen_box_is_all(&box);
		inside += box.max[0] < 1 && box.min[0] > -1;
		sm_scene_destroy(scene);
	}
	print_message("%d of %d are all of the screen, %d inside\n", whole, ROUNDS, inside);
	assert_true(whole > 0 && whole < ROUNDS / 2 && inside > ROUNDS / 20);
}

/* As technique/disc.h has it: what is before the far plane is seen beside where the middle sees it.
 */
static bool is_in_disc_box(
	const struct disc_box *box, const struct light_frame *frame, const float at[2], vec3 point)
{
	vec4 p = {point[0], point[1], point[2], 1};
	struct screen_box seen = disc_box_from(box, at);
	glm_mat4_mulv((vec4 *)frame->world_to_clip, p, p);
	for (int axis = 0; axis < 2; axis++) {
		float x = p[axis] / p[3] - disc_scale(frame) * at[axis] * (1 - p[2] / p[3]);
		if (!(x >= seen.min[axis] && x <= seen.max[axis]))
			return false;
	}
	return true;
}

static void test_what_a_point_of_a_disc_sees_is_in_its_box(void **unused)
{
	(void)unused;
	int whole = 0, narrow = 0;
	state = 0x1618033;
	for (int round = 0; round < ROUNDS; round++) {
		struct sm_scene *scene = random_scene();
		struct sm_light_desc light = random_light();
		struct object *object = &scene->objects[1];
		struct light_frame frame;
		float angle = between(0, 7), from_middle = between(0, 1);
		const float at[2] = {from_middle * cosf(angle), from_middle * sinf(angle)};
		light_frame_init(&frame, &light, scene);
		struct disc_box box = mesh_disc_box(&scene->meshes[0], object->transform, &frame);
		for (int i = 0; i < POINTS; i++) {
			vec3 point;
			point_of(object, point);
			vec4 p = {point[0], point[1], point[2], 1};
			glm_mat4_mulv(frame.world_to_clip, p, p);
			if (p[3] > 0 && fabsf(p[2]) <= p[3])
				assert_true(is_in_disc_box(&box, &frame, at, point));
		}
		whole += screen_box_is_all(&box.box);
		narrow += box.shear[1] - box.shear[0] < disc_scale(&frame);
		sm_scene_destroy(scene);
	}
	print_message("%d of %d are all of the screen, %d narrow\n", whole, ROUNDS, narrow);
	assert_true(whole > 0 && whole < ROUNDS / 2 && narrow > ROUNDS / 10);
}

/* Whether a light looks a point up in cells of its screen, and there are none there. */
static bool is_missed(
	const struct screen_grid *cells, const struct light_frame *frame, const vec3 point)
{
	vec4 p = {point[0], point[1], point[2], 1};
	glm_mat4_mulv((vec4 *)frame->world_to_clip, p, p);
	float x = p[0] / p[3], y = p[1] / p[3];
	if ((!frame->parallel && p[3] < frame->near) || fabsf(x) > 1 || fabsf(y) > 1)
		return false;
	const float at[2] = {x, y};
	return !screen_grid_touches(cells, at, at);
}

static int count_cells(const struct screen_grid *cells)
{
	int count = 0;
	for (int row = 0; row < SCREEN_GRID_SIZE; row++)
		for (int x = 0; x < SCREEN_GRID_SIZE; x++)
			count += screen_grid_has(cells, x, row);
	return count;
}

static void test_what_is_seen_is_in_marked_cells(void **unused)
{
	(void)unused;
	double all = 0;
	int none = 0, some = 0;
	state = 0x5772156;
	for (int round = 0; round < ROUNDS; round++) {
		struct sm_scene *scene = random_scene();
		struct sm_light_desc light = random_light();
		struct light_frame frame;
		struct view_volume volume;
		struct screen_grid cells;
		mat4 world_to_clip;
		random_view(scene, world_to_clip);
		scene->objects[2].receives = round % 2 == 0;
		light_frame_init(&frame, &light, scene);
		view_volume_init(&volume, world_to_clip);
		seen_cells_find(&cells, scene, &frame, &volume, 0);
		for (int i = 0; i < BOXES * POINTS; i++) {
			vec3 point;
			point_of(&scene->objects[i % BOXES], point);
			if (scene->objects[i % BOXES].receives &&
				is_on_screen(world_to_clip, point) &&
				is_missed(&cells, &frame, point))
				fail_msg("round %d: nothing marked for point %d", round, i);
		}
		int count = count_cells(&cells);
		all += count;
		none += count == 0;
		some += count > 0 && count < SCREEN_GRID_SIZE * SCREEN_GRID_SIZE / 2;
		sm_scene_destroy(scene);
	}
	print_message("%d of %d mark none, %d less than half, %.0f in the mean\n", none, ROUNDS,
		some, all / ROUNDS);
	assert_true(none > ROUNDS / 10 && some > ROUNDS / 4);
}

/* A square floor, seen all of: its own cells and those around, no more. */
static void test_cells_are_marked_no_farther_than_asked(void **unused)
{
	(void)unused;
	static const float cell = 2.0f / SCREEN_GRID_SIZE;
	struct sm_scene *scene = sm_scene_create();
	struct sm_object_desc floor = {
		.transform = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
		.image = SM_NONE,
		.receives = true};
	const struct sm_light_desc light = {.position = {0, 4, 0}, .angle = 90};
	struct sm_camera camera = {.eye = {0, 9, 0}, .up = {0, 0, 1}, .fov = 60};
	struct light_frame frame;
	struct view_volume volume;
	mat4 world_to_clip;
	uint32_t handle;
	floor.mesh = add_cube(scene);
	assert_true(sm_scene_add_object(scene, &floor, &handle, NULL));
	assert_true(camera_world_to_clip(&camera, scene, 4, 4, world_to_clip, NULL));
	light_frame_init(&frame, &light, scene);
	view_volume_init(&volume, world_to_clip);
	/* The floor is a quarter of the screen wide, in whole cells. */
	for (int margin = 0; margin < 5; margin++) {
		struct screen_grid cells;
		int side = SCREEN_GRID_SIZE / 4 + 2 * margin;
		seen_cells_find(&cells, scene, &frame, &volume, ((float)margin - 0.5f) * cell);
		assert_true(count_cells(&cells) <= side * side);
		assert_true(count_cells(&cells) > (side - 2) * (side - 2));
	}
	sm_scene_destroy(scene);
}

/* Whether the rectangle around a fin touches the screen. */
static bool fin_is_on_screen(const struct fin_set *set, size_t index)
{
	struct fin_vertex vertices[FIN_VERTICES_MAX];
	size_t count = fin_set_expand(set, index, vertices);
	for (int axis = 0; axis < 2; axis++) {
		float min = INFINITY, max = -INFINITY;
		for (size_t i = 0; i < count; i++) {
			min = fminf(min, vertices[i].position[axis]);
			max = fmaxf(max, vertices[i].position[axis]);
		}
		if (min > 1 || max < -1)
			return false;
	}
	return true;
}

/* Every fin on the screen is in both sets, in the same order. */
static void check_fins(const struct fin_set *all, const struct fin_set *some)
{
	size_t next = 0;
	for (size_t i = 0; i < all->count; i++) {
		bool same = next < some->count &&
			    memcmp(&all->fins[i], &some->fins[next], sizeof(*all->fins)) == 0;
		next += same ? 1 : 0;
		assert_true(same || !fin_is_on_screen(all, i));
	}
	assert_int_equal(next, some->count);
}

static void test_fins_on_the_screen_are_all_there(void **unused)
{
	(void)unused;
	static const struct fin_shape shapes[] = {
		{.share = SMOOTHIE_WIDTH_SHARE},
		{.share = 1, .apron = 1.5f, .both_sides = true},
		{.width = 0.1f},
	};
	struct fin_set all = {0}, some = {0};
	size_t missing = 0;
	state = 0x3141592;
	for (int round = 0; round < ROUNDS; round++) {
		struct sm_scene *scene = random_scene();
		struct sm_light_desc light = random_light();
		struct light_frame frame;
		light_frame_init(&frame, &light, scene);
		assert_true(fin_set_find(&all, scene, &frame, &shapes[round % 3], MAP, false));
		assert_true(fin_set_find(&some, scene, &frame, &shapes[round % 3], MAP, true));
		check_fins(&all, &some);
		missing += some.missing_count;
		sm_scene_destroy(scene);
	}
	print_message("%zu of %d casters are left out\n", missing, BOXES * ROUNDS);
	assert_true(missing > ROUNDS / 10);
	fin_set_finish(&all);
	fin_set_finish(&some);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_no_point_is_brighter_than_the_bound),
		cmocka_unit_test(test_nothing_that_misses_a_screen_is_on_it),
		cmocka_unit_test(test_what_a_screen_shows_is_in_its_box),
		cmocka_unit_test(test_what_a_point_of_a_disc_sees_is_in_its_box),
		cmocka_unit_test(test_what_is_seen_is_in_marked_cells),
		cmocka_unit_test(test_cells_are_marked_no_farther_than_asked),
		cmocka_unit_test(test_fins_on_the_screen_are_all_there),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
