/* SPDX-License-Identifier: MIT */
/*
 * A frame like the last one allocates nothing, and one that finds no memory fails cleanly. Linked
 * with --wrap, so that what this program and the library call is counted, and what the driver calls
 * is not.
 */
#include "allocations.h"
#include "canvas.h"
#include "parts.h"
#include "rig.h"
#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 48

/* Enough that sorting them by qsort() would allocate. */
#define OBJECTS 100

void __real_qsort(
	void *base, size_t count, size_t size, int (*compare)(const void *, const void *));
void __wrap_qsort(
	void *base, size_t count, size_t size, int (*compare)(const void *, const void *));

/* glibc's before 2.37 allocates above 1024 bytes. */
void __wrap_qsort(void *base, size_t count, size_t size, int (*compare)(const void *, const void *))
{
	allocations += count * size > 1024;
	__real_qsort(base, count, size, compare);
}

static const struct sm_light_desc lamp = {
	.name = "lamp",
	.type = SM_LIGHT_SPOT,
	.position = {0, 6, 1},
	.radius = 0.3f,
	.angle = 80,
	.color = {1, 1, 1},
	.intensity = 1,
};

/* Spheres on a floor, under two lights. */
static void set_up(struct sm_scene *scene)
{
	struct sm_light_desc sun = lamp;
	sun.type = SM_LIGHT_DIRECTIONAL;
	parts_add_light(scene, &lamp);
	parts_add_light(scene, &sun);
	uint32_t sphere = parts_add_sphere(scene, 8);
	for (int i = 0; i < OBJECTS; i++)
		parts_add_object(scene, sphere, PART_BOTH,
			&(struct pose){.scale = {0.2f, 0.2f, 0.2f},
				.position = {(float)(i % 10) / 2 - 2, 1, (float)(i / 10) / 2 - 2}});
	parts_add_object(
		scene, parts_add_square(scene), PART_RECEIVES, &(struct pose){.scale = {4, 1, 4}});
}

static struct sm_view view_of(const struct canvas *canvas)
{
	return (struct sm_view){
		.camera = {.eye = {4, 5, 6}, .up = {0, 1, 0}, .fov = 50},
		.framebuffer = canvas->framebuffer,
		.width = SIZE,
		.height = SIZE,
		.visibility_of = SM_NONE,
	};
}

static void the_same_frame_allocates_nothing(void **state)
{
	struct rig *rig = *state;
	static const struct {
		struct sm_shadow_options options;
		GLenum format;
		uint32_t visibility_of;
	} cases[] = {
		{{.technique = "hard"}, GL_SRGB8_ALPHA8, SM_NONE},
		{{.technique = "smoothie"}, GL_SRGB8_ALPHA8, SM_NONE},
		{{.technique = "smoothie", .passes = 2}, GL_RGBA8, SM_NONE},
		{{.technique = "smoothie-two-sided"}, GL_RGBA8, SM_NONE},
		{{.technique = "penumbra-map"}, GL_RGBA8, SM_NONE},
		{{.technique = "gather", .sampling = SM_SAMPLING_DENSE}, GL_RGBA8, SM_NONE},
		{{.technique = "gather", .sampling = SM_SAMPLING_SPARSE}, GL_RGBA8, SM_NONE},
		{{.technique = "gather", .sampling = SM_SAMPLING_DEFERRED}, GL_RGBA8, SM_NONE},
		{{.technique = "gather", .sampling = SM_SAMPLING_DEFERRED_SPARSE}, GL_RGBA8,
			SM_NONE},
		{{.technique = "gather"}, GL_SRGB8_ALPHA8, 1},
		{{.technique = "auto"}, GL_SRGB8_ALPHA8, SM_NONE},
		{{.technique = "smoothie", .falloff = SM_FALLOFF_SINUSOID}, GL_RGBA8, 1},
		{{.precision = SM_PRECISION_HALF}, GL_SRGB8_ALPHA8, SM_NONE},
		{{.precision = SM_PRECISION_FIXED12}, GL_RGBA8, 1},
	};
	rig_skip_nothing(rig);
	set_up(rig->scene);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct canvas canvas;
		canvas_init(&canvas, cases[i].format, SIZE, SIZE);
		struct sm_view view = view_of(&canvas);
		view.visibility_of = cases[i].visibility_of;
		rig_set_shadows(rig, &cases[i].options);
		allocations = 0;
		rig_draw(rig, rig->scene, &view);
		assert_true(allocations > 0);
		allocations = 0;
		rig_draw(rig, rig->scene, &view);
		assert_int_equal(allocations, 0);
		canvas_finish(&canvas);
	}
}

/* Draws with each allocation failing in turn, and after each as if nothing had been. Returns how
 * many there are. */
static unsigned long starve(struct rig *rig, const struct sm_shadow_options *options,
	const struct sm_view *view, const struct canvas *canvas)
{
	rig_set_shadows(rig, options);
	rig_draw(rig, rig->scene, view);
	uint8_t *whole = canvas_read(canvas);
	unsigned long allowed = 0;
	for (bool drawn = false; !drawn; allowed++) {
		struct sm_error error = {0};
		rig_set_shadows(rig, options);
		allocations_left = allowed;
		drawn = sm_renderer_draw(rig->renderer, rig->scene, view, &error);
		allocations_left = ULONG_MAX;
		assert_int_equal(error.status, drawn ? SM_OK : SM_ERROR_MACHINE);
		rig_draw(rig, rig->scene, view);
		uint8_t *again = canvas_read(canvas);
		assert_memory_equal(again, whole, SIZE * SIZE * 4);
		free(again);
	}
	free(whole);
	return allowed;
}

static void a_frame_without_memory_fails_and_leaves_nothing(void **state)
{
	struct rig *rig = *state;
	static const struct {
		struct sm_shadow_options options;
		unsigned long least; /* allocations */
	} cases[] = {
		{{.technique = "hard", .map_size = 64}, 1},
		{{.technique = "smoothie", .map_size = 64}, 4},
		{{.technique = "smoothie-two-sided", .map_size = 64}, 4},
		{{"gather", .map_size = 64, .sampling = SM_SAMPLING_DENSE}, 15},
		{{"gather", .map_size = 64, .sampling = SM_SAMPLING_SPARSE}, 15},
		{{.precision = SM_PRECISION_FIXED12, .map_size = 64}, 4},
	};
	struct canvas canvas;
	parts_add_light(rig->scene, &lamp);
	parts_add_object(rig->scene, parts_add_sphere(rig->scene, 4), PART_BOTH,
		&(struct pose){.scale = {1, 1, 1}, .position = {0, 1, 0}});
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES,
		&(struct pose){.scale = {4, 1, 4}});
	canvas_init(&canvas, GL_RGBA8, SIZE, SIZE);
	struct sm_view view = view_of(&canvas);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		unsigned long count = starve(rig, &cases[i].options, &view, &canvas);
		assert_in_range(count, cases[i].least, 1000);
	}
	canvas_finish(&canvas);
}

/* Of which triangles nothing is in front is searched in further frames of a light that stays: with
 * so many allocations allowed in them. Returns whether they were enough. */
static bool search_with(struct rig *rig, const struct sm_view *view, unsigned long allowed)
{
	static const struct sm_shadow_options options = {.technique = "smoothie", .map_size = 64};
	bool drawn = true;
	rig_set_shadows(rig, &options);
	rig_draw(rig, rig->scene, view);
	allocations_left = allowed;
	for (int frame = 0; frame < 4; frame++) {
		struct sm_error error = {0};
		bool done = sm_renderer_draw(rig->renderer, rig->scene, view, &error);
		assert_int_equal(error.status, done ? SM_OK : SM_ERROR_MACHINE);
		drawn = drawn && done;
	}
	allocations_left = ULONG_MAX;
	return drawn;
}

static void a_search_without_memory_fails_and_leaves_nothing(void **state)
{
	struct rig *rig = *state;
	struct canvas canvas;
	parts_add_light(rig->scene, &lamp);
	parts_add_object(rig->scene, parts_add_sphere(rig->scene, 8), PART_BOTH,
		&(struct pose){.scale = {1, 1, 1}, .position = {0, 1, 0}});
	canvas_init(&canvas, GL_RGBA8, SIZE, SIZE);
	struct sm_view view = view_of(&canvas);
	assert_true(search_with(rig, &view, ULONG_MAX));
	uint8_t *whole = canvas_read(&canvas);
	unsigned long allowed = 0;
	for (bool drawn = false; !drawn; allowed++) {
		drawn = search_with(rig, &view, allowed);
		for (int frame = 0; frame < 6; frame++)
			rig_draw(rig, rig->scene, &view);
		uint8_t *again = canvas_read(&canvas);
		assert_memory_equal(again, whole, SIZE * SIZE * 4);
		free(again);
	}
	assert_in_range(allowed, 8, 1000);
	free(whole);
	canvas_finish(&canvas);
}

static void moving_things_allocates_nothing(void **state)
{
	struct rig *rig = *state;
	struct sm_light_desc moved = lamp;
	float transform[16];
	set_up(rig->scene);
	pose_matrix(&(struct pose){.scale = {1, 1, 1}}, transform);
	moved.position[0] = 1;
	allocations = 0;
	assert_true(sm_scene_set_light(rig->scene, 0, &moved, NULL));
	assert_true(sm_scene_set_transform(rig->scene, 0, transform, NULL));
	assert_int_equal(allocations, 0);
	moved.name = "another";
	assert_true(sm_scene_set_light(rig->scene, 0, &moved, NULL));
	assert_int_equal(allocations, 1);
}

static void copying_to_a_screen_allocates_nothing(void **state)
{
	struct rig *rig = *state;
	struct canvas canvas;
	GLuint texture;
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, SIZE, SIZE);
	canvas_init(&canvas, GL_RGB565, SIZE, SIZE);
	struct sm_screen screen = {texture, SIZE, SIZE, canvas.framebuffer, 0, {5, 6, 5}};
	assert_true(sm_renderer_copy_to_screen(rig->renderer, &screen, NULL));
	allocations = 0;
	assert_true(sm_renderer_copy_to_screen(rig->renderer, &screen, NULL));
	assert_int_equal(allocations, 0);
	canvas_finish(&canvas);
	glDeleteTextures(1, &texture);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(the_same_frame_allocates_nothing),
		rig_test(a_frame_without_memory_fails_and_leaves_nothing),
		rig_test(a_search_without_memory_fails_and_leaves_nothing),
		rig_test(moving_things_allocates_nothing),
		rig_test(copying_to_a_screen_allocates_nothing),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
