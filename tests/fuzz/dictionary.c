/* SPDX-License-Identifier: MIT */
/* Prints libFuzzer's dictionary of what scene files and settings are made of. */
#include "load/builtin.h"
#include "load/key.h"
#include <stdio.h>
#include <string.h>

static void print_words(const char *words)
{
	for (size_t length; *words != '\0'; words += length + (words[length] == '|')) {
		length = strcspn(words, "|");
		printf("\"%.*s\"\n", (int)length, words);
	}
}

static void print_key(const struct key *key)
{
	const char *section = section_name(key->section);
	const char *name = section_is_named(key->section) ? " a" : "";
	printf("\"[%s%s]\\x0a%s = \"\n\"%s.%s=\"\n", section, name, key->name, section, key->name);
	if (key->words != NULL)
		print_words(key->words);
	if (key->initial != NULL)
		print_words(key->initial);
}

int main(void)
{
	const struct key *key;
	const char *name;
	for (size_t i = 0; (key = key_at(i)) != NULL; i++)
		print_key(key);
	for (size_t i = 0; (name = builtin_name(i)) != NULL; i++)
		printf("\"builtin:%s\"\n", name);
	return 0;
}
