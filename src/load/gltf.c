/* SPDX-License-Identifier: MIT */
#include "load/gltf.h"
#include "base/array.h"
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { JSON_BYTES = 64 << 20 };

/** Bytes of the JSON, which starts where the file then stands: after the headers of a binary file
 *  and of its first chunk (glTF 2.0, section 4.4). */
static size_t find_json(FILE *file)
{
	uint8_t head[20];
	struct stat status;
	if (fstat(fileno(file), &status) != 0)
		return 0;
	if (fread(head, 1, sizeof(head), file) == sizeof(head) && memcmp(head, "glTF", 4) == 0)
		return head[12] | (size_t)head[13] << 8 | (size_t)head[14] << 16 |
		       (size_t)head[15] << 24;
	rewind(file);
	return (size_t)status.st_size;
}

/** Ends with 0; NULL: there is none. */
static char *read_json(FILE *file)
{
	size_t size = find_json(file);
	char *json = size <= JSON_BYTES ? array_alloc(size + 1, 1) : NULL;
	if (json != NULL)
		json[fread(json, 1, size, file)] = '\0';
	return json;
}

static bool has_word(const char *text, const char *word)
{
	return strncmp(text, word, strlen(word)) == 0;
}

/** Whether a key "interpolation" has such a value: no other object of glTF has such a key. */
static bool has_curves(const char *json)
{
	static const char key[] = "\"interpolation\"";
	for (const char *at = strstr(json, key); at != NULL; at = strstr(at, key)) {
		at += strlen(key);
		at += strspn(at, " \t\r\n:");
		if (has_word(at, "\"STEP\"") || has_word(at, "\"CUBICSPLINE\""))
			return true;
	}
	return false;
}

bool gltf_has_curves(const char *path)
{
	FILE *file = fopen(path, "rb");
	if (file == NULL)
		return false;
	char *json = read_json(file);
	bool found = json != NULL && has_curves(json);
	free(json);
	fclose(file);
	return found;
}
