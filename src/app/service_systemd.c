/* SPDX-License-Identifier: MIT */
#include "app/service.h"
#include <stdio.h>
#include <systemd/sd-daemon.h>

void service_ready(void)
{
	sd_notify(0, "READY=1");
}

void service_status(const char *format, ...)
{
	char line[300];
	va_list args;
	va_start(args, format);
	vsnprintf(line, sizeof(line), format, args);
	va_end(args);
	sd_notifyf(0, "STATUS=%s", line);
}

void service_stopping(void)
{
	sd_notify(0, "STOPPING=1");
}

uint32_t service_watchdog(void)
{
	uint64_t microseconds = 0;
	if (sd_watchdog_enabled(0, &microseconds) <= 0)
		return 0;
	uint64_t half = microseconds / 2000;
	if (half > INT32_MAX) /* what poll() can wait */
		return INT32_MAX;
	return half > 0 ? (uint32_t)half : 1;
}

void service_alive(void)
{
	sd_notify(0, "WATCHDOG=1");
}
