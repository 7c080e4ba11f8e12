/* SPDX-License-Identifier: MIT */
/* Sequences that several processes draw. */
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* What a sequence is drawn of, each with something that would remember the frames before. */
static const char moving_scene[] = "[object knot]\nmodel = builtin:torus\nposition = 0 .8 0\n"
				   "rotation = 20 0 0\nspin = 90 45 0\n"
				   "[object block]\nmodel = builtin:cube\nposition = 1.5 0 0\n"
				   "orbit = 3\ntravel = 0 1 0\ntravel-time = 1\n"
				   "[light a]\norbit = -5\n[light b]\nposition = 2 4 1\n"
				   "travel = -3 0 0\n[camera]\norbit = 20\n";

/* A frame is the same whoever draws it, and whatever was drawn before. */
static void draw(const char *scene, const char *technique, const char *frames, const char *name)
{
	struct outcome outcome = RUN("render", scene, "--size", "64x64", "--map", "128",
		"--technique", technique, "--fps", "4", "--frames", frames, "-o", name);
	assert_string_equal(outcome.error, "");
	assert_int_equal(outcome.status, 0);
	outcome_finish(&outcome);
}

static void check_split(const char *scene, const char *technique)
{
	static const char *const parts[] = {"1:2", "3:5", "6:6"};
	draw(scene, technique, "6", "all%d.png");
	for (size_t i = 0; i < sizeof(parts) / sizeof(parts[0]); i++)
		draw(scene, technique, parts[i], "part%d.png");
	for (int i = 1; i <= 6; i++) {
		char all[32], part[32], next[32];
		snprintf(all, sizeof(all), "all%d.png", i);
		snprintf(part, sizeof(part), "part%d.png", i);
		snprintf(next, sizeof(next), "all%d.png", i % 6 + 1);
		if (!program_same_files(all, part))
			fail_msg("%s: frame %d of %s differs", technique, i, scene);
		assert_false(program_same_files(all, next));
	}
	assert_int_equal(count_entries("part"), 6);
}

static void a_sequence_can_be_split(void **state)
{
	(void)state;
	static const char *const techniques[] = {"hard", "smoothie", "gather", "auto"};
	const char *fox = SMOOTHIE_SHARED "/models/fox.glb";
	write_text("moving.ini", moving_scene);
	for (size_t i = 0; i < sizeof(techniques) / sizeof(techniques[0]); i++) {
		check_split("moving.ini", techniques[i]);
		if (SMOOTHIE_HAS_MODELS && access(fox, R_OK) == 0)
			check_split(fox, techniques[i]);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(
			a_sequence_can_be_split, enter_scratch, leave_scratch),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
