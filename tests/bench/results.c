/* SPDX-License-Identifier: MIT */
#include "results.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>

struct result make_result(const char *scene, const char *technique)
{
	struct result result = {
		.precision = "highp",
		.radius = 0.03,
		.map = 512,
		.width = 512,
		.height = 384,
		.time_width = 1280,
		.time_height = 720,
		.triangles = 123456,
		.machine = "A processor, 2 cores, a driver",
		.outside_wrong = 100,
		.flicker = 1.0 / 3,
		.passes = {{"shadow map", 0.1 + 0.2}, {"surfaces", 1e-300}},
		.geometry_bytes = UINT64_MAX,
		.target_bytes = (1ull << 53) + 1,
		.peak_bytes = 0,
	};
	snprintf(result.scene, sizeof(result.scene), "%s", scene);
	snprintf(result.technique, sizeof(result.technique), "%s", technique);
	for (int i = 0; i < REGIONS; i++)
		result.error[i] = (struct error_summary){1000u + (unsigned)i, 0.1 * (i + 1),
			-0.1 / (i + 3), 0.7 / (i + 1), 5e-324, 1};
	for (int i = 0; i < THREAD_CHOICES; i++)
		result.time[i] = (struct time_summary){1.1 * (i + 1), 1.0 / 7, 1e22,
			1.7976931348623157e308, 1 + 1.0 / (1ull << 52), 1.0 / 3};
	return result;
}

FILE *text_begin(struct text *text)
{
	text_finish(text);
	text->file = open_memstream(&text->bytes, &text->size);
	assert_non_null(text->file);
	return text->file;
}

const char *text_end(struct text *text)
{
	assert_int_equal(fclose(text->file), 0);
	return text->bytes;
}

void text_finish(struct text *text)
{
	free(text->bytes);
	*text = (struct text){0};
}
