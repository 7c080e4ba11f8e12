/* SPDX-License-Identifier: MIT */
#ifndef REF_TRACER_H
#define REF_TRACER_H

#include <embree3/rtcore.h>
#include <smoothie.h>

/**
 * A scene that rays are traced through, in a space of its own: moved so that its middle is the
 * origin and scaled by a power of two so that it fits [-1, 1]^3. Single precision then has the same
 * digits for it wherever it is and however large.
 */
struct tracer {
	RTCDevice device;
	RTCScene seen, casters; /* the same geometries, by the index of their objects */
	struct body *bodies;    /* [object_count], owned */
	double middle[3];       /* of the scene, world space */
	double scale;           /* from world space */
};

/** Fails (MACHINE) as Embree does. The scene's arrays are used until tracer_finish(). */
bool tracer_init(struct tracer *tracer, const struct sm_scene *scene, struct sm_error *error);
void tracer_finish(struct tracer *tracer);

/** From world space. */
void tracer_place(const struct tracer *tracer, const float world[3], double point[3]);

/** A ray in the tracer's space; direction is a unit vector. */
struct sight {
	double origin[3], direction[3];
	double near, far; /* along it */
};

/** A point of a surface as it is seen. */
struct surface {
	double point[3], normal[3]; /* unit, the triangle's own, on the side that is seen */
	bool receives;
};

/** The nearest surface seen, backs of single-sided objects being invisible; false if there is none.
 */
bool tracer_see(const struct tracer *tracer, const struct sight *sight, struct surface *surface);

/** Rays from a point along axis + x u + y v, each to `end` of that length. */
struct fan {
	double axis[3], u[3], v[3];
	double end;
};

/** How many of a fan's rays reach their end from a surface. All lead to the side of it that is
 *  seen. */
uint32_t tracer_count_free(const struct tracer *tracer, const struct surface *surface,
	const struct fan *fan, const float *x, const float *y, uint32_t count);

#endif
