/* SPDX-License-Identifier: MIT */
/* What all pixels of a light read comes from vertices, or from uniforms, and lists of edges from
 * images, or from textures: the picture is the same to the bit, whatever shadows are made by. */
#include "canvas.h"
#include "parts.h"
#include "renderer.h"
#include "rig.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define WIDTH 203
#define HEIGHT 151

#define GATHER .technique = "gather"

static const struct {
	struct sm_shadow_options shadow;
	GLsizei samples;
} cases[] = {
	{{.technique = "hard"}, 1},
	{{.technique = "smoothie"}, 1},
	{{.technique = "smoothie", .passes = 2, .falloff = SM_FALLOFF_SINUSOID}, 4},
	{{.technique = "smoothie", .precision = SM_PRECISION_FIXED12}, 1},
	{{.technique = "smoothie-two-sided"}, 1},
	{{.technique = "penumbra-map"}, 1},
	{{.technique = "pcf"}, 1},
	{{.technique = "pcf", .samples = 16}, 1},
	{{.technique = "pcss"}, 1},
	{{.technique = "vsm"}, 1},
	{{.technique = "maps", .samples = 4}, 1},
	{{GATHER, .sampling = SM_SAMPLING_DENSE}, 1},
	{{GATHER, .sampling = SM_SAMPLING_SPARSE}, 1},
	{{GATHER, .sampling = SM_SAMPLING_DEFERRED}, 1},
	{{GATHER, .sampling = SM_SAMPLING_DEFERRED}, 4},
	{{GATHER, .sampling = SM_SAMPLING_DEFERRED_SPARSE}, 1},
};

/* Objects of several colours, one of them textured, some of them beyond the lights' reach, in two
 * lights of either kind and the light of sky and ground. */
static void fill_scene(struct sm_scene *scene)
{
	static const uint8_t texels[4][4] = {
		{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 255, 255}};
	static const float colors[][3] = {{1, 0.5f, 0.2f}, {0.1f, 0.6f, 0.9f}, {0.7f, 0.7f, 0.3f}};
	uint32_t cube = parts_add_cube(scene), square = parts_add_square(scene), image, handle;
	assert_true(sm_scene_add_image(scene, 2, 2, texels[0], &image, NULL));
	for (size_t i = 0; i < 6; i++) {
		struct sm_object_desc desc = {.mesh = cube,
			.image = i == 4 ? image : SM_NONE,
			.casts = true,
			.receives = i != 5};
		pose_matrix(&(struct pose){{0.3f, 0.1f, 0.2f}, 30.0f * (float)i,
				    {0.7f * (float)(i % 3) - 1, 0.1f + 0.4f * (float)(i / 3), 0}},
			desc.transform);
		memcpy(desc.base_color, colors[i % 3], sizeof(colors[0]));
		assert_true(sm_scene_add_object(scene, &desc, &handle, NULL));
	}
	parts_add_object(scene, parts_add_sphere(scene, 16), PART_BOTH,
		&(struct pose){{0.3f, 0.3f, 0.3f}, 0, {-0.4f, 0.3f, 0.9f}});
	parts_add_object(scene, square, PART_RECEIVES, &(struct pose){{40, 1, 40}, 0, {0, 0, 0}});
	parts_add_light(scene, &(struct sm_light_desc){.position = {4, 5, 0},
				       .radius = 0.4f,
				       .angle = 40,
				       .softness = 0.2f,
				       .color = {1, 0.9f, 0.7f},
				       .intensity = 0.8f});
	parts_add_light(scene, &(struct sm_light_desc){.type = SM_LIGHT_DIRECTIONAL,
				       .position = {-1, 5, 2},
				       .radius = 0.3f,
				       .color = {0.5f, 0.6f, 1},
				       .intensity = 0.3f});
	sm_scene_set_environment(scene,
		&(struct sm_environment){.sky = {0.2f, 0.3f, 0.4f}, .ground = {0.3f, 0.2f, 0.1f}});
}

/* Light, or what of light 0 arrives. */
static uint8_t *draw(struct rig *rig, GLsizei samples, uint32_t visibility_of)
{
	struct canvas canvas;
	struct sm_view view = {.camera = {.eye = {1.2f, 2, 1.8f},
				       .target = {-0.5f, 0.2f, 0},
				       .up = {0, 1, 0},
				       .fov = 60},
		.width = WIDTH,
		.height = HEIGHT,
		.visibility_of = visibility_of};
	canvas_init_multisampled(&canvas, GL_RGBA8, WIDTH, HEIGHT, samples);
	view.framebuffer = canvas.framebuffer;
	rig_draw(rig, rig->scene, &view);
	uint8_t *pixels = canvas_read(&canvas);
	canvas_finish(&canvas);
	return pixels;
}

/* Of all programs that were used: of surfaces, or that walk along edges. */
static void assert_flagged(const struct sm_renderer *renderer, uint64_t flag, bool flagged)
{
	const struct program_cache *cache = &renderer->gpu.programs;
	size_t count = 0;
	for (size_t i = 0; i < cache->count; i++) {
		struct program_key key = cache->programs[i]->key;
		bool walks = key.kind == PROGRAM_FIND || key.flags & FLAG_EDGES;
		if (flag == FLAG_IMAGES ? !walks : key.kind != PROGRAM_SURFACE)
			continue;
		assert_int_equal((key.flags & flag) != 0, flagged);
		count++;
	}
	assert_true(count > 0);
}

static bool uses_runs(const struct sm_renderer *renderer)
{
	const struct program_cache *cache = &renderer->gpu.programs;
	bool found = false;
	for (size_t i = 0; i < cache->count; i++)
		found = found || cache->programs[i]->key.flags & FLAG_RUNS;
	return found;
}

static void assert_sampled(const struct sm_renderer *renderer, enum sm_sampling sampling)
{
	struct sm_frame_stats stats;
	sm_renderer_get_stats(renderer, &stats);
	assert_int_equal(stats.sparse_lights > 0,
		sampling == SM_SAMPLING_SPARSE || sampling == SM_SAMPLING_DEFERRED_SPARSE);
	assert_int_equal(stats.deferred_lights > 0,
		sampling == SM_SAMPLING_DEFERRED || sampling == SM_SAMPLING_DEFERRED_SPARSE);
}

/* By two ways, the second of which the flag is of. */
static void look_the_same(
	struct rig *rig, const char *const paths[2], uint64_t flag, const char *technique)
{
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		uint8_t *light[2], *visibility[2];
		if (!rig_can_draw(cases[i].shadow.technique) ||
			(technique != NULL && strcmp(cases[i].shadow.technique, technique) != 0))
			continue;
		for (int way = 0; way < 2; way++) {
			rig_use_path(rig, paths[way]);
			rig_set_shadows(rig, &cases[i].shadow);
			light[way] = draw(rig, cases[i].samples, SM_NONE);
			assert_sampled(rig->renderer, cases[i].shadow.sampling);
			visibility[way] = draw(rig, 1, 0);
			assert_flagged(rig->renderer, flag, way == 1);
		}
		size_t size = (size_t)4 * WIDTH * HEIGHT;
		if (memcmp(light[0], light[1], size) != 0 ||
			memcmp(visibility[0], visibility[1], size) != 0)
			fail_msg("case %zu: %s", i, cases[i].shadow.technique);
		for (int way = 0; way < 2; way++) {
			free(light[way]);
			free(visibility[way]);
		}
	}
}

static void constants_from_vertices_look_the_same(void **state)
{
	static const char *const paths[2] = {"constants=uniforms", "constants=flat"};
	struct rig *rig = *state;
	fill_scene(rig->scene);
	look_the_same(rig, paths, FLAG_FLAT_INPUTS, NULL);
}

/* Lists that are whole, and those of runs, which long ones are. */
static void edges_from_images_look_the_same(void **state)
{
	static const char *const paths[2] = {"tables=textures", "tables=images"};
	struct rig *rig = *state;
	rig_use_path(rig, paths[1]);
	fill_scene(rig->scene);
	look_the_same(rig, paths, FLAG_IMAGES, "gather");
	assert_false(uses_runs(rig->renderer));
	uint32_t leaf = parts_add_square(rig->scene);
	for (int i = 0; i < 300; i++)
		parts_add_object(rig->scene, leaf, PART_BOTH,
			&(struct pose){{0.05f, 1, 0.05f}, 7.0f * (float)i,
				{0.02f * (float)(i % 20), 0.5f + 0.001f * (float)i,
					0.02f * (float)(i / 20)}});
	look_the_same(rig, paths, FLAG_IMAGES, "gather");
	assert_true(uses_runs(rig->renderer));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(constants_from_vertices_look_the_same),
		rig_test(edges_from_images_look_the_same),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
