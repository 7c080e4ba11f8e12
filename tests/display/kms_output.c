/* SPDX-License-Identifier: MIT */
/* The way to a monitor: connector, CRTC, plane, format, and what the driver says of them. */
#include "kms_output.h"
#include "viewer.h"
#include <drm_fourcc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static enum kms_search find(struct fake_drm *drm, const struct kms_wish *wish,
	struct kms_output *output, struct sm_error *error)
{
	struct kms_device device;
	assert_true(kms_device_init(&device, fake_drm_open(drm->path), false, error));
	enum kms_search search = kms_output_find(output, &device, wish, true, error);
	fake_drm_close(device.fd);
	return search;
}

static void the_whole_way_is_found(void **state)
{
	(void)state;
	struct kms_output output;
	struct sm_error error;
	struct fake_drm *drm =
		fake_drm_init(0, &(struct fake_abilities){.modifiers = true,
					 .damage = true,
					 .rotations = DRM_MODE_ROTATE_0 | DRM_MODE_ROTATE_180});
	assert_int_equal(find(drm, &(struct kms_wish){0}, &output, &error), KMS_FOUND);
	assert_string_equal(output.name, "HDMI-A-1");
	assert_int_equal(output.connector, 20);
	assert_int_equal(output.crtc, 10);
	assert_int_equal(output.plane, 40);
	assert_string_equal(output.format->name, "xrgb8888");
	assert_int_equal(output.modifier_count, 2);
	assert_int_equal(output.modifiers[1], I915_FORMAT_MOD_X_TILED);
	assert_int_equal(output.rotations, DRM_MODE_ROTATE_0 | DRM_MODE_ROTATE_180);
	assert_int_equal(output.other_plane_count, 0);
	assert_int_equal(output.plane_properties.fb_id.id, 100 + FAKE_FB_ID);
	assert_int_equal(output.plane_properties.fb_damage_clips.id, 100 + FAKE_FB_DAMAGE_CLIPS);
	assert_int_equal(output.plane_properties.in_fence_fd.id, 0);
	assert_int_equal(output.crtc_properties.mode_id.id, 100 + FAKE_MODE_ID);
	assert_int_equal(output.connector_properties.crtc_id.id, 100 + FAKE_CRTC_ID);

	const struct kms_wish rgb565 = {.format = pixel_format_find("rgb565")};
	assert_int_equal(find(drm, &rgb565, &output, &error), KMS_FOUND);
	assert_int_equal(output.modifier_count, 1);
	assert_int_equal(output.modifiers[0], DRM_FORMAT_MOD_LINEAR);
}

static void a_crtc_is_chosen_that_can_and_is_free(void **state)
{
	(void)state;
	static const struct {
		uint32_t possible;
		bool other_lit;
		uint32_t crtc; /* 0: none */
	} cases[] = {{3, false, 10}, {2, false, 11}, {1, false, 10}, {3, true, 11}, {1, true, 10},
		{0, false, 0}};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct kms_output output;
		struct sm_error error;
		fake_world_reset();
		struct fake_drm *drm = fake_drm_init(0, &(struct fake_abilities){0});
		if (cases[i].other_lit)
			fake_drm_light_console(drm);
		drm->connectors[1].plugged = true;
		drm->connectors[1].possible_crtcs = cases[i].possible;
		enum kms_search search =
			find(drm, &(struct kms_wish){.connector = "DP-1"}, &output, &error);
		if (cases[i].crtc == 0) {
			assert_int_equal(search, KMS_UNUSABLE);
			assert_non_null(strstr(error.text, "DP-1 has no CRTC left"));
			assert_int_equal(error.status, SM_ERROR_MACHINE);
		} else {
			assert_int_equal(search, KMS_FOUND);
			assert_int_equal(output.crtc, cases[i].crtc);
			assert_int_equal(output.plane, cases[i].crtc + 30);
		}
	}
}

static void without_a_monitor_there_is_none(void **state)
{
	(void)state;
	struct kms_output output;
	struct sm_error error;
	struct fake_drm *drm = fake_drm_init(0, &(struct fake_abilities){0});
	const struct kms_wish second = {.connector = "DP-1"}, none = {.connector = "HDMI-A-2"};
	assert_int_equal(find(drm, &second, &output, &error), KMS_NO_MONITOR);
	assert_int_equal(find(drm, &none, &output, &error), KMS_UNUSABLE);
	assert_string_equal(error.text, "no connector HDMI-A-2; it has HDMI-A-1, DP-1");
	drm->connectors[0].mode_count = 0;
	assert_int_equal(find(drm, &(struct kms_wish){0}, &output, &error), KMS_NO_MONITOR);
}

/* Only drivers that do not tell of primary planes are taken at their word of old. */
static void drivers_without_universal_planes(void **state)
{
	(void)state;
	struct kms_output output;
	struct sm_error error;
	struct fake_drm *drm = fake_drm_init(
		0, &(struct fake_abilities){.no_atomic = true, .no_universal_planes = true});
	assert_int_equal(find(drm, &(struct kms_wish){0}, &output, &error), KMS_FOUND);
	assert_int_equal(output.plane, 0);
	assert_string_equal(output.format->name, "xrgb8888");
	const struct kms_wish deep = {.format = pixel_format_find("xrgb2101010")};
	assert_int_equal(find(drm, &deep, &output, &error), KMS_UNUSABLE);
	assert_string_equal(
		error.text, "HDMI-A-1 does not show xrgb2101010; it shows xrgb8888, rgb565");
}

static void a_device_without_a_display_is_none(void **state)
{
	(void)state;
	struct kms_device device;
	struct sm_error error;
	struct fake_drm *drm = fake_drm_init(0, &(struct fake_abilities){0});
	drm->connectors[0].absent = drm->connectors[1].absent = true;
	int fd = fake_drm_open(drm->path);
	assert_false(kms_device_init(&device, fd, false, &error));
	assert_string_equal(error.text, "it drives no display");
	fake_drm_close(fd);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		viewer_test(the_whole_way_is_found),
		viewer_test(a_crtc_is_chosen_that_can_and_is_free),
		viewer_test(without_a_monitor_there_is_none),
		viewer_test(drivers_without_universal_planes),
		viewer_test(a_device_without_a_display_is_none),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
