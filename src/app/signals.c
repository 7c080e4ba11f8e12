/* SPDX-License-Identifier: MIT */
#include "app/signals.h"
#include <stddef.h>
#include <unistd.h>

static const int ending[] = {SIGHUP, SIGINT, SIGTERM};
static const size_t ending_count = sizeof(ending) / sizeof(ending[0]);

static const char *volatile guarded;

/* SA_RESETHAND has restored the default action: raising again ends the program as the sender
 * expects. */
static void handle(int number)
{
	if (guarded != NULL)
		unlink(guarded);
	raise(number);
}

void signals_init(void)
{
	for (size_t i = 0; i < ending_count; i++) {
		struct sigaction action;
		/* nohup has made SIGHUP ignored: leave it so. */
		if (sigaction(ending[i], NULL, &action) != 0 || action.sa_handler == SIG_IGN)
			continue;
		action = (struct sigaction){.sa_handler = handle, .sa_flags = SA_RESETHAND};
		sigaction(ending[i], &action, NULL);
	}
	signal(SIGXFSZ, SIG_IGN);
}

void signals_suspend(sigset_t *before)
{
	sigset_t set;
	sigemptyset(&set);
	for (size_t i = 0; i < ending_count; i++)
		sigaddset(&set, ending[i]);
	pthread_sigmask(SIG_BLOCK, &set, before);
}

void signals_resume(const sigset_t *before)
{
	pthread_sigmask(SIG_SETMASK, before, NULL);
}

void signals_guard(const char *path)
{
	guarded = path;
}
