/* SPDX-License-Identifier: MIT */
#include "renderer.h"
#include <string.h>

/* The framebuffers there are displays for. */
static const uint8_t known_bits[][3] = {{5, 6, 5}, {8, 8, 8}, {10, 10, 10}};

static bool bits_are_known(const uint8_t bits[3])
{
	for (size_t i = 0; i < sizeof(known_bits) / sizeof(known_bits[0]); i++)
		if (memcmp(bits, known_bits[i], sizeof(known_bits[i])) == 0)
			return true;
	return false;
}

static bool check_size(const struct caps *caps, uint32_t width, uint32_t height)
{
	return width > 0 && height > 0 && width <= (uint32_t)caps->max_viewport[0] &&
	       height <= (uint32_t)caps->max_viewport[1];
}

static bool check_screen(
	const struct caps *caps, const struct sm_screen *screen, struct sm_error *error)
{
	bool turned = screen->rotation % 180 != 0;
	uint32_t width = turned ? screen->height : screen->width;
	uint32_t height = turned ? screen->width : screen->height;
	if (screen->rotation % 90 != 0 || screen->rotation > 270)
		return error_set(error, SM_ERROR_INPUT,
			"a picture turned by %u degrees; it can be by 0, 90, 180 or 270",
			screen->rotation);
	if (!bits_are_known(screen->bits))
		return error_set(error, SM_ERROR_INPUT,
			"a screen of %u,%u,%u bits; it can have 5,6,5, 8,8,8 or 10,10,10",
			screen->bits[0], screen->bits[1], screen->bits[2]);
	if (!check_size(caps, width, height))
		return error_set(error, SM_ERROR_INPUT,
			"a screen of %ux%u pixels; this driver draws from 1x1 to %dx%d", width,
			height, caps->max_viewport[0], caps->max_viewport[1]);
	return screen->texture != 0 ||
	       error_set(error, SM_ERROR_INPUT, "no texture with a picture for the screen");
}

static uint64_t flags_of(int way, const uint8_t bits[3])
{
	uint64_t flags = bits[0] < 8 ? FLAG_DITHER : bits[0] > 8 ? FLAG_WIDEN : 0;
	return way == COPY_STORED ? flags | FLAG_STORED : flags;
}

static bool use_program(
	struct gpu *gpu, const struct sm_screen *screen, int way, struct sm_error *error)
{
	const uint8_t *bits = screen->bits;
	struct program_key key = {PROGRAM_SCREEN, flags_of(way, bits)};
	const struct program *program = program_use(&gpu->programs, &gpu->gl, key, error);
	if (program == NULL)
		return false;
	gpu->gl.Uniform1i(program->uniform.quarter_turns, (GLint)(screen->rotation / 90));
	gpu->gl.Uniform3f(program->uniform.screen_max, (float)((1 << bits[0]) - 1),
		(float)((1 << bits[1]) - 1), (float)((1 << bits[2]) - 1));
	return true;
}

bool screen_draw(struct gpu *gpu, const struct sm_screen *screen, struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	if (!check_screen(&gpu->caps, screen, error))
		return false;
	int way = way_choose(gpu, DRIVER_COPY, error);
	gl->BindFramebuffer(GL_FRAMEBUFFER, screen->framebuffer);
	if (gl_framebuffer_is_srgb(gl, screen->framebuffer))
		return error_set(error, SM_ERROR_INPUT,
			"the screen's framebuffer is sRGB: the picture's bytes would be encoded "
			"again");
	bool turned = screen->rotation % 180 != 0;
	gl->Viewport(0, 0, (GLsizei)(turned ? screen->height : screen->width),
		(GLsizei)(turned ? screen->width : screen->height));
	bool used = way >= 0 && use_program(gpu, screen, way, error);
	if (used && way == COPY_STORED)
		gpu_bind_stored_sampler(gpu, UNIT_BASE);
	if (used) {
		/* The driver's own dithering is as it pleases. */
		gl->Disable(GL_DITHER);
		gpu_fill_viewport(gpu, screen->texture);
		gl->Enable(GL_DITHER);
	}
	gpu_restore_state(gpu);
	return used;
}
