/* SPDX-License-Identifier: MIT */
#ifndef TESTS_LOAD_FOLDER_H
#define TESTS_LOAD_FOLDER_H

#include <stddef.h>

/** A temporary folder for a group of tests; cmocka's group setup and teardown. */
int folder_make(void **state);
int folder_remove(void **state);

/** Path of a file in the folder, valid until the next call but one. */
const char *folder_path(const char *name);
/** Writes a file in the folder and returns its path, as folder_path(). */
const char *folder_write(const char *name, const void *bytes, size_t size);
/** The same for text. */
const char *folder_write_text(const char *name, const char *text);

#endif
