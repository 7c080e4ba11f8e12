/* SPDX-License-Identifier: MIT */
#ifndef REF_ARCHIVE_H
#define REF_ARCHIVE_H

#include "ref/content_id.h"

/**
 * A folder of finished references, one file each, by the id of their request. Files are of the
 * byte order of the machine, and checked when they are read. What fails is noted in the log for
 * debugging.
 */

/** Reads the visibility of width * height pixels; false where there is none, or a damaged one. */
bool archive_load(const char *folder, const struct content_id *id, float *visibility, size_t count);

/** Keeps it, whole or not at all. The folder is made where it is missing. */
void archive_save(
	const char *folder, const struct content_id *id, const float *visibility, size_t count);

#endif
