/* SPDX-License-Identifier: MIT */
/* Runs at build: writes every stage of every variant that the renderer may ask for into a folder,
 * for glslangValidator. */
#include "gles/shader_source.h"
#include <stdio.h>
#include <string.h>

static int write_stage(const char *folder, struct program_key key, enum shader_stage stage)
{
	char name[320], path[1200];
	program_key_name(key, name, sizeof(name));
	for (char *c = name; *c != '\0'; c++)
		if (*c == ' ')
			*c = '.';
	snprintf(path, sizeof(path), "%s/%s.%s", folder, name,
		stage == STAGE_VERTEX ? "vert" : "frag");
	FILE *file = fopen(path, "w");
	if (file == NULL) {
		perror(path);
		return 1;
	}
	const char *parts[SHADER_PARTS_MAX];
	size_t count = shader_parts(key, stage, parts);
	/* glslang does not know the extension that reads what is in the target. */
	for (size_t i = 0; i < count; i++)
		fputs(strncmp(parts[i], "#extension", 10) == 0 ? "#define inout out\n" : parts[i],
			file);
	return fclose(file) != 0;
}

static int write_kind(const char *folder, enum program_kind kind)
{
	struct program_key key = {.kind = kind};
	do
		if (program_key_is_valid(key) && (write_stage(folder, key, STAGE_VERTEX) ||
							 write_stage(folder, key, STAGE_FRAGMENT)))
			return 1;
	while (program_key_next(&key));
	return 0;
}

int main(int argc, char **argv)
{
	if (argc != 2)
		return 2;
	for (int kind = 0; kind < PROGRAM_KINDS; kind++)
		if (write_kind(argv[1], kind))
			return 1;
	return 0;
}
