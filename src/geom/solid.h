/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SOLID_H
#define GEOM_SOLID_H

#include "geom/caster.h"

/**
 * Whether the mesh, as the caster was given it, bounds solids that are seen from outside: every
 * edge joins two triangles that run through it in opposite ways, and every connected part is wound
 * counter-clockwise as seen from outside (its signed volume is above zero). Then nothing that a
 * triangle shows with its back is ever in front, and back faces need not be drawn. False also when
 * out of memory.
 */
bool caster_is_solid(const struct caster *caster);

#endif
