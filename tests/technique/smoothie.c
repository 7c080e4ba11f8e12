/* SPDX-License-Identifier: MIT */
/* Chan & Durand 2003: how wide penumbrae are, where they are, and what does not change them. */
#include "parts.h"
#include "visibility.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define DEGREE 0.017453292519943295
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* ---- scenes with a bit of everything */

#define GALLERY_SIZE 128

struct gallery {
	struct sm_scene *scene;
	struct sm_camera camera;
};

static const struct sm_light_desc gallery_lights[] = {
	{.type = SM_LIGHT_SPOT, .position = {1.5f, 5, 1}, .radius = 0.3f, .angle = 55},
	{.type = SM_LIGHT_DIRECTIONAL, .position = {1.5f, 5, 1}, .radius = 0.3f},
};

/* Boards that cross and overlap, and a block on the ground; the last one is a sphere. */
static const struct pose gallery_poses[] = {
	{.scale = {0.6f, 0.05f, 0.4f}, .turn = 25, .position = {-0.6f, 1.6f, 0.3f}},
	{.scale = {0.3f, 0.04f, 0.7f}, .turn = -40, .position = {-0.3f, 1.0f, 0.2f}},
	{.scale = {0.05f, 0.5f, 0.6f}, .turn = 70, .position = {-0.5f, 1.5f, 0.4f}},
	{.scale = {0.3f, 0.3f, 0.3f}, .turn = 15, .position = {0.7f, 0.3f, -0.5f}},
	{.scale = {0.4f, 0.4f, 0.4f}, .position = {0.6f, 1.2f, 0.6f}},
};

/* ground: its part_role bits. */
static void gallery_init(
	struct gallery *gallery, const struct sm_light_desc *light, unsigned int ground)
{
	struct sm_scene *scene = sm_scene_create();
	assert_non_null(scene);
	*gallery = (struct gallery){
		.scene = scene, .camera = {.eye = {-2, 4, 4}, .up = {0, 1, 0}, .fov = 40}};
	uint32_t cube = parts_add_cube(scene), sphere = parts_add_sphere(scene, 12);
	for (size_t i = 0; i < COUNT(gallery_poses); i++)
		parts_add_object(scene, i + 1 < COUNT(gallery_poses) ? cube : sphere, PART_BOTH,
			&gallery_poses[i]);
	parts_add_object(
		scene, parts_add_square(scene), ground, &(struct pose){.scale = {3, 1, 3}});
	parts_add_light(scene, light);
}

/* In the plane x = 0. */
static void gallery_mirror(struct gallery *gallery, const struct sm_light_desc *light)
{
	struct sm_light_desc mirrored = *light;
	mirrored.position[0] *= -1;
	assert_true(sm_scene_set_light(gallery->scene, 0, &mirrored, NULL));
	gallery->camera.eye[0] *= -1;
	for (uint32_t i = 0; i < COUNT(gallery_poses); i++) {
		float m[16];
		pose_matrix(&gallery_poses[i], m);
		for (int column = 0; column < 4; column++)
			m[4 * column] *= -1;
		assert_true(sm_scene_set_transform(gallery->scene, i, m, NULL));
	}
}

static void gallery_draw(const struct gallery *gallery, struct rig *rig,
	const struct sm_shadow_options *options, struct visibility *seen)
{
	rig_set_shadows(rig, options);
	visibility_draw(seen, rig, gallery->scene, &gallery->camera, GALLERY_SIZE, GALLERY_SIZE);
}

static struct visibility_change change_between(const struct gallery *gallery, struct rig *rig,
	const struct sm_shadow_options *first, const struct sm_shadow_options *second)
{
	struct visibility a, b;
	gallery_draw(gallery, rig, first, &a);
	gallery_draw(gallery, rig, second, &b);
	struct visibility_change change = visibility_compare(&a, &b);
	visibility_finish(&a);
	visibility_finish(&b);
	return change;
}

static void two_passes_and_one_agree(void **state)
{
	static const struct sm_shadow_options cases[] = {
		{.technique = "smoothie", .map_size = 256},
		{.technique = "smoothie", .map_size = 1024},
		{.technique = "smoothie", .map_size = 512, .falloff = SM_FALLOFF_SINUSOID},
		{.technique = "smoothie", .map_size = 512, .width = 0.1f},
	};
	for (size_t i = 0; i < COUNT(cases) * COUNT(gallery_lights) * 2; i++) {
		struct gallery gallery;
		struct sm_shadow_options one = cases[i % COUNT(cases)], two = one;
		unsigned int ground = i % 2 == 0 ? PART_RECEIVES : PART_BOTH;
		two.passes = 2;
		gallery_init(&gallery, &gallery_lights[i / COUNT(cases) % 2], ground);
		struct visibility_change change = change_between(&gallery, *state, &one, &two);
		assert_true(change.mean <= 5e-4 && change.off <= 1e-3);
		sm_scene_destroy(gallery.scene);
	}
}

static void a_point_light_gives_a_filtered_map(void **state)
{
	static const char *const techniques[] = {"smoothie", "smoothie-two-sided", "penumbra-map"};
	for (size_t i = 0; i < COUNT(gallery_lights) * COUNT(techniques); i++) {
		const struct sm_light_desc *light = &gallery_lights[i % COUNT(gallery_lights)];
		struct gallery gallery;
		struct sm_light_desc point = *light;
		point.radius = 0;
		gallery_init(&gallery, &point, PART_RECEIVES);
		struct sm_shadow_options soft = {
			.technique = techniques[i / COUNT(gallery_lights)], .map_size = 256};
		struct sm_shadow_options plain = {.technique = "pcf", .map_size = 256};
		assert_int_equal(change_between(&gallery, *state, &soft, &plain).differing, 0);
		/* And a light with a radius does not. */
		assert_true(sm_scene_set_light(gallery.scene, 0, light, NULL));
		assert_true(change_between(&gallery, *state, &soft, &plain).off > 0.01);
		sm_scene_destroy(gallery.scene);
	}
}

static void ground_shows_the_same_edges_whether_or_not_it_casts(void **state)
{
	struct rig *rig = *state;
	static const struct sm_shadow_options options = {.technique = "smoothie", .map_size = 512};
	for (size_t i = 0; i < COUNT(gallery_lights); i++) {
		struct visibility seen[2];
		for (int casts = 0; casts < 2; casts++) {
			struct gallery gallery;
			gallery_init(
				&gallery, &gallery_lights[i], casts ? PART_BOTH : PART_RECEIVES);
			gallery_draw(&gallery, rig, &options, &seen[casts]);
			sm_scene_destroy(gallery.scene);
		}
		struct visibility_change change = visibility_compare(&seen[0], &seen[1]);
		assert_true(change.mean < 2e-3 && change.off < 0.015);
		visibility_finish(&seen[0]);
		visibility_finish(&seen[1]);
	}
}

static void mirrored_transforms_give_the_mirrored_picture(void **state)
{
	struct rig *rig = *state;
	static const struct sm_shadow_options options = {.technique = "smoothie", .map_size = 512};
	for (size_t i = 0; i < COUNT(gallery_lights); i++) {
		struct visibility seen[2];
		for (int mirror = 0; mirror < 2; mirror++) {
			struct gallery gallery;
			gallery_init(&gallery, &gallery_lights[i], PART_RECEIVES);
			if (mirror)
				gallery_mirror(&gallery, &gallery_lights[i]);
			gallery_draw(&gallery, rig, &options, &seen[mirror]);
			sm_scene_destroy(gallery.scene);
		}
		for (size_t y = 0; y < GALLERY_SIZE; y++) {
			uint16_t *row = seen[1].values + y * GALLERY_SIZE;
			for (size_t x = 0; x < GALLERY_SIZE / 2; x++) {
				uint16_t left = row[x];
				row[x] = row[GALLERY_SIZE - 1 - x];
				row[GALLERY_SIZE - 1 - x] = left;
			}
		}
		struct visibility_change change = visibility_compare(&seen[0], &seen[1]);
		/* Texels whose centres an edge goes through belong to one side or the other. */
		assert_true(change.mean < 1e-3 && change.off < 2e-3);
		visibility_finish(&seen[0]);
		visibility_finish(&seen[1]);
	}
}

/* ---- one straight edge, seen from the light */

/* A strip of the light's screen, as wide as that: STRIP pixels and texels. */
#define STRIP 512
#define STRIP_HEIGHT 8
#define LIGHT_HEIGHT 4.0
#define LIGHT_ANGLE 50.0

static double light_slope(void)
{
	return tan(LIGHT_ANGLE / 2 * DEGREE);
}

/* From the light, straight down; right is +x, down is +z. */
static struct sm_camera camera_at_light(uint32_t height)
{
	double slope = light_slope() * height / STRIP;
	return (struct sm_camera){.eye = {0, (float)LIGHT_HEIGHT, 0},
		.up = {0, 0, -1},
		.fov = (float)(2 * atan(slope) / DEGREE)};
}

static void add_lamp_and_ground(struct sm_scene *scene, double radius)
{
	parts_add_object(
		scene, parts_add_square(scene), PART_RECEIVES, &(struct pose){.scale = {9, 1, 9}});
	parts_add_light(scene, &(struct sm_light_desc){.type = SM_LIGHT_SPOT,
				       .position = {0, (float)LIGHT_HEIGHT, 0},
				       .radius = (float)radius,
				       .angle = (float)LIGHT_ANGLE});
}

/* A blocker over all of x < 0, at `height` above the ground. */
static void add_half_plane(struct sm_scene *scene, double height)
{
	parts_add_object(scene, parts_add_square(scene), PART_BOTH,
		&(struct pose){.scale = {9, 1, 9}, .position = {-9, (float)height, 0}});
}

/* Pixels of the row that are neither lit nor dark. */
static double width_in(const struct visibility *seen, uint32_t y)
{
	uint32_t width = 0;
	for (uint32_t x = 0; x < seen->width; x++) {
		uint16_t v = seen->values[(size_t)y * seen->width + x];
		width += v > 0 && v < 65535;
	}
	return width;
}

/* Of the penumbra of a half-plane, in texels. */
static double half_plane_width(
	struct rig *rig, const struct sm_shadow_options *options, double radius, double height)
{
	struct visibility seen;
	struct sm_scene *scene = sm_scene_create();
	struct sm_camera camera = camera_at_light(STRIP_HEIGHT);
	assert_non_null(scene);
	add_lamp_and_ground(scene, radius);
	add_half_plane(scene, height);
	rig_set_shadows(rig, options);
	visibility_draw(&seen, rig, scene, &camera, STRIP, STRIP_HEIGHT);
	double width = width_in(&seen, 0);
	for (uint32_t y = 1; y < STRIP_HEIGHT; y++)
		assert_true(fabs(width_in(&seen, y) - width) <= 1);
	visibility_finish(&seen);
	sm_scene_destroy(scene);
	return width;
}

static void a_given_width_is_that_share_of_the_screen(void **state)
{
	static const double widths[] = {0.02, 0.05, 0.1, 0.3, 1};
	static const double heights[] = {0.4, 1, 2, 3};
	for (size_t i = 0; i < COUNT(widths) * COUNT(heights); i++) {
		double t = widths[i / COUNT(heights)], height = heights[i % COUNT(heights)];
		struct sm_shadow_options options = {
			.technique = "smoothie", .map_size = STRIP, .width = (float)t};
		double share = height / LIGHT_HEIGHT; /* 1 - b/r */
		/* The screen ends at its half, where the edge is in the middle. */
		double expected = fmin(t * share, 0.5) * STRIP;
		double width = half_plane_width(*state, &options, 0.1, height);
		assert_true(fabs(width - expected) <= 1.5);
		/* The sinusoid is within half a step of 8 bits of 0 and 1 at either end: over
		 * acos(1 - 1/255) / pi of its way, .028. */
		options.falloff = SM_FALLOFF_SINUSOID;
		width = half_plane_width(*state, &options, 0.1, height);
		assert_true(width <= expected + 1.5);
		assert_true(width >= (1 - 2 * 0.03) * expected - 2);
	}
}

static void the_default_width_is_proportional_to_the_radius(void **state)
{
	static const double heights[] = {0.5, 1, 2};
	static const struct sm_shadow_options options = {
		.technique = "smoothie", .map_size = STRIP};
	for (size_t h = 0; h < COUNT(heights); h++) {
		double largest = half_plane_width(*state, &options, 0.8, heights[h]);
		assert_true(largest > 5);
		for (double radius = 0.05; radius < 0.8; radius *= 2) {
			double width = half_plane_width(*state, &options, radius, heights[h]);
			assert_true(fabs(width - largest * radius / 0.8) <= 1.5);
		}
	}
}

/* Widths in the receiver: R (r - b) / b is the outer half of the true penumbra. */
static void the_default_width_follows_from_similar_triangles(void **state)
{
	static const struct sm_shadow_options options = {
		.technique = "smoothie", .map_size = STRIP};
	const double radius = 0.8, screen = 2 * light_slope() * LIGHT_HEIGHT;
	double share = 0;
	for (double height = 0.5; height <= 2; height += 0.5) {
		double b = LIGHT_HEIGHT - height;
		double half = radius * height / b / screen * STRIP;
		double width = half_plane_width(*state, &options, radius, height);
		/* The same share of it at each height, which is left to the technique. */
		if (share == 0)
			share = half_plane_width(*state, &options, radius, 3) /
				(radius * 3 / (LIGHT_HEIGHT - 3) / screen * STRIP);
		assert_true(fabs(width - share * half) <= 1.5);
	}
	assert_true(share > 0.2 && share < 1);
}

static void the_sinusoid_is_that_of_the_line(void **state)
{
	struct rig *rig = *state;
	struct visibility line, sinusoid;
	struct sm_shadow_options options = {
		.technique = "smoothie", .map_size = STRIP, .width = 0.4f};
	struct sm_camera camera = camera_at_light(1);
	/* Steps of what is fused are coarser than this in the middle. */
	rig_use_path(rig, "pairs=apart");
	add_lamp_and_ground(rig->scene, 0.1);
	add_half_plane(rig->scene, 2);
	rig_set_shadows(rig, &options);
	visibility_draw(&line, rig, rig->scene, &camera, STRIP, 1);
	options.falloff = SM_FALLOFF_SINUSOID;
	rig_set_shadows(rig, &options);
	visibility_draw(&sinusoid, rig, rig->scene, &camera, STRIP, 1);
	uint32_t below = 0, above = 0;
	for (uint32_t x = 0; x < STRIP; x++) {
		double v = visibility_at(&line, x, 0), s = visibility_at(&sinusoid, x, 0);
		below += v < 0.5 && s < v;
		above += v > 0.5 && s > v;
		assert_true(v <= 0.5 ? s <= v + 1e-3 : s >= v - 1e-3);
		/* A table of 256 steps of 1/255. */
		assert_true(fabs(s - (1 - cos(3.14159265 * v)) / 2) < 0.012);
	}
	/* Ends and middle aside. */
	assert_true(below > 40 && above > 40);
	visibility_finish(&line);
	visibility_finish(&sinusoid);
}

static void penumbrae_are_sharp_at_contact_and_grow_with_the_distance(void **state)
{
	struct rig *rig = *state;
	/* x < 0, from the ground at z = -1 up to 2 at z = 1. */
	static const float positions[][3] = {{0, 0, -1}, {-9, 0, -1}, {-9, 2, 1}, {0, 2, 1}};
	static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
	const double t = 0.2, rise = 1; /* of y over z */
	struct sm_camera camera = camera_at_light(STRIP);
	struct visibility seen;
	add_lamp_and_ground(rig->scene, 0.1);
	parts_add_object(rig->scene,
		parts_add_mesh(rig->scene, positions, COUNT(positions), indices, COUNT(indices)),
		PART_CASTS, &(struct pose){.scale = {1, 1, 1}});
	rig_set_shadows(
		rig, &(struct sm_shadow_options){
			     .technique = "smoothie", .map_size = STRIP, .width = (float)t});
	visibility_draw(&seen, rig, rig->scene, &camera, STRIP, STRIP);
	double last = 0;
	uint32_t rows = 0;
	for (uint32_t y = 0; y < STRIP; y++) {
		/* z = c b on this row, and b = LIGHT_HEIGHT - rise (z + 1) on the edge. */
		double c = light_slope() * (2 * (y + 0.5) / STRIP - 1);
		double b = (LIGHT_HEIGHT - rise) / (1 + rise * c), z = c * b;
		if (z < -1 || z > 0.95)
			continue;
		double expected = t * (1 - b / LIGHT_HEIGHT) * STRIP, width = width_in(&seen, y);
		assert_true(fabs(width - expected) <= 2);
		assert_true(width >= last - 1);
		last = width;
		rows++;
	}
	assert_true(last > 45 && rows > 200);
	visibility_finish(&seen);
}

/* ---- a directional light, straight down */

#define ROW 1024
#define ROW_EXTENT 5.0 /* to either side */

/* Of the penumbra that starts at the right of x, in scene units. */
static double width_right_of(const struct visibility *seen, double x)
{
	const double pixel = 2 * ROW_EXTENT / ROW;
	uint32_t at = (uint32_t)((x + ROW_EXTENT) / pixel) + 2, end = at;
	assert_true(visibility_at(seen, at, 0) < 0.5);
	while (end < ROW && visibility_at(seen, end, 0) < 1)
		end++;
	assert_true(end < ROW);
	return (end * pixel - ROW_EXTENT) - x;
}

static void directional_penumbrae_depend_on_the_height_alone(void **state)
{
	struct rig *rig = *state;
	static const struct {
		double x, height;
	} boards[] = {{-4, 1}, {-2, 2}, {0.2, 1}, {1.5, 0.5}, {3, 2}}; /* right edges */
	/* From so far above that it sees things as parallel, to a thousandth of their height. */
	struct sm_camera camera = {.eye = {0, 2000, 0},
		.up = {0, 0, -1},
		.fov = (float)(2 * atan(ROW_EXTENT / ROW / 2000) / DEGREE)};
	uint32_t square = parts_add_square(rig->scene);
	for (size_t i = 0; i < COUNT(boards); i++)
		parts_add_object(rig->scene, square, PART_BOTH,
			&(struct pose){.scale = {0.3f, 1, 4},
				.position = {
					(float)boards[i].x - 0.3f, (float)boards[i].height, 0}});
	parts_add_object(rig->scene, square, PART_RECEIVES,
		&(struct pose){.scale = {8, 1, 8}, .position = {0, 0, 0}});
	parts_add_light(rig->scene,
		&(struct sm_light_desc){
			.type = SM_LIGHT_DIRECTIONAL, .position = {0, 10, 0}, .radius = 5});
	struct visibility seen;
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "smoothie", .map_size = ROW});
	visibility_draw(&seen, rig, rig->scene, &camera, ROW, 1);
	/* Of a unit of height: a texel of the map or of the picture is .01 or more. */
	double unit = width_right_of(&seen, boards[4].x) / boards[4].height;
	assert_true(unit > 0.1);
	for (size_t i = 0; i < COUNT(boards); i++) {
		double width = width_right_of(&seen, boards[i].x);
		assert_true(fabs(width - unit * boards[i].height) < 0.03);
	}
	visibility_finish(&seen);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(two_passes_and_one_agree),
		rig_test(a_point_light_gives_a_filtered_map),
		rig_test(ground_shows_the_same_edges_whether_or_not_it_casts),
		rig_test(mirrored_transforms_give_the_mirrored_picture),
		rig_test(a_given_width_is_that_share_of_the_screen),
		rig_test(the_default_width_is_proportional_to_the_radius),
		rig_test(the_default_width_follows_from_similar_triangles),
		rig_test(the_sinusoid_is_that_of_the_line),
		rig_test(penumbrae_are_sharp_at_contact_and_grow_with_the_distance),
		rig_test(directional_penumbrae_depend_on_the_height_alone),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
