/* SPDX-License-Identifier: MIT */
/* Compiled programs kept between renderers, in a store that may do anything to them. */
#include "canvas.h"
#include "gles/program_entry.h"
#include "parts.h"
#include "platform.h"
#include "rig.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 40
#define ENTRIES_MAX 16

struct entry {
	char name[PROGRAM_ID_NAME_SIZE];
	uint8_t *bytes; /* owned */
	size_t size;
};

struct store {
	struct entry entries[ENTRIES_MAX];
	size_t count;
	unsigned int saves;
	bool fails; /* to save */
};

static struct entry *find(struct store *store, const char *name)
{
	for (size_t i = 0; i < store->count; i++)
		if (strcmp(store->entries[i].name, name) == 0)
			return &store->entries[i];
	return NULL;
}

static size_t load(void *data, const char *name, void *bytes, size_t capacity)
{
	const struct entry *entry = find(data, name);
	if (entry == NULL)
		return 0;
	if (capacity > 0 && entry->size <= capacity)
		memcpy(bytes, entry->bytes, entry->size);
	return entry->size;
}

static void set_bytes(struct entry *entry, const void *bytes, size_t size)
{
	uint8_t *copy = malloc(size);
	assert_non_null(copy);
	memcpy(copy, bytes, size);
	free(entry->bytes);
	entry->bytes = copy;
	entry->size = size;
}

static void save(void *data, const char *name, const void *bytes, size_t size)
{
	struct store *store = data;
	store->saves++;
	if (store->fails)
		return;
	struct entry *entry = find(store, name);
	if (entry == NULL) {
		assert_true(store->count < ENTRIES_MAX);
		entry = &store->entries[store->count++];
		*entry = (struct entry){0};
		assert_int_equal(strlen(name), 32);
		strcpy(entry->name, name);
	}
	set_bytes(entry, bytes, size);
}

static void store_finish(struct store *store)
{
	for (size_t i = 0; i < store->count; i++)
		free(store->entries[i].bytes);
}

/* A new renderer's first frame. */
struct first_frame {
	uint8_t *rgba; /* owned */
	struct sm_frame_stats stats;
};

static struct first_frame draw(const struct rig *rig, const struct sm_program_store *store)
{
	struct first_frame frame;
	struct canvas canvas;
	struct sm_error error;
	struct sm_renderer *renderer = sm_renderer_create(platform_get_proc, &error);
	assert_non_null(renderer);
	canvas_init(&canvas, GL_RGBA8, SIZE, SIZE);
	struct sm_view view = {
		.camera = {.eye = {3, 4, 5}, .up = {0, 1, 0}, .fov = 50},
		.framebuffer = canvas.framebuffer,
		.width = SIZE,
		.height = SIZE,
		.visibility_of = SM_NONE,
	};
	sm_renderer_set_program_store(renderer, store);
	if (!sm_renderer_draw(renderer, rig->scene, &view, &error))
		fail_msg("%s", error.text);
	sm_renderer_get_stats(renderer, &frame.stats);
	frame.rgba = canvas_read(&canvas);
	canvas_finish(&canvas);
	sm_renderer_destroy(renderer);
	return frame;
}

static void set_up_scene(struct sm_scene *scene)
{
	struct sm_light_desc lamp = {.position = {1, 5, 0}, .radius = 0.3f, .angle = 80};
	parts_add_light(scene, &lamp);
	parts_add_object(scene, parts_add_cube(scene), PART_BOTH,
		&(struct pose){.scale = {0.5f, 0.5f, 0.5f}, .position = {0, 1, 0}});
	parts_add_object(
		scene, parts_add_square(scene), PART_RECEIVES, &(struct pose){.scale = {3, 1, 3}});
}

/* Skips what needs a driver that hands out binaries; Mesa does with its shader cache alone. */
static void need_binaries(void)
{
	GLint formats = 0;
	glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
	if (formats == 0) {
		print_message("this driver has no program binaries\n");
		skip();
	}
}

/* Draws with the store, and asserts the picture and how many programs were compiled of all. */
static void assert_frame(const struct rig *rig, struct store *store,
	const struct first_frame *plain, uint32_t compiled)
{
	struct sm_program_store calls = {store, load, save};
	struct first_frame frame = draw(rig, &calls);
	assert_memory_equal(frame.rgba, plain->rgba, SIZE * SIZE * 4);
	assert_int_equal(frame.stats.programs_compiled, compiled);
	assert_int_equal(frame.stats.programs_loaded, plain->stats.programs_compiled - compiled);
	free(frame.rgba);
}

static void a_second_renderer_compiles_nothing(void **state)
{
	struct rig *rig = *state;
	struct store store = {0};
	need_binaries();
	set_up_scene(rig->scene);
	struct first_frame plain = draw(rig, NULL);
	uint32_t all = plain.stats.programs_compiled;
	assert_true(all > 2);
	assert_int_equal(plain.stats.programs_loaded, 0);
	assert_frame(rig, &store, &plain, all);
	assert_int_equal(store.saves, all);
	assert_int_equal(store.count, all);
	assert_frame(rig, &store, &plain, 0);
	assert_int_equal(store.saves, all);
	store_finish(&store);
	free(plain.rgba);
}

/* One program of the store is not there any more. */
static void assert_made_anew(
	const struct rig *rig, struct store *store, const struct first_frame *plain)
{
	assert_frame(rig, store, plain, 1);
	assert_frame(rig, store, plain, 0);
}

/* Whole, but of something else: what a driver that has changed would see. */
static void replace_binary(struct entry *entry)
{
	struct program_entry *whole = (struct program_entry *)entry->bytes;
	struct program_id id = whole->id;
	memset(whole->binary, 0x5a, whole->length);
	program_entry_seal(whole, &id);
}

static void damaged_entries_are_compiled_and_saved_anew(void **state)
{
	struct rig *rig = *state;
	struct store store = {0};
	need_binaries();
	set_up_scene(rig->scene);
	struct first_frame plain = draw(rig, NULL);
	assert_frame(rig, &store, &plain, plain.stats.programs_compiled);
	struct entry *entry = &store.entries[1];
	const size_t flips[] = {offsetof(struct program_entry, magic),
		offsetof(struct program_entry, checksum), offsetof(struct program_entry, id),
		offsetof(struct program_entry, format), offsetof(struct program_entry, length),
		offsetof(struct program_entry, binary), entry->size / 2, entry->size - 1};
	const size_t cuts[] = {0, 20, sizeof(struct program_entry), entry->size - 1};
	for (size_t i = 0; i < sizeof(flips) / sizeof(flips[0]); i++) {
		entry->bytes[flips[i]] ^= 0x10;
		assert_made_anew(rig, &store, &plain);
	}
	for (size_t i = 0; i < sizeof(cuts) / sizeof(cuts[0]); i++) {
		entry->size = cuts[i];
		assert_made_anew(rig, &store, &plain);
	}
	replace_binary(entry);
	assert_made_anew(rig, &store, &plain);
	store_finish(&store);
	free(plain.rgba);
}

static void entries_under_the_wrong_name_are_not_used(void **state)
{
	struct rig *rig = *state;
	struct store store = {0};
	char name[PROGRAM_ID_NAME_SIZE];
	need_binaries();
	set_up_scene(rig->scene);
	struct first_frame plain = draw(rig, NULL);
	assert_frame(rig, &store, &plain, plain.stats.programs_compiled);
	strcpy(name, store.entries[0].name);
	strcpy(store.entries[0].name, store.entries[1].name);
	strcpy(store.entries[1].name, name);
	assert_frame(rig, &store, &plain, 2);
	store_finish(&store);
	free(plain.rgba);
}

static void a_store_that_fails_changes_nothing(void **state)
{
	struct rig *rig = *state;
	struct store store = {.fails = true};
	set_up_scene(rig->scene);
	struct first_frame plain = draw(rig, NULL);
	for (int i = 0; i < 2; i++)
		assert_frame(rig, &store, &plain, plain.stats.programs_compiled);
	free(plain.rgba);
}

static void a_store_may_be_read_only_or_write_only(void **state)
{
	struct rig *rig = *state;
	struct store store = {0};
	need_binaries();
	set_up_scene(rig->scene);
	struct first_frame plain = draw(rig, NULL);
	struct first_frame written =
		draw(rig, &(struct sm_program_store){.data = &store, .save = save});
	assert_int_equal(written.stats.programs_loaded, 0);
	assert_true(store.count > 0);
	struct first_frame read =
		draw(rig, &(struct sm_program_store){.data = &store, .load = load});
	assert_int_equal(read.stats.programs_compiled, 0);
	assert_memory_equal(read.rgba, plain.rgba, SIZE * SIZE * 4);
	store_finish(&store);
	free(read.rgba);
	free(written.rgba);
	free(plain.rgba);
}

/* What a renderer says of branches, after yes or no. */
struct branch_fact {
	char text[96];
	unsigned int percent;
};

static void note_branch(void *data, const char *key, const char *value)
{
	struct branch_fact *fact = data;
	const char *share = strstr(value, "take ");
	if (strcmp(key, "cap slow_branch") != 0)
		return;
	snprintf(fact->text, sizeof(fact->text), "%s", value);
	fact->percent = share != NULL ? (unsigned int)atoi(share + strlen("take ")) : 0;
}

static struct branch_fact describe_branch(struct store *store)
{
	struct branch_fact fact = {0};
	struct sm_program_store calls = {store, load, save};
	struct sm_renderer *renderer = sm_renderer_create(platform_get_proc, NULL);
	assert_non_null(renderer);
	sm_renderer_set_program_store(renderer, &calls);
	sm_renderer_describe(renderer, note_branch, &fact);
	sm_renderer_destroy(renderer);
	return fact;
}

static void what_was_timed_is_kept(void **state)
{
	(void)state;
	struct store store = {0};
	need_binaries();
	struct branch_fact timed = describe_branch(&store), kept = describe_branch(&store);
	assert_null(strstr(timed.text, "kept"));
	assert_non_null(strstr(kept.text, "kept"));
	assert_int_equal(kept.percent, timed.percent);
	assert_memory_equal(kept.text, timed.text, strlen("no"));
	/* Damaged, it is timed again. */
	for (size_t i = 0; i < store.count; i++)
		store.entries[i].bytes[offsetof(struct program_entry, format)] ^= 1;
	assert_null(strstr(describe_branch(&store).text, "kept"));
	store_finish(&store);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(a_second_renderer_compiles_nothing),
		rig_test(damaged_entries_are_compiled_and_saved_anew),
		rig_test(entries_under_the_wrong_name_are_not_used),
		rig_test(a_store_that_fails_changes_nothing),
		rig_test(a_store_may_be_read_only_or_write_only),
		rig_test(what_was_timed_is_kept),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
