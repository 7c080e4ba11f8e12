/* SPDX-License-Identifier: MIT */
/* The soft shadow of a square above the ground, drawn without a window:
 *	cc soft_shadow.c -o soft_shadow $(pkg-config --cflags --libs smoothie egl glesv2)
 *	./soft_shadow > soft_shadow.ppm */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <smoothie.h>
#include <stdio.h>

enum { SIZE = 256 };

static const float corners[] = {-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1};
static const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
static const struct sm_mesh_desc square = {
	.positions = corners, .vertex_count = 4, .indices = triangles, .index_count = 6};
static const struct sm_object_desc ground = {"ground", /* mesh */ 0,
	{6, 0, 0, 0, 0, 1, 0, 0, 0, 0, 6, 0, 0, 0, 0, 1}, {1, 1, 1}, SM_NONE, .receives = true};
static const struct sm_object_desc blocker = {"blocker", /* mesh */ 0,
	{.6F, 0, 0, 0, 0, 1, 0, 0, 0, 0, .6F, 0, 0, 1, 0, 1}, {1, .4F, 0}, SM_NONE, .casts = true};
static const struct sm_light_desc lamp = {
	.position = {-2, 6, 1}, .radius = 1, .angle = 90, .color = {1, 1, 1}, .intensity = .7F};
static const struct sm_camera camera = {.eye = {.5F, 4, 3.5F}, .up = {0, 1, 0}, .fov = 40};

static void attach(GLenum point, GLenum format)
{
	GLuint buffer;
	glGenRenderbuffers(1, &buffer);
	glBindRenderbuffer(GL_RENDERBUFFER, buffer);
	glRenderbufferStorage(GL_RENDERBUFFER, format, SIZE, SIZE);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, buffer);
}

int main(void)
{
	/* Any current OpenGL ES 3 context will do; this one needs no display. */
	static const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
	EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, NULL, NULL);
	eglInitialize(display, NULL, NULL);
	eglMakeCurrent(display, NULL, NULL, eglCreateContext(display, NULL, NULL, version));

	struct sm_view view = {camera, 0, SIZE, SIZE, SM_NONE, true};
	glGenFramebuffers(1, &view.framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, view.framebuffer);
	attach(GL_COLOR_ATTACHMENT0, GL_RGBA8);
	attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24);

	uint32_t handle;
	struct sm_error error = {.text = "out of memory"};
	struct sm_scene *scene = sm_scene_create();
	struct sm_renderer *renderer = sm_renderer_create(eglGetProcAddress, &error);
	if (scene == NULL || renderer == NULL ||
		!sm_scene_add_mesh(scene, &square, &handle, &error) ||
		!sm_scene_add_object(scene, &ground, &handle, &error) ||
		!sm_scene_add_object(scene, &blocker, &handle, &error) ||
		!sm_scene_add_light(scene, &lamp, &handle, &error) ||
		!sm_renderer_draw(renderer, scene, &view, &error)) {
		fprintf(stderr, "soft_shadow: %s\n", error.text);
		return 1;
	}

	static uint8_t pixels[SIZE][SIZE][4];
	glReadPixels(0, 0, SIZE, SIZE, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
	printf("P6\n%d %d\n255\n", SIZE, SIZE);
	for (int row = SIZE - 1; row >= 0; row--) /* GL's first row is the bottom */
		for (int column = 0; column < SIZE; column++)
			fwrite(pixels[row][column], 1, 3, stdout);
	sm_renderer_destroy(renderer);
	sm_scene_destroy(scene);
}
