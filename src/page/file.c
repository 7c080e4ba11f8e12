/* SPDX-License-Identifier: MIT */
#include "page/file.h"
#include <stdlib.h>

bool file_print(const char *path, void (*print)(FILE *file, const void *data), const void *data,
	file_writer write, struct sm_error *error)
{
	char *text = NULL;
	size_t size = 0;
	FILE *file = open_memstream(&text, &size);
	if (file == NULL)
		return error_no_memory(error);
	print(file, data);
	bool printed = ferror(file) == 0;
	printed = fclose(file) == 0 && printed;
	bool written = printed ? write(path, text, size, error) : error_no_memory(error);
	free(text);
	return written;
}
