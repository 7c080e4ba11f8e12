/* SPDX-License-Identifier: MIT */
#ifndef BASE_UTF8_H
#define BASE_UTF8_H

#include <stddef.h>

/** The bytes of the character that a text goes on with, or 0 where it is no UTF-8 (RFC 3629). */
size_t utf8_size(const char *character);

#endif
