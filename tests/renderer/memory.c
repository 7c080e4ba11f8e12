/* SPDX-License-Identifier: MIT */
/* Every byte has an owner: what is listed is what GL and malloc() were asked for. */
#include "allocations.h"
#include "canvas.h"
#include "parts.h"
#include "platform.h"
#include "rig.h"
#include <GLES3/gl3.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 48
#define MAP 128

/* GL's textures and buffers, as it was asked for them. */
#define STORAGES_MAX 256
static struct {
	GLuint name;
	bool is_buffer;
	uint64_t bytes;
} storages[STORAGES_MAX];
static size_t storage_count;

static uint64_t storage_bytes(void)
{
	uint64_t bytes = 0;
	for (size_t i = 0; i < storage_count; i++)
		bytes += storages[i].bytes;
	return bytes;
}

static void drop(GLuint name, bool is_buffer)
{
	for (size_t i = 0; i < storage_count; i++)
		if (storages[i].name == name && storages[i].is_buffer == is_buffer)
			storages[i] = storages[--storage_count];
}

/* Of what is bound. */
static void keep(GLenum binding, bool is_buffer, uint64_t bytes)
{
	GLint name = 0;
	glGetIntegerv(binding, &name);
	assert_true(name != 0 && storage_count < STORAGES_MAX);
	drop((GLuint)name, is_buffer);
	storages[storage_count].name = (GLuint)name;
	storages[storage_count].is_buffer = is_buffer;
	storages[storage_count++].bytes = bytes;
}

static uint64_t texel_bytes(GLenum format)
{
	static const struct {
		GLenum format;
		uint64_t bytes;
	} formats[] = {
		{GL_R8, 1},
		{GL_R16F, 2},
		{GL_R16UI, 2},
		{GL_R32F, 4},
		{GL_R32I, 4},
		{GL_R32UI, 4},
		{GL_RG16F, 4},
		{GL_RGBA8, 4},
		{GL_RGB10_A2, 4},
		{GL_SRGB8_ALPHA8, 4},
		{GL_DEPTH_COMPONENT24, 4},
		{GL_RG32F, 8},
		{GL_RG32UI, 8},
		{GL_RGBA16F, 8},
		{GL_RGBA32F, 16},
		{GL_RGBA32I, 16},
		{GL_RGBA32UI, 16},
	};
	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
		if (formats[i].format == format)
			return formats[i].bytes;
	fail_msg("a texture of format 0x%x", format);
	return 0;
}

static void GL_APIENTRY tex_storage_2d(
	GLenum target, GLsizei levels, GLenum format, GLsizei width, GLsizei height)
{
	assert_int_equal(levels, 1);
	glTexStorage2D(target, levels, format, width, height);
	keep(GL_TEXTURE_BINDING_2D, false,
		texel_bytes(format) * (uint64_t)width * (uint64_t)height);
}

static void GL_APIENTRY tex_storage_3d(
	GLenum target, GLsizei levels, GLenum format, GLsizei width, GLsizei height, GLsizei depth)
{
	assert_int_equal(levels, 1);
	glTexStorage3D(target, levels, format, width, height, depth);
	keep(GL_TEXTURE_BINDING_2D_ARRAY, false,
		texel_bytes(format) * (uint64_t)width * (uint64_t)height * (uint64_t)depth);
}

static struct {
	GLint format;
	GLsizei width, height;
} last_image;

static void GL_APIENTRY tex_image_2d(GLenum target, GLint level, GLint internal, GLsizei width,
	GLsizei height, GLint border, GLenum format, GLenum type, const void *texels)
{
	assert_int_equal(level, 0);
	last_image.format = internal;
	last_image.width = width;
	last_image.height = height;
	glTexImage2D(target, level, internal, width, height, border, format, type, texels);
	keep(GL_TEXTURE_BINDING_2D, false,
		texel_bytes((GLenum)internal) * (uint64_t)width * (uint64_t)height);
}

static void GL_APIENTRY generate_mipmap(GLenum target)
{
	uint64_t width = (uint64_t)last_image.width, height = (uint64_t)last_image.height;
	uint64_t texels = width * height;
	glGenerateMipmap(target);
	while (width > 1 || height > 1) {
		width = width > 1 ? width / 2 : 1;
		height = height > 1 ? height / 2 : 1;
		texels += width * height;
	}
	keep(GL_TEXTURE_BINDING_2D, false, texel_bytes((GLenum)last_image.format) * texels);
}

static void GL_APIENTRY buffer_data(GLenum target, GLsizeiptr size, const void *data, GLenum usage)
{
	GLenum binding = GL_ELEMENT_ARRAY_BUFFER_BINDING;
	if (target != GL_ELEMENT_ARRAY_BUFFER)
		binding = target == GL_ARRAY_BUFFER ? GL_ARRAY_BUFFER_BINDING
						    : GL_UNIFORM_BUFFER_BINDING;
	glBufferData(target, size, data, usage);
	keep(binding, true, (uint64_t)size);
}

static void GL_APIENTRY delete_textures(GLsizei count, const GLuint *names)
{
	for (GLsizei i = 0; i < count; i++)
		drop(names[i], false);
	glDeleteTextures(count, names);
}

static void GL_APIENTRY delete_buffers(GLsizei count, const GLuint *names)
{
	for (GLsizei i = 0; i < count; i++)
		drop(names[i], true);
	glDeleteBuffers(count, names);
}

static void (*get_proc(const char *name))(void)
{
	static const struct {
		const char *name;
		void (*function)(void);
	} counted[] = {
		{"glTexStorage2D", (void (*)(void))tex_storage_2d},
		{"glTexStorage3D", (void (*)(void))tex_storage_3d},
		{"glTexImage2D", (void (*)(void))tex_image_2d},
		{"glGenerateMipmap", (void (*)(void))generate_mipmap},
		{"glBufferData", (void (*)(void))buffer_data},
		{"glDeleteTextures", (void (*)(void))delete_textures},
		{"glDeleteBuffers", (void (*)(void))delete_buffers},
	};
	/* That would give memory without being counted here. */
	static const char *const others[] = {"glTexImage3D", "glCopyTexImage2D",
		"glCompressedTexImage2D", "glCompressedTexImage3D", "glRenderbufferStorage",
		"glRenderbufferStorageMultisample"};
	for (size_t i = 0; i < sizeof(counted) / sizeof(counted[0]); i++)
		if (strcmp(counted[i].name, name) == 0)
			return counted[i].function;
	for (size_t i = 0; i < sizeof(others) / sizeof(others[0]); i++)
		assert_string_not_equal(others[i], name);
	return platform_get_proc(name);
}

struct world {
	struct rig *rig;
	struct canvas canvas;
	size_t before; /* bytes allocated by others */
};

/* False: the driver lacks what the path takes. */
static bool use_renderer(struct world *world, const char *path)
{
	const struct sm_driver_options driver = {.paths = &path, .path_count = path != NULL};
	struct sm_error error;
	sm_renderer_destroy(world->rig->renderer);
	world->rig->renderer = sm_renderer_create_with(get_proc, &driver, &error);
	if (world->rig->renderer == NULL && (path == NULL || error.status != SM_ERROR_MACHINE))
		fail_msg("%s", error.text);
	return world->rig->renderer != NULL;
}

static void add_image(struct sm_scene *scene)
{
	static const uint8_t texels[5 * 3 * 4];
	uint32_t image;
	assert_true(sm_scene_add_image(scene, 5, 3, texels, &image, NULL));
}

/* Spheres on a floor, some of them beside the lights' screens, and a cube: the one closed caster.
 */
static void set_up(struct world *world, struct rig *rig, int lights)
{
	sm_renderer_destroy(rig->renderer);
	sm_scene_destroy(rig->scene);
	rig->renderer = NULL;
	*world = (struct world){.rig = rig, .before = allocated_bytes};
	rig->scene = sm_scene_create();
	for (int i = 0; i < lights; i++)
		parts_add_light(rig->scene, &(struct sm_light_desc){.name = "lamp",
						    .position = {(float)i, 5, 1},
						    .radius = 0.3f,
						    .angle = 80});
	uint32_t sphere = parts_add_sphere(rig->scene, 8);
	for (int i = 0; i < 9; i++)
		parts_add_object(rig->scene, sphere, PART_BOTH,
			&(struct pose){.scale = {0.3f, 0.3f, 0.3f},
				.position = {(float)(i % 3), 1, (float)(i / 3)}});
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES,
		&(struct pose){.scale = {4, 1, 4}});
	parts_add_object(rig->scene, parts_add_cube(rig->scene), PART_BOTH,
		&(struct pose){.scale = {0.2f, 0.2f, 0.2f}, .position = {0, 2, 0}});
	add_image(rig->scene);
	canvas_init(&world->canvas, GL_RGBA8, SIZE, SIZE);
	assert_true(use_renderer(world, NULL));
}

static void draw(struct world *world, uint32_t visibility_of, float along)
{
	rig_draw(world->rig, world->rig->scene,
		&(struct sm_view){.camera = {.eye = {along + 4, 5, 6},
					  .target = {along, 0, 0},
					  .up = {0, 1, 0},
					  .fov = 50},
			.framebuffer = world->canvas.framebuffer,
			.width = SIZE,
			.height = SIZE,
			.visibility_of = visibility_of});
}

static void add_up(void *data, const struct sm_memory_part *part)
{
	uint64_t *sums = data;
	assert_true(part->bytes > 0 && part->owner[0] != '\0');
	sums[part->kind] += part->bytes;
}

static void print_part(void *data, const struct sm_memory_part *part)
{
	(void)data;
	print_message("%s\t%s\t%d\t%llu\n", part->kind == SM_MEMORY_GL ? "GL" : "processor",
		part->owner, (int)part->light, (unsigned long long)part->bytes);
}

/* What is listed, what GL and malloc() gave, and the sums. */
static void check_listed(const struct world *world)
{
	uint64_t listed[2] = {0};
	struct sm_memory memory;
	const struct rig *rig = world->rig;
	sm_renderer_list_memory(rig->renderer, rig->scene, add_up, listed);
	sm_renderer_get_memory(rig->renderer, rig->scene, &memory);
	if (listed[SM_MEMORY_GL] != storage_bytes() ||
		listed[SM_MEMORY_PROCESSOR] != allocated_bytes - world->before)
		sm_renderer_list_memory(rig->renderer, rig->scene, print_part, NULL);
	assert_int_equal(listed[SM_MEMORY_GL], storage_bytes());
	assert_int_equal(listed[SM_MEMORY_PROCESSOR], allocated_bytes - world->before);
	assert_int_equal(memory.gl, listed[SM_MEMORY_GL]);
	assert_int_equal(memory.processor, listed[SM_MEMORY_PROCESSOR]);
	assert_true(memory.targets <= memory.gl && memory.geometry < memory.processor);
}

static const struct technique_case {
	struct sm_shadow_options options;
	const char *path;
} cases[] = {
	{{.technique = "hard"}, NULL},
	{{.technique = "hard"}, "depth=r32f"},
	{{.technique = "pcf"}, NULL},
	{{.technique = "pcss"}, "depth=rgba8"},
	{{.technique = "smoothie"}, NULL},
	{{.technique = "smoothie", .passes = 2}, "smoothie=rgba8"},
	{{.technique = "smoothie", .falloff = SM_FALLOFF_SINUSOID}, "depth=rgba8"},
	{{.technique = "smoothie-two-sided"}, NULL},
	{{.technique = "penumbra-map"}, NULL},
	{{.technique = "vsm"}, NULL},
	{{.technique = "maps", .samples = 4}, "comparison=fetch"},
	{{.technique = "gather", .sampling = SM_SAMPLING_DENSE}, NULL},
	{{.technique = "gather", .sampling = SM_SAMPLING_SPARSE}, NULL},
	{{.technique = "gather", .sampling = SM_SAMPLING_DEFERRED}, NULL},
	{{.technique = "gather", .sampling = SM_SAMPLING_DEFERRED_SPARSE}, NULL},
	{{.technique = "auto"}, NULL},
	{{.precision = SM_PRECISION_HALF}, NULL},
	{{.precision = SM_PRECISION_FIXED12, .falloff = SM_FALLOFF_SINUSOID}, NULL},
};

#define CASES (sizeof(cases) / sizeof(cases[0]))

/* False: the driver cannot. */
static bool use_case(struct world *world, const struct technique_case *is)
{
	struct sm_shadow_options options = is->options;
	options.map_size = MAP;
	if (!rig_can_draw(options.technique) || !use_renderer(world, is->path))
		return false;
	rig_set_shadows(world->rig, &options);
	return true;
}

static void tear_down(struct world *world)
{
	struct rig *rig = world->rig;
	canvas_finish(&world->canvas);
	sm_renderer_destroy(rig->renderer);
	sm_scene_destroy(rig->scene);
	rig->renderer = NULL;
	rig->scene = NULL;
	assert_int_equal(storage_bytes(), 0);
	assert_int_equal(allocated_bytes, world->before);
}

static void all_is_listed(void **state)
{
	struct world world;
	set_up(&world, *state, 2);
	check_listed(&world);
	for (size_t i = 0; i < CASES; i++) {
		if (!use_case(&world, &cases[i]))
			continue;
		draw(&world, SM_NONE, 0);
		check_listed(&world);
		draw(&world, 1, 0);
		draw(&world, SM_NONE, 500); /* far from the origin */
		check_listed(&world);
	}
	tear_down(&world);
}

/* With what is kept of objects that stay while one moves. */
static void what_moves_is_listed(void **state)
{
	struct world world;
	static const float positions[][3] = {{-1, 0, -1}, {1, 0, -1}, {1, 0.5f, 1}, {-1, 0, 1}};
	float transform[16];
	set_up(&world, *state, 1);
	for (size_t i = 0; i < CASES; i++) {
		if (!use_case(&world, &cases[i]))
			continue;
		for (int move = 0; move < 3; move++) {
			pose_matrix(&(struct pose){.scale = {0.3f, 0.3f, 0.3f},
					    .position = {(float)move, 1, 0}},
				transform);
			assert_true(sm_scene_set_transform(world.rig->scene, 0, transform, NULL));
			draw(&world, SM_NONE, 0);
			check_listed(&world);
		}
	}
	assert_true(use_case(&world, &cases[4]));
	draw(&world, SM_NONE, 0);
	assert_true(sm_scene_set_vertices(world.rig->scene, 1, positions[0], NULL, NULL));
	parts_add_sphere(world.rig->scene, 4);
	draw(&world, SM_NONE, 0);
	check_listed(&world);
	tear_down(&world);
}

static void add_own(void *data, const struct sm_memory_part *part)
{
	uint64_t *bytes = data;
	/* Which grow with what was drawn, and serve all. */
	if (part->kind == SM_MEMORY_GL && strcmp(part->owner, "indices of quads") != 0)
		*bytes += part->bytes;
}

/* Of GL's, with one frame of "hard"; before it is drawn there is no target but the accumulator. */
static uint64_t draw_hard(struct world *world)
{
	const struct sm_shadow_options hard = {.technique = "hard", .map_size = MAP};
	uint64_t bytes = 0;
	struct sm_memory memory;
	rig_set_shadows(world->rig, &hard);
	sm_renderer_get_memory(world->rig->renderer, world->rig->scene, &memory);
	assert_true(memory.targets == 0 || memory.targets == SIZE * SIZE * 8);
	draw(world, SM_NONE, 0);
	sm_renderer_list_memory(world->rig->renderer, world->rig->scene, add_own, &bytes);
	return bytes;
}

static void what_is_switched_off_is_given_back(void **state)
{
	struct world world;
	set_up(&world, *state, 2);
	for (size_t i = 0; i < CASES; i++) {
		if (!use_renderer(&world, cases[i].path))
			continue;
		uint64_t hard = draw_hard(&world);
		if (!use_case(&world, &cases[i]))
			continue;
		draw(&world, SM_NONE, 0);
		uint64_t after = draw_hard(&world);
		if (after != hard)
			fail_msg("case %zu: %d bytes are left", i, (int)(after - hard));
	}
	tear_down(&world);
}

struct light_sums {
	uint64_t of[8], shared;
};

/* Of what shadows take of GL, but for the indices of quads. */
static void add_light(void *data, const struct sm_memory_part *part)
{
	static const char *const others[] = {
		"meshes as drawn", "casters", "images", "accumulator", "indices of quads"};
	struct light_sums *sums = data;
	if (part->kind != SM_MEMORY_GL)
		return;
	for (size_t i = 0; i < sizeof(others) / sizeof(others[0]); i++)
		if (strcmp(part->owner, others[i]) == 0)
			return;
	*(part->light != SM_NONE ? &sums->of[part->light] : &sums->shared) += part->bytes;
}

static struct light_sums weigh_lights(struct world *world, const struct sm_shadow_options *options)
{
	struct light_sums sums = {0};
	assert_true(use_renderer(world, NULL));
	rig_set_shadows(world->rig, options);
	draw(world, SM_NONE, 0);
	sm_renderer_list_memory(world->rig->renderer, world->rig->scene, add_light, &sums);
	return sums;
}

static void a_smoothie_light_costs_ten_bytes_a_texel(void **state)
{
	struct world world;
	const struct sm_shadow_options options = {.technique = "smoothie", .map_size = 1024};
	const uint64_t most = UINT64_C(10) * 1024 * 1024;
	set_up(&world, *state, 8);
	struct light_sums sums = weigh_lights(&world, &options);
	uint64_t all = sums.shared;
	for (int i = 0; i < 8; i++) {
		assert_in_range(sums.of[i], most / 2, most);
		all += sums.of[i];
	}
	print_message("a light: %.3f bytes a texel, of eight each: %.3f\n",
		(double)sums.of[0] / (1024 * 1024), (double)all / (8 * 1024 * 1024));
	assert_true(all / 8 <= most);
	tear_down(&world);
}

static void lights_share_what_is_soon_read(void **state)
{
	static const struct {
		struct sm_shadow_options options;
		uint64_t shared; /* bytes a texel */
	} shares[] = {
		{{.technique = "hard", .map_size = MAP}, 0},
		{{.technique = "smoothie", .map_size = MAP}, 4},
		{{.technique = "penumbra-map", .map_size = MAP}, 4},
		{{.technique = "smoothie-two-sided", .map_size = MAP}, 8},
		{{.technique = "vsm", .map_size = MAP}, 12},
		{{.precision = SM_PRECISION_HALF, .map_size = MAP}, 22},
	};
	for (int lights = 1; lights <= 8; lights += 7) {
		struct world world;
		set_up(&world, *state, lights);
		for (size_t i = 0; i < sizeof(shares) / sizeof(shares[0]); i++)
			if (rig_can_draw(shares[i].options.technique))
				assert_int_equal(weigh_lights(&world, &shares[i].options).shared,
					shares[i].shared * MAP * MAP);
		tear_down(&world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(all_is_listed),
		rig_test(what_moves_is_listed),
		rig_test(what_is_switched_off_is_given_back),
		rig_test(a_smoothie_light_costs_ten_bytes_a_texel),
		rig_test(lights_share_what_is_soon_read),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
