/* SPDX-License-Identifier: MIT */
#include "gles/skip.h"
#include <stdio.h>
#include <string.h>

static const struct {
	const char *name, *summary;
} infos[SKIP_COUNT] = {
	[SKIP_FRAME] = {"frame", "a picture that would be the one that is there"},
	[SKIP_LIGHT] = {"light", "what a light sees, while it and the objects stay as they are"},
	[SKIP_STATIC] = {"static", "what a light sees beside objects that have changed"},
	[SKIP_CASTER] = {"caster", "an object that is beside a light's screen"},
	[SKIP_TRIANGLE] = {"triangle",
		"64 triangles of which it is known which side they show a light"},
	[SKIP_RECEIVER] = {"receiver",
		"all but a hard shadow, or light itself, on what no penumbra can reach"},
	[SKIP_VOLUME] = {"volume", "an object whose shadow volume misses the view"},
	[SKIP_VIEW] = {"view", "a light that reaches nothing in the view"},
	[SKIP_DIM] = {"dim", "a light, after the first, that adds less than rounding takes away"},
	[SKIP_POINTS] = {"points", "a light's visibility at points of a view that stays the same"},
};

const char *skip_name(size_t index)
{
	return index < SKIP_COUNT ? infos[index].name : NULL;
}

const char *skip_summary(size_t index)
{
	return index < SKIP_COUNT ? infos[index].summary : NULL;
}

static bool is_name(const char *item, size_t length, const char *name)
{
	return strlen(name) == length && memcmp(item, name, length) == 0;
}

/* "-name" or "+name", `length` characters. */
static bool set_one(bool off[SKIP_COUNT], const char *item, size_t length, struct sm_error *error)
{
	char names[200] = "";
	size_t used = 0;
	bool found = false;
	if (length == 0 || (item[0] != '-' && item[0] != '+'))
		return error_set(error, SM_ERROR_INPUT,
			"skips \"%.*s\": a list such as -name,+name is wanted",
			(int)(length < 40 ? length : 40), item);
	bool all = is_name(item + 1, length - 1, "all");
	for (size_t i = 0; i < SKIP_COUNT; i++) {
		if (all || is_name(item + 1, length - 1, infos[i].name)) {
			off[i] = item[0] == '-';
			found = true;
		}
		if (used < sizeof(names))
			used += (size_t)snprintf(
				names + used, sizeof(names) - used, " %s", infos[i].name);
	}
	return found || error_set(error, SM_ERROR_INPUT, "no skip \"%.*s\"; there are: all%s",
				(int)(length < 41 ? length - 1 : 40), item + 1, names);
}

bool skips_set(struct skips *skips, const char *list, struct sm_error *error)
{
	bool off[SKIP_COUNT];
	memcpy(off, skips->off, sizeof(off));
	for (size_t length; list != NULL; list = list[length] == ',' ? list + length + 1 : NULL) {
		length = strcspn(list, ",");
		if (!set_one(off, list, length, error))
			return false;
	}
	memcpy(skips->off, off, sizeof(off));
	return true;
}

void skip_count(struct skips *skips, enum skip skip, size_t tested, size_t skipped)
{
	if (skips->off[skip])
		return;
	skips->stats[skip].tested += tested;
	skips->stats[skip].skipped += skipped;
	skips->stats[skip].redrawn += tested - skipped;
}

bool skip_take(struct skips *skips, enum skip skip, bool could)
{
	skip_count(skips, skip, 1, could);
	return could && !skips->off[skip];
}
