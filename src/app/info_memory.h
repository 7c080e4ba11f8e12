/* SPDX-License-Identifier: MIT */
#ifndef APP_INFO_MEMORY_H
#define APP_INFO_MEMORY_H

#include "app/driver_options.h"
#include "app/facts.h"
#include "app/options.h"
#include "app/scene_options.h"

/** Draws the scene and prints which memory that takes, by owner. */
bool info_memory(const struct common_options *common, const struct driver_options *driver,
	const struct scene_options *scene, bool json, struct sm_error *error);

#endif
