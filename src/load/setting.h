/* SPDX-License-Identifier: MIT */
#ifndef LOAD_SETTING_H
#define LOAD_SETTING_H

#include "load/plan.h"

/**
 * Applies settings "section.key=value" or "section NAME.key=value" (stage_load()) to a plan, either
 * those of lights or all others: lights may come from models, which the others may choose. Fails
 * (INPUT) with "--set section.key: cause".
 */
bool settings_apply(struct plan *plan, const char *const *settings, size_t count, bool lights,
	struct sm_error *error);

#endif
