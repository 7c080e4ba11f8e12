/* SPDX-License-Identifier: MIT */
/* Runs at build: writes every stage of every variant that the renderer may ask for into a folder,
 * for glslangValidator. */
#include "gles/shader_source.h"
#include <stdio.h>
#include <string.h>

static int write_stage(const char *folder, struct program_key key, enum shader_stage stage)
{
	char name[256], path[1200];
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
	for (size_t i = 0; i < count; i++)
		fputs(parts[i], file);
	return fclose(file) != 0;
}

int main(int argc, char **argv)
{
	if (argc != 2)
		return 2;
	for (int kind = 0; kind < PROGRAM_KINDS; kind++) {
		for (uint32_t flags = 0; flags < FLAG_END; flags++) {
			struct program_key key = {.kind = kind, .flags = flags};
			if (program_key_is_valid(key) &&
				(write_stage(argv[1], key, STAGE_VERTEX) ||
					write_stage(argv[1], key, STAGE_FRAGMENT)))
				return 1;
		}
	}
	return 0;
}
