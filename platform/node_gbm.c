/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "node.h"
#include <errno.h>
#include <fcntl.h>
#include <gbm.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xf86drm.h>

/* GBM itself would serve any file at all, in software. */
static bool is_drm(int fd)
{
	drmVersion *version = drmGetVersion(fd);
	drmFreeVersion(version);
	return version != NULL;
}

/* libgbm writes to stderr about each driver that it tries in vain, and has no switch for that. */
static struct gbm_device *create_device_quietly(int fd)
{
	int before = dup(STDERR_FILENO);
	int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
	bool quiet = before >= 0 && null >= 0 && dup2(null, STDERR_FILENO) >= 0;
	struct gbm_device *device = gbm_create_device(fd);
	if (quiet)
		dup2(before, STDERR_FILENO);
	if (null >= 0)
		close(null);
	if (before >= 0)
		close(before);
	return device;
}

struct gbm_device *node_create_gbm(int fd, bool debug)
{
	return debug ? gbm_create_device(fd) : create_device_quietly(fd);
}

bool node_init(struct node *node, const char *path, bool debug, struct sm_error *error)
{
	*node = (struct node){.fd = open(path, O_RDWR | O_CLOEXEC)};
	if (node->fd < 0)
		return error_set(error,
			errno == EACCES || errno == EPERM ? SM_ERROR_MACHINE : SM_ERROR_INPUT, "%s",
			strerror(errno));
	if (!is_drm(node->fd))
		return error_set(error, SM_ERROR_INPUT, "it is no DRM node");
	node->gbm = node_create_gbm(node->fd, debug);
	if (node->gbm == NULL)
		return error_set(error, SM_ERROR_MACHINE, "it has no GBM driver");
	return true;
}

bool node_primary(const char *path, char *primary, size_t size)
{
	int fd = open(path, O_RDWR | O_CLOEXEC);
	char *name = fd >= 0 && drmGetNodeTypeFromFd(fd) == DRM_NODE_RENDER
			     ? drmGetPrimaryDeviceNameFromFd(fd)
			     : NULL;
	bool fits = name != NULL && strlen(name) < size;
	if (fits)
		strcpy(primary, name);
	free(name);
	if (fd >= 0)
		close(fd);
	return fits;
}

void node_finish(struct node *node)
{
	if (node->gbm != NULL)
		gbm_device_destroy(node->gbm);
	if (node->fd >= 0)
		close(node->fd);
	*node = (struct node){.fd = -1};
}
