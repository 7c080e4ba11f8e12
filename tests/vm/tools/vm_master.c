/* SPDX-License-Identifier: MIT */
/* vm_master CARD [PID]: is the card's master until SIGTERM. With PID, takes that from this process
 * first, shows the test pattern instead, and gives it back at the end. */
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <xf86drm.h>

#include "card.h"

/* The number of the first open file of a process with this path, or -1. */
static int find_file(const char *pid, const char *path)
{
	for (int number = 3; number < 1024; number++) {
		char link[64], target[PATH_MAX];
		snprintf(link, sizeof(link), "/proc/%s/fd/%d", pid, number);
		ssize_t length = readlink(link, target, sizeof(target) - 1);
		if (length < 0)
			continue;
		target[length] = '\0';
		if (!strcmp(target, path))
			return number;
	}
	return -1;
}

/* The process's own file of the card that is master, through the back door. */
static int steal(const char *pid, const char *path)
{
	int number = find_file(pid, path);
	demand(number >= 0, "the process has no such file");
	int process = (int)syscall(SYS_pidfd_open, atoi(pid), 0);
	demand(process >= 0, "pidfd_open");
	int stolen = (int)syscall(SYS_pidfd_getfd, process, number, 0);
	demand(stolen >= 0, "pidfd_getfd");
	demand(!drmDropMaster(stolen), "drmDropMaster");
	return stolen;
}

int main(int argc, char **argv)
{
	if (argc < 2) {
		fputs("usage: vm_master CARD [PID]\n", stderr);
		return 2;
	}
	int stolen = argc > 2 ? steal(argv[2], argv[1]) : -1;
	int card = card_open(argv[1]);
	demand(!drmSetMaster(card), "drmSetMaster");
	if (stolen >= 0)
		show_pattern(card, "640x480");
	sleep_until_told("master");
	demand(!drmDropMaster(card), "drmDropMaster");
	demand(stolen < 0 || !drmSetMaster(stolen), "drmSetMaster, giving back");
	return 0;
}
