/* SPDX-License-Identifier: MIT */
#include "seat_backend.h"

bool seat_ask_managers(struct seat *seat)
{
	(void)seat;
	return false;
}
