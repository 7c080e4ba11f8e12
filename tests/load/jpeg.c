/* SPDX-License-Identifier: MIT */
#include "load/image.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <turbojpeg.h>

#include <cmocka.h>

struct fixture {
	struct model *model;
	unsigned char *bytes; /* a JPEG file, 16 x 16 texels of orange */
	unsigned long size;
};

static int set_up(void **state)
{
	static struct fixture fixture;
	uint8_t orange[16][16][3];
	for (int i = 0; i < 256; i++)
		memcpy(orange[i / 16][i % 16], (uint8_t[3]){230, 120, 30}, 3);
	fixture = (struct fixture){.model = model_create(NULL)};
	tjhandle encoder = tjInitCompress();
	int failed = tjCompress2(encoder, **orange, 16, 0, 16, TJPF_RGB, &fixture.bytes,
		&fixture.size, TJSAMP_444, 95, 0);
	tjDestroy(encoder);
	*state = &fixture;
	return failed != 0 || fixture.model == NULL;
}

static int tear_down(void **state)
{
	struct fixture *fixture = *state;
	model_destroy(fixture->model);
	tjFree(fixture->bytes);
	return 0;
}

static void a_picture_is_decoded(void **state)
{
	struct fixture *fixture = *state;
	struct model_image image;
	assert_null(image_decode(fixture->model, fixture->bytes, fixture->size, &image));
	assert_int_equal(image.width, 16);
	assert_int_equal(image.height, 16);
	for (int i = 0; i < 256; i++) {
		const uint8_t *texel = image.rgba + 4 * i;
		assert_in_range(texel[0], 227, 233);
		assert_in_range(texel[1], 117, 123);
		assert_in_range(texel[2], 27, 33);
		assert_int_equal(texel[3], 255);
	}
}

static void a_file_cut_in_its_texels_keeps_its_size(void **state)
{
	struct fixture *fixture = *state;
	struct model_image image;
	assert_null(image_decode(fixture->model, fixture->bytes, fixture->size - 8, &image));
	assert_int_equal(image.width, 16);
	assert_int_equal(image.height, 16);
}

static void a_file_cut_in_its_head_is_refused(void **state)
{
	struct fixture *fixture = *state;
	struct model_image image = {.width = 7};
	const char *problem = image_decode(fixture->model, fixture->bytes, 100, &image);
	assert_string_equal(problem, "a damaged JPEG");
	assert_int_equal(image.width, 7);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(a_picture_is_decoded, set_up, tear_down),
		cmocka_unit_test_setup_teardown(
			a_file_cut_in_its_texels_keeps_its_size, set_up, tear_down),
		cmocka_unit_test_setup_teardown(
			a_file_cut_in_its_head_is_refused, set_up, tear_down),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
