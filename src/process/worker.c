/* SPDX-License-Identifier: MIT */
#include "process/worker.h"
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

bool worker_start(
	struct worker_process *process, const struct worker *worker, struct sm_error *error)
{
	*process = (struct worker_process){
		.worker = worker, .found = worker_share(sizeof(*process->found))};
	if (process->found == NULL)
		return error_no_memory(error);
	fflush(NULL);
	pid_t parent = getpid();
	process->pid = fork();
	if (process->pid == 0)
		work(worker, parent, process->found);
	if (process->pid > 0)
		return true;
	error_set(error, SM_ERROR_MACHINE, "%s: no process for it (%s)", worker->name,
		strerror(errno));
	worker_unshare(process->found, sizeof(*process->found));
	*process = (struct worker_process){0};
	return false;
}

/* status: of waitpid(), or -1 where that fails. */
static enum worker_end judge(
	const char *name, int status, const struct sm_error *found, struct sm_error *error)
{
	if (WIFEXITED(status) && WEXITSTATUS(status) == SM_OK)
		return WORKER_DONE;
	if (WIFEXITED(status) && found->text[0] != '\0') {
		error_set(error, found->status, "%s", found->text);
		return WORKER_FAILED;
	}
	if (WIFSIGNALED(status))
		error_set(error, SM_ERROR_MACHINE, "%s: the process for it crashed (%s)", name,
			strsignal(WTERMSIG(status)));
	else
		error_set(error, SM_ERROR_MACHINE, "%s: the process for it ended early (status %d)",
			name, WIFEXITED(status) ? WEXITSTATUS(status) : -1);
	return WORKER_CRASHED;
}

enum worker_end worker_poll(struct worker_process *process, struct sm_error *error)
{
	int status = -1;
	pid_t ended = waitpid(process->pid, &status, WNOHANG);
	if (ended == 0 || (ended < 0 && errno == EINTR))
		return WORKER_RUNNING;
	enum worker_end end = judge(
		process->worker->name, ended == process->pid ? status : -1, process->found, error);
	worker_unshare(process->found, sizeof(*process->found));
	*process = (struct worker_process){0};
	return end;
}

void worker_stop(struct worker_process *process)
{
	if (process->pid > 0) {
		kill(process->pid, SIGKILL);
		while (waitpid(process->pid, NULL, 0) < 0 && errno == EINTR)
			;
	}
	worker_unshare(process->found, sizeof(*process->found));
	*process = (struct worker_process){0};
}

bool worker_run(const struct worker *worker, struct sm_error *error)
{
	static const struct timespec pause = {.tv_nsec = 5000000};
	struct worker_process process;
	enum worker_end end;
	if (!worker_start(&process, worker, error))
		return false;
	while ((end = worker_poll(&process, error)) == WORKER_RUNNING) {
		if (worker->watch != NULL)
			worker->watch(worker->watch_data);
		nanosleep(&pause, NULL);
	}
	return end == WORKER_DONE;
}
