/* SPDX-License-Identifier: MIT */
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

/* As a shell would start it: a caller such as nohup may have us ignore signals. */
static void heed_signals(posix_spawnattr_t *attributes)
{
	sigset_t heeded;
	sigemptyset(&heeded);
	sigaddset(&heeded, SIGHUP);
	sigaddset(&heeded, SIGINT);
	sigaddset(&heeded, SIGTERM);
	posix_spawnattr_init(attributes);
	posix_spawnattr_setsigdefault(attributes, &heeded);
	posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETSIGDEF);
}

static pid_t spawn(const struct run *run, int out, int error)
{
	char *argv[MAX_ARGUMENTS + 2] = {(char *)SMOOTHIE_PROGRAM};
	char *environment[1000] = {(char *)run->environment};
	size_t count = run->environment != NULL ? 1 : 0;
	for (size_t i = 0; i < MAX_ARGUMENTS && run->arguments[i] != NULL; i++)
		argv[i + 1] = (char *)run->arguments[i];
	for (size_t i = 0; environ[i] != NULL && count < 999; i++)
		environment[count++] = environ[i];

	posix_spawn_file_actions_t actions;
	posix_spawn_file_actions_init(&actions);
	posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
	posix_spawn_file_actions_adddup2(&actions, error, STDERR_FILENO);
	posix_spawnattr_t attributes;
	heed_signals(&attributes);
	pid_t pid;
	int code = posix_spawn(&pid, argv[0], &actions, &attributes, argv, environment);
	posix_spawnattr_destroy(&attributes);
	posix_spawn_file_actions_destroy(&actions);
	assert_int_equal(code, 0);
	return pid;
}

int await_program(pid_t pid)
{
	/* One that hangs; sanitizers on a busy machine take ten seconds of some. */
	enum { SECONDS_MOST = 60, POLLS_A_SECOND = 500 };
	static const struct timespec pause = {.tv_nsec = 1000000000 / POLLS_A_SECOND};
	int status;
	for (int i = 0; i < SECONDS_MOST * POLLS_A_SECOND; i++) {
		if (waitpid(pid, &status, WNOHANG) == pid)
			return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
		nanosleep(&pause, NULL);
	}
	kill(pid, SIGKILL);
	waitpid(pid, &status, 0);
	return -1;
}

static char *read_all(FILE *file, size_t *size)
{
	fseek(file, 0, SEEK_END);
	*size = (size_t)ftell(file);
	char *text = calloc(1, *size + 1);
	assert_non_null(text);
	rewind(file);
	assert_int_equal(fread(text, 1, *size, file), *size);
	return text;
}

struct outcome run_program(const struct run *run)
{
	struct rlimit before, limited;
	FILE *out = tmpfile(), *error = tmpfile();
	assert_true(out != NULL && error != NULL);
	getrlimit(RLIMIT_FSIZE, &before);
	limited = before;
	if (run->file_limit > 0)
		limited.rlim_cur = run->file_limit;
	setrlimit(RLIMIT_FSIZE, &limited);
	pid_t pid = spawn(run, fileno(out), fileno(error));
	setrlimit(RLIMIT_FSIZE, &before);

	struct outcome outcome = {.status = await_program(pid)};
	size_t error_size;
	outcome.out = read_all(out, &outcome.out_size);
	outcome.error = read_all(error, &error_size);
	fclose(out);
	fclose(error);
	return outcome;
}

void outcome_finish(struct outcome *outcome)
{
	free(outcome->out);
	free(outcome->error);
	*outcome = (struct outcome){0};
}

pid_t start_program(const struct run *run)
{
	int null = open("/dev/null", O_RDWR | O_CLOEXEC);
	pid_t pid = spawn(run, null, null);
	close(null);
	return pid;
}

void assert_failure(const struct outcome *outcome, int status, const char *text)
{
	const char *end = strchr(outcome->error, '\n');
	if (outcome->status != status || strncmp(outcome->error, "smoothie: ", 10) != 0 ||
		end == NULL || end[1] != '\0' || strstr(outcome->error, text) == NULL)
		fail_msg("wanted status %d and one line with \"%s\"; got status %d and:\n%s",
			status, text, outcome->status, outcome->error);
}

void assert_output(const struct outcome *outcome, const char *const *texts, size_t count)
{
	assert_int_equal(outcome->status, 0);
	assert_string_equal(outcome->error, "");
	for (size_t i = 0; i < count; i++)
		if (strstr(outcome->out, texts[i]) == NULL)
			fail_msg("text %zu of the expected is not in\n%s", i, outcome->out);
}

int enter_scratch(void **state)
{
	char path[] = "/tmp/smoothie-test-XXXXXX";
	if (mkdtemp(path) == NULL || chdir(path) != 0)
		return -1;
	*state = strdup(path);
	return *state != NULL ? 0 : -1;
}

static bool is_entry(const char *name)
{
	return strcmp(name, ".") != 0 && strcmp(name, "..") != 0;
}

/* Tests make no folders but empty ones. */
int leave_scratch(void **state)
{
	DIR *folder = opendir(*state);
	assert_non_null(folder);
	for (struct dirent *entry; (entry = readdir(folder)) != NULL;)
		if (is_entry(entry->d_name))
			assert_int_equal(remove(entry->d_name), 0);
	closedir(folder);
	int result = rmdir(*state);
	free(*state);
	return chdir("/") != 0 ? -1 : result;
}

size_t count_entries(const char *prefix)
{
	size_t count = 0;
	DIR *folder = opendir(".");
	assert_non_null(folder);
	for (struct dirent *entry; (entry = readdir(folder)) != NULL;)
		count += is_entry(entry->d_name) &&
			 strncmp(entry->d_name, prefix, strlen(prefix)) == 0;
	closedir(folder);
	return count;
}

void write_text(const char *path, const char *text)
{
	FILE *file = fopen(path, "w");
	assert_non_null(file);
	fputs(text, file);
	fclose(file);
}

bool program_same_files(const char *a, const char *b)
{
	FILE *files[] = {fopen(a, "rb"), fopen(b, "rb")};
	assert_true(files[0] != NULL && files[1] != NULL);
	int bytes[2];
	do
		for (int i = 0; i < 2; i++)
			bytes[i] = fgetc(files[i]);
	while (bytes[0] == bytes[1] && bytes[0] != EOF);
	fclose(files[0]);
	fclose(files[1]);
	return bytes[0] == bytes[1];
}
