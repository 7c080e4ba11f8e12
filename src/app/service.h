/* SPDX-License-Identifier: MIT */
#ifndef APP_SERVICE_H
#define APP_SERVICE_H

#include "base/error.h"
#include <stdint.h>

/** What a supervised program tells its service manager (systemd, sd_notify(3)). Without one, and in
 *  a build without libsystemd, nothing is sent. */

/** The start is over: others that wait for it may go on. */
void service_ready(void);

/** One line on what it does at the moment, for `systemctl status`. */
void service_status(const char *format, ...) PRINTF_LIKE(1, 2);

/** The end has begun. */
void service_stopping(void);

/** Milliseconds within which service_alive() is to be called again and again, half of what the
 *  manager grants before it takes the program for hung; 0: it does not watch. */
uint32_t service_watchdog(void);
void service_alive(void);

#endif
