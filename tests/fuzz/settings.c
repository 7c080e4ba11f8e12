/* SPDX-License-Identifier: MIT */
/* Settings, one a line, of a stage that they leave little of.
 *	build-fuzz/tests/fuzz/fuzz-settings -dict=build-fuzz/tests/fuzz/words.dict FOUND \
 *		tests/fuzz/corpus/settings
 */
#include "expect.h"
#include "stage_check.h"
#include <stdlib.h>
#include <string.h>

enum { SETTINGS_MAX = 16 };

/* A model's file is not for this target to read. */
static size_t split(char *text, const char *settings[SETTINGS_MAX])
{
	size_t count = 0;
	char *rest;
	for (char *line = strtok_r(text, "\n", &rest); line != NULL && count < SETTINGS_MAX;
		line = strtok_r(NULL, "\n", &rest)) {
		const char *model = strstr(line, ".model=");
		if (model == NULL || strncmp(model, ".model=builtin:", 15) == 0)
			settings[count++] = line;
	}
	return count;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	const char *settings[SETTINGS_MAX];
	struct stage stage;
	struct sm_error error = {0};
	char *text = malloc(size + 1);
	expect(text != NULL);
	memcpy(text, data, size);
	text[size] = '\0';
	if (stage_load(&stage, "builtin:cube", settings, split(text, settings), &error))
		expect_sound_stage(&stage);
	else
		expect_clear_error(&error);
	stage_finish(&stage);
	free(text);
	return 0;
}
