/* SPDX-License-Identifier: MIT */
#ifndef BASE_JSON_H
#define BASE_JSON_H

#include <stdio.h>

/** Prints text as a string of JSON (RFC 8259, section 7), with its quotes; bytes that are no UTF-8
 *  as U+FFFD. */
void json_string(FILE *file, const char *text);

#endif
