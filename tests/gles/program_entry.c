/* SPDX-License-Identifier: MIT */
#include "gles/program_entry.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char binary[] = "what a driver makes of two shaders";

static struct program_id id_of(const char *const *texts, size_t count)
{
	struct program_id id = program_id_start();
	for (size_t i = 0; i < count; i++)
		program_id_add(&id, texts[i]);
	return id;
}

/* To be freed. */
static struct program_entry *make_entry(const struct program_id *id, size_t *size)
{
	*size = sizeof(struct program_entry) + sizeof(binary);
	struct program_entry *entry = calloc(1, *size);
	assert_non_null(entry);
	entry->format = 0x875f;
	entry->length = sizeof(binary);
	memcpy(entry->binary, binary, sizeof(binary));
	program_entry_seal(entry, id);
	return entry;
}

static void a_sealed_entry_is_whole(void **state)
{
	(void)state;
	struct program_id id = id_of((const char *const[]){"a"}, 1);
	struct program_id other = id_of((const char *const[]){"b"}, 1);
	size_t size;
	struct program_entry *entry = make_entry(&id, &size);
	assert_true(program_entry_is_whole(entry, size, &id));
	assert_false(program_entry_is_whole(entry, size, &other));
	entry->length = 0;
	program_entry_seal(entry, &id);
	assert_true(program_entry_is_whole(entry, sizeof(*entry), &id));
	free(entry);
}

static void no_byte_can_change_unnoticed(void **state)
{
	(void)state;
	struct program_id id = id_of((const char *const[]){"a"}, 1);
	size_t size;
	struct program_entry *entry = make_entry(&id, &size);
	uint8_t *bytes = (uint8_t *)entry;
	for (size_t i = 0; i < size; i++) {
		for (int bit = 0; bit < 8; bit++) {
			bytes[i] ^= (uint8_t)(1 << bit);
			assert_false(program_entry_is_whole(entry, size, &id));
			bytes[i] ^= (uint8_t)(1 << bit);
		}
	}
	assert_true(program_entry_is_whole(entry, size, &id));
	free(entry);
}

/* In memory of exactly that size, so that reading beyond it is noticed. */
static void no_entry_can_be_cut_or_grown_unnoticed(void **state)
{
	(void)state;
	struct program_id id = id_of((const char *const[]){"a"}, 1);
	size_t size;
	struct program_entry *entry = make_entry(&id, &size);
	for (size_t length = 0; length <= size + 9; length++) {
		uint8_t *bytes = calloc(1, length > 0 ? length : 1);
		assert_non_null(bytes);
		memcpy(bytes, entry, length < size ? length : size);
		assert_int_equal(program_entry_is_whole(bytes, length, &id), length == size);
		free(bytes);
	}
	free(entry);
}

static void what_a_program_is_made_from_names_it(void **state)
{
	(void)state;
	static const char *const texts[][2] = {
		{"ab", "c"}, {"a", "bc"}, {"abc", ""}, {"", "abc"}, {"abc", "d"}, {"c", "ab"}};
	enum { COUNT = sizeof(texts) / sizeof(texts[0]) };
	char names[COUNT][PROGRAM_ID_NAME_SIZE];
	for (size_t i = 0; i < COUNT; i++) {
		struct program_id id = id_of(texts[i], 2);
		program_id_name(&id, names[i]);
		assert_int_equal(strlen(names[i]), 32);
		assert_int_equal(strspn(names[i], "0123456789abcdef"), 32);
		for (size_t j = 0; j < i; j++)
			assert_string_not_equal(names[i], names[j]);
	}
	struct program_id empty = id_of((const char *const[]){""}, 1);
	struct program_id null = id_of((const char *const[]){NULL}, 1);
	assert_memory_equal(&empty, &null, sizeof(empty));
}

/* draft-eastlake-fnv, appendix C: of "foobar" and its 0. */
static void the_hash_is_fnv_1a(void **state)
{
	(void)state;
	struct program_id id = id_of((const char *const[]){"foobar"}, 1);
	assert_true(id.words[0] == UINT64_C(0x34531ca7168b8f38));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_sealed_entry_is_whole),
		cmocka_unit_test(no_byte_can_change_unnoticed),
		cmocka_unit_test(no_entry_can_be_cut_or_grown_unnoticed),
		cmocka_unit_test(what_a_program_is_made_from_names_it),
		cmocka_unit_test(the_hash_is_fnv_1a),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
