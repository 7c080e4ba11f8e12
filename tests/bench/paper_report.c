/* SPDX-License-Identifier: MIT */
#include "bench/paper_report.h"
#include "paper_results.h"
#include "results.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Commas of a line that are not in quotes. */
static int count_commas(const char *line, size_t length)
{
	int commas = 0;
	bool quoted = false;
	for (size_t i = 0; i < length; i++) {
		quoted ^= line[i] == '"';
		commas += line[i] == ',' && !quoted;
	}
	assert_false(quoted);
	return commas;
}

/* Lines, each of eight fields. */
static size_t check_csv(const char *text)
{
	size_t lines = 0;
	for (; *text != '\0'; lines++) {
		size_t length = strcspn(text, "\n");
		assert_int_equal(count_commas(text, length), 7);
		assert_true(text[length] == '\n');
		text += length + 1;
	}
	return lines;
}

static void csv_has_a_number_a_line(void **state)
{
	struct paper_result ideal = paper_ideal();
	struct text text = {0};
	(void)state;
	paper_csv_write(&ideal, text_begin(&text));
	const char *csv = text_end(&text);
	/* 6 counts, 4 qualities, 9 + 4 + 2 times of 4 scenes; 4 of 8 meshes; 4 of 6 sizes; 5
	 * errors of 2, and 2 of 3; 2 more; the head */
	assert_int_equal(check_csv(csv), 4 * 25 + 4 * 8 + 4 * 6 + 5 * 2 + 2 * 3 + 2 + 1);
	assert_non_null(strstr(csv, "table,name,technique,map,t,quantity,value,unit\n"));
	assert_non_null(strstr(csv, "scenes,\"scene, 0\",hard,256,,frame,10,ms\n"));
	assert_non_null(strstr(csv, "scenes,\"scene, 0\",smoothie,512,0.2,frame,11.2,ms\n"));
	assert_non_null(strstr(csv, "maps,\"urchin\",smoothie,8192,,buffers,5,ms\n"));
	text_finish(&text);
}

static void csv_leaves_out_what_was_not_measured(void **state)
{
	struct paper_result nothing = paper_nothing();
	struct text text = {0};
	(void)state;
	paper_csv_write(&nothing, text_begin(&text));
	assert_int_equal(check_csv(text_end(&text)), 1);
	text_finish(&text);
}

static int count_cells(const char *line, size_t length)
{
	int cells = 0;
	for (size_t i = 0; i < length; i++)
		cells += line[i] == '|';
	return cells;
}

/* Rows of a table have as many cells as its head. */
static void check_tables(const char *text)
{
	int cells = 0;
	size_t tables = 0;
	while (*text != '\0') {
		size_t length = strcspn(text, "\n");
		int now = text[0] == '|' ? count_cells(text, length) : 0;
		tables += now > 0 && cells == 0;
		if (now > 0 && cells > 0 && now != cells)
			fail_msg("%.*s", (int)length, text);
		cells = now;
		text += length + (text[length] == '\n');
	}
	assert_int_equal(tables, 7);
}

static void markdown_has_whole_tables(void **state)
{
	struct paper_result results[] = {paper_ideal(), paper_nothing()};
	(void)state;
	for (size_t i = 0; i < 2; i++) {
		struct text text = {0};
		paper_markdown_write(&results[i], text_begin(&text));
		const char *markdown = text_end(&text);
		check_tables(markdown);
		assert_null(strstr(markdown, "nan"));
		assert_null(strstr(markdown, "inf"));
		assert_non_null(strstr(markdown, "(paper-edges.svg)"));
		assert_non_null(strstr(markdown, "(paper-maps.svg)"));
		text_finish(&text);
	}
}

static void markdown_says_what_is_judged(void **state)
{
	struct paper_result ideal = paper_ideal();
	struct text text = {0};
	(void)state;
	paper_markdown_write(&ideal, text_begin(&text));
	const char *markdown = text_end(&text);
	assert_non_null(
		strstr(markdown, "| scene, 3 | 5700 | 40000 | 60000 | 0 | 0 | 2000 | 4000 |\n"));
	assert_non_null(strstr(markdown, "| 4096 | 10.00 | 5.00 | 1.50 | 20.0 | 30.0 | 3.8 | 5.4 | "
					 "1.42 |\n"));
	assert_non_null(strstr(markdown, "| Fixed point of 12 bits suffices for the smoothie "
					 "buffer. | Chan & Durand 2003 | **holds** | penumbra RMSE "
					 "against ray tracing in fixed12 0.2302, "));
	text_finish(&text);
}

static void plots_hold_each_point(void **state)
{
	struct paper_result ideal = paper_ideal();
	static const char *const points[PAPER_PLOTS] = {"\n1000000 50 ", "\n8192 10 15\n"};
	(void)state;
	for (int plot = 0; plot < PAPER_PLOTS; plot++)
		for (int svg = 0; svg < 2; svg++) {
			struct text text = {0};
			paper_plot_write(&ideal, plot, svg, text_begin(&text));
			const char *script = text_end(&text);
			assert_non_null(strstr(script, points[plot]));
			assert_non_null(strstr(script, svg ? "terminal svg" : "terminal pngcairo"));
			text_finish(&text);
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(csv_has_a_number_a_line),
		cmocka_unit_test(csv_leaves_out_what_was_not_measured),
		cmocka_unit_test(markdown_has_whole_tables),
		cmocka_unit_test(markdown_says_what_is_judged),
		cmocka_unit_test(plots_hold_each_point),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
