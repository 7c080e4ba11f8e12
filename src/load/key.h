/* SPDX-License-Identifier: MIT */
#ifndef LOAD_KEY_H
#define LOAD_KEY_H

#include <smoothie.h>

/** Sections of a scene file. */
enum section {
	SECTION_CAMERA,
	SECTION_LIGHT,  /* [light NAME] */
	SECTION_OBJECT, /* [object NAME] */
	SECTION_GROUND,
	SECTION_ENVIRONMENT,
	SECTION_MOTION,
	SECTION_SHADOW,
	SECTION_OUTPUT,
	SECTION_COUNT,
};

enum key_type {
	KEY_NUMBER, /* float */
	KEY_COUNT,  /* uint32_t */
	KEY_PERIOD, /* double: 0, or in the range with either sign */
	KEY_VECTOR, /* float[3] */
	KEY_SCALE,  /* float[3]; one number stands for three */
	KEY_COLOR,  /* float[3], linear */
	KEY_SIZE,   /* uint32_t[2], as WIDTHxHEIGHT */
	KEY_WORD,   /* enum: the index of the word */
	KEY_YES,    /* bool */
	KEY_TEXT,   /* char *, from malloc() */
};

/** One key of a section: how it is written, where it is stored, what it may be. */
struct key {
	enum section section;
	const char *name;
	enum key_type type;
	size_t offset;       /**< in the section's struct of plan.h */
	const char *initial; /**< default, as one would write it; NULL: left open */
	const char *follows; /**< where the default comes from when it is left open */
	double min, max;     /**< of each number, both allowed */
	const char *words;   /**< KEY_WORD: separated by | */
};

/** The keys in the order of the manual; NULL past the last, of which there are less than 64. */
const struct key *key_at(size_t index);
/** Index of a key for key_at(), or SIZE_MAX. */
size_t key_find(enum section section, const char *name);

/** What the key takes: "a number from 0 to 1". */
void key_describe(const struct key *key, char *text, size_t size);

/** Writes a value into the section's struct; on false, which means that the value is not allowed,
 *  or not enough memory for a text, nothing changes. */
bool key_parse(const struct key *key, const char *value, void *section);

/** Puts a section's struct, of which KEY_TEXT fields are NULL or undefined, at its defaults. */
bool section_reset(enum section section, void *data);

/** "light" */
const char *section_name(enum section section);
/** The section of that name, or SECTION_COUNT. */
enum section section_find(const char *name);
/** Whether there may be several, told apart by names. */
bool section_is_named(enum section section);

#endif
