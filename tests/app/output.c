/* SPDX-License-Identifier: MIT */
/* What `smoothie render` writes, where, and what it leaves when it is stopped. */
#include "app/output.h"
#include "app/signals.h"
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <fcntl.h>
#include <png.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define CYLINDER "builtin:cylinder"

/* Asserts that path holds a whole PNG of this size, and returns its libpng format. */
static uint32_t assert_png(const char *path, uint32_t width, uint32_t height)
{
	png_image image = {.version = PNG_IMAGE_VERSION};
	if (!png_image_begin_read_from_file(&image, path))
		fail_msg("%s: %s", path, image.message);
	assert_int_equal(image.width, width);
	assert_int_equal(image.height, height);
	uint32_t format = image.format;
	void *pixels = malloc(PNG_IMAGE_SIZE(image));
	assert_non_null(pixels);
	if (!png_image_finish_read(&image, NULL, pixels, 0, NULL))
		fail_msg("%s: %s", path, image.message);
	free(pixels);
	return format;
}

static void assert_success(struct outcome outcome)
{
	if (outcome.status != 0 || outcome.error[0] != '\0')
		fail_msg("status %d and:\n%s", outcome.status, outcome.error);
	outcome_finish(&outcome);
}

static void test_pictures_of_all_sizes(void **state)
{
	(void)state;
	static const struct {
		const char *text;
		uint32_t width, height;
	} sizes[] = {
		{"1x1", 1, 1},
		{"3x2", 3, 2},
		{"1x300", 1, 300},
		{"4096x1", 4096, 1},
		{"33x17", 33, 17},
	};
	for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
		assert_success(RUN("render", CYLINDER, "--size", sizes[i].text, "-o", "out.png"));
		assert_png("out.png", sizes[i].width, sizes[i].height);
	}
	assert_int_equal(count_entries(""), 1);
}

static void test_samples_and_visibility_change_the_format_alone(void **state)
{
	(void)state;
	assert_success(RUN("render", CYLINDER, "--size", "40x30", "--samples", "1", "-o", "1.png"));
	assert_success(RUN("render", CYLINDER, "--size", "40x30", "--samples", "4", "-o", "4.png"));
	assert_success(RUN("render", CYLINDER, "--size", "40x30", "--visibility", "-o", "v.png"));
	assert_int_equal(assert_png("1.png", 40, 30), PNG_FORMAT_RGB);
	assert_int_equal(assert_png("4.png", 40, 30), PNG_FORMAT_RGB);
	assert_int_equal(assert_png("v.png", 40, 30), PNG_FORMAT_LINEAR_Y);
}

/* Only penumbrae have low bytes between 0 and 255. An sRGB target would lift each byte of 1 to 12
 * above them: 1 becomes 13 (IEC 61966-2-1). */
static void test_visibility_is_linear(void **state)
{
	(void)state;
	static uint16_t grey[200 * 200];
	png_image image = {.version = PNG_IMAGE_VERSION};
	size_t lit = 0, dark = 0, low = 0;
	assert_success(RUN("render", CYLINDER, "--size", "200x200", "--visibility", "-o", "v.png"));
	assert_true(png_image_begin_read_from_file(&image, "v.png"));
	assert_int_equal(PNG_IMAGE_SIZE(image), sizeof(grey));
	assert_true(png_image_finish_read(&image, NULL, grey, 0, NULL));
	for (size_t i = 0; i < 200 * 200; i++) {
		lit += grey[i] == 65535;
		dark += grey[i] == 0;
		low += (grey[i] & 255) >= 1 && (grey[i] & 255) <= 12;
	}
	assert_true(lit > 0 && dark > 0 && low > 0);
}

static void test_default_name_is_the_scene_in_the_working_folder(void **state)
{
	(void)state;
	assert_success(RUN("render", CYLINDER, "--size", "8x8"));
	assert_png("cylinder.png", 8, 8);
	assert_int_equal(count_entries(""), 1);
}

static void test_standard_output_holds_the_picture_alone(void **state)
{
	(void)state;
	struct outcome outcome = RUN("render", CYLINDER, "--size", "8x8", "-o", "-", "--stats");
	png_image image = {.version = PNG_IMAGE_VERSION};
	assert_int_equal(outcome.status, 0);
	assert_true(png_image_begin_read_from_memory(&image, outcome.out, outcome.out_size));
	png_image_free(&image);
	assert_non_null(strstr(outcome.error, "first frame: "));
	assert_int_equal(count_entries(""), 0);
	outcome_finish(&outcome);
}

static void test_stats_name_every_stage(void **state)
{
	(void)state;
	static const char *const keys[] = {"process start", "load scene", "open device",
		"create renderer", "first frame", "read back", "write PNG", "total", "draw calls",
		"silhouette edges", "silhouette edges left out", "fins left out", "fin vertices",
		"fin bytes", "uploaded bytes", "silhouette time", "skipped, volume"};
	struct outcome outcome = RUN("render", CYLINDER, "--size", "8x8", "--stats");
	assert_int_equal(outcome.status, 0);
	for (size_t i = 0; i < sizeof(keys) / sizeof(keys[0]); i++) {
		char line[40];
		snprintf(line, sizeof(line), "%s: ", keys[i]);
		if (strstr(outcome.out, line) == NULL)
			fail_msg("no \"%s\" in\n%s", line, outcome.out);
	}
	outcome_finish(&outcome);
}

static void test_sequences_are_numbered(void **state)
{
	(void)state;
	assert_success(RUN("render", CYLINDER, "--size", "8x8", "--frames", "3", "--fps", "25",
		"-o", "out.png"));
	assert_success(
		RUN("render", CYLINDER, "--size", "8x8", "--frames", "2", "-o", "f%02d.png"));
	static const char *const names[] = {
		"out-0001.png", "out-0002.png", "out-0003.png", "f01.png", "f02.png"};
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		assert_png(names[i], 8, 8);
	assert_int_equal(count_entries(""), 5);
}

/* At the default of 25 frames a second, 3 are a turn, each of which starts at rest. */
static void test_scenes_move_from_where_they_rest(void **state)
{
	(void)state;
	static const char *const parts[] = {"motion.turns=camera", "motion.turns=light"};
	assert_success(RUN("render", CYLINDER, "--size", "64x64", "-o", "rest.png"));
	for (size_t i = 0; i < sizeof(parts) / sizeof(parts[0]); i++) {
		assert_success(RUN("render", CYLINDER, "--size", "64x64", "--set", parts[i],
			"--set", "motion.period=.12", "-o", "first.png"));
		assert_true(program_same_files("rest.png", "first.png"));
		assert_success(RUN("render", CYLINDER, "--size", "64x64", "--set", parts[i],
			"--set", "motion.period=.12", "--frames", "4", "-o", "f%d.png"));
		assert_true(program_same_files("rest.png", "f1.png"));
		assert_false(program_same_files("f1.png", "f2.png"));
		assert_false(program_same_files("f2.png", "f3.png"));
		assert_true(program_same_files("f1.png", "f4.png"));
	}
}

static void draw_animation(const char *flag, const char *value, const char *name)
{
	assert_success(RUN("render", "-q", SMOOTHIE_RIG, "--size", "32x24", "--fps", "4",
		"--frames", "2:2", flag, value, "-o", name));
}

static void test_an_animation_is_chosen(void **state)
{
	(void)state;
	if (!SMOOTHIE_HAS_MODELS)
		skip();
	draw_animation("--animation", "none", "none.png");
	draw_animation("--animation", "Wave", "name.png");
	draw_animation("--animation", "1", "number.png");
	draw_animation("--set", "object.animation=Wave", "set.png");
	assert_true(program_same_files("name-0002.png", "number-0002.png"));
	assert_true(program_same_files("name-0002.png", "set-0002.png"));
	assert_false(program_same_files("name-0002.png", "none-0002.png"));
}

/* A fourth of a turn each. */
static void test_the_rate_of_frames_is_a_ratio(void **state)
{
	(void)state;
	assert_success(RUN("render", CYLINDER, "--size", "16x16", "--set", "motion.period=1001",
		"--frames", "2", "--fps", "4/1001", "-o", "r%d.png"));
	assert_success(RUN("render", CYLINDER, "--size", "16x16", "--set", "motion.period=4",
		"--frames", "2", "--fps", "1", "-o", "s%d.png"));
	assert_true(program_same_files("r2.png", "s2.png"));
	assert_false(program_same_files("r1.png", "r2.png"));
}

static void test_files_get_the_permissions_of_the_umask(void **state)
{
	(void)state;
	struct stat file;
	mode_t before = umask(027);
	assert_success(RUN("render", CYLINDER, "--size", "8x8", "-o", "out.png"));
	umask(before);
	assert_int_equal(stat("out.png", &file), 0);
	assert_int_equal(file.st_mode & 0777, 0640);
}

static void test_links_are_followed(void **state)
{
	(void)state;
	struct stat file;
	write_text("real.png", "old");
	assert_int_equal(symlink("real.png", "link.png"), 0);
	assert_success(RUN("render", CYLINDER, "--size", "8x8", "-o", "link.png"));
	assert_png("real.png", 8, 8);
	assert_int_equal(lstat("link.png", &file), 0);
	assert_true(S_ISLNK(file.st_mode));
}

static void test_a_full_disk_leaves_the_old_file(void **state)
{
	(void)state;
	char kept[4] = "";
	write_text("out.png", "old");
	/* A file that grows beyond its limit fails where one on a full disk does. */
	struct outcome outcome = run_program(&(struct run){
		.arguments = {"render", CYLINDER, "-o", "out.png", "--size", "256x256"},
		.file_limit = 200,
		.environment = "MESA_SHADER_CACHE_DISABLE=true"});
	assert_failure(&outcome, 1, "cannot write out.png (File too large)");
	outcome_finish(&outcome);
	FILE *file = fopen("out.png", "r");
	assert_int_equal(fread(kept, 1, 3, file), 3);
	fclose(file);
	assert_string_equal(kept, "old");
	assert_int_equal(count_entries(""), 1);
}

static void test_folder_without_write_permission(void **state)
{
	(void)state;
	assert_int_equal(mkdir("closed", 0555), 0);
	if (access("closed", W_OK) == 0) /* root may */
		skip();
	struct outcome outcome = RUN("render", CYLINDER, "-o", "closed/out.png");
	assert_failure(&outcome, 2, "closed/out.png (Permission denied)");
	outcome_finish(&outcome);
}

static void test_an_interrupted_sequence_leaves_whole_pictures(void **state)
{
	(void)state;
	static const struct timespec pause = {.tv_nsec = 3000000};
	static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
	for (int i = 0; i < 9; i++) {
		pid_t pid = start_program(&(struct run){.arguments = {"render", CYLINDER, "--size",
								"64x64", "--frames", "100000"}});
		for (int wait = 0; wait < 3000 && count_entries("cylinder") <= (size_t)i; wait++)
			nanosleep(&pause, NULL);
		assert_int_equal(kill(pid, signals[i % 3]), 0);
		assert_int_equal(await_program(pid), 128 + signals[i % 3]);
		assert_true(count_entries("cylinder") > 0);
		assert_int_equal(count_entries("."), 0);
	}
	for (int number = 1; number <= (int)count_entries(""); number++) {
		char name[40];
		snprintf(name, sizeof(name), "cylinder-%04d.png", number);
		assert_png(name, 64, 64);
	}
}

static void test_a_signal_removes_the_guarded_file(void **state)
{
	(void)state;
	int status;
	write_text("half", "written");
	pid_t pid = fork();
	if (pid == 0) {
		signals_init();
		signals_guard("half");
		raise(SIGTERM);
		_exit(0);
	}
	assert_int_equal(waitpid(pid, &status, 0), pid);
	assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
	assert_int_equal(count_entries(""), 0);
}

static void test_signals_wait_while_suspended(void **state)
{
	(void)state;
	int status;
	pid_t pid = fork();
	if (pid == 0) {
		sigset_t before;
		signals_init();
		signals_suspend(&before);
		raise(SIGINT);
		write_text("survived", "");
		write_text("half", "written");
		signals_guard("half");
		signals_resume(&before);
		_exit(0);
	}
	assert_int_equal(waitpid(pid, &status, 0), pid);
	assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
	assert_int_equal(count_entries("survived"), 1);
	assert_int_equal(count_entries(""), 1);
}

/* Whether the signal came while the file was being written. */
static bool interrupt_writing(const void *bytes, size_t size)
{
	int status;
	pid_t pid = fork();
	if (pid == 0) {
		signals_init();
		_exit(output_write("big", bytes, size, NULL) ? 0 : 1);
	}
	pid_t ended = 0;
	while (count_entries("") == 0 && ended == 0)
		ended = waitpid(pid, &status, WNOHANG);
	if (ended == 0) {
		kill(pid, SIGTERM);
		waitpid(pid, &status, 0);
	}
	return WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM;
}

static void test_a_signal_while_writing_leaves_nothing(void **state)
{
	(void)state;
	const size_t size = 64u << 20; /* some 30 ms of writing */
	void *bytes = calloc(1, size);
	assert_non_null(bytes);
	bool interrupted = false;
	for (int i = 0; i < 20 && !interrupted; i++) {
		remove("big");
		interrupted = interrupt_writing(bytes, size);
	}
	free(bytes);
	assert_true(interrupted);
	assert_int_equal(count_entries(""), 0);
}

static void test_pipes_are_written_directly(void **state)
{
	(void)state;
	char text[8] = "";
	struct stat file;
	assert_int_equal(mkfifo("pipe", 0600), 0);
	int fd = open("pipe", O_RDWR | O_NONBLOCK | O_CLOEXEC);
	assert_true(fd >= 0);
	assert_true(output_write("pipe", "through", 7, NULL));
	assert_int_equal(read(fd, text, 7), 7);
	close(fd);
	assert_string_equal(text, "through");
	assert_int_equal(stat("pipe", &file), 0);
	assert_true(S_ISFIFO(file.st_mode));
}

static void test_a_terminal_gets_no_picture(void **state)
{
	(void)state;
	struct sm_error error = {0};
	int terminal = open("/dev/ptmx", O_RDWR | O_NOCTTY | O_CLOEXEC);
	if (terminal < 0)
		skip();
	fflush(stdout);
	int before = dup(STDOUT_FILENO);
	dup2(terminal, STDOUT_FILENO);
	bool allowed = output_check("-", &error);
	dup2(before, STDOUT_FILENO);
	close(before);
	close(terminal);
	assert_false(allowed);
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_non_null(strstr(error.text, "standard output is a terminal"));
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter_scratch, leave_scratch)

int main(void)
{
	const struct CMUnitTest tests[] = {
		IN_SCRATCH(test_pictures_of_all_sizes),
		IN_SCRATCH(test_samples_and_visibility_change_the_format_alone),
		IN_SCRATCH(test_visibility_is_linear),
		IN_SCRATCH(test_default_name_is_the_scene_in_the_working_folder),
		IN_SCRATCH(test_standard_output_holds_the_picture_alone),
		IN_SCRATCH(test_stats_name_every_stage),
		IN_SCRATCH(test_sequences_are_numbered),
		IN_SCRATCH(test_scenes_move_from_where_they_rest),
		IN_SCRATCH(test_an_animation_is_chosen),
		IN_SCRATCH(test_the_rate_of_frames_is_a_ratio),
		IN_SCRATCH(test_files_get_the_permissions_of_the_umask),
		IN_SCRATCH(test_links_are_followed),
		IN_SCRATCH(test_a_full_disk_leaves_the_old_file),
		IN_SCRATCH(test_folder_without_write_permission),
		IN_SCRATCH(test_an_interrupted_sequence_leaves_whole_pictures),
		IN_SCRATCH(test_a_signal_removes_the_guarded_file),
		IN_SCRATCH(test_signals_wait_while_suspended),
		IN_SCRATCH(test_a_signal_while_writing_leaves_nothing),
		IN_SCRATCH(test_pipes_are_written_directly),
		cmocka_unit_test(test_a_terminal_gets_no_picture),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
