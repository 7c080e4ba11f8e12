/* SPDX-License-Identifier: MIT */
/* Text of scene files.
 *	build-fuzz/tests/fuzz/fuzz-scene_file -dict=build-fuzz/tests/fuzz/words.dict FOUND \
 *		tests/fuzz/corpus/scene_file
 */
#include "load/scene_file.h"
#include "expect.h"
#include <stdlib.h>
#include <string.h>

static const char path[] = "scenes/fuzz.ini";

static void expect_sound(const struct plan *plan)
{
	for (size_t i = 0; i < plan->light_count; i++)
		expect(plan->lights[i].name[0] != '\0');
	for (size_t i = 0; i < plan->object_count; i++)
		expect(plan->objects[i].model == NULL || plan->objects[i].model[0] != '\0');
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct plan plan;
	struct sm_error error = {0};
	char *text = malloc(size + 1);
	expect(text != NULL && plan_init(&plan, NULL));
	memcpy(text, data, size);
	text[size] = '\0';
	if (scene_file_parse(path, text, &plan, &error)) {
		expect_sound(&plan);
	} else {
		expect_clear_error(&error);
		expect(strncmp(error.text, path, strlen(path)) == 0);
	}
	plan_finish(&plan);
	free(text);
	return 0;
}
