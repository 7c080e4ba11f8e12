/* SPDX-License-Identifier: MIT */
#include "ref/archive.h"
#include "base/log.h"
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct header {
	char magic[8];
	struct content_id id;
	uint64_t count;
	struct content_id content; /* of the values, which follow */
};

static const char magic[8] = "SMREF 01";

/* FOLDER/ID.EXTENSION in PATH_MAX bytes. */
static bool file_path(
	const char *folder, const struct content_id *id, const char *extension, char *path)
{
	int length = snprintf(path, PATH_MAX, "%s/%016" PRIx64 "%016" PRIx64 ".%s", folder,
		id->words[0], id->words[1], extension);
	return length > 0 && length < PATH_MAX;
}

static struct header header_of(const struct content_id *id, const float *visibility, size_t count)
{
	struct header header = {
		.id = *id,
		.count = count,
		.content = content_id_of_bytes(visibility, count * sizeof(*visibility)),
	};
	memcpy(header.magic, magic, sizeof(magic));
	return header;
}

/* A pipe of that name would wait for a writer. */
static FILE *open_to_read(const char *path)
{
	int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
	FILE *file = fd >= 0 ? fdopen(fd, "rb") : NULL;
	if (file == NULL && fd >= 0)
		close(fd);
	return file;
}

bool archive_load(const char *folder, const struct content_id *id, float *visibility, size_t count)
{
	char path[PATH_MAX];
	struct header found;
	FILE *file = file_path(folder, id, "reference", path) ? open_to_read(path) : NULL;
	if (file == NULL)
		return false;
	bool whole = fread(&found, sizeof(found), 1, file) == 1 &&
		     fread(visibility, sizeof(*visibility), count, file) == count &&
		     fgetc(file) == EOF;
	fclose(file);
	if (whole) {
		struct header expected = header_of(id, visibility, count);
		whole = memcmp(&found, &expected, sizeof(found)) == 0;
	}
	if (!whole)
		log_debug("%s is damaged", path);
	return whole;
}

static bool write_values(int fd, const struct header *header, const float *visibility, size_t count)
{
	FILE *file = fdopen(fd, "wb");
	if (file == NULL) {
		close(fd);
		return false;
	}
	bool written = fwrite(header, sizeof(*header), 1, file) == 1 &&
		       fwrite(visibility, sizeof(*visibility), count, file) == count;
	/* A full disk may show here only. */
	return fclose(file) == 0 && written;
}

/* The same name each time: what a killed process leaves is written over. Who writes at once with
 * another writes the same bytes, and a file that is read too early is found to be damaged. */
void archive_save(
	const char *folder, const struct content_id *id, const float *visibility, size_t count)
{
	char path[PATH_MAX], part[PATH_MAX];
	struct header header = header_of(id, visibility, count);
	if (!file_path(folder, id, "reference", path) || !file_path(folder, id, "part", part))
		return;
	mkdir(folder, 0777);
	int fd = open(part, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
	bool saved =
		fd >= 0 && write_values(fd, &header, visibility, count) && rename(part, path) == 0;
	if (saved)
		return;
	log_debug("a reference is not kept in %s (%s)", folder, strerror(errno));
	if (fd >= 0)
		unlink(part);
}
