/* SPDX-License-Identifier: MIT */
#include "facing.h"
#include <math.h>

bool faces_by_definition(const struct caster *caster, size_t triangle, const float l[4])
{
	const uint32_t *v = &caster->indices[3 * triangle];
	const float *p0 = caster->positions[v[0]];
	const float *p1 = caster->positions[v[1]], *p2 = caster->positions[v[2]];
	double ux = (double)p1[0] - p0[0], uy = (double)p1[1] - p0[1], uz = (double)p1[2] - p0[2];
	double vx = (double)p2[0] - p0[0], vy = (double)p2[1] - p0[1], vz = (double)p2[2] - p0[2];
	double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
	double w = l[3];
	if (!isfinite(l[0]) || !isfinite(l[1]) || !isfinite(l[2]) || !isfinite(l[3]))
		return false;
	return nx * (l[0] - w * p0[0]) + ny * (l[1] - w * p0[1]) + nz * (l[2] - w * p0[2]) > 0.0;
}
