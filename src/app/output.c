/* SPDX-License-Identifier: MIT */
#include "app/output.h"
#include "app/signals.h"
#include "base/error.h"
#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The user chose a path that does not serve, or the machine failed on one that does. */
static enum sm_status status_of(int code)
{
	static const int choices[] = {
		EACCES, EISDIR, ELOOP, ENAMETOOLONG, ENOENT, ENOTDIR, EPERM, EROFS, ENXIO};
	for (size_t i = 0; i < sizeof(choices) / sizeof(choices[0]); i++)
		if (choices[i] == code)
			return SM_ERROR_INPUT;
	return SM_ERROR_MACHINE;
}

static bool fail(struct sm_error *error, const char *path, int code)
{
	return error_set(error, status_of(code), "cannot write %.300s (%s)", path, strerror(code));
}

static bool is_standard_output(const char *path)
{
	return strcmp(path, "-") == 0;
}

/* Neither a regular file nor a folder, so there is nothing to replace. */
static bool is_device(const char *path)
{
	struct stat file;
	return stat(path, &file) == 0 && !S_ISREG(file.st_mode) && !S_ISDIR(file.st_mode);
}

/* Where the file really is or will be: PATH_MAX bytes. */
static bool resolve(const char *path, char *resolved, struct sm_error *error)
{
	if (realpath(path, resolved) != NULL) {
		struct stat file;
		if (stat(resolved, &file) == 0 && S_ISDIR(file.st_mode))
			return fail(error, path, EISDIR);
		return true;
	}
	if (errno != ENOENT || path[0] == '\0' || path[strlen(path) - 1] == '/')
		return fail(error, path, errno);
	if (strlen(path) >= PATH_MAX)
		return fail(error, path, ENAMETOOLONG);
	strcpy(resolved, path);
	return true;
}

bool output_check(const char *path, struct sm_error *error)
{
	char resolved[PATH_MAX];
	if (is_standard_output(path))
		return !isatty(STDOUT_FILENO) ||
		       error_set(error, SM_ERROR_INPUT,
			       "-o -: standard output is a terminal; send it to a file or a pipe");
	if (is_device(path))
		return true;
	if (!resolve(path, resolved, error))
		return false;
	return access(dirname(resolved), W_OK | X_OK) == 0 || fail(error, path, errno);
}

static bool write_all(int fd, const char *bytes, size_t size)
{
	while (size > 0) {
		ssize_t written = write(fd, bytes, size);
		if (written < 0 && errno == EINTR)
			continue;
		if (written < 0)
			return false;
		bytes += written;
		size -= (size_t)written;
	}
	return true;
}

/* Closes fd after `written`, keeping the first failure in errno: a full disk may show here only. */
static bool close_written(int fd, bool written)
{
	int code = errno;
	bool closed = close(fd) == 0;
	if (!written)
		errno = code;
	return written && closed;
}

static bool write_directly(const char *path, const void *bytes, size_t size, struct sm_error *error)
{
	int fd = is_standard_output(path) ? dup(STDOUT_FILENO) : open(path, O_WRONLY | O_CLOEXEC);
	if (fd >= 0 && close_written(fd, write_all(fd, bytes, size)))
		return true;
	return fail(error, is_standard_output(path) ? "standard output" : path, errno);
}

/* What open() gives to a new file. */
static mode_t usual_mode(void)
{
	mode_t mask = umask(0);
	umask(mask);
	return 0666 & ~mask;
}

static int open_temporary(char *temporary)
{
	sigset_t before;
	signals_suspend(&before);
	int fd = mkstemp(temporary);
	if (fd >= 0)
		signals_guard(temporary);
	signals_resume(&before);
	return fd;
}

/* Gives the temporary file its name if it is whole, or removes it; keeps errno. */
static bool settle_temporary(const char *temporary, const char *target, bool whole)
{
	sigset_t before;
	signals_suspend(&before);
	bool settled = whole && rename(temporary, target) == 0;
	int code = errno;
	if (!settled)
		unlink(temporary);
	signals_guard(NULL);
	signals_resume(&before);
	errno = code;
	return settled;
}

/* Puts a whole file of that mode in the place of path. */
static bool replace(
	const char *path, const void *bytes, size_t size, mode_t mode, struct sm_error *error)
{
	static const char suffix[] = "/" OUTPUT_TEMPORARY "XXXXXX";
	char target[PATH_MAX], folder[PATH_MAX], temporary[PATH_MAX + sizeof(suffix)];
	if (!resolve(path, target, error))
		return false;
	strcpy(folder, target);
	snprintf(temporary, sizeof(temporary), "%s%s", dirname(folder), suffix);
	int fd = open_temporary(temporary);
	if (fd < 0)
		return fail(error, path, errno);
	bool whole = close_written(fd, fchmod(fd, mode) == 0 && write_all(fd, bytes, size));
	return settle_temporary(temporary, target, whole) || fail(error, path, errno);
}

bool output_write(const char *path, const void *bytes, size_t size, struct sm_error *error)
{
	if (is_standard_output(path) || is_device(path))
		return write_directly(path, bytes, size, error);
	return replace(path, bytes, size, usual_mode(), error);
}

bool output_write_private(const char *path, const void *bytes, size_t size, struct sm_error *error)
{
	return replace(path, bytes, size, S_IRUSR | S_IWUSR, error);
}
