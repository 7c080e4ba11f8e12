/* SPDX-License-Identifier: MIT */
#include "faults.h"
#include "gles/shader_source.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *join(GLsizei count, const GLchar *const *strings, const GLint *lengths)
{
	char *text = NULL;
	size_t size = 0;
	FILE *stream = open_memstream(&text, &size);
	for (GLsizei i = 0; stream != NULL && i < count; i++) {
		bool ends = lengths == NULL || lengths[i] < 0;
		fwrite(strings[i], 1, ends ? strlen(strings[i]) : (size_t)lengths[i], stream);
	}
	if (stream == NULL || fclose(stream) != 0)
		abort();
	return text;
}

/* Of what must come before any function: the version, and extensions. */
static size_t head_length(const char *source)
{
	const char *head = source;
	for (const char *line = source; *line != '\0'; line += strspn(line, "\n")) {
		bool first =
			strncmp(line, "#version", 8) == 0 || strncmp(line, "#extension", 10) == 0;
		line += strcspn(line, "\n");
		if (first)
			head = line;
	}
	return (size_t)(head - source);
}

char *shift_look_ups(GLsizei count, const GLchar *const *strings, const GLint *lengths)
{
	char *source = join(count, strings, lengths), *shifted = NULL;
	size_t size = 0, head = head_length(source);
	bool es_300 = strncmp(source, "#version 300", 12) == 0;
	FILE *stream = open_memstream(&shifted, &size);
	if (stream == NULL)
		abort();
	fprintf(stream, "%.*s\n%s%s%s", (int)head, source, shader_files[0].text,
		es_300 ? "" : shader_files[1].text, source + head);
	if (fclose(stream) != 0)
		abort();
	free(source);
	return shifted;
}
