/* SPDX-License-Identifier: MIT */
#ifndef BENCH_GLYPH_H
#define BENCH_GLYPH_H

#include <stdint.h>

/** Pixels of a character; others follow one column apart, and lines below GLYPH_DESCENT more. */
#define GLYPH_WIDTH 5
#define GLYPH_HEIGHT 7
#define GLYPH_DESCENT 2

/** By how many rows it hangs below the others: 0 or GLYPH_DESCENT. */
int glyph_drop(char c);

/** The rows of a character from the top, bit 4 leftmost: small letters, digits, '-' and '.';
 * capital letters as small ones, anything else blank. */
const uint8_t *glyph_rows(char c);

#endif
