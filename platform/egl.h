/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_EGL_H
#define PLATFORM_EGL_H

#include <EGL/egl.h>
#include <smoothie.h>

/** An EGL display with a context that is current without a surface; zero is empty. */
struct egl {
	EGLDisplay display;
	EGLContext context;
};

/** The display that needs neither window nor node: whichever way the EGL here offers. */
bool egl_init_surfaceless(struct egl *egl, bool debug, struct sm_error *error);

/** The display of a GBM device (struct gbm_device *), which must outlive it. */
bool egl_init_gbm(struct egl *egl, void *gbm_device, bool debug, struct sm_error *error);

/** Releases whatever an init, complete or not, has made. */
void egl_finish(struct egl *egl);

#endif
