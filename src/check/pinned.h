/* SPDX-License-Identifier: MIT */
#ifndef CHECK_PINNED_H
#define CHECK_PINNED_H

#include <smoothie.h>

/** Size of the pictures whose bits are pinned, and of their shadow maps. */
#define PINNED_SIZE 256
#define PINNED_MAP 512

/** Hashes of the visibility of light 0 of a built-in scene: what every driver must draw. */
struct pinned {
	const char *scene;
	uint64_t half, fixed12;
};

/** The built-in scenes in their order; NULL past the last. */
const struct pinned *pinned_scene(size_t i);

/** FNV-1a, 64 bits, of the high byte and then the low byte of each value. */
uint64_t pinned_hash(const uint16_t *values, size_t count);

/** The hash of a built-in scene in half or fixed12; false where none is pinned. */
bool pinned_find(const char *scene, enum sm_precision precision, uint64_t *hash);

#endif
