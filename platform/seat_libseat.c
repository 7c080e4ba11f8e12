/* SPDX-License-Identifier: MIT */
#include "base/log.h"
#include "seat_backend.h"
#include <errno.h>
#include <libseat.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static const char variable[] = "LIBSEAT_BACKEND"; /* libseat's own */

static PRINTF_LIKE(2, 0) void pass_on(
	enum libseat_log_level level, const char *format, va_list args)
{
	char line[500];
	(void)level;
	vsnprintf(line, sizeof(line), format, args);
	log_debug("libseat: %s", line);
}

static void enable(struct libseat *libseat, void *data)
{
	(void)libseat;
	seat_set_active(data);
}

/* The terminal switches only once the seat has been given up. */
static void disable(struct libseat *libseat, void *data)
{
	struct seat *seat = data;
	seat->active = false;
	libseat_disable_seat(libseat);
}

/* libseat_dispatch() without waiting does not notice an end of the connection. */
static bool is_connected(const struct seat *seat)
{
	struct pollfd connection = {.fd = seat->fd};
	if (poll(&connection, 1, 0) != 1)
		return true;
	errno = ECONNRESET;
	return false;
}

static bool dispatch(struct seat *seat, int timeout)
{
	return is_connected(seat) && libseat_dispatch(seat->manager, timeout) >= 0;
}

static int open_device(struct seat *seat, const char *path, int *id)
{
	int fd = -1;
	if (path[0] == '\0') { /* seatd would stop at an assertion */
		errno = ENOENT;
		return -1;
	}
	*id = libseat_open_device(seat->manager, path, &fd);
	return *id < 0 ? -1 : fd;
}

/* The manager closes its descriptor, not ours. */
static void close_device(struct seat *seat, int fd, int id)
{
	libseat_close_device(seat->manager, id);
	close(fd);
}

static void finish(struct seat *seat)
{
	libseat_close_seat(seat->manager);
}

static bool ask(struct seat *seat, const char *name)
{
	static const struct libseat_seat_listener listener = {enable, disable};
	static const struct seat_backend backend = {
		.dispatch = dispatch,
		.open = open_device,
		.close = close_device,
		.finish = finish,
	};
	struct libseat *libseat = libseat_open_seat(&listener, seat);
	if (libseat == NULL)
		return false;
	seat->backend = &backend;
	seat->name = name;
	seat->manager = libseat;
	seat->fd = libseat_get_fd(libseat);
	return true;
}

/* Left to itself, libseat would end with its built-in manager, which as root takes over whatever
 * terminal is shown, also from a shell on another machine. */
static bool ask_each(struct seat *seat)
{
	static const char *const managers[] = {"seatd", "logind"};
	bool found = false;
	for (size_t i = 0; i < sizeof(managers) / sizeof(managers[0]) && !found; i++) {
		setenv(variable, managers[i], 1);
		found = ask(seat, managers[i]);
	}
	unsetenv(variable);
	return found;
}

bool seat_ask_managers(struct seat *seat)
{
	const char *chosen = getenv(variable);
	libseat_set_log_handler(pass_on);
	libseat_set_log_level(LIBSEAT_LOG_LEVEL_DEBUG);
	if (chosen == NULL)
		return ask_each(seat);
	if (ask(seat, chosen))
		return true;
	log_warning("no seat from %s=%s: opening devices directly", variable, chosen);
	return false;
}
