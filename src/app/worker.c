/* SPDX-License-Identifier: MIT */
#include "app/worker.h"
#include "base/error.h"
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

void *worker_share(size_t size)
{
	void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
	return memory != MAP_FAILED ? memory : NULL;
}

void worker_unshare(void *memory, size_t size)
{
	if (memory != NULL)
		munmap(memory, size);
}

/* Never returns. Leaves to the parent what waits to be written by it. */
static void work(const struct worker *worker, pid_t parent, struct sm_error *error)
{
	prctl(PR_SET_PDEATHSIG, SIGTERM);
	if (getppid() != parent) /* it ended before that */
		_exit(SM_ERROR_MACHINE);
	_exit(worker->work(worker->data, error) ? SM_OK : SM_ERROR_MACHINE);
}

/* Waits for the child's end. Returns what waitpid() says of it, or -1. */
static int await(const struct worker *worker, pid_t child)
{
	static const struct timespec pause = {.tv_nsec = 5000000};
	int status;
	pid_t ended;
	while ((ended = waitpid(child, &status, WNOHANG)) == 0 || (ended < 0 && errno == EINTR)) {
		if (worker->watch != NULL)
			worker->watch(worker->watch_data);
		nanosleep(&pause, NULL);
	}
	return ended == child ? status : -1;
}

static bool judge(const struct worker *worker, int status, const struct sm_error *found,
	struct sm_error *error)
{
	if (WIFEXITED(status) && WEXITSTATUS(status) == SM_OK)
		return true;
	if (WIFEXITED(status) && found->text[0] != '\0')
		return error_set(error, found->status, "%s", found->text);
	if (WIFSIGNALED(status))
		return error_set(error, SM_ERROR_MACHINE, "%s: the process for it crashed (%s)",
			worker->name, strsignal(WTERMSIG(status)));
	return error_set(error, SM_ERROR_MACHINE, "%s: the process for it ended early (status %d)",
		worker->name, WIFEXITED(status) ? WEXITSTATUS(status) : -1);
}

bool worker_run(const struct worker *worker, struct sm_error *error)
{
	struct sm_error *found = worker_share(sizeof(*found));
	if (found == NULL)
		return error_no_memory(error);
	fflush(NULL);
	pid_t parent = getpid(), child = fork();
	if (child == 0)
		work(worker, parent, found);
	bool done = child > 0 ? judge(worker, await(worker, child), found, error)
			      : error_set(error, SM_ERROR_MACHINE, "%s: no process for it (%s)",
					worker->name, strerror(errno));
	worker_unshare(found, sizeof(*found));
	return done;
}
