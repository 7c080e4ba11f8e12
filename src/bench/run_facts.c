/* SPDX-License-Identifier: MIT */
#include "bench/run_facts.h"
#include "base/array.h"
#include "bench/commit.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

static void add(struct run_facts *facts, const char *key, const char *value)
{
	void *items = facts->items;
	struct run_fact fact = {strdup(key), strdup(value)};
	if (fact.key != NULL && fact.value != NULL &&
		array_reserve(&items, &facts->capacity, facts->count + 1, sizeof(fact))) {
		facts->items = items;
		facts->items[facts->count++] = fact;
		return;
	}
	free(fact.key);
	free(fact.value);
	facts->failed = true;
}

void run_facts_add(struct run_facts *facts, const char *key, const char *format, ...)
{
	char value[401];
	va_list args;
	va_start(args, format);
	vsnprintf(value, sizeof(value), format, args);
	va_end(args);
	add(facts, key, value);
}

void run_facts_driver(void *data, const char *key, const char *value)
{
	char name[128];
	snprintf(name, sizeof(name), "driver %s", key);
	add(data, name, value);
}

/* A shell takes these as they are. */
static bool is_plain(const char *word)
{
	static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
				    "-_./:=,+@%";
	return word[0] != '\0' && strspn(word, plain) == strlen(word);
}

static void print_word(FILE *file, const char *word)
{
	if (is_plain(word)) {
		fputs(word, file);
		return;
	}
	fputc('\'', file);
	for (; *word != '\0'; word++)
		if (*word == '\'')
			fputs("'\\''", file);
		else
			fputc(*word, file);
	fputc('\'', file);
}

static void add_command(struct run_facts *facts, int argc, char *const *argv)
{
	char *text = NULL;
	size_t size;
	FILE *file = open_memstream(&text, &size);
	if (file == NULL) {
		facts->failed = true;
		return;
	}
	fputs("smoothie", file);
	for (int i = 0; i < argc; i++) {
		fputc(' ', file);
		print_word(file, argv[i]);
	}
	if (fclose(file) == 0)
		add(facts, "command", text);
	else
		facts->failed = true;
	free(text);
}

static void add_date(struct run_facts *facts)
{
	char text[32];
	time_t now = time(NULL);
	struct tm parts;
	if (gmtime_r(&now, &parts) != NULL && strftime(text, sizeof(text), "%FT%TZ", &parts) > 0)
		add(facts, "date", text);
}

/* Linux names x86 processors in "model name" and some others in "Hardware" or "Model". */
static void add_processor(struct run_facts *facts)
{
	static const char *const keys[] = {"model name", "Hardware", "Model"};
	char line[256], name[128] = "not known";
	FILE *file = fopen("/proc/cpuinfo", "re");
	while (file != NULL && fgets(line, sizeof(line), file) != NULL) {
		char *value = strchr(line, ':');
		size_t key = 0;
		while (key < 3 && strncmp(line, keys[key], strlen(keys[key])) != 0)
			key++;
		if (key == 3 || value == NULL)
			continue;
		snprintf(name, sizeof(name), "%s", value + 1 + strspn(value + 1, " "));
		name[strcspn(name, "\n")] = '\0';
		break;
	}
	if (file != NULL)
		fclose(file);
	add(facts, "processor", name);
}

void run_facts_init(struct run_facts *facts, int argc, char *const *argv)
{
	struct utsname system;
	*facts = (struct run_facts){0};
	add(facts, "version", SMOOTHIE_VERSION);
	add(facts, "commit", SMOOTHIE_COMMIT);
	add_date(facts);
	add_command(facts, argc, argv);
	if (uname(&system) == 0)
		run_facts_add(facts, "system", "%s %s %s", system.sysname, system.release,
			system.machine);
	add_processor(facts);
	run_facts_add(facts, "cores", "%ld", sysconf(_SC_NPROCESSORS_ONLN));
}

const char *run_facts_get(const struct run_facts *facts, const char *key)
{
	for (size_t i = 0; i < facts->count; i++)
		if (strcmp(facts->items[i].key, key) == 0)
			return facts->items[i].value;
	return "";
}

void run_facts_machine(const struct run_facts *facts, char *text, size_t size)
{
	snprintf(text, size, "%s, %s cores, %s, %s", run_facts_get(facts, "processor"),
		run_facts_get(facts, "cores"), run_facts_get(facts, "driver renderer"),
		run_facts_get(facts, "driver version"));
}

void run_facts_finish(struct run_facts *facts)
{
	for (size_t i = 0; i < facts->count; i++) {
		free(facts->items[i].key);
		free(facts->items[i].value);
	}
	free(facts->items);
	*facts = (struct run_facts){0};
}
