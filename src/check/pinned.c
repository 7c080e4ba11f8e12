/* SPDX-License-Identifier: MIT */
#include "check/pinned.h"
#include <string.h>

static const struct pinned pinned[] = {
	{"cylinder", UINT64_C(0xe10d7bfc2e7a6e1c), UINT64_C(0x3a2ecd23a885eeb8)},
	{"boxes", UINT64_C(0xdf0cce13a97cc501), UINT64_C(0xf0ef3a0543d18d73)},
	{"fence", UINT64_C(0xccc1816099f501b8), UINT64_C(0x9b4ef70ee87d95f8)},
	{"knot", UINT64_C(0xa7f6c91f5ee8762b), UINT64_C(0x44219447a168b5f7)},
	{"urchin", UINT64_C(0x4a7fdd5d8a93bf50), UINT64_C(0xf3e25bb53f5e8cf8)},
	{"debris", UINT64_C(0x47f8986561fa4eb7), UINT64_C(0x23f1eebfcb532c71)},
	{"primitives", UINT64_C(0x24465ffac4d1e370), UINT64_C(0xf6b41a1889dc55b2)},
	{"cube", UINT64_C(0x5b54192368859051), UINT64_C(0x5d7980ffda1f48c8)},
	{"sphere", UINT64_C(0xd9ef82cc6a059a46), UINT64_C(0x256e65818828a07c)},
	{"icosahedron", UINT64_C(0x9137dd6ed3b6cfab), UINT64_C(0x9b0e564d426fd4e8)},
	{"pillar", UINT64_C(0x42b894ac1a67c81f), UINT64_C(0xfb02899d3d037c5f)},
	{"cone", UINT64_C(0x9c5c7bdc6f1609bb), UINT64_C(0x9e1c9e2c4b35910b)},
	{"torus", UINT64_C(0x19f2959042578fbb), UINT64_C(0xfc11e8c6531a1f0f)},
	{"vase", UINT64_C(0x193df9a0c37fffc0), UINT64_C(0x7c2db87ac9cbfd9e)},
};

#define COUNT (sizeof(pinned) / sizeof(pinned[0]))

const struct pinned *pinned_scene(size_t i)
{
	return i < COUNT ? &pinned[i] : NULL;
}

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
	for (size_t i = 0; i < COUNT; i++)
		if (strcmp(pinned[i].scene, scene) == 0) {
			*hash = precision == SM_PRECISION_HALF ? pinned[i].half : pinned[i].fixed12;
			return precision == SM_PRECISION_HALF || precision == SM_PRECISION_FIXED12;
		}
	return false;
}
