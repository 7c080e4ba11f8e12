/* SPDX-License-Identifier: MIT */
/* Where closed parts are hollow. */
#include "geom/caster.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#define VERTICES 9

/* A cube whose top is a fan around its middle. */
static const uint32_t cube[][3] = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
	{2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}, {4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 4, 8}};

#define TRIANGLES (sizeof(cube) / sizeof(cube[0]))

static void place(float positions[VERTICES][3], float height)
{
	const float placed[VERTICES][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},
		{1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5f, 0.5f, height}};
	memcpy(positions, placed, sizeof(placed));
}

/* With the middle at a height; open: without its floor. */
static void make(struct caster *caster, float height, bool open)
{
	float positions[VERTICES][3];
	size_t first = open ? 2 : 0;
	place(positions, height);
	assert_true(caster_init(caster, (const float(*)[3])positions, VERTICES, &cube[first][0],
		TRIANGLES - first));
}

/* Moves the middle. */
static void move(struct caster *caster, float height)
{
	float positions[VERTICES][3];
	place(positions, height);
	assert_true(caster_let_move(caster));
	caster_move(caster, (const float(*)[3])positions);
}

static void dents_are_hollow_and_nothing_else(void **state)
{
	(void)state;
	static const struct {
		float height;
		bool open;
		size_t hollows;
	} rows[] = {{0.5f, false, 2 * 4}, {1.0f, false, 0}, {1.5f, false, 0}, {0.99f, false, 0},
		{0.5f, true, 0}};
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct caster caster;
		make(&caster, rows[i].height, rows[i].open);
		assert_int_equal(caster.hollows.count, rows[i].hollows);
		caster_finish(&caster);
	}
}

/* Which they are is asked of where its vertices are, not of where they were at first. */
static void a_mesh_that_moves_is_hollow_where_it_is(void **state)
{
	(void)state;
	static const struct {
		float at_first, then;
		bool open;
		size_t hollows;
	} rows[] = {{1.5f, 0.5f, false, 2 * 4}, {0.5f, 1.5f, false, 0}, {0.5f, 0.5f, false, 2 * 4},
		{1.0f, 0.99f, false, 0}, {1.5f, 0.5f, true, 0}};
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct caster caster;
		size_t hollows = 0;
		make(&caster, rows[i].at_first, rows[i].open);
		move(&caster, 1.25f);
		move(&caster, rows[i].then);
		for (size_t k = 0; k < caster.hollows.count; k++)
			hollows += hollow_rises(&caster.hollows.of[k],
				(const float(*)[3])caster.positions, caster.indices);
		assert_int_equal(hollows, rows[i].hollows);
		caster_finish(&caster);
	}
}

/* Each edge is there as both of its triangles see it, in the order of triangles. */
static void assert_seen_from_both_sides(const struct caster *caster)
{
	const struct hollows *hollows = &caster->hollows;
	for (size_t i = 0; i < hollows->count; i++) {
		const struct hollow *hollow = &hollows->of[i];
		uint32_t corner = hollow->corner, beside = corner / 3, matched = 0, shared = 0;
		assert_true(i == 0 || hollow[-1].triangle <= hollow->triangle);
		for (size_t k = 0; k < hollows->count; k++)
			matched += hollows->of[k].triangle == beside &&
				   hollows->of[k].corner / 3 == hollow->triangle;
		assert_int_equal(matched, 1);
		for (uint32_t k = 0; k < 3; k++) {
			uint32_t vertex = caster->indices[3 * hollow->triangle + k];
			shared += vertex == caster->indices[corner];
			shared += vertex == caster->indices[3 * beside + (corner + 1) % 3];
		}
		assert_int_equal(shared, 2);
	}
	assert_int_equal(hollows->ends[0], hollows->count);
}

/* All edges, of a mesh that moves. */
static void hollows_are_seen_from_both_sides(void **state)
{
	(void)state;
	struct caster caster;
	make(&caster, 0.5f, false);
	assert_seen_from_both_sides(&caster);
	move(&caster, 1.5f);
	assert_int_equal(caster.hollows.count, 3 * TRIANGLES);
	assert_seen_from_both_sides(&caster);
	caster_finish(&caster);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(dents_are_hollow_and_nothing_else),
		cmocka_unit_test(a_mesh_that_moves_is_hollow_where_it_is),
		cmocka_unit_test(hollows_are_seen_from_both_sides),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
