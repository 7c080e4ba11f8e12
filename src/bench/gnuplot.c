/* SPDX-License-Identifier: MIT */
#include "bench/gnuplot.h"
#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static bool spawn(FILE *script, FILE *output, pid_t *child, struct sm_error *error)
{
	/* Without the user's start-up file, so that charts are the same everywhere. */
	static char *const arguments[] = {"gnuplot", "-d", NULL};
	posix_spawn_file_actions_t actions;
	int code = posix_spawn_file_actions_init(&actions);
	if (code != 0)
		return error_set(error, SM_ERROR_MACHINE, "gnuplot: %s", strerror(code));
	code = posix_spawn_file_actions_adddup2(&actions, fileno(script), STDIN_FILENO);
	if (code == 0)
		code = posix_spawn_file_actions_adddup2(&actions, fileno(output), STDOUT_FILENO);
	if (code == 0)
		code = posix_spawnp(child, arguments[0], &actions, NULL, arguments, environ);
	posix_spawn_file_actions_destroy(&actions);
	return code == 0 ||
	       error_set(error, SM_ERROR_MACHINE, "cannot run gnuplot (%s)", strerror(code));
}

static bool wait_for(pid_t child, struct sm_error *error)
{
	int status;
	while (waitpid(child, &status, 0) < 0)
		if (errno != EINTR)
			return error_set(error, SM_ERROR_MACHINE, "gnuplot: %s", strerror(errno));
	return (WIFEXITED(status) && WEXITSTATUS(status) == 0) ||
	       error_set(error, SM_ERROR_MACHINE, "gnuplot failed (status 0x%x)", (unsigned)status);
}

bool gnuplot_run(FILE *script, FILE **output, struct sm_error *error)
{
	pid_t child;
	/* A file, as a pipe could fill up while the script is still being sent. */
	*output = tmpfile();
	if (*output == NULL || fflush(script) != 0 || lseek(fileno(script), 0, SEEK_SET) != 0)
		error_set(error, SM_ERROR_MACHINE, "cannot keep a chart (%s)", strerror(errno));
	else if (spawn(script, *output, &child, error) && wait_for(child, error)) {
		rewind(*output);
		return true;
	}
	if (*output != NULL)
		fclose(*output);
	*output = NULL;
	return false;
}
