/* SPDX-License-Identifier: MIT */
#include "app/command.h"
#include "app/options.h"
#include "app/report.h"
#include "app/signals.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>

static const struct command *const commands[] = {
	&render_command, &show_command, &check_command, &bench_command, &info_command};
static const size_t command_count = sizeof(commands) / sizeof(commands[0]);

static void print_usage(void)
{
	printf("usage: smoothie COMMAND ...\n"
	       "Soft shadows on OpenGL ES 3.\n\n");
	for (size_t i = 0; i < command_count; i++)
		printf("  %-12s %s\n", commands[i]->name, commands[i]->summary);
	printf("  %-12s %s\n\n", "help COMMAND", "show a command's flags");
	printf("  --help       show this\n"
	       "  --version    show the version\n");
}

/* Insertions, deletions and replacements that turn a into b (Levenshtein), for short words. */
static size_t edit_distance(const char *a, const char *b)
{
	size_t row[16];
	size_t length = strlen(b);
	for (size_t j = 0; j <= length; j++)
		row[j] = j;
	for (size_t i = 0; a[i] != '\0'; i++) {
		size_t diagonal = row[0];
		row[0] = i + 1;
		for (size_t j = 0; j < length; j++) {
			size_t replaced = diagonal + (a[i] != b[j]);
			size_t shorter = (row[j] < row[j + 1] ? row[j] : row[j + 1]) + 1;
			diagonal = row[j + 1];
			row[j + 1] = replaced < shorter ? replaced : shorter;
		}
	}
	return row[length];
}

static const struct command *find_command(const char *name, struct sm_error *error)
{
	const struct command *nearest = NULL;
	size_t least = 3; /* edits: more are another word */
	for (size_t i = 0; i < command_count; i++) {
		size_t distance = edit_distance(name, commands[i]->name);
		if (distance == 0)
			return commands[i];
		if (distance < least) {
			least = distance;
			nearest = commands[i];
		}
	}
	if (nearest != NULL)
		error_set(error, SM_ERROR_INPUT, "no command \"%.100s\"; did you mean \"%s\"?",
			name, nearest->name);
	else
		error_set(
			error, SM_ERROR_INPUT, "no command \"%.100s\"; see smoothie --help", name);
	return NULL;
}

static bool help(int argc, char **argv, struct sm_error *error)
{
	if (argc < 2) {
		print_usage();
		return true;
	}
	const struct command *command = find_command(argv[1], error);
	if (command != NULL)
		options_help(command);
	return command != NULL;
}

static bool run(int argc, char **argv, struct sm_error *error)
{
	if (argc < 2)
		return error_set(
			error, SM_ERROR_INPUT, "a command is missing; see smoothie --help");
	if (strcmp(argv[1], "--version") == 0) {
		printf("smoothie %s\n", sm_version());
		return true;
	}
	if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)
		return help(1, argv, error);
	if (strcmp(argv[1], "help") == 0)
		return help(argc - 1, argv + 1, error);
	const struct command *command = find_command(argv[1], error);
	return command != NULL && command->run(argc - 1, argv + 1, error);
}

int main(int argc, char **argv)
{
	struct sm_error error = {0};
	signals_init();
	if (!run(argc, argv, &error))
		return report_error(&error);
	if (fflush(stdout) != 0 || ferror(stdout)) {
		error_set(&error, SM_ERROR_MACHINE, "cannot write to standard output (%s)",
			strerror(errno));
		return report_error(&error);
	}
	return 0;
}
