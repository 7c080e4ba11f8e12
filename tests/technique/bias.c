/* SPDX-License-Identifier: MIT */
/* Nothing shadows itself, and no shadow stands off from what throws it. */
#include "parts.h"
#include "visibility.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#define SIZE 96
#define DEGREE 0.017453292519943295

static const struct technique {
	const char *name;
	uint32_t samples;
	double light_at_foot; /* most, where the light grazes the ground */
} techniques[] = {
	{"hard", 0},
	{"pcf", 4},
	{"pcf", 16, 0.25}, /* its filter is two texels wide on each side */
	{"smoothie", 0},
	{"smoothie-two-sided", 0},
	{"penumbra-map", 0},
	{"pcss", 16},
	{"vsm", 5, 0.25}, /* so is its blur */
	{"maps", 4},
};
static const uint32_t map_sizes[] = {64, 128, 256, 512, 1024};

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* From 30 degrees off the x axis, `angle` degrees off the vertical, `distance` from the origin. */
static struct sm_light_desc light_from(enum sm_light_type type, double angle, double distance)
{
	double aside = distance * sin(angle * DEGREE);
	return (struct sm_light_desc){
		.type = type,
		.position = {(float)(aside * cos(30 * DEGREE)),
			(float)(distance * cos(angle * DEGREE)), (float)(aside * sin(30 * DEGREE))},
		.radius = (float)(0.03 * distance),
		.angle = 50,
		.color = {1, 1, 1},
		.intensity = 1,
	};
}

static struct sm_camera camera_at(double scale, double x, double y, double z)
{
	return (struct sm_camera){
		.eye = {(float)(scale * x), (float)(scale * y), (float)(scale * z)},
		.up = {0, 1, 0},
		.fov = 40,
	};
}

static void set_map(struct rig *rig, const struct technique *technique, uint32_t size)
{
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = technique->name,
				     .samples = technique->samples,
				     .map_size = size});
}

static void assert_all_lit(struct rig *rig, const struct sm_camera *camera,
	const struct technique *technique, double angle, uint32_t map_size)
{
	struct visibility seen;
	visibility_draw(&seen, rig, rig->scene, camera, SIZE, SIZE);
	uint32_t dark = 0;
	uint16_t darkest = 65535;
	for (size_t i = 0; i < SIZE * SIZE; i++) {
		dark += seen.values[i] != 65535;
		if (seen.values[i] < darkest)
			darkest = seen.values[i];
	}
	visibility_finish(&seen);
	if (dark > 0)
		fail_msg("%s %u, light at %g degrees, map %u: %u pixels down to %.3f",
			technique->name, technique->samples, angle, map_size, dark,
			darkest / 65535.0);
}

/* distance: of the light, in units of scale */
static void check_plane(struct rig *rig, enum sm_light_type type, double scale, double distance)
{
	struct sm_camera camera = camera_at(scale, -2, 4, 3.5);
	float size = (float)(2 * scale);
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_BOTH,
		&(struct pose){.scale = {size, size, size}, .turn = 10});
	struct sm_light_desc light = light_from(type, 0, distance * scale);
	parts_add_light(rig->scene, &light);
	for (size_t t = 0; t < COUNT(techniques); t++) {
		if (!rig_can_draw(techniques[t].name))
			continue;
		for (size_t m = 0; m < COUNT(map_sizes); m++) {
			set_map(rig, &techniques[t], map_sizes[m]);
			for (int angle = 0; angle <= 80; angle += 10) {
				light = light_from(type, angle, distance * scale);
				assert_true(sm_scene_set_light(rig->scene, 0, &light, NULL));
				assert_all_lit(rig, &camera, &techniques[t], angle, map_sizes[m]);
			}
		}
	}
}

static void a_plane_does_not_shadow_itself_from_a_spot(void **state)
{
	check_plane(*state, SM_LIGHT_SPOT, 1, 6);
}

static void a_plane_does_not_shadow_itself_from_a_directional_light(void **state)
{
	check_plane(*state, SM_LIGHT_DIRECTIONAL, 1, 6);
}

static void a_tiny_plane_does_not_shadow_itself_from_a_spot(void **state)
{
	check_plane(*state, SM_LIGHT_SPOT, 1e-2, 6);
}

static void a_tiny_plane_does_not_shadow_itself_from_a_directional_light(void **state)
{
	check_plane(*state, SM_LIGHT_DIRECTIONAL, 1e-2, 6);
}

static void a_huge_plane_does_not_shadow_itself_from_a_spot(void **state)
{
	check_plane(*state, SM_LIGHT_SPOT, 1e3, 6);
}

static void a_huge_plane_does_not_shadow_itself_from_a_directional_light(void **state)
{
	check_plane(*state, SM_LIGHT_DIRECTIONAL, 1e3, 6);
}

static void nor_from_a_directional_light_far_away(void **state)
{
	check_plane(*state, SM_LIGHT_DIRECTIONAL, 1, 1e5);
}

/* Where a pixel's ray from the eye meets the unit sphere, and from which side it is lit there;
 * false beside it. */
static bool sphere_facing(const struct sm_camera *camera, const struct sm_light_desc *light,
	uint32_t x, uint32_t y, double *facing)
{
	/* The camera looks along -z at the origin from z. */
	double half = tan(camera->fov / 2 * DEGREE), z = camera->eye[2];
	double dx = half * (2 * (x + 0.5) / SIZE - 1), dy = half * (1 - 2 * (y + 0.5) / SIZE);
	double a = dx * dx + dy * dy + 1, disc = z * z - a * (z * z - 1);
	if (disc < 0)
		return false;
	double t = (z - sqrt(disc)) / a;
	double n[3] = {t * dx, t * dy, z - t}, dot = 0, square = 0;
	for (int i = 0; i < 3; i++) {
		double towards = light->position[i] - (light->type == SM_LIGHT_SPOT ? n[i] : 0);
		dot += n[i] * towards;
		square += towards * towards;
	}
	*facing = dot / sqrt(square);
	return true;
}

static void check_sphere(struct rig *rig, enum sm_light_type type)
{
	struct sm_camera camera = camera_at(1, 0, 0, 4);
	parts_add_object(rig->scene, parts_add_sphere(rig->scene, 32), PART_BOTH,
		&(struct pose){.scale = {1, 1, 1}});
	struct sm_light_desc light = light_from(type, 0, 6);
	parts_add_light(rig->scene, &light);
	for (size_t i = 0; i < COUNT(techniques) * COUNT(map_sizes); i++) {
		const struct technique *technique = &techniques[i % COUNT(techniques)];
		uint32_t map_size = map_sizes[i / COUNT(techniques)];
		if (!rig_can_draw(technique->name))
			continue;
		set_map(rig, technique, map_size);
		for (int angle = 0; angle <= 90; angle += 30) {
			struct visibility seen;
			light = light_from(type, angle, 6);
			assert_true(sm_scene_set_light(rig->scene, 0, &light, NULL));
			visibility_draw(&seen, rig, rig->scene, &camera, SIZE, SIZE);
			for (uint32_t y = 0; y < SIZE; y++) {
				for (uint32_t x = 0; x < SIZE; x++) {
					double facing, v = visibility_at(&seen, x, y);
					if (sphere_facing(&camera, &light, x, y, &facing) &&
						facing > 0.3 && v < 0.9)
						fail_msg("%s %u, map %u, light at %d degrees: %.3f "
							 "at %u, %u, which faces it by %.2f",
							technique->name, technique->samples,
							map_size, angle, v, x, y, facing);
				}
			}
			visibility_finish(&seen);
		}
	}
}

static void a_sphere_does_not_shadow_its_lit_side_from_a_spot(void **state)
{
	check_sphere(*state, SM_LIGHT_SPOT);
}

static void a_sphere_does_not_shadow_its_lit_side_from_a_directional_light(void **state)
{
	check_sphere(*state, SM_LIGHT_DIRECTIONAL);
}

/* Width of a map texel on the ground near the origin, along the light's way. */
static double texel_on_ground(
	const struct sm_light_desc *light, double angle, double distance, uint32_t map_size)
{
	double screen = light->type == SM_LIGHT_SPOT ? 2 * tan(light->angle / 2 * DEGREE) * distance
						     : 4; /* the screen of a directional light fits
							     the casters, which are smaller */
	return screen / map_size / cos(angle * DEGREE);
}

/* A block on the ground, lit from the right; its shadow lies to the left of x = -0.5. */
static void check_foot(struct rig *rig, enum sm_light_type type)
{
	/* Straight down from just left of the block's wall, so that its foot is seen. */
	struct sm_camera camera = {
		.eye = {-0.55f, 4, 0}, .target = {-0.55f, 0, 0}, .up = {0, 0, -1}, .fov = 10};
	double half = 4 * tan(camera.fov / 2 * DEGREE);
	parts_add_object(rig->scene, parts_add_cube(rig->scene), PART_BOTH,
		&(struct pose){.scale = {0.5f, 0.5f, 0.5f}, .position = {0, 0.5f, 0}});
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES,
		&(struct pose){.scale = {4, 1, 4}});
	struct sm_light_desc light = light_from(type, 0, 6);
	parts_add_light(rig->scene, &light);
	for (size_t i = 0; i < COUNT(techniques) * COUNT(map_sizes); i++) {
		const struct technique *technique = &techniques[i % COUNT(techniques)];
		uint32_t map_size = map_sizes[i / COUNT(techniques)];
		if (!rig_can_draw(technique->name))
			continue;
		set_map(rig, technique, map_size);
		for (int angle = 20; angle <= 80; angle += 15) {
			struct visibility seen;
			light = light_from(type, angle, 6);
			assert_true(sm_scene_set_light(rig->scene, 0, &light, NULL));
			visibility_draw(&seen, rig, rig->scene, &camera, SIZE, SIZE);
			double near_foot =
				fmin(2 * texel_on_ground(&light, angle, 6, map_size), half - 0.05);
			for (uint32_t x = 0; x < SIZE; x++) {
				double left = camera.eye[0] + half * (2 * (x + 0.5) / SIZE - 1);
				if (left > -0.5 || left < -0.5 - near_foot)
					continue;
				double v = visibility_at(&seen, x, SIZE / 2);
				if (v > technique->light_at_foot)
					fail_msg("%s %u, map %u, light at %d degrees: %.3f at %.4f "
						 "from the foot",
						technique->name, technique->samples, map_size,
						angle, v, -0.5 - left);
			}
			visibility_finish(&seen);
		}
	}
}

static void the_shadow_of_a_spot_starts_at_the_foot_of_a_block(void **state)
{
	check_foot(*state, SM_LIGHT_SPOT);
}

static void the_shadow_of_a_directional_light_starts_at_the_foot_of_a_block(void **state)
{
	check_foot(*state, SM_LIGHT_DIRECTIONAL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(a_plane_does_not_shadow_itself_from_a_spot),
		rig_test(a_plane_does_not_shadow_itself_from_a_directional_light),
		rig_test(a_tiny_plane_does_not_shadow_itself_from_a_spot),
		rig_test(a_tiny_plane_does_not_shadow_itself_from_a_directional_light),
		rig_test(a_huge_plane_does_not_shadow_itself_from_a_spot),
		rig_test(a_huge_plane_does_not_shadow_itself_from_a_directional_light),
		rig_test(nor_from_a_directional_light_far_away),
		rig_test(a_sphere_does_not_shadow_its_lit_side_from_a_spot),
		rig_test(a_sphere_does_not_shadow_its_lit_side_from_a_directional_light),
		rig_test(the_shadow_of_a_spot_starts_at_the_foot_of_a_block),
		rig_test(the_shadow_of_a_directional_light_starts_at_the_foot_of_a_block),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
