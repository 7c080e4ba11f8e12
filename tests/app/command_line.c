/* SPDX-License-Identifier: MIT */
/* What the program says to a command line that it cannot follow, and to one that asks for help. */
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <glob.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define CYLINDER "builtin:cylinder"

/* What a command line is refused for by a build that can show something. */
#define DISPLAY_PROBLEM(text) (SMOOTHIE_HAS_DISPLAY ? (text) : "a display needs GBM and libdrm")

static const struct {
	int status;
	const char *text;
	const char *arguments[MAX_ARGUMENTS];
} refused[] = {
	{2, "a command is missing; see smoothie --help", {NULL}},
	{2, "no command \"rendr\"; did you mean \"render\"?", {"rendr", CYLINDER}},
	{2, "no command \"inf\"; did you mean \"info\"?", {"inf"}},
	{2, "no command \"explode\"; see smoothie --help", {"explode"}},
	{2, "no command \"--frob\"", {"--frob"}},
	{2, "no command \"rindr\"; did you mean", {"help", "rindr"}},

	{2, "SCENE is missing; see smoothie render --help", {"render"}},
	{2, "SCENE is missing", {"render", "-o", "out.png"}},
	{2, "not also second", {"render", CYLINDER, "second"}},
	{2, "unknown flag --frob;", {"render", CYLINDER, "--frob"}},
	{2, "unknown flag --frob=3;", {"render", "--frob=3", CYLINDER}},
	{2, "unknown flag -z;", {"render", "-z", CYLINDER}},
	{2, "unknown flag -z;", {"render", "-qz", CYLINDER}},
	{2, "--output needs FILE", {"render", CYLINDER, "-o"}},
	{2, "--size needs WxH", {"render", CYLINDER, "--size"}},
	{2, "--stats takes no value", {"render", CYLINDER, "--stats=yes"}},

	{2, "--size 64: ", {"render", CYLINDER, "--size", "64"}},
	{2, "--size 0x64: ", {"render", CYLINDER, "--size", "0x64"}},
	{2, "--size 64x: ", {"render", CYLINDER, "--size", "64x"}},
	{2, "--size 64x64x: ", {"render", CYLINDER, "--size", "64x64x"}},
	{2, "--size -1x5: ", {"render", CYLINDER, "--size", "-1x5"}},
	{2, "--size 4294967297x1: ", {"render", CYLINDER, "--size", "4294967297x1"}},
	{2, "2147483647x2147483647: this driver draws 1x1 to ",
		{"render", CYLINDER, "--size", "2147483647x2147483647"}},
	{2, "1x100000: this driver draws 1x1 to ", {"render", CYLINDER, "--size", "1x100000"}},
	{2, "--samples 2: 1 or 4", {"render", CYLINDER, "--samples", "2"}},
	{2, "--map 0: ", {"render", CYLINDER, "--map", "0"}},
	{2, "--map big: ", {"render", CYLINDER, "--map", "big"}},
	{2, "--animation: a name or number", {"render", CYLINDER, "--animation", ""}},
	{2, "known: none", {"render", CYLINDER, "--animation", "Run"}},
	{2, "--visibility=x: ", {"render", CYLINDER, "--visibility=x"}},
	{2, "--visibility=7: builtin:cylinder has 1 light", {"render", CYLINDER, "--visibility=7"}},
	{2, "--frames x: ", {"render", CYLINDER, "--frames", "x"}},
	{2, "--frames 0: ", {"render", CYLINDER, "--frames", "0"}},
	{2, "--frames 5:3: ", {"render", CYLINDER, "--frames", "5:3"}},
	{2, "--fps 0: ", {"render", CYLINDER, "--frames", "2", "--fps", "0"}},
	{2, "--fps 1001: ", {"render", CYLINDER, "--frames", "2", "--fps", "1001"}},
	{2, "--fps 29.97: ", {"render", CYLINDER, "--frames", "2", "--fps", "29.97"}},
	{2, "--fps 25/0: ", {"render", CYLINDER, "--frames", "2", "--fps", "25/0"}},

	{2, "--fps needs --frames", {"render", CYLINDER, "--fps", "25"}},
	{2, "--samples 4 does not go with", {"render", CYLINDER, "--visibility", "--samples", "4"}},
	{2, "-o - does not go with", {"render", CYLINDER, "--frames", "2", "-o", "-"}},

	{2, "no-such-technique", {"render", CYLINDER, "--technique", "no-such-technique"}},
	{2, "--sampling coarse: dense, sparse, deferred or deferred-sparse is wanted",
		{"render", CYLINDER, "--sampling", "coarse"}},
	{2, "--precision double: float, half or fixed12 is wanted",
		{"render", CYLINDER, "--precision", "double"}},
	{2, "builtin:nothing", {"render", "builtin:nothing"}},
	{2, "missing.obj", {"render", "missing.obj"}},
	{2, "folder", {"render", "folder"}},
	{2, "noise.obj", {"render", "noise.obj"}},
	{2, "empty.glb", {"render", "empty.glb"}},
	{2, "--set", {"render", CYLINDER, "--set", "nonsense"}},
	{2, "--set", {"render", CYLINDER, "--set", "light.radius=wide"}},
	{2, "--set motion.period: ", {"render", CYLINDER, "--set", "motion.period=.01"}},
	{2, "turns is camera", {"render", CYLINDER, "--set", "motion.light=key"}},

	{2, "missing/out.png (No such file", {"render", CYLINDER, "-o", "missing/out.png"}},
	{2, "folder (Is a directory)", {"render", CYLINDER, "-o", "folder"}},
	{2, "noise.obj/out.png (Not a directory)", {"render", CYLINDER, "-o", "noise.obj/out.png"}},
	{2, "new/ (No such file", {"render", CYLINDER, "-o", "new/"}},
	{2, "cannot write ", {"render", CYLINDER, "-o", ""}},
	{2, "/proc/out.png", {"render", CYLINDER, "--size", "8x8", "-o", "/proc/out.png"}},
	{1, "/dev/full (No space left", {"render", CYLINDER, "--size", "8x8", "-o", "/dev/full"}},
	{2, "noise.obj would be written over itself", {"render", "noise.obj", "-o", "noise.obj"}},

	{2, "no device \"gpu\"", {"render", CYLINDER, "--device", "gpu"}},
	{2, "/dev/dri/none does not work", {"render", CYLINDER, "--device", "/dev/dri/none"}},
	{2, "no device \"gpu\"", {"info", "--device", "gpu"}},

	{2, "SCENE is missing; see smoothie show --help", {"show"}},
	{2, "--rotate 45: 0, 90, 180 or 270", {"show", CYLINDER, "--rotate", "45"}},
	{2, "--vsync maybe: on or off", {"show", CYLINDER, "--vsync", "maybe"}},
	{2, "--frames 0: ", {"show", CYLINDER, "--frames", "0"}},
	{2, "--connector needs NAME", {"show", CYLINDER, "--connector"}},
	{2, "unknown flag --size", {"show", CYLINDER, "--size", "3x3"}},
	{2, "missing.obj", {"show", "missing.obj"}},
	{2, DISPLAY_PROBLEM("no mode \"9x\": "), {"show", CYLINDER, "--mode", "9x"}},
	{2, DISPLAY_PROBLEM("no format \"nope\": "), {"show", CYLINDER, "--format", "nope"}},
	{2, DISPLAY_PROBLEM("device /dev/dri/none: No such file"),
		{"show", CYLINDER, "--device", "/dev/dri/none"}},

	{2, "no cap \"warp\"; there are: EXT_color_buffer_float ",
		{"render", CYLINDER, "--caps", "-warp"}},
	{2, "caps \"min_rg16f\": a list such as -name,+name", {"info", "--caps", "min_rg16f"}},
	{2, "caps \"\": a list", {"info", "--caps", "-min_rg16f,"}},
	{2, "no need \"colour\"; there are: smoothie, ", {"info", "--path", "colour=rg16f"}},
	{2, "no way \"rg8\" of the need smoothie; there are: rg16f, ",
		{"render", CYLINDER, "--path", "smoothie=rg8"}},
	{2, "path \"smoothie\": NEED=WAY is wanted", {"info", "--path", "smoothie"}},
	{1, "the path smoothie=rg16f takes min_rg16f, which is not there: taken away",
		{"render", CYLINDER, "--caps", "-min_rg16f", "--path", "smoothie=rg16f"}},
	{2, "--path needs NEED=WAY", {"show", CYLINDER, "--path"}},
	{2, "--caps needs -NAME,+NAME", {"bench", "--caps"}},
	{2, "no skip \"nothing\"; there are: all frame light",
		{"render", CYLINDER, "--no-skip", "light", "--no-skip", "nothing"}},
	{2, "--no-skip needs NAME", {"show", "--no-skip"}},
	{2, "--no-skip does nothing", {"bench", "--errors", "--no-skip", "receiver"}},

	{2, "unknown flag --size", {"info", "--size", "3x3"}},
	{2, "missing.obj", {"info", "missing.obj"}},
	{2, "not also second", {"info", CYLINDER, "second"}},
};

static void make_inputs(void)
{
	assert_int_equal(mkdir("folder", 0777), 0);
	write_text("noise.obj", "v 1 2\nf 7 8 9\nnothing\n");
	write_text("empty.glb", "");
}

static void test_refusals_are_one_line_and_leave_nothing(void **state)
{
	(void)state;
	make_inputs();
	size_t entries = count_entries("");
	for (size_t i = 0; i < sizeof(refused) / sizeof(refused[0]); i++) {
		struct run run = {{NULL}};
		memcpy(run.arguments, refused[i].arguments, sizeof(run.arguments));
		struct outcome outcome = run_program(&run);
		assert_failure(&outcome, refused[i].status, refused[i].text);
		assert_string_equal(outcome.out, "");
		if (count_entries("") != entries)
			fail_msg("case %zu (%s) leaves a file", i, refused[i].text);
		outcome_finish(&outcome);
	}
}

static void test_no_usable_egl_is_a_failure_of_the_machine(void **state)
{
	(void)state;
	struct outcome outcome = run_program(&(struct run){.arguments = {"render", CYLINDER},
		.environment = "__EGL_VENDOR_LIBRARY_FILENAMES=/dev/null"});
	if (outcome.status ==
		0) { /* EGL without the vendor-neutral dispatch heeds no such variable */
		outcome_finish(&outcome);
		skip();
	}
	assert_failure(&outcome, 1, "no device can render with OpenGL ES 3; tried ");
	assert_non_null(strstr(outcome.error, "surfaceless: "));
	assert_int_equal(count_entries(""), 0);
	outcome_finish(&outcome);
}

static void test_no_display_device_is_a_failure_of_the_machine(void **state)
{
	(void)state;
	glob_t nodes;
	if (!SMOOTHIE_HAS_DISPLAY || glob("/dev/dri/card*", 0, NULL, &nodes) == 0)
		skip();
	static const char *const commands[][2] = {{CYLINDER, "--stats"}, {"--list", NULL}};
	for (size_t i = 0; i < 2; i++) {
		struct outcome outcome = RUN("show", commands[i][0], commands[i][1]);
		assert_failure(&outcome, 1, "there is no display device (/dev/dri/card*)");
		assert_string_equal(outcome.out, "");
		outcome_finish(&outcome);
	}
}

static void test_standard_output_that_is_full_is_an_error(void **state)
{
	(void)state;
	struct outcome outcome =
		run_program(&(struct run){.arguments = {"info", CYLINDER}, .file_limit = 100});
	assert_failure(&outcome, 1, "cannot write to standard output");
	outcome_finish(&outcome);
}

static void test_version(void **state)
{
	(void)state;
	int major, minor, patch;
	struct outcome outcome = RUN("--version");
	assert_int_equal(outcome.status, 0);
	assert_int_equal(sscanf(outcome.out, "smoothie %d.%d.%d\n", &major, &minor, &patch), 3);
	outcome_finish(&outcome);
}

static void test_help_in_every_form(void **state)
{
	(void)state;
	static const struct {
		const char *arguments[MAX_ARGUMENTS];
		const char *start;
	} cases[] = {
		{{"--help"}, "usage: smoothie COMMAND"},
		{{"-h"}, "usage: smoothie COMMAND"},
		{{"help"}, "usage: smoothie COMMAND"},
		{{"help", "render"}, "usage: smoothie render SCENE"},
		{{"render", "--help"}, "usage: smoothie render SCENE"},
		{{"info", "-h"}, "usage: smoothie info"},
		{{"show", "-h"}, "usage: smoothie show SCENE"},
		{{"bench", "-h"}, "usage: smoothie bench"},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct run run = {{NULL}};
		memcpy(run.arguments, cases[i].arguments, sizeof(run.arguments));
		struct outcome outcome = run_program(&run);
		assert_int_equal(outcome.status, 0);
		assert_string_equal(outcome.error, "");
		assert_ptr_equal(strstr(outcome.out, cases[i].start), outcome.out);
		outcome_finish(&outcome);
	}
}

/* Each flag at the start of a help line must stand in the reference. */
static void assert_documented(const char *help, const char *reference)
{
	for (const char *line = help; *line != '\0'; line += strcspn(line, "\n") + 1) {
		char name[32], flag[40];
		if (sscanf(line, " -%*c, --%31[a-z]", name) != 1 &&
			sscanf(line, " --%31[a-z]", name) != 1)
			continue;
		snprintf(flag, sizeof(flag), "`--%s", name);
		if (strstr(reference, flag) == NULL)
			fail_msg("the reference does not tell of --%s", name);
	}
}

static void test_every_flag_is_documented(void **state)
{
	(void)state;
	static char reference[100000];
	FILE *file = fopen(SMOOTHIE_REFERENCE, "r");
	assert_non_null(file);
	assert_true(fread(reference, 1, sizeof(reference) - 1, file) > 0);
	fclose(file);
	static const char *const commands[] = {"render", "check", "bench", "info"};
	for (size_t i = 0; i < sizeof(commands) / sizeof(commands[0]); i++) {
		struct outcome outcome = RUN("help", commands[i]);
		assert_documented(outcome.out, reference);
		outcome_finish(&outcome);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(
			test_refusals_are_one_line_and_leave_nothing, enter_scratch, leave_scratch),
		cmocka_unit_test_setup_teardown(test_no_usable_egl_is_a_failure_of_the_machine,
			enter_scratch, leave_scratch),
		cmocka_unit_test(test_no_display_device_is_a_failure_of_the_machine),
		cmocka_unit_test_setup_teardown(test_standard_output_that_is_full_is_an_error,
			enter_scratch, leave_scratch),
		cmocka_unit_test(test_version),
		cmocka_unit_test(test_help_in_every_form),
		cmocka_unit_test(test_every_flag_is_documented),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
