/* SPDX-License-Identifier: MIT */
#include "fake_world.h"
#include "base/error.h"
#include "fake_drm.h"
#include "seat.h"
#include <errno.h>
#include <gbm.h>
#include <glob.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <time.h>

#define SECOND INT64_C(1000000000)

struct fake_world fake_world;

struct seat {
	char unused;
};
static struct seat seat;

struct hotplug {
	char unused;
};
static struct hotplug hotplug;

int real_poll(struct pollfd *fds, nfds_t count, int timeout);
int real_clock_gettime(clockid_t clock, struct timespec *time);
void *real_mmap(void *address, size_t size, int protection, int flags, int fd, off_t offset);
int real_munmap(void *address, size_t size);
int real_glob(const char *pattern, int flags, int (*on_error)(const char *, int), glob_t *found);
int wrapped_poll(struct pollfd *fds, nfds_t count, int timeout);
int wrapped_clock_gettime(clockid_t clock, struct timespec *time);
void *wrapped_mmap(void *address, size_t size, int protection, int flags, int fd, off_t offset);
int wrapped_munmap(void *address, size_t size);
int wrapped_glob(const char *pattern, int flags, int (*on_error)(const char *, int), glob_t *found);

void fake_world_reset(void)
{
	fake_drm_finish();
	fake_world = (struct fake_world){.now = 1000 * SECOND, .seat_active = true};
}

void fake_world_tell(void)
{
	if (!fake_world.no_news)
		fake_world.news = HOTPLUG_CHANGED;
}

void fake_world_wait(int64_t nanoseconds)
{
	int64_t end = fake_world.now + nanoseconds;
	while (fake_drm_next() <= end) {
		if (fake_drm_next() > fake_world.now)
			fake_world.now = fake_drm_next();
		fake_drm_run(fake_world.now);
	}
	fake_world.now = end;
}

int fake_world_poll(struct pollfd *fds, nfds_t count, int64_t nanoseconds)
{
	int64_t end = fake_world.now + nanoseconds;
	fake_drm_run(fake_world.now);
	int ready = real_poll(fds, count, 0);
	while (ready == 0 && fake_world.now < end) {
		int64_t next = fake_drm_next();
		fake_world_wait((next < end ? next : end) - fake_world.now);
		ready = real_poll(fds, count, 0);
	}
	return ready;
}

int wrapped_poll(struct pollfd *fds, nfds_t count, int timeout)
{
	return fake_world_poll(fds, count, timeout * INT64_C(1000000));
}

int wrapped_clock_gettime(clockid_t clock, struct timespec *time)
{
	if (clock != CLOCK_MONOTONIC)
		return real_clock_gettime(clock, time);
	*time = (struct timespec){fake_world.now / SECOND, fake_world.now % SECOND};
	return 0;
}

static struct fake_drm *device_of(int fd)
{
	for (size_t i = 0; i < 2; i++)
		if (fd >= 0 && fake_drm_at(i)->fd == fd)
			return fake_drm_at(i);
	return NULL;
}

void *wrapped_mmap(void *address, size_t size, int protection, int flags, int fd, off_t offset)
{
	struct fake_drm *drm = device_of(fd);
	if (drm == NULL)
		return real_mmap(address, size, protection, flags, fd, offset);
	errno = drm->gone ? ENODEV : fake_fault(drm, FAKE_MMAP);
	if (errno != 0)
		return MAP_FAILED;
	fake_world.mappings++;
	return real_mmap(address, size, protection, flags, drm->memory, offset);
}

int wrapped_munmap(void *address, size_t size)
{
	fake_world.mappings--;
	return real_munmap(address, size);
}

int wrapped_glob(const char *pattern, int flags, int (*on_error)(const char *, int), glob_t *found)
{
	int code = GLOB_NOMATCH, more = GLOB_NOCHECK;
	(void)pattern, (void)flags;
	for (size_t i = 0; i < 2; i++) {
		const char *path = fake_drm_at(i)->path;
		if (path == NULL || fake_drm_at(i)->gone)
			continue;
		code = real_glob(path, more, on_error, found);
		more |= GLOB_APPEND;
	}
	return code;
}

/* Without a driver of GBM's for it, the device shows what is drawn elsewhere. */
struct gbm_device *gbm_create_device(int fd)
{
	(void)fd;
	return NULL;
}

struct seat *seat_create(struct sm_error *error)
{
	(void)error;
	return &seat;
}

void seat_destroy(struct seat *self)
{
	(void)self;
}

const char *seat_name(const struct seat *self)
{
	(void)self;
	return "fake";
}

int seat_fd(const struct seat *self)
{
	(void)self;
	return -1;
}

bool seat_dispatch(struct seat *self, struct sm_error *error)
{
	(void)self;
	return !fake_world.seat_lost || error_set(error, SM_ERROR_MACHINE, "the seat has gone");
}

bool seat_is_active(const struct seat *self)
{
	(void)self;
	return fake_world.seat_active;
}

unsigned seat_activations(const struct seat *self)
{
	(void)self;
	return fake_world.seat_activations;
}

int seat_open_device(struct seat *self, const char *path, struct sm_error *error)
{
	(void)self;
	int fd = fake_drm_open(path);
	if (fd < 0)
		error_set(error, SM_ERROR_INPUT, "No such file or directory");
	return fd;
}

void seat_close_device(struct seat *self, int fd)
{
	if (self == NULL)
		abort(); /* as the real one would */
	if (fd >= 0)
		fake_drm_close(fd);
}

struct hotplug *hotplug_create(struct sm_error *error)
{
	(void)error;
	return &hotplug;
}

void hotplug_destroy(struct hotplug *self)
{
	(void)self;
}

int hotplug_fd(const struct hotplug *self)
{
	(void)self;
	return -1;
}

enum hotplug_news hotplug_read(struct hotplug *self, dev_t device)
{
	(void)self, (void)device;
	enum hotplug_news news = fake_world.news;
	fake_world.news = HOTPLUG_NOTHING;
	return news;
}
