/* SPDX-License-Identifier: MIT */
/* What a commit carries besides a framebuffer, and what framebuffers are made with. */
#include "kms_commit.h"
#include "kms_buffer.h"
#include "viewer.h"
#include <drm_fourcc.h>
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <xf86drm.h>

#include <cmocka.h>

struct setup {
	struct fake_drm *drm;
	struct kms_device device;
	struct kms_output output;
	uint32_t handle;
	struct kms_layout layout;
};

static void set_up(struct setup *setup, const struct fake_abilities *can)
{
	struct sm_error error;
	uint64_t size;
	fake_world_reset();
	*setup = (struct setup){.drm = fake_drm_init(0, can)};
	assert_true(
		kms_device_init(&setup->device, fake_drm_open("/dev/dri/card0"), false, &error));
	assert_int_equal(kms_output_find(&setup->output, &setup->device, &(struct kms_wish){0},
				 true, &error),
		KMS_FOUND);
	setup->layout = (struct kms_layout){.width = 64,
		.height = 48,
		.format = DRM_FORMAT_XRGB8888,
		.modifier = DRM_FORMAT_MOD_INVALID};
	assert_int_equal(drmModeCreateDumbBuffer(setup->device.fd, 64, 48, 32, 0,
				 &setup->layout.handles[0], &setup->layout.strides[0], &size),
		0);
}

static void tear_down(struct setup *setup)
{
	drmModeDestroyDumbBuffer(setup->device.fd, setup->layout.handles[0]);
	assert_int_equal(fake_drm_count(setup->drm), 0);
	fake_drm_close(setup->device.fd);
}

static struct kms_frame frame_of(struct setup *setup)
{
	return (struct kms_frame){
		.framebuffer = kms_add_framebuffer(&setup->device, &setup->layout),
		.width = 64,
		.height = 48,
		.in_fence = -1,
	};
}

static void fences_go_along_where_the_driver_has_them(void **state)
{
	(void)state;
	for (int fences = 0; fences < 2; fences++) {
		struct setup setup;
		set_up(&setup, &(struct fake_abilities){.fences = fences});
		int in_fence = eventfd(0, EFD_CLOEXEC), out_fence = 99;
		struct kms_frame frame = frame_of(&setup), other = frame_of(&setup);
		frame.in_fence = other.in_fence = in_fence;
		frame.out_fence = other.out_fence = &out_fence;
		assert_int_equal(
			kms_atomic.set_mode(&setup.device, &setup.output, &frame, NULL), KMS_DONE);
		assert_int_equal(setup.drm->last_had_in_fence, fences);
		assert_int_equal(out_fence >= 0, fences);
		if (out_fence >= 0)
			close(out_fence);
		out_fence = 99;
		assert_int_equal(kms_atomic.flip(&setup.device, &setup.output, &other, false, NULL),
			KMS_DONE);
		assert_int_equal(setup.drm->last_had_in_fence, fences);
		assert_int_equal(out_fence >= 0, fences);
		if (out_fence >= 0)
			close(out_fence);
		out_fence = 99;
		/* The calls from before have none, and say so. */
		fake_world_wait(VIEWER_SECOND);
		assert_int_equal(kms_legacy.flip(&setup.device, &setup.output, &frame, false, NULL),
			KMS_DONE);
		assert_int_equal(out_fence, -1);
		close(in_fence);
		kms_remove_framebuffer(&setup.device, frame.framebuffer);
		kms_remove_framebuffer(&setup.device, other.framebuffer);
		tear_down(&setup);
	}
}

static void a_flip_carries_its_damage(void **state)
{
	(void)state;
	static const struct rect part = {3, 5, 20, 10};
	for (int damage = 0; damage < 2; damage++) {
		struct setup setup;
		set_up(&setup, &(struct fake_abilities){.damage = damage});
		struct kms_frame frame = frame_of(&setup), other = frame_of(&setup);
		frame.damage = other.damage = &part;
		/* With a mode all is new. */
		assert_int_equal(
			kms_atomic.set_mode(&setup.device, &setup.output, &frame, NULL), KMS_DONE);
		assert_false(setup.drm->crtcs[0].has_clip);
		assert_int_equal(kms_atomic.flip(&setup.device, &setup.output, &other, false, NULL),
			KMS_DONE);
		const struct drm_mode_rect *clip = &setup.drm->crtcs[0].clip;
		assert_int_equal(setup.drm->crtcs[0].has_clip, damage);
		if (damage) {
			assert_int_equal(clip->x1, 3);
			assert_int_equal(clip->y1, 5);
			assert_int_equal(clip->x2, 23);
			assert_int_equal(clip->y2, 15);
		}
		kms_remove_framebuffer(&setup.device, frame.framebuffer);
		kms_remove_framebuffer(&setup.device, other.framebuffer);
		tear_down(&setup); /* where blobs are counted */
	}
}

static void framebuffers_have_modifiers_where_they_can(void **state)
{
	(void)state;
	static const struct {
		struct fake_abilities can;
		uint64_t modifier;
		bool made, told;
	} cases[] = {
		{{.modifiers = true}, DRM_FORMAT_MOD_LINEAR, true, true},
		{{.modifiers = true}, I915_FORMAT_MOD_X_TILED, true, true},
		{{.modifiers = true}, DRM_FORMAT_MOD_INVALID, true, false},
		{{0}, DRM_FORMAT_MOD_LINEAR, true, false},
		{{0}, DRM_FORMAT_MOD_INVALID, true, false},
		/* Shown as if it were linear, tiles would be noise. */
		{{0}, I915_FORMAT_MOD_X_TILED, false, false},
		{{.only_by_depth = true}, DRM_FORMAT_MOD_INVALID, true, false},
		{{.only_by_depth = true, .modifiers = true}, DRM_FORMAT_MOD_LINEAR, true, false},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct setup setup;
		set_up(&setup, &cases[i].can);
		setup.layout.modifier = cases[i].modifier;
		uint32_t id = kms_add_framebuffer(&setup.device, &setup.layout);
		assert_int_equal(id != 0, cases[i].made);
		if (cases[i].told)
			assert_int_equal(
				fake_framebuffer(setup.drm, id)->modifier, cases[i].modifier);
		kms_remove_framebuffer(&setup.device, id);
		tear_down(&setup);
	}
}

static void results_tell_what_to_do(void **state)
{
	(void)state;
	static const struct {
		int code;
		enum kms_result result;
	} cases[] = {{0, KMS_DONE}, {EBUSY, KMS_BUSY}, {-EBUSY, KMS_BUSY}, {EACCES, KMS_NO_MASTER},
		{-EPERM, KMS_NO_MASTER}, {ENODEV, KMS_GONE}, {EINVAL, KMS_REFUSED},
		{-ERANGE, KMS_REFUSED}, {ENOMEM, KMS_FAILED}, {EIO, KMS_FAILED}};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		assert_int_equal(kms_result_of(cases[i].code), cases[i].result);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		viewer_test(fences_go_along_where_the_driver_has_them),
		viewer_test(a_flip_carries_its_damage),
		viewer_test(framebuffers_have_modifiers_where_they_can),
		viewer_test(results_tell_what_to_do),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
