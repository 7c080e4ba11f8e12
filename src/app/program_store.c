/* SPDX-License-Identifier: MIT */
#include "app/program_store.h"
#include "app/output.h"
#include "base/array.h"
#include "base/log.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A few dozen programs are all that one driver ever has. */
#define ENTRIES_MAX 200
#define ENTRY_BYTES_MAX (4 << 20)

#define SUFFIX ".program"

/* The name of an entry's file in PATH_MAX bytes. */
static bool entry_path(const struct program_store *store, const char *name, char *path)
{
	return snprintf(path, PATH_MAX, "%s/%s" SUFFIX, store->folder, name) < PATH_MAX;
}

/* A driver trusts its binaries: nobody else may have written this one. */
static bool is_trusted(const struct stat *file)
{
	return S_ISREG(file->st_mode) && (file->st_uid == geteuid() || file->st_uid == 0) &&
	       (file->st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

static bool read_all(int fd, char *bytes, size_t size)
{
	while (size > 0) {
		ssize_t done = read(fd, bytes, size);
		if (done < 0 && errno == EINTR)
			continue;
		if (done <= 0)
			return false;
		bytes += done;
		size -= (size_t)done;
	}
	return true;
}

static size_t read_entry(int fd, void *bytes, size_t capacity)
{
	struct stat file;
	if (fstat(fd, &file) != 0 || !is_trusted(&file) || file.st_size > ENTRY_BYTES_MAX)
		return 0;
	size_t size = (size_t)file.st_size;
	return size > capacity || read_all(fd, bytes, size) ? size : 0;
}

static size_t load(void *data, const char *name, void *bytes, size_t capacity)
{
	char path[PATH_MAX];
	if (!entry_path(data, name, path))
		return 0;
	/* A pipe of that name would wait for a writer. */
	int fd = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
	if (fd < 0)
		return 0;
	size_t size = read_entry(fd, bytes, capacity);
	close(fd);
	return size;
}

static void save(void *data, const char *name, const void *bytes, size_t size)
{
	char path[PATH_MAX];
	struct sm_error error;
	if (size > ENTRY_BYTES_MAX || !entry_path(data, name, path))
		log_debug("a compiled program of %zu bytes is not kept", size);
	else if (!output_write_private(path, bytes, size, &error))
		log_debug("%s", error.text);
}

/* Makes it and what it lies in, for the user alone. */
static bool make_folder(char *path)
{
	for (char *slash = path + 1; (slash = strchr(slash, '/')) != NULL; slash++) {
		*slash = '\0';
		mkdir(path, S_IRWXU);
		*slash = '/';
	}
	mkdir(path, S_IRWXU);
	struct stat folder;
	if (stat(path, &folder) != 0)
		return false;
	errno = ENOTDIR;
	return S_ISDIR(folder.st_mode) && access(path, R_OK | X_OK) == 0;
}

/* PARENT/BELOW as a folder that is there, to be freed, or NULL. */
static char *have_folder(const char *parent, size_t length, const char *below)
{
	size_t size = length + strlen(below) + 1;
	char *path = length > 0 ? array_alloc(size, 1) : NULL;
	if (path == NULL)
		return NULL;
	snprintf(path, size, "%.*s%s", (int)length, parent, below);
	if (make_folder(path))
		return path;
	log_debug("compiled programs are not kept in %s (%s)", path, strerror(errno));
	free(path);
	return NULL;
}

static char *choose_folder(void)
{
	static const struct {
		const char *variable, *below;
	} places[] = {
		{"STATE_DIRECTORY", "/programs"}, /* of a systemd unit; several are a list by ":" */
		{"XDG_CACHE_HOME", "/smoothie/programs"},
		{"HOME", "/.cache/smoothie/programs"},
	};
	const char *chosen = getenv("SMOOTHIE_CACHE_DIR");
	if (chosen != NULL)
		return have_folder(chosen, strlen(chosen), "");
	char *folder = NULL;
	for (size_t i = 0; i < sizeof(places) / sizeof(places[0]) && folder == NULL; i++) {
		const char *parent = getenv(places[i].variable);
		/* The XDG base directory specification has relative paths ignored. */
		if (parent != NULL && parent[0] == '/')
			folder = have_folder(parent, strcspn(parent, ":"), places[i].below);
	}
	return folder;
}

/* Entries, and what a loss of power has left of them in the making. */
static int is_entry(const struct dirent *file)
{
	const char *dot = strrchr(file->d_name, '.');
	return (dot != NULL && strcmp(dot, SUFFIX) == 0) ||
	       strncmp(file->d_name, OUTPUT_TEMPORARY, strlen(OUTPUT_TEMPORARY)) == 0;
}

struct aged_entry {
	char *name; /* of the list by scandir() */
	struct timespec written;
};

static int compare_ages(const void *a, const void *b)
{
	const struct timespec *x = &((const struct aged_entry *)a)->written;
	const struct timespec *y = &((const struct aged_entry *)b)->written;
	if (x->tv_sec != y->tv_sec)
		return x->tv_sec < y->tv_sec ? -1 : 1;
	return (x->tv_nsec > y->tv_nsec) - (x->tv_nsec < y->tv_nsec);
}

/* Removes the oldest of these files of the folder until ENTRIES_MAX are left. */
static void remove_oldest(int folder, struct dirent **files, size_t count)
{
	struct aged_entry *entries = array_zalloc(count, sizeof(*entries));
	if (entries == NULL)
		return;
	for (size_t i = 0; i < count; i++) {
		struct stat file;
		entries[i].name = files[i]->d_name;
		if (fstatat(folder, entries[i].name, &file, AT_SYMLINK_NOFOLLOW) == 0)
			entries[i].written = file.st_mtim;
	}
	qsort(entries, count, sizeof(*entries), compare_ages);
	for (size_t i = 0; i + ENTRIES_MAX < count; i++)
		unlinkat(folder, entries[i].name, 0);
	free(entries);
}

static void limit_entries(const char *path)
{
	struct dirent **files;
	int count = scandir(path, &files, is_entry, NULL);
	if (count < 0)
		return;
	int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
	if (folder >= 0 && count > ENTRIES_MAX)
		remove_oldest(folder, files, (size_t)count);
	if (folder >= 0)
		close(folder);
	for (int i = 0; i < count; i++)
		free(files[i]);
	free(files);
}

void program_store_init(struct program_store *store)
{
	*store = (struct program_store){.folder = choose_folder()};
	if (store->folder == NULL)
		return;
	log_debug("compiled programs are kept in %s", store->folder);
	limit_entries(store->folder);
	store->calls = (struct sm_program_store){store, load, save};
}

void program_store_finish(struct program_store *store)
{
	free(store->folder);
	*store = (struct program_store){0};
}
