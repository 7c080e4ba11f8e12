/* SPDX-License-Identifier: MIT */
/*
 * The soft shadow of a box above the ground, drawn without a window:
 *
 *	cc soft_shadow.c -o soft_shadow $(pkg-config --cflags --libs smoothie egl glesv2)
 *	./soft_shadow > soft_shadow.ppm
 */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <smoothie.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZE = 256 };

static void require(bool done, const char *failure)
{
	if (done)
		return;
	fprintf(stderr, "soft_shadow: %s\n", failure);
	exit(1);
}

/* Any current OpenGL ES 3 context will do; this one needs no display. */
static void make_context_current(void)
{
	static const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
	EGLDisplay display =
		eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
	require(eglInitialize(display, NULL, NULL) && eglBindAPI(EGL_OPENGL_ES_API), "no EGL");
	EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
	require(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context), "no GLES 3");
}

static void attach(GLenum attachment, GLenum format)
{
	GLuint buffer;
	glGenRenderbuffers(1, &buffer);
	glBindRenderbuffer(GL_RENDERBUFFER, buffer);
	glRenderbufferStorage(GL_RENDERBUFFER, format, SIZE, SIZE);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
}

static bool fill_scene(struct sm_scene *scene, struct sm_error *error)
{
	/* Corner i has x, y and z from bits 0, 1 and 2 of i. */
	static const float corners[8][3] = {{-.5F, -.5F, -.5F}, {.5F, -.5F, -.5F},
		{-.5F, .5F, -.5F}, {.5F, .5F, -.5F}, {-.5F, -.5F, .5F}, {.5F, -.5F, .5F},
		{-.5F, .5F, .5F}, {.5F, .5F, .5F}};
	static const uint32_t triangles[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
		{0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5},
		{3, 7, 5}};
	const struct sm_mesh_desc cube = {
		.positions = corners[0],
		.vertex_count = 8,
		.indices = triangles[0],
		.index_count = 36,
	};
	struct sm_object_desc ground = {
		.base_color = {.8F, .8F, .8F},
		.image = SM_NONE,
		.transform = {12, 0, 0, 0, 0, .1F, 0, 0, 0, 0, 12, 0, 0, -.05F, 0, 1},
		.receives = true,
	};
	struct sm_object_desc box = {
		.base_color = {.9F, .5F, .2F},
		.image = SM_NONE,
		.transform = {1, 0, 0, 0, 0, .6F, 0, 0, 0, 0, 1, 0, 0, .9F, 0, 1},
		.casts = true,
		.receives = true,
	};
	const struct sm_light_desc sun = {
		.type = SM_LIGHT_DIRECTIONAL,
		.position = {-3, 5, 1},
		.radius = 1,
		.color = {1, 1, 1},
		.intensity = 1,
	};
	uint32_t mesh, handle;

	if (!sm_scene_add_mesh(scene, &cube, &mesh, error))
		return false;
	ground.mesh = box.mesh = mesh;
	return sm_scene_add_object(scene, &ground, &handle, error) &&
	       sm_scene_add_object(scene, &box, &handle, error) &&
	       sm_scene_add_light(scene, &sun, &handle, error);
}

static void write_picture(FILE *file)
{
	static uint8_t pixels[SIZE][SIZE][4];
	glReadPixels(0, 0, SIZE, SIZE, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
	fprintf(file, "P6\n%d %d\n255\n", SIZE, SIZE);
	for (int row = SIZE - 1; row >= 0; row--) /* GL's first row is the bottom */
		for (int column = 0; column < SIZE; column++)
			fwrite(pixels[row][column], 1, 3, file);
}

int main(void)
{
	struct sm_error error;
	struct sm_scene *scene = sm_scene_create();
	require(scene != NULL, "out of memory");
	require(fill_scene(scene, &error), error.text);

	make_context_current();
	struct sm_renderer *renderer = sm_renderer_create(eglGetProcAddress, &error);
	require(renderer != NULL, error.text);

	struct sm_view view = {
		.camera = {.eye = {.5F, 4, 3.5F},
			.target = {.5F, .3F, 0},
			.up = {0, 1, 0},
			.fov = 40},
		.width = SIZE,
		.height = SIZE,
		.visibility_of = SM_NONE,
	};
	glGenFramebuffers(1, &view.framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, view.framebuffer);
	attach(GL_COLOR_ATTACHMENT0, GL_RGBA8);
	attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24);
	require(sm_renderer_draw(renderer, scene, &view, &error), error.text);
	write_picture(stdout);

	sm_renderer_destroy(renderer);
	sm_scene_destroy(scene);
	return 0;
}
