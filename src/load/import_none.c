/* SPDX-License-Identifier: MIT */
#include "load/import.h"

bool import_model(const char *path, enum plan_up up, struct model *model, struct sm_error *error)
{
	(void)up;
	(void)model;
	return error_set(error, SM_ERROR_INPUT,
		"%s: this build reads no model files (it was made without assimp)", path);
}
