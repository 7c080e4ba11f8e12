/* SPDX-License-Identifier: MIT */
#ifndef LOAD_BUILTIN_H
#define LOAD_BUILTIN_H

#include "base/error.h"
#include <stddef.h>

struct model;

/** The NAMEs of builtin:NAME, whole scenes first and then single solids; NULL past the last. */
const char *builtin_name(size_t index);

enum { BUILTIN_TRIANGLES_MIN = 100, BUILTIN_TRIANGLES_MAX = 4000000 };

/**
 * Generates builtin:NAME into an empty model, or, of the names that have sizes, builtin:NAME:N of
 * about N triangles.
 *
 * A scene stands on the plane y = 0 and brings its light, camera and ground along. A solid brings
 * nothing; it stands on y = 0 and fits a cube of side 1. Fails (INPUT) on an unknown name, listing
 * the known ones, and on a size that is none or too many.
 */
bool builtin_build(const char *name, struct model *model, struct sm_error *error);

#endif
