/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_KMS_DEVICE_H
#define PLATFORM_KMS_DEVICE_H

#include <smoothie.h>

/** What a call to the kernel's mode-setting came to. */
enum kms_result {
	KMS_DONE,
	KMS_BUSY,      /**< an earlier commit is not through yet */
	KMS_NO_MASTER, /**< another program, or another virtual terminal, has the display */
	KMS_GONE,      /**< the device was removed */
	KMS_REFUSED,   /**< the driver does not do this; something else may work */
	KMS_FAILED,    /**< anything else; errno says what */
};

/** The result of a call that returned `code`: 0, or an error number of either sign. */
enum kms_result kms_result_of(int code);

/** A display device and what its driver can do. */
struct kms_device {
	int fd; /* not owned; -1: none */
	bool universal_planes;
	bool atomic;
	bool modifiers;  /* of framebuffers, DRM_CAP_ADDFB2_MODIFIERS */
	bool dumb;       /* buffers that the processor fills */
	bool async_flip; /* flips that do not wait for the vertical blank */
};

/** Asks the driver behind fd what it can do, and for all that we can use; legacy: but not for
 *  atomic mode-setting. Fails (MACHINE) when it drives no display. */
bool kms_device_init(struct kms_device *device, int fd, bool legacy, struct sm_error *error);

/** Takes the display from nobody: fails when another program has it. */
enum kms_result kms_device_take(const struct kms_device *device);

#endif
