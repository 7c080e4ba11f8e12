/* SPDX-License-Identifier: MIT */
#include "load/child.h"
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/** Address space of this process in bytes; a limit must count it in, for a sanitizer's shadow
 *  alone takes terabytes. 0 if unknown. */
static size_t mapped_bytes(void)
{
	unsigned long pages = 0;
	FILE *file = fopen("/proc/self/statm", "r");
	if (file == NULL)
		return 0;
	if (fscanf(file, "%lu", &pages) != 1)
		pages = 0;
	fclose(file);
	return pages * (size_t)sysconf(_SC_PAGESIZE);
}

static void confine(unsigned seconds, size_t bytes)
{
	/* The parent's handlers would clean up what is the parent's, or survive a crash. */
	for (int i = 1; i < NSIG; i++)
		signal(i, SIG_DFL);
	sigset_t none;
	sigemptyset(&none);
	sigprocmask(SIG_SETMASK, &none, NULL);

	size_t mapped = mapped_bytes();
	struct rlimit memory;
	if (mapped > 0 && getrlimit(RLIMIT_AS, &memory) == 0 && mapped + bytes < memory.rlim_cur) {
		memory.rlim_cur = mapped + bytes;
		setrlimit(RLIMIT_AS, &memory);
	}
	prctl(PR_SET_DUMPABLE, 0); /* a crash is expected: no core file */
	int nowhere = open("/dev/null", O_RDWR);
	if (nowhere >= 0) {
		dup2(nowhere, STDOUT_FILENO);
		dup2(nowhere, STDERR_FILENO);
	}
	alarm(seconds);
}

enum child_end child_run(bool (*work)(void *data), void *data, unsigned seconds, size_t bytes)
{
	pid_t child = fork();
	if (child < 0)
		return CHILD_MISSING;
	if (child == 0) {
		confine(seconds, bytes);
		_exit(work(data) ? 0 : 1);
	}
	int status;
	while (waitpid(child, &status, 0) < 0)
		if (errno != EINTR)
			return CHILD_CRASHED;
	if (WIFEXITED(status) && WEXITSTATUS(status) <= 1)
		return WEXITSTATUS(status) == 0 ? CHILD_SUCCEEDED : CHILD_FAILED;
	return WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM ? CHILD_SLOW : CHILD_CRASHED;
}
