/* SPDX-License-Identifier: MIT */
#ifndef SCENE_LIGHT_REACH_H
#define SCENE_LIGHT_REACH_H

#include "geom/disc_box.h"
#include "scene/light.h"

/** The part of space that a camera sees. */
struct view_volume {
	vec4 sides[6];   /* planes, positive inside; a bit wide */
	vec3 corners[8]; /* NaN where there is none */
};

void view_volume_init(struct view_volume *volume, mat4 world_to_clip);

/** Most corners of the part of a box that is in a view. */
#define VIEW_PART_CORNERS_MAX 200

/** Corners of the convex part of an object's box that is in the view: their number. They are NaN
 *  where the view has no end there. */
int view_volume_cut(const struct view_volume *volume, const struct object *object,
	vec3 part[VIEW_PART_CORNERS_MAX]);

/**
 * A bound on what a light adds to the colour of a pixel in the view, linear: 0 where nothing that
 * is seen lies in a spot's cone. Textures have no more than 1. The search ends where the bound is
 * found to be `enough` at least.
 *
 * frame: of the light, for its axes.
 */
float light_brightest(const struct sm_light_desc *light, const struct light_frame *frame,
	const struct sm_scene *scene, const struct view_volume *volume, float enough);

/** Whether nothing of a mesh's box is on a light's screen, nor `reach` beside it, NDC, or all of it
 *  is before the near plane or, where that cuts, behind the far one. */
bool mesh_misses_screen(
	const struct mesh *mesh, mat4 transform, mat4 world_to_clip, float reach, bool far_cuts);

/** A bound on where a mesh is on a light's screen: all of that, where it may come as near as the
 *  light itself. */
void mesh_screen_box(
	const struct mesh *mesh, mat4 transform, mat4 world_to_clip, struct screen_box *box);

/** The same, and where other points of the light's disc see it (technique/disc.h). */
struct disc_box mesh_disc_box(
	const struct mesh *mesh, mat4 transform, const struct light_frame *frame);

#endif
