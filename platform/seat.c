/* SPDX-License-Identifier: MIT */
#include "seat.h"
#include "base/array.h"
#include "base/error.h"
#include "base/log.h"
#include "seat_backend.h"
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static const int patience = 1000; /* ms for a manager to say that the seat is active */

static bool direct_dispatch(struct seat *seat, int timeout)
{
	(void)seat, (void)timeout;
	return true;
}

static int direct_open(struct seat *seat, const char *path, int *id)
{
	(void)seat;
	*id = -1;
	return open(path, O_RDWR | O_CLOEXEC);
}

static void direct_close(struct seat *seat, int fd, int id)
{
	(void)seat, (void)id;
	close(fd);
}

static void direct_finish(struct seat *seat)
{
	(void)seat;
}

static const struct seat_backend direct = {
	.dispatch = direct_dispatch,
	.open = direct_open,
	.close = direct_close,
	.finish = direct_finish,
};

void seat_set_active(struct seat *seat)
{
	seat->active = true;
	seat->activations++;
}

static int milliseconds(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (int)(now.tv_sec % 1000000 * 1000 + now.tv_nsec / 1000000);
}

/* A seat in the background stays inactive: that is no error. */
static void await_activation(struct seat *seat)
{
	int start = milliseconds(), passed = 0;
	while (!seat->active && passed < patience &&
		seat->backend->dispatch(seat, patience - passed))
		passed = milliseconds() - start;
}

struct seat *seat_create(struct sm_error *error)
{
	struct seat *seat = array_zalloc(1, sizeof(*seat));
	if (seat == NULL) {
		error_no_memory(error);
		return NULL;
	}
	*seat = (struct seat){.backend = &direct, .name = "direct", .fd = -1};
	if (seat_ask_managers(seat))
		await_activation(seat);
	else
		seat_set_active(seat);
	log_debug("seat: %s, %s", seat->name, seat->active ? "active" : "not active");
	return seat;
}

void seat_destroy(struct seat *seat)
{
	if (seat == NULL)
		return;
	while (seat->device_count > 0)
		seat_close_device(seat, seat->devices[0].fd);
	seat->backend->finish(seat);
	free(seat->devices);
	free(seat);
}

const char *seat_name(const struct seat *seat)
{
	return seat->name;
}

int seat_fd(const struct seat *seat)
{
	return seat->fd;
}

bool seat_dispatch(struct seat *seat, struct sm_error *error)
{
	if (seat->backend->dispatch(seat, 0))
		return true;
	seat->active = false;
	seat->fd = -1;
	return error_set(error, SM_ERROR_MACHINE, "%s has gone, and the seat with it: %s",
		seat->name, strerror(errno));
}

bool seat_is_active(const struct seat *seat)
{
	return seat->active;
}

unsigned seat_activations(const struct seat *seat)
{
	return seat->activations;
}

static bool refuse(const struct seat *seat, const char *path, int number, struct sm_error *error)
{
	switch (number) {
	case ENOENT:
	case ENOTDIR:
		if (access(path, F_OK) == 0) /* managers say so of what is no display or input */
			return error_set(error, SM_ERROR_INPUT, "it is no device of a seat");
		return error_set(error, SM_ERROR_INPUT, "%s", strerror(number));
	case EACCES:
	case EPERM:
		return error_set(error, SM_ERROR_MACHINE,
			"permission denied%s: run it from a seat (seatd or logind), as a member "
			"of the group video, or as root",
			seat->backend == &direct ? "" : " by the seat manager");
	case EBUSY:
		return error_set(error, SM_ERROR_MACHINE,
			"in use by another program: end that one, or run this one on a virtual "
			"terminal of its own");
	default:
		return error_set(error, SM_ERROR_MACHINE, "%s", strerror(number));
	}
}

int seat_open_device(struct seat *seat, const char *path, struct sm_error *error)
{
	struct seat_device device;
	if (!seat->active) {
		error_set(
			error, SM_ERROR_MACHINE, "the seat is not active: switch to its terminal");
		return -1;
	}
	if (!array_reserve((void **)&seat->devices, &seat->device_capacity, seat->device_count + 1,
		    sizeof(device))) {
		error_no_memory(error);
		return -1;
	}
	device.fd = seat->backend->open(seat, path, &device.id);
	if (device.fd < 0) {
		refuse(seat, path, errno, error);
		return -1;
	}
	seat->devices[seat->device_count++] = device;
	return device.fd;
}

void seat_close_device(struct seat *seat, int fd)
{
	if (fd < 0)
		return;
	for (size_t i = 0; i < seat->device_count; i++) {
		if (seat->devices[i].fd != fd)
			continue;
		seat->backend->close(seat, fd, seat->devices[i].id);
		seat->devices[i] = seat->devices[--seat->device_count];
		return;
	}
}
