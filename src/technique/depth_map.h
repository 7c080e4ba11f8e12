/* SPDX-License-Identifier: MIT */
#ifndef TECHNIQUE_DEPTH_MAP_H
#define TECHNIQUE_DEPTH_MAP_H

#include "gles/target.h"
#include "scene/object_watch.h"
#include "technique/disc.h"
#include "technique/technique.h"

/** At which texels the sampler compares. */
enum depth_map_filter { DEPTH_MAP_NEAREST, DEPTH_MAP_LINEAR };

/** How a driver has shadow maps looked up: flags of the programs that do. */
struct depth_ways {
	uint64_t write;   /* of PROGRAM_DEPTH_MAP, for maps that are read without comparing */
	uint64_t plain;   /* to read such a map */
	uint64_t compare; /* to compare at four texels, blended */
	uint64_t taps;    /* to look four texels up apart */
	GLenum format;    /* of a map that is read without comparing; 0: its depth texture */
	bool compares_plainly, taps_plainly; /* reading without comparing */
};

/** Fails as way_choose(). */
bool depth_ways_choose(struct depth_ways *ways, struct gpu *gpu, struct sm_error *error);

/** A light's shadow map, or a layer for each of many points of it: a depth texture that is
 * compared, and what is read plainly. It is kept from frame to frame, and drawn anew where objects
 * that it holds have changed. */
struct depth_map {
	const struct disc *disc; /* of the layers' points; not owned. NULL: there is one map */
	struct target target;
	struct target
		plain;  /* depths as colours, with the depth texture; zero: they are read there */
	GLuint compare; /* sampler: LEQUAL */
	enum depth_map_filter filter;
	uint64_t write;            /* flags of PROGRAM_DEPTH_MAP */
	struct object_watch watch; /* on what it holds */
	struct disc_box moved;     /* of that, what had changed at the last look */
	struct screen_box changed; /* of the light's screen, when it was last asked for */
	bool cleared;              /* all beside what is held */
	struct disc_box held;      /* where it holds something, if so */
	struct disc_box before;    /* where it did before that look */
	uint64_t failures;         /* of the GPU so far, when it was drawn */
	bool shared;               /* with the other lights: of receivers */
};

/** plain: whether it is read without comparing as well. */
bool depth_map_init(struct depth_map *map, struct gpu *gpu, uint32_t size,
	enum depth_map_filter filter, bool plain, struct sm_error *error);
/** The same with a layer for each point of a disc. */
bool depth_map_init_layers(struct depth_map *map, struct gpu *gpu, uint32_t size,
	const struct disc *disc, enum depth_map_filter filter, bool plain, struct sm_error *error);
void depth_map_finish(struct depth_map *map, struct gpu *gpu);

void depth_map_list_memory(const struct depth_map *map, const struct memory_list *list);

/** Which objects a map holds: where there are none it is 1, or 0 where it holds the farthest. */
enum depth_map_content {
	DEPTH_OF_CASTERS,
	DEPTH_OF_RECEIVERS_ONLY,
	DEPTH_OF_FARTHEST_RECEIVERS, /* of those that do not cast */
};

/** True if the scene has objects of that kind. */
bool depth_map_has_content(const struct sm_scene *scene, enum depth_map_content content);

/** Objects that are drawn again: those that touch a part of the light's screen. */
struct depth_map_redraw {
	const struct object_watch *watch; /* has been looked at */
	struct screen_box reach;
	float point[2]; /* of the light's disc, that the screen is seen from */
};

/** Whether an object is drawn: some of it may be on the light's screen and, unless redraw is
 *  NULL, there, and it is not left out. */
bool depth_map_is_drawn(struct gpu *gpu, const struct sm_scene *scene, size_t index,
	const struct light_frame *frame, const struct depth_map_redraw *redraw);

/** Has the map hold the casters, in its inside: what it held, it keeps where none of them has
 *  changed. map->changed is set to where that is not so. */
bool depth_map_draw(struct depth_map *map, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error);

/** Narrows a part of the screen that is to be drawn anew to where something was or is, since the
 *  rest is clear already: but from all to no part that is too large for that to pay. */
void depth_map_narrow(struct screen_box *part, const struct screen_box *held);

/** The part of the light's screen beside which the map is 1. */
struct screen_box depth_map_held(const struct depth_map *map);

/** Has the next draw start with nothing. */
void depth_map_forget(struct depth_map *map);

/** Initialises a zeroed map, of receivers, the first time that it is needed. All lights share one:
 *  what is drawn is there until another one is. */
bool depth_map_init_once(
	struct depth_map *map, struct gpu *gpu, GLsizei size, struct sm_error *error);

/** The texture to be read without comparing. */
GLuint depth_map_plain_texture(const struct depth_map *map);

/** Clears a part of the map and draws the objects into that; what is around it is not touched. */
bool depth_map_draw_part(struct depth_map *map, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, enum depth_map_content content,
	const struct screen_box *part, struct sm_error *error);

/** Widens `changed` to where what only receives shows otherwise than at the last look. */
bool depth_map_look_at_receivers(struct object_watch *watch, const struct sm_scene *scene,
	const struct light_frame *frame, struct screen_box *changed, struct sm_error *error);

/** Binds the map, or its layers, for a surface program, and sets the uniforms that it is looked up
 *  by. */
void depth_map_bind(const struct depth_map *map, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program);

/** Sets the uniforms of shadow_screen.glsl and shadow_receiver.glsl for maps of `texels` a side. */
void depth_map_set_receiver(struct gpu *gpu, GLsizei texels, enum depth_map_filter filter,
	const struct light_frame *frame, const struct program *program);

#endif
