/* SPDX-License-Identifier: MIT */
#include "app/signals.h"
#include <stdbool.h>
#include <stddef.h>
#include <unistd.h>

static const int ending[] = {SIGHUP, SIGINT, SIGTERM};
static const size_t ending_count = sizeof(ending) / sizeof(ending[0]);

static const char *volatile guarded;
static volatile sig_atomic_t *noted;

/* SA_RESETHAND has restored the default action: raising again ends the program as the sender
 * expects. */
static void handle(int number)
{
	if (guarded != NULL)
		unlink(guarded);
	raise(number);
}

static bool is_ignored(int number)
{
	struct sigaction action;
	return sigaction(number, NULL, &action) == 0 && action.sa_handler == SIG_IGN;
}

void signals_init(void)
{
	for (size_t i = 0; i < ending_count; i++) {
		/* nohup has made SIGHUP ignored: leave it so. */
		if (is_ignored(ending[i]))
			continue;
		struct sigaction action = {.sa_handler = handle, .sa_flags = SA_RESETHAND};
		sigaction(ending[i], &action, NULL);
	}
	signal(SIGXFSZ, SIG_IGN);
}

static void note(int number)
{
	*noted = number;
}

void signals_note(volatile sig_atomic_t *number)
{
	noted = number;
	for (size_t i = 0; i < ending_count; i++)
		if (!is_ignored(ending[i])) {
			struct sigaction action = {
				.sa_handler = note, .sa_flags = SA_RESETHAND | SA_RESTART};
			sigaction(ending[i], &action, NULL);
		}
}

void signals_leave_to_parent(void)
{
	signal(SIGHUP, SIG_IGN);
	signal(SIGINT, SIG_IGN);
	signal(SIGTERM, SIG_DFL);
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
