/* SPDX-License-Identifier: MIT */
/* In the place of libFuzzer: hands a target every file of its corpus, once. */
#include "expect.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>

/* In memory of exactly its size, so that a sanitizer sees any read beyond. */
static void replay(const char *path)
{
	FILE *file = fopen(path, "rb");
	expect(file != NULL && fseek(file, 0, SEEK_END) == 0);
	long size = ftell(file);
	rewind(file);
	uint8_t *bytes = size >= 0 ? malloc((size_t)size) : NULL;
	expect(size == 0 || (bytes != NULL && fread(bytes, 1, (size_t)size, file) == (size_t)size));
	LLVMFuzzerTestOneInput(bytes, (size_t)size);
	free(bytes);
	fclose(file);
}

int main(int argc, char **argv)
{
	struct dirent **files;
	int replayed = 0, count = argc == 2 ? scandir(argv[1], &files, NULL, alphasort) : -1;
	for (int i = 0; i < count; i++) {
		char path[4096];
		snprintf(path, sizeof(path), "%s/%s", argv[1], files[i]->d_name);
		if (files[i]->d_name[0] != '.') {
			printf("%s\n", path);
			fflush(stdout); /* before it aborts */
			replay(path);
			replayed++;
		}
		free(files[i]);
	}
	if (count >= 0)
		free(files);
	if (replayed == 0)
		fprintf(stderr, "usage: %s FOLDER, which holds a corpus\n", argv[0]);
	return replayed > 0 ? 0 : 2;
}
