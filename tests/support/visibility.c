/* SPDX-License-Identifier: MIT */
#include "visibility.h"
#include "canvas.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

void visibility_draw(struct visibility *visibility, struct rig *rig, const struct sm_scene *scene,
	const struct sm_camera *camera, uint32_t width, uint32_t height)
{
	struct canvas canvas;
	canvas_init(&canvas, GL_RGBA8, width, height);
	struct sm_view view = {.camera = *camera,
		.framebuffer = canvas.framebuffer,
		.width = width,
		.height = height};
	rig_draw(rig, scene, &view);
	uint8_t *rgba = canvas_read(&canvas);
	canvas_finish(&canvas);

	size_t count = (size_t)width * height;
	*visibility = (struct visibility){.width = width, .height = height};
	visibility->values = calloc(count, sizeof(*visibility->values));
	assert_non_null(visibility->values);
	for (size_t i = 0; i < count; i++) {
		const uint8_t *pixel = rgba + 4 * i;
		visibility->values[i] = (uint16_t)(pixel[0] * 256 + pixel[1]);
		if (pixel[2] != 0 || pixel[3] != 255)
			fail_msg("pixel %zu is no visibility: %u %u %u %u", i, pixel[0], pixel[1],
				pixel[2], pixel[3]);
	}
	free(rgba);
}

void visibility_finish(struct visibility *visibility)
{
	free(visibility->values);
	*visibility = (struct visibility){0};
}

double visibility_at(const struct visibility *visibility, uint32_t x, uint32_t y)
{
	assert_true(x < visibility->width && y < visibility->height);
	return visibility->values[(size_t)y * visibility->width + x] / 65535.0;
}

struct visibility_change visibility_compare(const struct visibility *a, const struct visibility *b)
{
	struct visibility_change change = {0};
	assert_true(a->width == b->width && a->height == b->height);
	size_t count = (size_t)a->width * a->height;
	for (size_t i = 0; i < count; i++) {
		double by = fabs(a->values[i] / 65535.0 - b->values[i] / 65535.0);
		change.mean += by / (double)count;
		change.off += (by > 0.02) / (double)count;
		change.differing += a->values[i] != b->values[i];
	}
	return change;
}
