/* SPDX-License-Identifier: MIT */
/* Visibility found for some of the pixels alone, or for each after its surface is known, against
 * that found for each with its surface. */
#include "canvas.h"
#include "parts.h"
#include "visibility.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define WIDTH 389
#define HEIGHT 278

static const struct sm_camera aside = {
	.eye = {1.2f, 2, 1.8f}, .target = {-0.5f, 0.2f, 0}, .up = {0, 1, 0}, .fov = 40};
static const struct sm_light_desc lamp = {
	.position = {4, 5, 0}, .radius = 1, .angle = 60, .color = {1, 1, 1}, .intensity = 1};
static const struct sm_light_desc sun = {.type = SM_LIGHT_DIRECTIONAL,
	.position = {-1, 5, 2},
	.radius = 1,
	.color = {1, 0.8f, 0.6f},
	.intensity = 0.5f};

/* Blocks and a sphere above and on a ground. */
static void fill_scene(struct rig *rig)
{
	uint32_t cube = parts_add_cube(rig->scene);
	for (int i = 0; i < 6; i++)
		parts_add_object(rig->scene, cube, PART_BOTH,
			&(struct pose){{0.3f, 0.1f, 0.2f}, 30.0f * (float)i,
				{0.7f * (float)(i % 3) - 1, 0.1f + 0.4f * (float)(i / 3), 0}});
	parts_add_object(rig->scene, parts_add_sphere(rig->scene, 16), PART_BOTH,
		&(struct pose){{0.3f, 0.3f, 0.3f}, 0, {-0.4f, 0.3f, 0.9f}});
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES,
		&(struct pose){{4, 1, 4}, 0, {0, 0, 0}});
}

static void use(struct rig *rig, enum sm_sampling sampling)
{
	rig_set_shadows(rig, &(struct sm_shadow_options){
				     .technique = "gather", .map_size = 512, .sampling = sampling});
}

static struct visibility draw(
	struct rig *rig, enum sm_sampling sampling, uint32_t width, uint32_t height)
{
	struct visibility seen;
	use(rig, sampling);
	visibility_draw(&seen, rig, rig->scene, &aside, width, height);
	return seen;
}

/* That the last frame drew so. */
static uint32_t lights_of(struct rig *rig, enum sm_sampling sampling)
{
	struct sm_frame_stats stats;
	sm_renderer_get_stats(rig->renderer, &stats);
	switch (sampling) {
	case SM_SAMPLING_SPARSE:
		return stats.sparse_lights;
	case SM_SAMPLING_DEFERRED:
		return stats.deferred_lights;
	case SM_SAMPLING_DEFERRED_SPARSE:
		return stats.deferred_lights < stats.sparse_lights ? stats.deferred_lights
								   : stats.sparse_lights;
	default:
		return stats.lights - stats.sparse_lights - stats.deferred_lights;
	}
}

static struct visibility_change change_of(
	struct rig *rig, enum sm_sampling sampling, uint32_t width, uint32_t height)
{
	struct visibility dense = draw(rig, SM_SAMPLING_DENSE, width, height);
	assert_int_equal(lights_of(rig, SM_SAMPLING_DENSE), 1);
	struct visibility other = draw(rig, sampling, width, height);
	assert_int_equal(lights_of(rig, sampling), 1);
	struct visibility_change change = visibility_compare(&dense, &other);
	print_message("%ux%u: mean %g, off %g, %u differ\n", width, height, change.mean, change.off,
		change.differing);
	visibility_finish(&dense);
	visibility_finish(&other);
	return change;
}

static void what_is_between_points_is_as_if_found(void **state)
{
	struct rig *rig = *state;
	static const struct sm_light_desc *const lights[] = {&lamp, &sun};
	static const enum sm_sampling sparse[] = {SM_SAMPLING_SPARSE, SM_SAMPLING_DEFERRED_SPARSE};
	fill_scene(rig);
	uint32_t light = parts_add_light(rig->scene, &lamp);
	for (size_t i = 0; i < sizeof(lights) / sizeof(lights[0]); i++) {
		assert_true(sm_scene_set_light(rig->scene, light, lights[i], NULL));
		for (size_t j = 0; j < sizeof(sparse) / sizeof(sparse[0]); j++) {
			struct visibility_change change = change_of(rig, sparse[j], WIDTH, HEIGHT);
			/* Some pixels were interpolated. */
			assert_true(change.differing > 300);
			assert_true(change.mean < 0.0005 && change.off < 0.003);
		}
	}
}

static void pictures_may_be_of_any_size(void **state)
{
	struct rig *rig = *state;
	static const uint32_t sizes[][2] = {{1, 1}, {2, 3}, {5, 4}, {64, 1}, {1, 97}, {31, 43}};
	fill_scene(rig);
	parts_add_light(rig->scene, &lamp);
	for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
		const uint32_t *size = sizes[i];
		assert_true(change_of(rig, SM_SAMPLING_SPARSE, size[0], size[1]).mean < 0.005);
		assert_true(change_of(rig, SM_SAMPLING_DEFERRED, size[0], size[1]).mean < 0.0001);
		assert_true(
			change_of(rig, SM_SAMPLING_DEFERRED_SPARSE, size[0], size[1]).mean < 0.005);
	}
}

static void what_is_found_later_is_the_same(void **state)
{
	struct rig *rig = *state;
	static const struct sm_light_desc *const lights[] = {&lamp, &sun};
	fill_scene(rig);
	uint32_t light = parts_add_light(rig->scene, &lamp);
	for (size_t i = 0; i < sizeof(lights) / sizeof(lights[0]); i++) {
		assert_true(sm_scene_set_light(rig->scene, light, lights[i], NULL));
		struct visibility_change change =
			change_of(rig, SM_SAMPLING_DEFERRED, WIDTH, HEIGHT);
		/* Slopes have half the digits. */
		assert_true(change.mean < 0.00001 && change.off < 0.0001);
	}
}

/* Two lights, each in a view of its own: the receivers of one view are drawn over in the other,
 * while what was found of the light is kept. */
static void what_was_found_goes_with_its_receivers(void **state)
{
	struct rig *rig = *state;
	static const float places[] = {-20, 20};
	static const int order[] = {0, 1, 0, 1};
	uint32_t cube = parts_add_cube(rig->scene), square = parts_add_square(rig->scene);
	uint8_t *first[2] = {NULL, NULL};
	struct canvas canvas;
	for (int i = 0; i < 2; i++) {
		struct sm_light_desc spot = lamp;
		spot.position[0] = places[i] + 1;
		spot.target[0] = places[i];
		parts_add_light(rig->scene, &spot);
		parts_add_object(rig->scene, cube, PART_BOTH,
			&(struct pose){
				{0.3f, 0.3f, 0.3f}, 20, {places[i], 0.4f + 0.3f * (float)i, 0}});
		parts_add_object(rig->scene, square, PART_RECEIVES,
			&(struct pose){{2, 1, 2}, 0, {places[i], 0, 0}});
	}
	use(rig, SM_SAMPLING_DEFERRED);
	canvas_init_multisampled(&canvas, GL_SRGB8_ALPHA8, WIDTH, HEIGHT, 4);
	for (size_t i = 0; i < sizeof(order) / sizeof(order[0]); i++) {
		struct sm_view view = {.camera = aside,
			.width = WIDTH,
			.height = HEIGHT,
			.visibility_of = SM_NONE,
			.framebuffer = canvas.framebuffer};
		view.camera.eye[0] += places[order[i]];
		view.camera.target[0] += places[order[i]];
		rig_draw(rig, rig->scene, &view);
		assert_int_equal(lights_of(rig, SM_SAMPLING_DEFERRED), 1);
		uint8_t *pixels = canvas_read(&canvas);
		if (first[order[i]] == NULL) {
			first[order[i]] = pixels;
			continue;
		}
		assert_memory_equal(pixels, first[order[i]], (size_t)4 * WIDTH * HEIGHT);
		free(pixels);
	}
	free(first[0]);
	free(first[1]);
	canvas_finish(&canvas);
}

static void many_small_triangles_are_deferred(void **state)
{
	struct rig *rig = *state;
	fill_scene(rig);
	parts_add_light(rig->scene, &lamp);
	struct visibility small = draw(rig, SM_SAMPLING_DEFAULT, 40, 30);
	assert_int_equal(lights_of(rig, SM_SAMPLING_DEFERRED), 1);
	struct visibility large = draw(rig, SM_SAMPLING_DEFAULT, WIDTH, HEIGHT);
	assert_int_equal(lights_of(rig, SM_SAMPLING_DEFERRED), 0);
	visibility_finish(&small);
	visibility_finish(&large);
}

static void set_radius(struct rig *rig, float radius)
{
	struct sm_light_desc light = lamp;
	light.radius = radius;
	assert_true(sm_scene_set_light(rig->scene, 0, &light, NULL));
}

/* And their pixels found between points, whatever their triangles. */
static void long_lists_are_deferred(void **state)
{
	struct rig *rig = *state;
	parts_add_small_blocks(rig->scene, PART_BOTH);
	parts_add_light(rig->scene, &lamp);
	set_radius(rig, 0.05f);
	struct visibility brief = draw(rig, SM_SAMPLING_DEFAULT, WIDTH, HEIGHT);
	assert_int_equal(lights_of(rig, SM_SAMPLING_DEFERRED), 0);
	set_radius(rig, 1);
	struct visibility wide = draw(rig, SM_SAMPLING_DEFAULT, WIDTH, HEIGHT);
	assert_int_equal(lights_of(rig, SM_SAMPLING_DEFERRED_SPARSE), 1);
	visibility_finish(&brief);
	visibility_finish(&wide);
	struct visibility_change change =
		change_of(rig, SM_SAMPLING_DEFERRED_SPARSE, WIDTH, HEIGHT);
	assert_true(change.differing > 300 && change.mean < 0.005);
}

static bool is_sparse(struct rig *rig, const struct canvas *canvas, float radius, bool alone)
{
	struct sm_light_desc light = lamp;
	const struct sm_view view = {.camera = aside,
		.width = WIDTH,
		.height = HEIGHT,
		.visibility_of = SM_NONE,
		.framebuffer = canvas->framebuffer,
		.alone = alone};
	light.radius = radius;
	assert_true(sm_scene_set_light(rig->scene, 0, &light, NULL));
	rig_draw(rig, rig->scene, &view);
	return lights_of(rig, SM_SAMPLING_SPARSE) == 1;
}

/* The least radius, to a fiftieth, that a picture alone is sampled sparsely for; 0: none is. */
static float find_sparse_radius(struct rig *rig, const struct canvas *canvas)
{
	float dense = 0, sparse = 3;
	if (!is_sparse(rig, canvas, sparse, true))
		return 0;
	while (sparse - dense > 0.02f * sparse) {
		float middle = (dense + sparse) / 2;
		if (is_sparse(rig, canvas, middle, true))
			sparse = middle;
		else
			dense = middle;
	}
	return sparse;
}

/* Between others a choice is kept a while, by "gather" itself and where "auto" has taken it. */
static void a_picture_alone_is_sampled_by_itself(void **state)
{
	struct rig *rig = *state;
	static const char *const techniques[] = {"gather", "auto"};
	struct canvas canvas;
	fill_scene(rig);
	parts_add_light(rig->scene, &lamp);
	canvas_init(&canvas, GL_SRGB8_ALPHA8, WIDTH, HEIGHT);
	for (size_t i = 0; i < sizeof(techniques) / sizeof(techniques[0]); i++) {
		rig_set_shadows(rig,
			&(struct sm_shadow_options){.technique = techniques[i], .map_size = 512});
		float radius = find_sparse_radius(rig, &canvas);
		GLint bits = 0; /* of a grid that is too coarse for it */
		glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
		assert_true(radius > 0 || bits < 6);
		if (radius == 0)
			break;
		assert_true(is_sparse(rig, &canvas, radius, false));
		assert_true(is_sparse(rig, &canvas, 0.9f * radius, false));
		assert_false(is_sparse(rig, &canvas, 0.9f * radius, true));
	}
	canvas_finish(&canvas);
}

static void a_point_has_nothing_between(void **state)
{
	struct rig *rig = *state;
	struct sm_light_desc point = lamp;
	point.radius = 0;
	fill_scene(rig);
	parts_add_light(rig->scene, &point);
	struct visibility seen = draw(rig, SM_SAMPLING_SPARSE, WIDTH, HEIGHT), hard;
	assert_int_equal(lights_of(rig, SM_SAMPLING_SPARSE), 0);
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = "hard", .map_size = 512});
	visibility_draw(&hard, rig, rig->scene, &aside, WIDTH, HEIGHT);
	assert_int_equal(visibility_compare(&seen, &hard).differing, 0);
	visibility_finish(&seen);
	visibility_finish(&hard);
}

static uint8_t *draw_scaled(struct rig *rig, GLenum format, GLsizei samples, uint32_t scale)
{
	struct canvas canvas;
	uint32_t width = scale * WIDTH, height = scale * HEIGHT;
	struct sm_view view = {
		.camera = aside, .width = width, .height = height, .visibility_of = SM_NONE};
	if (samples > 1)
		canvas_init_multisampled(&canvas, format, width, height, samples);
	else
		canvas_init(&canvas, format, width, height);
	view.framebuffer = canvas.framebuffer;
	rig_draw(rig, rig->scene, &view);
	uint8_t *pixels = canvas_read(&canvas);
	canvas_finish(&canvas);
	return pixels;
}

static uint8_t *draw_picture(struct rig *rig, GLenum format, GLsizei samples)
{
	return draw_scaled(rig, format, samples, 1);
}

#define FINE 4

/* Mean difference to a picture FINE times as wide and high. */
static double error_of(const uint8_t *pixels, const uint8_t *fine)
{
	double sum = 0;
	for (size_t y = 0; y < HEIGHT; y++)
		for (size_t x = 0; x < WIDTH; x++) {
			double mean = 0;
			for (size_t i = 0; i < FINE * FINE; i++)
				mean += fine[4 * ((FINE * y + i / FINE) * FINE * WIDTH + FINE * x +
							 i % FINE)];
			sum += fabs(mean / (FINE * FINE) - pixels[4 * (y * WIDTH + x)]);
		}
	return sum / (WIDTH * HEIGHT);
}

/* Along edges dense samples are found where their surface would go on at the pixel's middle. */
static void samples_of_a_pixel_find_their_surface(void **state)
{
	struct rig *rig = *state;
	fill_scene(rig);
	parts_add_light(rig->scene, &lamp);
	use(rig, SM_SAMPLING_DENSE);
	uint8_t *fine = draw_scaled(rig, GL_SRGB8_ALPHA8, 1, FINE);
	uint8_t *dense = draw_picture(rig, GL_SRGB8_ALPHA8, 4);
	use(rig, SM_SAMPLING_DEFERRED);
	uint8_t *deferred = draw_picture(rig, GL_SRGB8_ALPHA8, 4);
	double error = error_of(deferred, fine), dense_error = error_of(dense, fine);
	print_message("dense %g, deferred %g of 255\n", dense_error, error);
	assert_int_equal(lights_of(rig, SM_SAMPLING_DEFERRED), 1);
	assert_true(error < 1.05 * dense_error);
	free(fine);
	free(dense);
	free(deferred);
}

/* A pixel that two passes draw, or none, would be off by far more. */
static void assert_alike(const uint8_t *a, const uint8_t *b, const char *what)
{
	double sum = 0;
	size_t off = 0;
	for (size_t i = 0; i < (size_t)4 * WIDTH * HEIGHT; i++) {
		int apart = abs(a[i] - b[i]);
		sum += apart;
		off += apart > 8;
	}
	sum /= 4.0 * WIDTH * HEIGHT;
	print_message("%s: mean %g of 255, %zu off\n", what, sum, off);
	assert_true(sum < 0.1 && off < 4 * WIDTH * HEIGHT / 1000);
}

/* Plates beside and before each other and a ground, of which a small part is in a penumbra. */
static void fill_with_plates(struct rig *rig)
{
	uint32_t cube = parts_add_cube(rig->scene), square = parts_add_square(rig->scene);
	for (int i = 0; i < 5; i++)
		parts_add_object(rig->scene, cube, PART_CASTS,
			&(struct pose){{0.2f, 0.05f, 0.2f}, 25.0f * (float)i,
				{0.6f * (float)(i % 3) - 0.6f, 0.9f,
					0.7f * (float)(i / 3) - 0.3f}});
	for (int i = 0; i < 100; i++)
		parts_add_object(rig->scene, square, PART_RECEIVES,
			&(struct pose){{0.07f, 1, 0.07f}, 11.0f * (float)i,
				{0.2f * (float)(i % 10) - 0.9f, 0.03f * (float)(i % 7),
					0.2f * (float)(i / 10) - 0.9f}});
}

static void add_ground(struct rig *rig)
{
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES,
		&(struct pose){{4, 1, 4}, 0, {0, -0.1f, 0}});
}

#define PLACES 8

/* From one of the places around the scene. */
static uint8_t *draw_from(
	struct rig *rig, enum sm_sampling sampling, const struct canvas *canvas, int place)
{
	struct sm_view view = {.camera = aside,
		.width = WIDTH,
		.height = HEIGHT,
		.visibility_of = SM_NONE,
		.framebuffer = canvas->framebuffer};
	float turn = 6.2831853f / PLACES * (float)place;
	view.camera.eye[0] = 2.4f * cosf(turn);
	view.camera.eye[2] = 2.4f * sinf(turn);
	rig_draw(rig, rig->scene, &view);
	assert_int_equal(lights_of(rig, sampling), 2);
	return canvas_read(canvas);
}

/* Passes before surfaces leave out what surfaces do not look up: there is what other views, or
 * other lights, have left there. */
static void check_left_out(struct rig *rig, enum sm_sampling sampling, GLsizei samples)
{
	struct sm_light_desc narrow[2] = {lamp, sun};
	struct canvas canvas;
	uint8_t *first[PLACES];
	narrow[0].radius = narrow[1].radius = 0.03f;
	for (uint32_t light = 0; light < 2; light++)
		assert_true(sm_scene_set_light(rig->scene, light, &narrow[light], NULL));
	canvas_init_multisampled(&canvas, GL_SRGB8_ALPHA8, WIDTH, HEIGHT, samples);
	for (int place = 0; place < PLACES; place++) {
		rig_use_path(rig, "branch=early-depth");
		use(rig, SM_SAMPLING_DENSE);
		uint8_t *dense = draw_from(rig, SM_SAMPLING_DENSE, &canvas, place);
		use(rig, sampling);
		first[place] = draw_from(rig, sampling, &canvas, place);
		if (samples == 1)
			assert_alike(dense, first[place], "place");
		free(dense);
	}
	for (int place = 0; place < PLACES; place++) {
		uint8_t *again = draw_from(rig, sampling, &canvas, place);
		assert_memory_equal(first[place], again, (size_t)4 * WIDTH * HEIGHT);
		free(again);
	}
	for (uint32_t light = 0; light < 2; light++)
		assert_true(sm_scene_set_light(rig->scene, light, &narrow[1 - light], NULL));
	for (int place = 0; place < PLACES; place++) {
		uint8_t *other = draw_from(rig, sampling, &canvas, place);
		/* Each light is rounded when it is added. */
		/* Each light is rounded when it is added, and of several samples those along a
		 * tile's side may be drawn with the next tile. */
		size_t off = 0;
		for (size_t i = 0; i < (size_t)4 * WIDTH * HEIGHT; i++)
			off += abs(other[i] - first[place][i]) > 2;
		assert_in_range(off, 0, samples > 1 ? 16 : 0);
		free(other);
		free(first[place]);
	}
	canvas_finish(&canvas);
}

static void what_is_left_out_is_not_looked_up(void **state)
{
	struct rig *rig = *state;
	static const enum sm_sampling deferred[] = {
		SM_SAMPLING_DEFERRED, SM_SAMPLING_DEFERRED_SPARSE};
	fill_with_plates(rig);
	parts_add_light(rig->scene, &lamp);
	parts_add_light(rig->scene, &sun);
	for (size_t i = 0; i < 8; i++) {
		if (i == 4)
			add_ground(rig);
		check_left_out(rig, deferred[i % 2], i / 2 % 2 ? 4 : 1);
	}
}

static void several_lights_add_up(void **state)
{
	struct rig *rig = *state;
	static const struct {
		GLenum format;
		GLsizei samples;
		const char *name;
	} cases[] = {{GL_SRGB8_ALPHA8, 1, "sRGB"}, {GL_RGBA8, 1, "accumulator"},
		{GL_SRGB8_ALPHA8, 4, "multisampled"}};
	fill_scene(rig);
	parts_add_light(rig->scene, &lamp);
	parts_add_light(rig->scene, &sun);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		use(rig, SM_SAMPLING_DENSE);
		uint8_t *dense = draw_picture(rig, cases[i].format, cases[i].samples);
		use(rig, SM_SAMPLING_SPARSE);
		uint8_t *sparse = draw_picture(rig, cases[i].format, cases[i].samples);
		assert_int_equal(lights_of(rig, SM_SAMPLING_SPARSE), 2);
		assert_alike(dense, sparse, cases[i].name);
		use(rig, SM_SAMPLING_DEFERRED);
		uint8_t *deferred = draw_picture(rig, cases[i].format, cases[i].samples);
		assert_int_equal(lights_of(rig, SM_SAMPLING_DEFERRED), 2);
		use(rig, SM_SAMPLING_DEFERRED_SPARSE);
		uint8_t *both = draw_picture(rig, cases[i].format, cases[i].samples);
		assert_int_equal(lights_of(rig, SM_SAMPLING_DEFERRED_SPARSE), 2);
		assert_alike(deferred, both, cases[i].name);
		if (cases[i].samples == 1)
			assert_alike(dense, deferred, cases[i].name);
		free(dense);
		free(sparse);
		free(deferred);
		free(both);
	}
}

static void either_way_of_branching_looks_the_same(void **state)
{
	struct rig *rig = *state;
	rig_use_path(rig, "branch=shader");
	fill_scene(rig);
	parts_add_light(rig->scene, &lamp);
	struct visibility one = draw(rig, SM_SAMPLING_SPARSE, WIDTH, HEIGHT);
	rig_use_path(rig, "branch=early-depth");
	struct visibility two = draw(rig, SM_SAMPLING_SPARSE, WIDTH, HEIGHT);
	assert_int_equal(visibility_compare(&one, &two).differing, 0);
	visibility_finish(&one);
	visibility_finish(&two);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(what_is_between_points_is_as_if_found),
		rig_test(what_is_found_later_is_the_same),
		rig_test(samples_of_a_pixel_find_their_surface),
		rig_test(what_was_found_goes_with_its_receivers),
		rig_test(many_small_triangles_are_deferred),
		rig_test(long_lists_are_deferred),
		rig_test(pictures_may_be_of_any_size),
		rig_test(a_picture_alone_is_sampled_by_itself),
		rig_test(a_point_has_nothing_between),
		rig_test(what_is_left_out_is_not_looked_up),
		rig_test(several_lights_add_up),
		rig_test(either_way_of_branching_looks_the_same),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
