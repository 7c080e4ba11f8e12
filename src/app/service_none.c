/* SPDX-License-Identifier: MIT */
#include "app/service.h"

void service_ready(void)
{
}

void service_status(const char *format, ...)
{
	(void)format;
}

void service_stopping(void)
{
}

uint32_t service_watchdog(void)
{
	return 0;
}

void service_alive(void)
{
}
