/* SPDX-License-Identifier: MIT */
#ifndef LOAD_PLAN_H
#define LOAD_PLAN_H

#include "base/error.h"
#include "load/key.h"
#include "load/motion.h"
#include <stddef.h>

enum plan_up { PLAN_UP_AUTO, PLAN_UP_Y, PLAN_UP_Z };
enum plan_show { PLAN_SHOW_AUTO, PLAN_SHOW_YES, PLAN_SHOW_NO };
enum plan_turns { PLAN_TURNS_CAMERA, PLAN_TURNS_LIGHT };
enum plan_samples { PLAN_SAMPLES_1, PLAN_SAMPLES_4 };

/* What a light or camera was taken from, and goes with. */
struct plan_origin {
	uint32_t object; /* of the plan; SM_NONE: it is the plan's own */
	uint32_t node;   /* of its model's rig */
	bool aimed;      /* not all around */
};

struct plan_camera {
	struct sm_camera desc;
	struct plan_origin origin;
	struct motion_path path;
};

struct plan_light {
	char *name;                /* owned */
	struct sm_light_desc desc; /* its name is not used */
	struct plan_origin origin;
	struct motion_path path;
	uint64_t given;
};

struct plan_object {
	char *name;  /* owned */
	char *model; /* owned; NULL: none given */
	enum plan_up up;
	float position[3], rotation[3], scale[3], color[3];
	bool casts, receives;
	float spin[3];   /* degrees a second, added to rotation */
	float center[3]; /* of the orbit */
	struct motion_path path;
	char *animation; /* owned; NULL: the first; "none" */
	float speed;     /* of the animation */
	uint64_t given;
};

struct plan_ground {
	enum plan_show show;
	float height, size, color[3];
};

struct plan_motion {
	enum plan_turns turns;
	char *light;   /* owned; NULL: the first */
	double period; /* 0: stands still */
};

struct plan_shadow {
	char *technique; /* owned; NULL: the renderer's default */
	uint32_t map;    /* 0: the renderer's default, also below */
	float width;     /* NaN: the renderer's default */
	enum sm_falloff falloff;
	uint32_t samples, passes;
	enum sm_precision precision;
	enum sm_sampling sampling;
};

struct plan_output {
	uint32_t width, height; /* 0: the model's, or the program's default */
	enum plan_samples samples;
};

/**
 * What a scene file and settings say. A number or vector that was left open, to follow from the
 * scene, is NaN.
 */
struct plan {
	struct plan_camera camera;
	struct plan_light *lights;
	size_t light_count, light_capacity;
	struct plan_object *objects;
	size_t object_count, object_capacity;
	struct plan_ground ground;
	struct sm_environment environment;
	struct plan_motion motion;
	struct plan_shadow shadow;
	struct plan_output output;
	uint64_t given[SECTION_COUNT];
};

/** Every key at its default, no lights and no objects. */
bool plan_init(struct plan *plan, struct sm_error *error);
void plan_finish(struct plan *plan);

/** Appends a light or object with every key at its default; NULL without memory. */
struct plan_light *plan_add_light(struct plan *plan, const char *name, struct sm_error *error);
struct plan_object *plan_add_object(struct plan *plan, const char *name, struct sm_error *error);

/** One section of a plan, open for setting keys; data is NULL when there is none. */
struct plan_section {
	enum section section;
	void *data;      /* not owned; moves when a light or object is added */
	uint64_t *given; /* bit k: the key of key_at(k) was set */
};

/** The section; for a light or object, the one of that index, which must exist. */
struct plan_section plan_get(struct plan *plan, enum section section, size_t index);
/** How many of the section there are: 1, or the number of lights or objects. */
size_t plan_count(const struct plan *plan, enum section section);
/** Name of a light or object. */
const char *plan_name(const struct plan *plan, enum section section, size_t index);
/** Index of the first light or object of that name, or SIZE_MAX. */
size_t plan_find(const struct plan *plan, enum section section, const char *name);
/** Writes the names of all lights or objects: "key, fill", or "none". */
void plan_list_names(const struct plan *plan, enum section section, char *text, size_t size);

/**
 * Sets a key of an open section from text.
 *
 * place: what stands in front of an error, such as "scene.ini:3". Fails (INPUT) on an unknown key
 * or a value that the key does not take.
 */
bool plan_set(const struct plan_section *open, const char *key, const char *value,
	const char *place, struct sm_error *error);

#endif
