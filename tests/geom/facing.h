/* SPDX-License-Identifier: MIT */
#ifndef TESTS_GEOM_FACING_H
#define TESTS_GEOM_FACING_H

#include "geom/caster.h"

/** The specification of facing_find() for one triangle, word for word. */
bool faces_by_definition(const struct caster *caster, size_t triangle, const float light[4]);

#endif
