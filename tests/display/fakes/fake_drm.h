/* SPDX-License-Identifier: MIT */
#ifndef TESTS_DISPLAY_FAKE_DRM_H
#define TESTS_DISPLAY_FAKE_DRM_H

#include "fake_world.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <xf86drmMode.h>

/*
 * Display devices that are not there. They answer the calls that libdrm makes of the kernel, so
 * that libdrm itself is the real one, keep the state that the kernel would, and refuse what it
 * would. Each can be given faults.
 */

/** What a driver can do, or lacks; zero is an atomic one without further abilities. */
struct fake_abilities {
	bool no_atomic, no_universal_planes, no_dumb;
	bool no_blanks;     /**< it neither counts vertical blanks nor waits for them */
	bool modifiers;     /**< takes framebuffers with them */
	bool async_flip;    /**< flips that do not wait */
	bool async_claim;   /**< it says so, and refuses them */
	bool fences;        /**< IN_FENCE_FD, OUT_FENCE_PTR */
	bool damage;        /**< FB_DAMAGE_CLIPS: what is outside of the clip is not looked at */
	uint64_t rotations; /**< DRM_MODE_ROTATE_* of the planes; 0: no such property */
	bool refuses_rotations; /**< all but the upright one, for all that */
	bool only_by_depth;     /**< no ADDFB2 */
	uint32_t formats[4];    /**< of the planes; 0: XRGB8888, RGB565 and XRGB2101010 */
};

/** Objects of KMS, with all their properties in one list. */
enum fake_property {
	FAKE_CRTC_ID,
	FAKE_LINK_STATUS,
	FAKE_NON_DESKTOP,
	FAKE_ACTIVE,
	FAKE_MODE_ID,
	FAKE_OUT_FENCE_PTR,
	FAKE_TYPE,
	FAKE_IN_FORMATS,
	FAKE_FB_ID,
	FAKE_SRC_X,
	FAKE_SRC_Y,
	FAKE_SRC_W,
	FAKE_SRC_H,
	FAKE_CRTC_X,
	FAKE_CRTC_Y,
	FAKE_CRTC_W,
	FAKE_CRTC_H,
	FAKE_ROTATION,
	FAKE_IN_FENCE_FD,
	FAKE_FB_DAMAGE_CLIPS,
	FAKE_PROPERTIES
};

enum { FAKE_PRIMARY = 1, FAKE_OVERLAY = 0 }; /* values of "type" */

/** Two ways of each: connector i may be lit by any CRTC, plane i is CRTC i's primary one. */
enum { FAKE_CONNECTORS = 2, FAKE_CRTCS = 2, FAKE_PLANES = 3, FAKE_MODES = 4 };
enum { FAKE_OBJECTS = FAKE_CONNECTORS + FAKE_CRTCS + FAKE_PLANES };

struct fake_object {
	uint32_t id, type; /* DRM_MODE_OBJECT_* */
	bool has[FAKE_PROPERTIES];
	uint64_t values[FAKE_PROPERTIES];
};

struct fake_connector {
	uint32_t type, type_id;
	bool absent;  /**< there is no such connector */
	bool plugged; /**< a monitor is; the kernel knows once it was asked to probe */
	bool known;
	drmModeModeInfo modes[FAKE_MODES];
	size_t mode_count;
	uint32_t possible_crtcs;
};

struct fake_crtc {
	drmModeModeInfo mode;
	bool pending; /* a flip is, until `due` */
	bool wants_event;
	int64_t due;
	uint64_t user_data;
	bool has_clip;
	struct drm_mode_rect clip;
	/* What the monitor was sent: shown with the last flip that came through. */
	uint32_t shown; /* framebuffer */
	uint8_t *screen;
	uint32_t width, height, row_size;
};

struct fake_dumb {
	bool open; /* its handle */
	bool used; /* its memory */
	uint32_t width, height, pitch;
	uint64_t size;
};

struct fake_framebuffer {
	uint32_t id, width, height, format, pitch, dumb; /* dumb: index */
	uint64_t modifier;
};

struct fake_blob {
	uint32_t id, size;
	uint8_t data[256];
};

/** What can be made to fail, by either interface. */
enum fake_step {
	FAKE_SET_MODE,
	FAKE_FLIP,
	FAKE_SWITCH_OFF,
	FAKE_ADD_FRAMEBUFFER,
	FAKE_CREATE_DUMB,
	FAKE_MAP_DUMB,
	FAKE_MMAP,
	FAKE_CREATE_BLOB,
	FAKE_STEPS
};

struct fake_fault {
	int code;       /* 0: none */
	unsigned after; /* of so many that work */
	unsigned times; /* 0: from then on always */
};

enum { FAKE_BUFFERS = 12, FAKE_BLOBS = 8 };

/** Bytes from one dumb buffer's place in the memory to the next. */
enum { FAKE_DUMB_ROOM = 1 << 20 };

struct fake_drm {
	const char *path;
	struct fake_abilities can;
	int fd, far_end; /* -1: closed */
	bool gone;
	bool master, other_master;
	bool client_universal, client_atomic;
	bool withholds_events;
	struct fake_connector connectors[FAKE_CONNECTORS];
	struct fake_object objects[FAKE_OBJECTS];
	struct fake_crtc crtcs[FAKE_CRTCS];
	struct fake_dumb dumbs[FAKE_BUFFERS];
	struct fake_framebuffer framebuffers[FAKE_BUFFERS];
	struct fake_blob blobs[FAKE_BLOBS];
	int memory; /* of the dumb buffers */
	uint8_t *pixels;
	uint32_t last_id;
	struct fake_fault faults[FAKE_STEPS];
	unsigned steps[FAKE_STEPS]; /* that worked */
	unsigned async_flips;
	unsigned calls, probes;
	unsigned left;    /* framebuffers, dumb buffers and blobs that were there at a close */
	unsigned blanked; /* times that a framebuffer was removed from under a lit CRTC */
	bool last_had_in_fence;
};

enum { FAKE_CONSOLE = 1000 }; /* the framebuffer of the one who was there before */

/** Makes device 0 or 1, forgetting what it was: two connectors, of which the first, "HDMI-A-1", has
 *  a monitor of 64x48 at 60 Hz, 32x24 at 60 and at 75 Hz; the second, "DP-1", has none. */
struct fake_drm *fake_drm_init(size_t index, const struct fake_abilities *can);
/** Ends both, and all memory of theirs. */
void fake_drm_finish(void);

/** A console is shown on CRTC 0, in the connector's last mode. */
void fake_drm_light_console(struct fake_drm *drm);

/** Another program takes the display, and gives it back. */
void fake_drm_steal(struct fake_drm *drm);
void fake_drm_give_back(struct fake_drm *drm);

/** Framebuffers, dumb buffers, blobs and mappings that are there; the console's apart. */
unsigned fake_drm_count(const struct fake_drm *drm);

drmModeModeInfo fake_mode(uint16_t width, uint16_t height, uint32_t hz);

/** Lets what is due by `now` happen. */
void fake_drm_run(int64_t now);
/** When the next is due; INT64_MAX: nothing is. */
int64_t fake_drm_next(void);

/** For the fakes: */
struct fake_drm *fake_drm_at(size_t index);
int fake_drm_open(const char *path);
void fake_drm_close(int fd);
struct fake_object *fake_object(struct fake_object *objects, uint32_t id);
struct fake_crtc *fake_crtc(struct fake_drm *drm, uint32_t id);
struct fake_framebuffer *fake_framebuffer(struct fake_drm *drm, uint32_t id);
struct fake_blob *fake_blob(struct fake_drm *drm, uint32_t id);
struct fake_object *fake_primary(struct fake_object *objects, size_t crtc);
/** 0, or the error number of the fault that is due at this step. */
int fake_fault(struct fake_drm *drm, enum fake_step step);
/** Ends the flip that is on its way. */
void fake_complete(struct fake_drm *drm, size_t crtc);
/** Begins one: it comes through at the next vertical blank, or at once. */
void fake_begin_flip(struct fake_drm *drm, size_t crtc, bool at_once);
int fake_drm_atomic(struct fake_drm *drm, struct drm_mode_atomic *atomic);
int fake_drm_call(struct fake_drm *drm, unsigned long request, void *argument);
/** Checks planes against framebuffers, CRTCs against connectors. */
int fake_drm_check(struct fake_drm *drm, const struct fake_object *objects);

#endif
