/* SPDX-License-Identifier: MIT */
#include "check/pinned.h"
#include <string.h>

static const struct {
	const char *scene;
	uint64_t half, fixed12;
} pinned[] = {
	{"cylinder", UINT64_C(0xe10d7bfc2e7a6e1c), UINT64_C(0x3a2ecd23a885eeb8)},
	{"boxes", UINT64_C(0xdf0cce13a97cc501), UINT64_C(0xf0ef3a0543d18d73)},
	{"fence", UINT64_C(0xc87b32a057a95b67), UINT64_C(0x950eb22d1ed4de78)},
	{"knot", UINT64_C(0xef1bcc32b99ca8ab), UINT64_C(0xd7ed7a2c29a3c637)},
	{"urchin", UINT64_C(0xbf069f93d88699c4), UINT64_C(0xf3e25bb53f5e8cf8)},
	{"debris", UINT64_C(0xe6cc1a2ab7b109e2), UINT64_C(0x23f1eebfcb532c71)},
	{"primitives", UINT64_C(0xd2d8f8fcc1c32840), UINT64_C(0xf6b41a1889dc55b2)},
};

/* fnv.org */
uint64_t pinned_hash(const uint16_t *values, size_t count)
{
	uint64_t hash = UINT64_C(0xcbf29ce484222325);
	for (size_t i = 0; i < 2 * count; i++) {
		hash ^= i % 2 == 0 ? values[i / 2] >> 8 : values[i / 2] & 0xff;
		hash *= UINT64_C(0x100000001b3);
	}
	return hash;
}

bool pinned_find(const char *scene, enum sm_precision precision, uint64_t *hash)
{
	for (size_t i = 0; i < sizeof(pinned) / sizeof(pinned[0]); i++)
		if (strcmp(pinned[i].scene, scene) == 0) {
			*hash = precision == SM_PRECISION_HALF ? pinned[i].half : pinned[i].fixed12;
			return precision == SM_PRECISION_HALF || precision == SM_PRECISION_FIXED12;
		}
	return false;
}
