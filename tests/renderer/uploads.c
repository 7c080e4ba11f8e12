/* SPDX-License-Identifier: MIT */
/* What fins take on their way to the driver: bytes, and no waiting. */
#include "load/builtin.h"
#include "load/stage.h"
#include "parts.h"
#include "platform.h"
#include "rig.h"
#include "visibility.h"
#include <GLES3/gl3.h>
#include <glob.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define SIZE 32

/* Of a fin and a half: one has an edge and the corner at its start; where more than two edges meet,
 * and corners have no such edge, there are further ones. */
#define EDGE_BYTES 48

static void check_bytes(struct rig *rig, const char *source)
{
	static const struct sm_shadow_options options[] = {
		{.technique = "smoothie", .map_size = 512},
		{.technique = "smoothie", .map_size = 2048, .passes = 2},
		{.technique = "smoothie-two-sided", .map_size = 1024},
		{.technique = "penumbra-map", .map_size = 1024},
	};
	struct stage stage;
	struct sm_error error;
	if (!stage_load(&stage, source, NULL, 0, &error))
		fail_msg("%s", error.text);
	for (size_t i = 0; i < COUNT(options); i++) {
		struct visibility seen;
		struct sm_frame_stats stats;
		rig_set_shadows(rig, &options[i]);
		visibility_draw(&seen, rig, stage.scene, &stage.camera, SIZE, SIZE);
		visibility_finish(&seen);
		sm_renderer_get_stats(rig->renderer, &stats);
		assert_true(stats.silhouette_edges > 0 && stats.fin_bytes > 0);
		double bytes = (double)stats.fin_bytes / (double)stats.silhouette_edges;
		print_message("%s, %s, map of %u: %.1f bytes an edge\n", source,
			options[i].technique, options[i].map_size, bytes);
		assert_true(bytes <= EDGE_BYTES);
		assert_true(stats.fin_bytes <= stats.uploaded_bytes);
	}
	stage_finish(&stage);
}

static void an_edge_takes_few_bytes(void **state)
{
	char source[500];
	glob_t models;
	for (size_t i = 0; builtin_name(i) != NULL; i++) {
		snprintf(source, sizeof(source), "builtin:%s", builtin_name(i));
		check_bytes(*state, source);
	}
	if (glob(SMOOTHIE_SHARED "/models/*.glb", 0, NULL, &models) != 0)
		return;
	for (size_t i = 0; i < models.gl_pathc; i++)
		check_bytes(*state, models.gl_pathv[i]);
	globfree(&models);
}

/* A driver that reaches fences late, and what buffers it may still draw from. */
#define BUFFERS_MAX 256
static struct {
	unsigned int lag; /* fences are reached when so many more have been set */
	unsigned int fences, drawn_before[BUFFERS_MAX], waits, memories, writes;
	bool drawn[BUFFERS_MAX];
} driver;

static GLuint bound_block_buffer(void)
{
	GLint name = 0;
	glGetIntegerv(GL_UNIFORM_BUFFER_BINDING, &name);
	assert_true(name > 0 && name < BUFFERS_MAX);
	return (GLuint)name;
}

/* Fences are their numbers, from 1 on. */
static GLsync GL_APIENTRY fence_sync(GLenum condition, GLbitfield flags)
{
	assert_true(condition == GL_SYNC_GPU_COMMANDS_COMPLETE && flags == 0);
	return (GLsync)(uintptr_t)++driver.fences;
}

static bool is_reached(uintptr_t fence)
{
	return fence + driver.lag <= driver.fences;
}

static GLenum GL_APIENTRY client_wait_sync(GLsync fence, GLbitfield flags, GLuint64 timeout)
{
	(void)flags;
	driver.waits += timeout > 0;
	return is_reached((uintptr_t)fence) ? GL_ALREADY_SIGNALED : GL_TIMEOUT_EXPIRED;
}

static void GL_APIENTRY delete_sync(GLsync fence)
{
	(void)fence;
}

static void GL_APIENTRY bind_buffer_range(
	GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr size)
{
	assert_true(buffer < BUFFERS_MAX);
	driver.drawn[buffer] = true;
	driver.drawn_before[buffer] = driver.fences + 1;
	glBindBufferRange(target, index, buffer, offset, size);
}

static void GL_APIENTRY buffer_data(GLenum target, GLsizeiptr size, const void *data, GLenum usage)
{
	if (target == GL_UNIFORM_BUFFER) {
		driver.drawn[bound_block_buffer()] = false;
		driver.memories++;
	}
	glBufferData(target, size, data, usage);
}

/* Into what is drawn from no more. */
static void GL_APIENTRY buffer_sub_data(
	GLenum target, GLintptr offset, GLsizeiptr size, const void *data)
{
	assert_int_equal(target, GL_UNIFORM_BUFFER);
	GLuint buffer = bound_block_buffer();
	assert_true(!driver.drawn[buffer] || is_reached(driver.drawn_before[buffer]));
	driver.writes++;
	glBufferSubData(target, offset, size, data);
}

static void GL_APIENTRY finish(void)
{
	driver.waits++;
	glFinish();
}

static void (*get_proc(const char *name))(void)
{
	static const struct {
		const char *name;
		void (*function)(void);
	} watched[] = {
		{"glBindBufferRange", (void (*)(void))bind_buffer_range},
		{"glBufferData", (void (*)(void))buffer_data},
		{"glBufferSubData", (void (*)(void))buffer_sub_data},
		{"glClientWaitSync", (void (*)(void))client_wait_sync},
		{"glDeleteSync", (void (*)(void))delete_sync},
		{"glFenceSync", (void (*)(void))fence_sync},
		{"glFinish", (void (*)(void))finish},
	};
	/* That would write or wait without being seen here. */
	static const char *const others[] = {"glMapBufferRange", "glWaitSync"};
	for (size_t i = 0; i < COUNT(watched); i++)
		if (strcmp(watched[i].name, name) == 0)
			return watched[i].function;
	for (size_t i = 0; i < COUNT(others); i++)
		assert_string_not_equal(others[i], name);
	return platform_get_proc(name);
}

/* One that passes need not wait for. */
static void use_driver(struct rig *rig, unsigned int lag)
{
	static const char *const path = "passes=queued";
	memset(&driver, 0, sizeof(driver));
	driver.lag = lag;
	sm_renderer_destroy(rig->renderer);
	rig->renderer = sm_renderer_create_with(
		get_proc, &(struct sm_driver_options){.paths = &path, .path_count = 1}, NULL);
	assert_non_null(rig->renderer);
	assert_true(sm_renderer_set_skips(rig->renderer, "-all", NULL));
}

static void set_up(struct sm_scene *scene)
{
	parts_add_object(scene, parts_add_sphere(scene, 16), PART_BOTH,
		&(struct pose){.scale = {0.6f, 0.4f, 0.6f}, .position = {0, 1, 0}});
	parts_add_object(
		scene, parts_add_square(scene), PART_RECEIVES, &(struct pose){.scale = {4, 1, 4}});
	parts_add_light(
		scene, &(struct sm_light_desc){.position = {1, 5, 1}, .radius = 0.4f, .angle = 60});
}

/* The frames of a sphere that moves; the pictures end up in seen[frames]. */
static void draw_frames(struct rig *rig, unsigned int frames, struct visibility *seen)
{
	static const struct sm_camera camera = {.eye = {2, 3, 5}, .up = {0, 1, 0}, .fov = 45};
	for (unsigned int frame = 0; frame < frames; frame++) {
		float transform[16];
		pose_matrix(&(struct pose){.scale = {0.6f, 0.4f, 0.6f},
				    .position = {0.1f * (float)frame, 1, 0}},
			transform);
		assert_true(sm_scene_set_transform(rig->scene, 0, transform, NULL));
		visibility_draw(&seen[frame], rig, rig->scene, &camera, SIZE, SIZE);
	}
}

/* However late the driver is, each frame is drawn as if it were not. */
static void no_upload_waits(void **state)
{
	enum { FRAMES = 9 };
	static const struct {
		unsigned int lag, memories;
	} cases[] = {
		{0, 3}, /* those of the ring */
		{1, 3},
		{2, 3}, /* two frames on their way, beside the one that is being made */
		{3, FRAMES},
		{100, FRAMES},
	};
	static const char *const techniques[] = {"smoothie", "smoothie-two-sided"};
	struct rig *rig = *state;
	set_up(rig->scene);
	for (size_t t = 0; t < COUNT(techniques); t++) {
		struct visibility first[FRAMES], seen[FRAMES];
		for (size_t i = 0; i < COUNT(cases); i++) {
			use_driver(rig, cases[i].lag);
			rig_set_shadows(rig, &(struct sm_shadow_options){
						     .technique = techniques[t], .map_size = 128});
			draw_frames(rig, FRAMES, i == 0 ? first : seen);
			assert_int_equal(driver.writes, FRAMES);
			assert_int_equal(driver.waits, 0);
			assert_int_equal(driver.memories, cases[i].memories);
			for (int frame = 0; frame < FRAMES && i > 0; frame++) {
				assert_memory_equal(seen[frame].values, first[frame].values,
					SIZE * SIZE * sizeof(*seen[frame].values));
				visibility_finish(&seen[frame]);
			}
		}
		for (int frame = 0; frame < FRAMES; frame++)
			visibility_finish(&first[frame]);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(an_edge_takes_few_bytes),
		rig_test(no_upload_waits),
	};
	return cmocka_run_group_tests_name("uploads", tests, NULL, NULL);
}
