/* SPDX-License-Identifier: MIT */
#include "check/needs.h"
#include <string.h>

static const struct {
	const char *need, *technique;
	size_t samples; /* which choice of them */
} users[] = {
	{"smoothie", "smoothie", 0},
	{"depth", "smoothie", 0},
	{"depth", "smoothie-two-sided", 0},
	{"depth", "pcss", 0},
	{"depth", "vsm", 0},
	{"comparison", "pcf", 0},
	{"comparison", "pcss", 0},
	{"comparison", "maps", 0},
	{"taps", "smoothie", 0},
	{"taps", "smoothie-two-sided", 0},
	{"taps", "pcf", 1},
	{"pairs", "smoothie", 0},
	{"moments", "vsm", 0},
	{"branch", "gather", 0},
};

#define USERS (sizeof(users) / sizeof(users[0]))

bool check_uses(size_t technique, size_t samples, size_t need)
{
	for (size_t i = 0; i < USERS; i++)
		if (users[i].samples == samples &&
			strcmp(users[i].technique, sm_technique_name(technique)) == 0 &&
			strcmp(users[i].need, sm_need_name(need)) == 0)
			return true;
	return false;
}

struct lack {
	const char *technique;
	bool found;
};

/* "need NEED: none; ..." of sm_renderer_describe() */
static void look_for_lack(void *data, const char *key, const char *value)
{
	static const char prefix[] = "need ", none[] = "none";
	struct lack *lack = data;
	if (strncmp(key, prefix, strlen(prefix)) != 0 || strncmp(value, none, strlen(none)) != 0)
		return;
	for (size_t i = 0; i < USERS; i++)
		if (strcmp(users[i].need, key + strlen(prefix)) == 0 &&
			strcmp(users[i].technique, lack->technique) == 0)
			lack->found = true;
}

bool check_lacks(struct sm_renderer *renderer, size_t technique)
{
	struct lack lack = {.technique = sm_technique_name(technique)};
	sm_renderer_describe(renderer, look_for_lack, &lack);
	return lack.found;
}
