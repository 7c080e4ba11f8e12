/* SPDX-License-Identifier: MIT */
#include "base/log.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

struct lines {
	int count;
	enum sm_log_level level; /* of the last one */
	char text[2000];
};

static void note(void *data, enum sm_log_level level, const char *line)
{
	struct lines *lines = data;
	lines->count++;
	lines->level = level;
	snprintf(lines->text, sizeof(lines->text), "%s", line);
}

static void nothing_listens_at_first(void **state)
{
	(void)state;
	log_error("%s", "unheard");
}

static void lines_reach_the_sink_with_their_level(void **state)
{
	(void)state;
	struct lines lines = {0};
	log_set_sink(note, &lines);
	log_error("%d of %s", 1, "these");
	assert_int_equal(lines.level, SM_LOG_ERROR);
	assert_string_equal(lines.text, "1 of these");
	log_warning("2");
	assert_int_equal(lines.level, SM_LOG_WARNING);
	log_info("3");
	assert_int_equal(lines.level, SM_LOG_INFO);
	log_debug("4");
	assert_int_equal(lines.level, SM_LOG_DEBUG);
	assert_int_equal(lines.count, 4);
}

static void a_null_sink_silences(void **state)
{
	(void)state;
	struct lines lines = {0};
	log_set_sink(note, &lines);
	log_set_sink(NULL, &lines);
	log_error("unheard");
	assert_int_equal(lines.count, 0);
}

static void a_long_line_is_cut(void **state)
{
	(void)state;
	struct lines lines = {0};
	char text[1500];
	memset(text, 'a', sizeof(text));
	text[sizeof(text) - 1] = '\0';
	log_set_sink(note, &lines);
	log_info("%s", text);
	assert_int_equal(strlen(lines.text), 999);
	log_set_sink(NULL, NULL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(nothing_listens_at_first),
		cmocka_unit_test(lines_reach_the_sink_with_their_level),
		cmocka_unit_test(a_null_sink_silences),
		cmocka_unit_test(a_long_line_is_cut),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
