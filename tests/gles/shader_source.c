/* SPDX-License-Identifier: MIT */
#include "gles/shader_source.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* Flags as #defines, in shader source. */
static const struct {
	uint64_t flag;
	const char *name;
} flags[] = {
	{FLAG_SINUSOID, "SINUSOID"},
	{FLAG_DEPTH_ONLY, "DEPTH_ONLY"},
	{FLAG_RECEIVER_MAP, "RECEIVER_MAP"},
	{FLAG_LIT, "LIT"},
	{FLAG_SHADOWED, "SHADOWED"},
	{FLAG_HARD, "HARD"},
	{FLAG_SMOOTHIE, "SMOOTHIE"},
	{FLAG_SEPARATE_DEPTH, "SEPARATE_DEPTH"},
	{FLAG_GATHER, "GATHER"},
	{FLAG_TEXTURED, "TEXTURED"},
	{FLAG_VISIBILITY, "VISIBILITY"},
	{FLAG_ENCODE_SRGB, "ENCODE_SRGB"},
	{FLAG_DITHER, "DITHER"},
	{FLAG_WIDEN, "WIDEN"},
	{FLAG_STORED, "STORED"},
	{FLAG_TWO_SIDED, "TWO_SIDED"},
	{FLAG_CONE, "CONE"},
	{FLAG_BICUBIC, "BICUBIC"},
	{FLAG_PCSS, "PCSS"},
	{FLAG_MAPS, "MAPS"},
	{FLAG_VSM, "VSM"},
	{FLAG_FOUR_FETCHES, "FOUR_FETCHES"},
	{FLAG_FROM_DEPTH, "FROM_DEPTH"},
	{FLAG_ALPHA_DEPTH, "ALPHA_DEPTH"},
	{FLAG_FETCH, "FETCH"},
	{FLAG_DEPTH_FLOAT, "DEPTH_FLOAT"},
	{FLAG_DEPTH_HALF, "DEPTH_HALF"},
	{FLAG_DEPTH_PACKED, "DEPTH_PACKED"},
	{FLAG_SPLIT, "SPLIT"},
	{FLAG_FIXED12, "FIXED12"},
	{FLAG_SEEN, "SEEN"},
	{FLAG_EDGES, "EDGES"},
	{FLAG_PEEL, "PEEL"},
	{FLAG_RUNS, "RUNS"},
	{FLAG_COARSE, "COARSE"},
	{FLAG_BEHIND, "BEHIND"},
	{FLAG_TWO_LAYERS, "TWO_LAYERS"},
	{FLAG_HOLLOWS, "HOLLOWS"},
	{FLAG_SAMPLES, "SAMPLES"},
	{FLAG_FLAT_INPUTS, "FLAT_INPUTS"},
	{FLAG_FUSED, "FUSED"},
	{FLAG_IMAGES, "IMAGES"},
};

#define FLAG_COUNT (sizeof(flags) / sizeof(flags[0]))

/* One stage as GL sees it. */
struct source {
	size_t parts;
	char text[65536];
};

static void assemble(struct source *source, struct program_key key, enum shader_stage stage)
{
	const char *parts[SHADER_PARTS_MAX];
	size_t used = 0;
	source->parts = shader_parts(key, stage, parts);
	assert_in_range(source->parts, 1, SHADER_PARTS_MAX);
	for (size_t i = 0; i < source->parts; i++) {
		size_t length = strlen(parts[i]);
		assert_true(length < sizeof(source->text) - used);
		memcpy(source->text + used, parts[i], length + 1);
		used += length;
	}
}

static void check_stage(struct program_key key, enum shader_stage stage)
{
	static struct source source;
	assemble(&source, key, stage);
	const char *version =
		key.flags & (FLAG_GATHER | FLAG_IMAGES) ? "#version 310 es\n" : "#version 300 es\n";
	assert_memory_equal(source.text, version, strlen(version));
	/* Precision, before any declaration that it is for. */
	const char *precision = strstr(source.text, "precision highp float;");
	assert_non_null(precision);
	static const char *const declarations[] = {"\nin ", "\nout ", "\nuniform ", "\nlayout"};
	for (size_t i = 0; i < sizeof(declarations) / sizeof(declarations[0]); i++) {
		const char *first = strstr(source.text, declarations[i]);
		assert_true(first == NULL || first > precision);
	}
	const char *main_function = strstr(source.text, "\nvoid main()");
	assert_non_null(main_function);
	for (size_t i = 0; i < FLAG_COUNT; i++) {
		char define[64];
		snprintf(define, sizeof(define), "\n#define %s\n", flags[i].name);
		const char *found = strstr(source.text, define);
		assert_int_equal(found != NULL, (key.flags & flags[i].flag) != 0);
		assert_true(found < main_function);
	}
}

/* Checks both stages of every variant of a kind, and counts these. */
static size_t check_kind(enum program_kind kind)
{
	struct program_key key = {.kind = kind};
	size_t count = 0;
	do {
		if (program_key_is_valid(key)) {
			check_stage(key, STAGE_VERTEX);
			check_stage(key, STAGE_FRAGMENT);
			count++;
		}
	} while (program_key_next(&key));
	return count;
}

static void each_valid_variant_assembles_with_its_defines(void **state)
{
	(void)state;
	size_t counts[PROGRAM_KINDS];
	for (int kind = 0; kind < PROGRAM_KINDS; kind++)
		counts[kind] = check_kind(kind);
	/* A colour, a depth, or the lesser of what is there and a colour, or a word of it. */
	assert_int_equal(counts[PROGRAM_PROBE_DRAW], 4);
	assert_int_equal(counts[PROGRAM_PROBE_READ], 2);
	assert_int_equal(counts[PROGRAM_PROBE_BRANCH], 1);
	/* No colours, or depths as floats of 32 or 16 bits, or as bytes. */
	assert_int_equal(counts[PROGRAM_DEPTH_MAP], 4);
	/* The front one, or what is behind it, on a fine raster grid or a coarse one. */
	assert_int_equal(counts[PROGRAM_LAYER], 2 * 2);
	assert_int_equal(counts[PROGRAM_COPY], 1);
	assert_int_equal(counts[PROGRAM_WORD], 1);
	/* Fewer bits than 8, as many, or more; as stored, or decoded and encoded again. */
	assert_int_equal(counts[PROGRAM_SCREEN], 3 * 2);
	/* As they are, linear in 16 bits, or packed. */
	const size_t plain = 3;
	/* With and without a receiver map: linear or sinusoid, of cones or not, with a minimum by
	 * blending, depth test or shader, which may have the map's depth as well; depth only. */
	assert_int_equal(counts[PROGRAM_FIN], plain * 2 * (2 * 2 * 4 + 1));
	assert_int_equal(counts[PROGRAM_TWO_SIDED_FIN], plain * 2);
	/* Across, with and without a receiver map, and up; each of whole values or split ones. */
	assert_int_equal(counts[PROGRAM_BLUR], 2 * (plain * 2 + 1));
	/* Half or fixed12; the fins, in each, as those of floats. */
	assert_int_equal(counts[PROGRAM_EXACT_DEPTH], 1);
	assert_int_equal(counts[PROGRAM_EXACT_FIN], 2 * 2 * (2 + 1));
	assert_int_equal(counts[PROGRAM_EXACT_SURFACE], 2 * 2);
	assert_int_equal(counts[PROGRAM_EXACT_COPY], 1);
	const size_t taps = 1 + plain;       /* gathered, or fetched from plain depths */
	const size_t comparison = 2 + plain; /* by the sampler, gathered, or fetched */
	/* Whole lists or runs, on fine or coarse raster grids, behind all casters or anywhere, with
	 * up to two layers or more, and with triangles over hollows or without; from textures or
	 * images. */
	const size_t edges = 2 * 2 * 2 * (1 + 2 * 2);
	/* For each pixel or what cells leave out, cells, and what was found before surfaces, of one
	 * sample a pixel or more. */
	const size_t gathers = 2 * edges + 1 + 2;
	const size_t shadows = comparison + /* hard */
			       3 * taps +   /* smoothies, with no or own depth, or alpha too */
			       2 +         /* depth and alpha of smoothies at once, and the map's */
			       taps +      /* two-sided smoothies */
			       taps +      /* bicubic */
			       3 * plain + /* pcss: plain depths, and one of three comparisons */
			       comparison + /* maps */
			       2 * 2 +      /* variance maps, filtered or fetched, whole or split */
			       gathers;
	/* No light, no shadow, or one; each as visibility, or textured or not into sRGB or not. */
	const size_t surfaces = (2 + shadows) * (1 + 2 * 2);
	/* What was seen before has no picture of visibility; points without light or shadow, or
	 * with each gather; receivers without light or shadow, or with one on either grid, as
	 * visibility or not. All with flat inputs or uniforms. */
	assert_int_equal(counts[PROGRAM_SURFACE], 2 * (surfaces + 2 * 2 + 2 + edges + 4 * 2));
	assert_int_equal(counts[PROGRAM_CELLS], 1);
	/* Whole lists or runs, on a fine raster grid or a coarse one, with up to two layers or
	 * more, with triangles over hollows or without, of pixels or points, from textures or
	 * images. */
	assert_int_equal(counts[PROGRAM_FIND], 2 * 2 * 2 * 2 * 2 * 2);
	assert_int_equal(counts[PROGRAM_KNOWN], 2);
}

/* Variants that have the key's flags, and up to so many more of those that are left. */
static size_t count_variants(struct program_key key, uint64_t left, unsigned more)
{
	size_t count = program_key_is_valid(key);
	for (; more > 0 && left != 0; left &= left - 1) {
		struct program_key with = {key.kind, key.flags | (left & -left)};
		count += count_variants(with, left & (left - 1), more - 1);
	}
	return count;
}

/* Sets of flags are passed over with what they have in common. All of up to seven tell whether that
 * loses a variant. */
static void no_variant_is_passed_over(void **state)
{
	(void)state;
	for (int kind = 0; kind < PROGRAM_KINDS; kind++) {
		struct program_key key = {.kind = (enum program_kind)kind};
		uint64_t all = program_kind_flags(key.kind), before;
		size_t wanted = count_variants(key, all, 7), found = program_key_is_valid(key);
		for (before = 0; program_key_next(&key); before = key.flags) {
			assert_true(key.flags > before && program_key_is_valid(key));
			found += __builtin_popcountll(key.flags) <= 7;
		}
		assert_int_equal(found, wanted);
	}
}

static void shadow_functions_come_with_the_flag_of_their_technique(void **state)
{
	(void)state;
	static const struct {
		uint64_t flags;
		bool receiver, smoothie;
	} cases[] = {
		{FLAG_LIT, false, false},
		{FLAG_LIT | FLAG_SHADOWED | FLAG_HARD, true, false},
		{FLAG_LIT | FLAG_SHADOWED | FLAG_SMOOTHIE, true, true},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		static struct source source;
		struct program_key key = {PROGRAM_SURFACE, cases[i].flags};
		assemble(&source, key, STAGE_FRAGMENT);
		assert_int_equal(
			strstr(source.text, "float receiver_depth(") != NULL, cases[i].receiver);
		assert_int_equal(strstr(source.text, "uniform sampler2D smoothie_map") != NULL,
			cases[i].smoothie);
	}
}

static void flags_that_make_no_sense_are_refused(void **state)
{
	(void)state;
	static const struct program_key keys[] = {
		{PROGRAM_DEPTH_MAP, FLAG_LIT},
		{PROGRAM_COPY, FLAG_ENCODE_SRGB},
		{PROGRAM_COPY, FLAG_DITHER},
		{PROGRAM_FIN, FLAG_LIT},
		{PROGRAM_EXACT_FIN, FLAG_FIXED12 | FLAG_DEPTH_ONLY | FLAG_SINUSOID},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_SEEN | FLAG_VISIBILITY},
		{PROGRAM_FIN, FLAG_DEPTH_ONLY | FLAG_SINUSOID}, /* alpha is not written */
		{PROGRAM_SURFACE, FLAG_SINUSOID},
		{PROGRAM_SURFACE, FLAG_SHADOWED | FLAG_HARD}, /* of no light */
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED},  /* of no technique */
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_HARD},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SMOOTHIE},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_HARD | FLAG_SMOOTHIE},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_SMOOTHIE | FLAG_TWO_SIDED},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_BICUBIC | FLAG_PCSS},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_VSM | FLAG_GATHER},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_SMOOTHIE | FLAG_FOUR_FETCHES},
		{PROGRAM_SURFACE,
			FLAG_LIT | FLAG_SHADOWED | FLAG_HARD | FLAG_GATHER | FLAG_FOUR_FETCHES},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_HARD | FLAG_DEPTH_HALF},
		{PROGRAM_SURFACE,
			FLAG_LIT | FLAG_SHADOWED | FLAG_PCSS | FLAG_DEPTH_HALF | FLAG_DEPTH_PACKED},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_SMOOTHIE | FLAG_ALPHA_DEPTH},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_SMOOTHIE | FLAG_WORDS},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_SMOOTHIE | FLAG_GATHER |
					  FLAG_SEPARATE_DEPTH | FLAG_WORDS},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_SMOOTHIE | FLAG_FUSED},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_SMOOTHIE | FLAG_GATHER |
					  FLAG_WORDS | FLAG_FUSED},
		{PROGRAM_SURFACE, FLAG_DEPTH_HALF},
		{PROGRAM_FIN, FLAG_FUSED},
		{PROGRAM_FIN, FLAG_ALPHA_DEPTH | FLAG_FETCH},
		{PROGRAM_FIN, FLAG_DEPTH_ONLY | FLAG_ALPHA_DEPTH},
		{PROGRAM_DEPTH_MAP, FLAG_DEPTH_FLOAT | FLAG_DEPTH_HALF},
		{PROGRAM_BLUR, FLAG_DEPTH_PACKED},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_VSM | FLAG_MAPS},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_EDGES | FLAG_GATHER},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_HARD | FLAG_CELLS},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_CELLS},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_EDGES | FLAG_POINTS},
		{PROGRAM_SURFACE, FLAG_VISIBILITY | FLAG_LIT | FLAG_SHADOWED | FLAG_EDGES |
					  FLAG_CELLS | FLAG_POINTS},
		{PROGRAM_DEPTH_MAP, FLAG_PEEL},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_HARD | FLAG_RUNS},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_HARD | FLAG_IMAGES},
		{PROGRAM_BLUR, FLAG_RECEIVER_MAP}, /* of what is blurred already */
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_HARD | FLAG_SEPARATE_DEPTH},
		{PROGRAM_SURFACE, FLAG_VISIBILITY | FLAG_TEXTURED},
		{PROGRAM_SURFACE, FLAG_VISIBILITY | FLAG_ENCODE_SRGB},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_HARD | FLAG_HOLLOWS},
		{PROGRAM_SURFACE,
			FLAG_LIT | FLAG_SHADOWED | FLAG_EDGES | FLAG_BEHIND | FLAG_HOLLOWS},
		{PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_SEEN | FLAG_SAMPLES},
		{PROGRAM_SURFACE, FLAG_END},
	};
	for (size_t i = 0; i < sizeof(keys) / sizeof(keys[0]); i++)
		assert_false(program_key_is_valid(keys[i]));
}

static void names_tell_variants_apart(void **state)
{
	(void)state;
	char text[400], cut[8];
	struct program_key key = {PROGRAM_SURFACE, FLAG_LIT | FLAG_SHADOWED | FLAG_HARD};
	assert_string_equal(program_key_name(key, text, sizeof(text)), "surface LIT SHADOWED HARD");
	assert_string_equal(program_key_name(key, cut, sizeof(cut)), "surface");
	struct program_key all = {PROGRAM_SURFACE, FLAG_END - 1};
	assert_true(strlen(program_key_name(all, text, sizeof(text))) < sizeof(text) - 1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(each_valid_variant_assembles_with_its_defines),
		cmocka_unit_test(no_variant_is_passed_over),
		cmocka_unit_test(shadow_functions_come_with_the_flag_of_their_technique),
		cmocka_unit_test(flags_that_make_no_sense_are_refused),
		cmocka_unit_test(names_tell_variants_apart),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
