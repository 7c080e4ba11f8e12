/* SPDX-License-Identifier: MIT */
#ifndef CHECK_PINNED_H
#define CHECK_PINNED_H

#include <smoothie.h>

/** Size of the pictures whose bits are pinned, and of their shadow maps. */
#define PINNED_SIZE 256
#define PINNED_MAP 512

/** FNV-1a, 64 bits, of the high byte and then the low byte of each value. */
uint64_t pinned_hash(const uint16_t *values, size_t count);

/** The hash of the visibility that every driver must draw of light 0 of a built-in scene, at that
 *  size, in half or fixed12; false where none is pinned. */
bool pinned_find(const char *scene, enum sm_precision precision, uint64_t *hash);

#endif
