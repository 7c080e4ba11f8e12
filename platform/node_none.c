/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "node.h"

bool node_init(struct node *node, const char *path, bool debug, struct sm_error *error)
{
	(void)path, (void)debug;
	*node = (struct node){.fd = -1};
	return error_set(error, SM_ERROR_INPUT,
		"it needs GBM, which this smoothie was built without; try \"surfaceless\"");
}

bool node_primary(const char *path, char *primary, size_t size)
{
	(void)path, (void)primary, (void)size;
	return false;
}

void node_finish(struct node *node)
{
	*node = (struct node){.fd = -1};
}
