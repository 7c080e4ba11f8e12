/* SPDX-License-Identifier: MIT */
/* Drivers that do not do what they say: probes find out, and the picture is right all the same. */
#include "parts.h"
#include "platform.h"
#include "visibility.h"
#include <GLES3/gl3.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 128

/* ---- faults, between the renderer and the driver */

static PFNGLBLENDEQUATIONPROC blend_equation;
static PFNGLTEXSTORAGE2DPROC tex_storage;
static PFNGLDEPTHFUNCPROC depth_func;
static PFNGLSAMPLERPARAMETERIPROC sampler_parameter;
static PFNGLSHADERSOURCEPROC shader_source;

static void GL_APIENTRY add_for_min(GLenum mode)
{
	blend_equation(mode == GL_MIN ? GL_FUNC_ADD : mode);
}

static void GL_APIENTRY bytes_for_halves(
	GLenum target, GLsizei levels, GLenum format, GLsizei width, GLsizei height)
{
	tex_storage(target, levels, format == GL_RG16F ? GL_RG8 : format, width, height);
}

static void GL_APIENTRY coarse_depth(
	GLenum target, GLsizei levels, GLenum format, GLsizei width, GLsizei height)
{
	tex_storage(target, levels, format == GL_DEPTH_COMPONENT24 ? GL_DEPTH_COMPONENT16 : format,
		width, height);
}

static void GL_APIENTRY any_depth(GLenum func)
{
	(void)func;
	depth_func(GL_ALWAYS);
}

static void GL_APIENTRY unfiltered(GLuint sampler, GLenum name, GLint value)
{
	sampler_parameter(sampler, name, value == GL_LINEAR ? GL_NEAREST : value);
}

static void GL_APIENTRY without_gather(
	GLuint shader, GLsizei count, const GLchar *const *strings, const GLint *lengths)
{
	static const GLchar *const error = "#error";
	bool gathers = false;
	for (GLsizei i = 0; i < count; i++)
		gathers = gathers || strstr(strings[i], "#define GATHER") != NULL;
	if (gathers)
		shader_source(shader, 1, &error, NULL);
	else
		shader_source(shader, count, strings, lengths);
}

struct fault {
	const char *function;
	void (*replacement)(void);
	const char *cap;        /* that must not be there then */
	const char *need, *way; /* what is done instead; NULL: nothing can be */
};

#define FUNCTION(name) (void (*)(void))(name)

static const struct fault faults[] = {
	{"glBlendEquation", FUNCTION(add_for_min), "min_rg16f", "smoothie", "depth-test"},
	{"glTexStorage2D", FUNCTION(bytes_for_halves), "min_rg16f", "smoothie", "rg32f"},
	{"glTexStorage2D", FUNCTION(coarse_depth), "depth_fetch", "depth", "r32f"},
	{"glDepthFunc", FUNCTION(any_depth), "frag_depth_min", NULL, NULL},
	{"glSamplerParameteri", FUNCTION(unfiltered), "shadow_filter", "comparison", NULL},
	{"glShaderSource", FUNCTION(without_gather), "texture_gather", "smoothie", "rg16f"},
};

static const struct fault *fault;

static void (*get_proc(const char *name))(void)
{
	return strcmp(name, fault->function) == 0 ? fault->replacement : platform_get_proc(name);
}

/* ---- what the renderer finds */

struct found {
	char cap[200], need[900];
};

static void note_fact(void *data, const char *key, const char *value)
{
	struct found *found = data;
	if (strncmp(key, "cap ", 4) == 0 && strcmp(key + 4, fault->cap) == 0)
		snprintf(found->cap, sizeof(found->cap), "%s", value);
	if (fault->need != NULL && strncmp(key, "need ", 5) == 0 &&
		strcmp(key + 5, fault->need) == 0)
		snprintf(found->need, sizeof(found->need), "%s", value);
}

static struct visibility draw(struct rig *rig)
{
	static const struct sm_camera camera = {.eye = {-2, 4, 4}, .up = {0, 1, 0}, .fov = 40};
	struct visibility seen;
	rig_set_shadows(rig, &(struct sm_shadow_options){.map_size = 256});
	visibility_draw(&seen, rig, rig->scene, &camera, SIZE, SIZE);
	return seen;
}

static void set_up_scene(struct sm_scene *scene)
{
	parts_add_object(scene, parts_add_square(scene), PART_RECEIVES,
		&(struct pose){{3, 1, 3}, 0, {0, 0, 0}});
	parts_add_object(scene, parts_add_cube(scene), PART_BOTH,
		&(struct pose){{0.6f, 0.05f, 0.4f}, 25, {-0.3f, 1.2f, 0.3f}});
	parts_add_light(scene,
		&(struct sm_light_desc){.position = {1.5f, 5, 1}, .radius = 0.4f, .angle = 55});
}

static void check_fault(struct rig *rig, const struct visibility *right)
{
	struct found found = {0};
	struct sm_error error;
	sm_renderer_destroy(rig->renderer);
	rig->renderer = sm_renderer_create(get_proc, &error);
	assert_non_null(rig->renderer);
	sm_renderer_describe(rig->renderer, note_fact, &found);
	if (strncmp(found.cap, "no: ", 4) != 0)
		fail_msg("%s: %s", fault->cap, found.cap);
	if (fault->way != NULL && strncmp(found.need, fault->way, strlen(fault->way)) != 0)
		fail_msg("%s is met by %s", fault->need, found.need);
	if (fault->need == NULL)
		return;
	struct visibility seen = draw(rig);
	struct visibility_change change = visibility_compare(right, &seen);
	print_message("%s, faulty: mean |dv| %.5f\n", fault->function, change.mean);
	assert_true(change.mean <= 0.002);
	visibility_finish(&seen);
}

static void faults_are_found_and_gone_around(void **state)
{
	struct rig *rig = *state;
	set_up_scene(rig->scene);
	struct visibility right = draw(rig);
	for (size_t i = 0; i < sizeof(faults) / sizeof(faults[0]); i++) {
		fault = &faults[i];
		check_fault(rig, &right);
	}
	rig->problems = 0; /* of a shader that is not to compile */
	visibility_finish(&right);
}

static int resolve(void **state)
{
	int result = rig_setup(state);
	blend_equation = (PFNGLBLENDEQUATIONPROC)platform_get_proc("glBlendEquation");
	tex_storage = (PFNGLTEXSTORAGE2DPROC)platform_get_proc("glTexStorage2D");
	depth_func = (PFNGLDEPTHFUNCPROC)platform_get_proc("glDepthFunc");
	sampler_parameter = (PFNGLSAMPLERPARAMETERIPROC)platform_get_proc("glSamplerParameteri");
	shader_source = (PFNGLSHADERSOURCEPROC)platform_get_proc("glShaderSource");
	return result;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(
			faults_are_found_and_gone_around, resolve, rig_teardown),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
