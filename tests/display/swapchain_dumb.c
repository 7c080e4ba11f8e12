/* SPDX-License-Identifier: MIT */
/* Buffers that take turns both end up with the picture, and tell exactly what changed. */
#include "pixel_format.h"
#include "swapchain.h"
#include "viewer.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct setup {
	struct fake_drm *drm;
	struct kms_device device;
	struct swapchain *swapchain;
	const struct pixel_format *format;
	uint32_t width, height;
	uint8_t *rgba, *packed, *before; /* packed, before: rows from the top */
	size_t row_size;
};

static void set_up(struct setup *setup, const char *format, uint32_t width, uint32_t height)
{
	struct sm_error error;
	fake_world_reset();
	*setup = (struct setup){.drm = fake_drm_init(0, &(struct fake_abilities){0}),
		.format = pixel_format_find(format),
		.width = width,
		.height = height};
	assert_true(
		kms_device_init(&setup->device, fake_drm_open("/dev/dri/card0"), false, &error));
	setup->swapchain =
		swapchain_create_dumb(&setup->device, setup->format, width, height, &error);
	if (setup->swapchain == NULL)
		fail_msg("%s", error.text);
	setup->row_size = (size_t)width * setup->format->bytes;
	setup->rgba = calloc(height, (size_t)width * 4);
	setup->packed = calloc(height, setup->row_size);
	setup->before = calloc(height, setup->row_size);
	assert_true(setup->rgba != NULL && setup->packed != NULL && setup->before != NULL);
}

static void tear_down(struct setup *setup)
{
	swapchain_destroy(setup->swapchain);
	assert_int_equal(fake_drm_count(setup->drm), 0);
	fake_drm_close(setup->device.fd);
	free(setup->rgba);
	free(setup->packed);
	free(setup->before);
}

static void pack(struct setup *setup)
{
	memcpy(setup->before, setup->packed, setup->height * setup->row_size);
	for (uint32_t y = 0; y < setup->height; y++)
		pixel_format_pack(setup->format,
			setup->rgba + (size_t)(setup->height - 1 - y) * setup->width * 4,
			setup->width, setup->packed + y * setup->row_size);
}

static void assert_holds_picture(const struct setup *setup, uint32_t framebuffer)
{
	const struct fake_framebuffer *shown = fake_framebuffer(setup->drm, framebuffer);
	assert_non_null(shown);
	assert_int_equal(shown->format, setup->format->code);
	const uint8_t *pixels = setup->drm->pixels + (size_t)shown->dumb * FAKE_DUMB_ROOM;
	for (uint32_t y = 0; y < setup->height; y++)
		assert_memory_equal(pixels + y * shown->pitch, setup->packed + y * setup->row_size,
			setup->row_size);
}

/* The least rectangle that holds all pixels that changed; without any, the least there is. */
static struct rect find_damage(const struct setup *setup)
{
	uint32_t left = UINT32_MAX, top = UINT32_MAX, right = 0, bottom = 0;
	size_t bytes = setup->format->bytes;
	for (uint32_t y = 0; y < setup->height; y++)
		for (uint32_t x = 0; x < setup->width; x++) {
			size_t at = y * setup->row_size + x * bytes;
			if (memcmp(setup->packed + at, setup->before + at, bytes) == 0)
				continue;
			left = x < left ? x : left;
			top = y < top ? y : top;
			right = x + 1 > right ? x + 1 : right;
			bottom = y + 1;
		}
	return right == 0 ? (struct rect){0, 0, 1, 1}
			  : (struct rect){left, top, right - left, bottom - top};
}

static uint32_t show(struct setup *setup, struct kms_frame *frame)
{
	assert_true(swapchain_begin(setup->swapchain, NULL));
	pack(setup);
	assert_true(swapchain_end(setup->swapchain, setup->rgba, frame, NULL));
	assert_int_equal(frame->width, setup->width);
	assert_int_equal(frame->height, setup->height);
	assert_int_equal(frame->in_fence, -1);
	assert_holds_picture(setup, frame->framebuffer);
	return frame->framebuffer;
}

/* Now and then nothing, one pixel, a block, or all. */
static void change(struct setup *setup)
{
	uint32_t width = 1, height = 1, x = (uint32_t)rand() % setup->width,
		 y = (uint32_t)rand() % setup->height;
	switch (rand() % 4) {
	case 0:
		return;
	case 1:
		break;
	case 2:
		width = 1 + (uint32_t)rand() % (setup->width - x);
		height = 1 + (uint32_t)rand() % (setup->height - y);
		break;
	default:
		x = y = 0;
		width = setup->width;
		height = setup->height;
	}
	for (uint32_t i = y; i < y + height; i++)
		for (uint32_t j = x; j < x + width; j++)
			setup->rgba[((size_t)i * setup->width + j) * 4 + (size_t)rand() % 3] =
				(uint8_t)rand();
}

static const struct {
	const char *format;
	uint32_t width, height;
} cases[] = {{"xrgb8888", 64, 48}, {"xrgb8888", 1, 1}, {"xrgb8888", 33, 17}, {"rgb565", 64, 48},
	{"rgb565", 31, 1}, {"rgb565", 1, 29}, {"xrgb2101010", 5, 7}};

static void both_buffers_end_up_with_the_picture(void **state)
{
	(void)state;
	srand(1);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct setup setup;
		uint32_t shown = 0;
		set_up(&setup, cases[i].format, cases[i].width, cases[i].height);
		for (int frame_number = 0; frame_number < 200; frame_number++) {
			struct kms_frame frame;
			change(&setup);
			uint32_t next = show(&setup, &frame);
			assert_int_not_equal(next, shown);
			if (frame_number == 0) {
				assert_null(frame.damage);
			} else {
				struct rect damage = find_damage(&setup);
				assert_memory_equal(frame.damage, &damage, sizeof(damage));
			}
			swapchain_release(setup.swapchain, shown);
			shown = next;
		}
		tear_down(&setup);
	}
}

static void a_frame_that_was_lost_leaves_all_damaged(void **state)
{
	(void)state;
	struct setup setup;
	struct kms_frame frame;
	set_up(&setup, "xrgb8888", 9, 9);
	uint32_t shown = show(&setup, &frame);
	setup.rgba[0] = 1;
	uint32_t lost = show(&setup, &frame);
	assert_non_null(frame.damage);
	swapchain_release(setup.swapchain, lost);
	uint32_t next = show(&setup, &frame);
	assert_null(frame.damage);
	swapchain_release(setup.swapchain, shown);
	show(&setup, &frame);
	assert_non_null(frame.damage);
	assert_int_not_equal(frame.framebuffer, next);
	tear_down(&setup);
}

static void no_buffer_is_drawn_to_while_it_is_shown(void **state)
{
	(void)state;
	struct setup setup;
	struct kms_frame frame;
	struct sm_error error;
	set_up(&setup, "rgb565", 8, 8);
	uint32_t first = show(&setup, &frame);
	show(&setup, &frame);
	assert_false(swapchain_begin(setup.swapchain, &error));
	assert_non_null(strstr(error.text, "all buffers are being shown"));
	swapchain_release(setup.swapchain, 0);
	assert_false(swapchain_begin(setup.swapchain, &error));
	swapchain_release(setup.swapchain, first);
	assert_int_equal(show(&setup, &frame), first);
	tear_down(&setup);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		viewer_test(both_buffers_end_up_with_the_picture),
		viewer_test(a_frame_that_was_lost_leaves_all_damaged),
		viewer_test(no_buffer_is_drawn_to_while_it_is_shown),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
