/* SPDX-License-Identifier: MIT */
#ifndef PAGE_PAGE_H
#define PAGE_PAGE_H

#include <stddef.h>
#include <stdio.h>

/* The frame of pages that say what a run resulted in: HTML that needs nothing from a network. */

/** Starts a page and its head, with the style that pages share; more may be added to the head. */
void page_begin(const char *title, FILE *file);
/** Ends the head, starts the body. */
void page_body(FILE *file);
void page_end(FILE *file);

/** A row of a table that has a key and a value. */
void page_pair(const char *key, const char *value, FILE *file);

/** Writes bytes as a data: URI (RFC 2397) of a media type such as "image/png". */
void page_data_uri(const char *type, const void *bytes, size_t size, FILE *file);

#endif
