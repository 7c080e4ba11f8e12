/* SPDX-License-Identifier: MIT */
#ifndef PAGE_ESCAPE_H
#define PAGE_ESCAPE_H

#include <stdio.h>

/** Writes text as content, or as a quoted attribute, of HTML and of XML 1.0, so that no character
 *  of it is markup: blanks for controls, U+FFFD for what is no UTF-8 or no character of XML. */
void escape_markup(const char *text, FILE *file);

/** Writes text as a field of CSV (RFC 4180), between quotes where it takes them. */
void escape_csv(const char *text, FILE *file);

#endif
