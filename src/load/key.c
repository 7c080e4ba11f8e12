/* SPDX-License-Identifier: MIT */
#include "load/key.h"
#include "load/plan.h"
#include <stdio.h>
#include <string.h>

static const struct key keys[] = {
	{SECTION_CAMERA, "eye", KEY_VECTOR, offsetof(struct plan_camera, desc.eye),
		.follows = "a view of the casters and their shadows from a bit above", .min = -1e6,
		.max = 1e6},
	{SECTION_CAMERA, "target", KEY_VECTOR, offsetof(struct plan_camera, desc.target),
		.follows = "the middle of the casters and their shadows", .min = -1e6, .max = 1e6},
	{SECTION_CAMERA, "up", KEY_VECTOR, offsetof(struct plan_camera, desc.up),
		.follows = "the model's camera, or else 0 1 0", .min = -1e6, .max = 1e6},
	{SECTION_CAMERA, "fov", KEY_NUMBER, offsetof(struct plan_camera, desc.fov),
		.follows = "the model's camera, or else 35", .min = 1, .max = 170},
	{SECTION_CAMERA, "near", KEY_NUMBER, offsetof(struct plan_camera, desc.near),
		.follows = "the scene's bounds", .min = 1e-6, .max = 1e6},
	{SECTION_CAMERA, "far", KEY_NUMBER, offsetof(struct plan_camera, desc.far),
		.follows = "the scene's bounds", .min = 1e-6, .max = 1e6},
	{SECTION_CAMERA, "orbit", KEY_PERIOD, offsetof(struct plan_camera, path.orbit),
		.initial = "0", .min = .1, .max = 1e6},
	{SECTION_CAMERA, "travel", KEY_VECTOR, offsetof(struct plan_camera, path.travel),
		.initial = "0 0 0", .min = -1e6, .max = 1e6},
	{SECTION_CAMERA, "travel-time", KEY_NUMBER, offsetof(struct plan_camera, path.travel_time),
		.initial = "4", .min = .1, .max = 1e6},
	{SECTION_LIGHT, "type", KEY_WORD, offsetof(struct plan_light, desc.type), .initial = "spot",
		.words = "spot|directional"},
	{SECTION_LIGHT, "position", KEY_VECTOR, offsetof(struct plan_light, desc.position),
		.follows = "above the casters, to the left of the camera", .min = -1e6, .max = 1e6},
	{SECTION_LIGHT, "target", KEY_VECTOR, offsetof(struct plan_light, desc.target),
		.follows = "the middle of the casters", .min = -1e6, .max = 1e6},
	{SECTION_LIGHT, "radius", KEY_NUMBER, offsetof(struct plan_light, desc.radius),
		.follows = ".04 of the distance from position to target", .min = 0, .max = 1e6},
	{SECTION_LIGHT, "angle", KEY_NUMBER, offsetof(struct plan_light, desc.angle),
		.follows = "around the casters and their shadows", .min = 1, .max = 170},
	{SECTION_LIGHT, "softness", KEY_NUMBER, offsetof(struct plan_light, desc.softness),
		.initial = "0.5", .min = 0, .max = 1},
	{SECTION_LIGHT, "color", KEY_COLOR, offsetof(struct plan_light, desc.color),
		.initial = "1 1 1", .min = 0, .max = 1},
	{SECTION_LIGHT, "intensity", KEY_NUMBER, offsetof(struct plan_light, desc.intensity),
		.initial = "1", .min = 0, .max = 1000},
	{SECTION_LIGHT, "orbit", KEY_PERIOD, offsetof(struct plan_light, path.orbit),
		.initial = "0", .min = .1, .max = 1e6},
	{SECTION_LIGHT, "travel", KEY_VECTOR, offsetof(struct plan_light, path.travel),
		.initial = "0 0 0", .min = -1e6, .max = 1e6},
	{SECTION_LIGHT, "travel-time", KEY_NUMBER, offsetof(struct plan_light, path.travel_time),
		.initial = "4", .min = .1, .max = 1e6},
	{SECTION_OBJECT, "model", KEY_TEXT, offsetof(struct plan_object, model),
		.follows = "none, it must be given"},
	{SECTION_OBJECT, "up", KEY_WORD, offsetof(struct plan_object, up), .initial = "auto",
		.words = "auto|y|z"},
	{SECTION_OBJECT, "position", KEY_VECTOR, offsetof(struct plan_object, position),
		.initial = "0 0 0", .min = -1e6, .max = 1e6},
	{SECTION_OBJECT, "rotation", KEY_VECTOR, offsetof(struct plan_object, rotation),
		.initial = "0 0 0", .min = -3600, .max = 3600},
	{SECTION_OBJECT, "scale", KEY_SCALE, offsetof(struct plan_object, scale), .initial = "1",
		.min = 1e-6, .max = 1e6},
	{SECTION_OBJECT, "color", KEY_COLOR, offsetof(struct plan_object, color),
		.follows = "the model's own", .min = 0, .max = 1},
	{SECTION_OBJECT, "casts", KEY_YES, offsetof(struct plan_object, casts), .initial = "yes"},
	{SECTION_OBJECT, "receives", KEY_YES, offsetof(struct plan_object, receives),
		.initial = "yes"},
	{SECTION_OBJECT, "animation", KEY_TEXT, offsetof(struct plan_object, animation),
		.follows = "the model's first"},
	{SECTION_OBJECT, "speed", KEY_NUMBER, offsetof(struct plan_object, speed), .initial = "1",
		.min = -1000, .max = 1000},
	{SECTION_OBJECT, "spin", KEY_VECTOR, offsetof(struct plan_object, spin), .initial = "0 0 0",
		.min = -36000, .max = 36000},
	{SECTION_OBJECT, "center", KEY_VECTOR, offsetof(struct plan_object, center),
		.initial = "0 0 0", .min = -1e6, .max = 1e6},
	{SECTION_OBJECT, "orbit", KEY_PERIOD, offsetof(struct plan_object, path.orbit),
		.initial = "0", .min = .1, .max = 1e6},
	{SECTION_OBJECT, "travel", KEY_VECTOR, offsetof(struct plan_object, path.travel),
		.initial = "0 0 0", .min = -1e6, .max = 1e6},
	{SECTION_OBJECT, "travel-time", KEY_NUMBER, offsetof(struct plan_object, path.travel_time),
		.initial = "4", .min = .1, .max = 1e6},
	{SECTION_GROUND, "show", KEY_WORD, offsetof(struct plan_ground, show), .initial = "auto",
		.words = "auto|yes|no"},
	{SECTION_GROUND, "height", KEY_NUMBER, offsetof(struct plan_ground, height),
		.follows = "the lowest point of the casters", .min = -1e6, .max = 1e6},
	{SECTION_GROUND, "size", KEY_NUMBER, offsetof(struct plan_ground, size),
		.follows = "60 times the radius of the casters", .min = 1e-6, .max = 1e6},
	{SECTION_GROUND, "color", KEY_COLOR, offsetof(struct plan_ground, color),
		.initial = "0.52 0.49 0.45", .min = 0, .max = 1},
	{SECTION_ENVIRONMENT, "sky", KEY_COLOR, offsetof(struct sm_environment, sky),
		.initial = "0.20 0.23 0.28", .min = 0, .max = 1},
	{SECTION_ENVIRONMENT, "ground", KEY_COLOR, offsetof(struct sm_environment, ground),
		.initial = "0.11 0.10 0.09", .min = 0, .max = 1},
	{SECTION_ENVIRONMENT, "background", KEY_COLOR, offsetof(struct sm_environment, background),
		.initial = "0.24 0.29 0.35", .min = 0, .max = 1},
	{SECTION_MOTION, "turns", KEY_WORD, offsetof(struct plan_motion, turns),
		.initial = "camera", .words = "camera|light"},
	{SECTION_MOTION, "light", KEY_TEXT, offsetof(struct plan_motion, light),
		.follows = "the first light"},
	{SECTION_MOTION, "period", KEY_PERIOD, offsetof(struct plan_motion, period), .initial = "0",
		.min = .1, .max = 1e6},
	{SECTION_SHADOW, "technique", KEY_TEXT, offsetof(struct plan_shadow, technique),
		.follows = "auto"},
	{SECTION_SHADOW, "map", KEY_COUNT, offsetof(struct plan_shadow, map), .follows = "1024",
		.min = 1, .max = 16384},
	{SECTION_SHADOW, "width", KEY_NUMBER, offsetof(struct plan_shadow, width),
		.follows = "the light's radius", .min = 1e-4, .max = 1},
	{SECTION_SHADOW, "falloff", KEY_WORD, offsetof(struct plan_shadow, falloff),
		.initial = "default", .words = "default|linear|sinusoid"},
	{SECTION_SHADOW, "samples", KEY_COUNT, offsetof(struct plan_shadow, samples),
		.follows = "the technique's first", .min = 1, .max = 1024},
	{SECTION_SHADOW, "passes", KEY_COUNT, offsetof(struct plan_shadow, passes), .follows = "1",
		.min = 1, .max = 2},
	{SECTION_SHADOW, "precision", KEY_WORD, offsetof(struct plan_shadow, precision),
		.initial = "default", .words = "default|float|half|fixed12"},
	{SECTION_SHADOW, "sampling", KEY_WORD, offsetof(struct plan_shadow, sampling),
		.initial = "default", .words = "default|dense|sparse|deferred|deferred-sparse"},
	{SECTION_OUTPUT, "size", KEY_SIZE, offsetof(struct plan_output, width),
		.follows = "the model's camera, or else 1280x960", .min = 1, .max = 16384},
	{SECTION_OUTPUT, "samples", KEY_WORD, offsetof(struct plan_output, samples), .initial = "4",
		.words = "1|4"},
};
static const size_t key_count = sizeof(keys) / sizeof(*keys);

static const struct {
	const char *name;
	bool is_named;
} sections[SECTION_COUNT] = {
	[SECTION_CAMERA] = {"camera"},
	[SECTION_LIGHT] = {"light", true},
	[SECTION_OBJECT] = {"object", true},
	[SECTION_GROUND] = {"ground"},
	[SECTION_ENVIRONMENT] = {"environment"},
	[SECTION_MOTION] = {"motion"},
	[SECTION_SHADOW] = {"shadow"},
	[SECTION_OUTPUT] = {"output"},
};

const struct key *key_at(size_t index)
{
	return index < key_count ? &keys[index] : NULL;
}

size_t key_find(enum section section, const char *name)
{
	for (size_t i = 0; i < key_count; i++)
		if (keys[i].section == section && strcmp(keys[i].name, name) == 0)
			return i;
	return SIZE_MAX;
}

const char *section_name(enum section section)
{
	return sections[section].name;
}

enum section section_find(const char *name)
{
	enum section section = 0;
	while (section < SECTION_COUNT && strcmp(sections[section].name, name) != 0)
		section++;
	return section;
}

bool section_is_named(enum section section)
{
	return sections[section].is_named;
}

/** "a|b|c" as "a, b or c". */
static void describe_words(const char *words, char *text, size_t size)
{
	const char *last = strrchr(words, '|');
	size_t used = 0;
	for (const char *c = words; *c != '\0' && used + 5 < size; c++) {
		if (*c == '|')
			used += (size_t)snprintf(
				text + used, size - used, c == last ? " or " : ", ");
		else
			text[used++] = *c;
	}
	text[used] = '\0';
}

void key_describe(const struct key *key, char *text, size_t size)
{
	switch (key->type) {
	case KEY_NUMBER:
		snprintf(text, size, "a number from %.7g to %.7g", key->min, key->max);
		break;
	case KEY_COUNT:
		snprintf(text, size, "a whole number from %.7g to %.7g", key->min, key->max);
		break;
	case KEY_PERIOD:
		snprintf(text, size, "0, or a number from %.7g to %.7g with either sign", key->min,
			key->max);
		break;
	case KEY_VECTOR:
		snprintf(text, size, "three numbers from %.7g to %.7g", key->min, key->max);
		break;
	case KEY_SCALE:
		snprintf(text, size, "one or three numbers from %.7g to %.7g", key->min, key->max);
		break;
	case KEY_COLOR:
		snprintf(text, size, "three numbers from %.7g to %.7g, or #rrggbb", key->min,
			key->max);
		break;
	case KEY_SIZE:
		snprintf(text, size, "WIDTHxHEIGHT, each from %.7g to %.7g", key->min, key->max);
		break;
	case KEY_WORD:
		describe_words(key->words, text, size);
		break;
	case KEY_YES:
		snprintf(text, size, "yes or no");
		break;
	case KEY_TEXT:
		snprintf(text, size, "text");
		break;
	}
}
