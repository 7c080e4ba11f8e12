/* SPDX-License-Identifier: MIT */
#ifndef LOAD_GLTF_H
#define LOAD_GLTF_H

#include <stdbool.h>

/**
 * Whether an animation of a glTF file, text or binary, goes from key to key in steps or cubic
 * splines, of which assimp 5.2 says nothing. False also where the file cannot be read, or has more
 * than 64 MiB of JSON.
 */
bool gltf_has_curves(const char *path);

#endif
