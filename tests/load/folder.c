/* SPDX-License-Identifier: MIT */
#include "folder.h"
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[] = "/tmp/smoothie-test-XXXXXX";

int folder_make(void **state)
{
	(void)state;
	return mkdtemp(folder) != NULL ? 0 : -1;
}

int folder_remove(void **state)
{
	(void)state;
	DIR *listing = opendir(folder);
	for (struct dirent *entry = readdir(listing); entry != NULL; entry = readdir(listing))
		if (entry->d_name[0] != '.')
			unlink(folder_path(entry->d_name));
	closedir(listing);
	return rmdir(folder);
}

const char *folder_path(const char *name)
{
	static char paths[2][512];
	static int next;
	next = 1 - next;
	snprintf(paths[next], sizeof(paths[next]), "%s/%s", folder, name);
	return paths[next];
}

const char *folder_write(const char *name, const void *bytes, size_t size)
{
	const char *path = folder_path(name);
	FILE *file = fopen(path, "wb");
	assert_non_null(file);
	assert_int_equal(fwrite(bytes, 1, size, file), size);
	assert_int_equal(fclose(file), 0);
	return path;
}

const char *folder_write_text(const char *name, const char *text)
{
	return folder_write(name, text, strlen(text));
}
