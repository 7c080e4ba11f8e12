/* SPDX-License-Identifier: MIT */
#ifndef APP_SEQUENCE_H
#define APP_SEQUENCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/**
 * Writes the name of frame `number` into path, size bytes; false when it does not fit.
 * One "%d" or "%0Nd" in pattern (N from 1 to 9) becomes the number; in any other pattern the number
 * goes, with four digits, before the extension: out.png gives out-0001.png.
 */
bool sequence_path(const char *pattern, uint32_t number, char *path, size_t size);

#endif
