/* SPDX-License-Identifier: MIT */
#include "fixed/primitive.h"
#include <stdlib.h>

_Static_assert(sizeof(struct fixed_blocker) == 5 * 4 * sizeof(int32_t), "whole groups of four");
_Static_assert(sizeof(struct fixed_fin) == 7 * 4 * sizeof(int32_t), "whole groups of four");
_Static_assert(sizeof(struct fixed_receiver) == 9 * 4 * sizeof(int32_t), "whole groups of four");

void fixed_blockers_finish(struct fixed_blockers *blockers)
{
	free(blockers->items);
	*blockers = (struct fixed_blockers){0};
}

void fixed_fins_finish(struct fixed_fins *fins)
{
	free(fins->items);
	*fins = (struct fixed_fins){0};
}

void fixed_receivers_finish(struct fixed_receivers *receivers)
{
	free(receivers->items);
	*receivers = (struct fixed_receivers){0};
}
