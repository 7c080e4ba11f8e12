/* SPDX-License-Identifier: MIT */
#ifndef REF_REFERENCE_H
#define REF_REFERENCE_H

#include <smoothie.h>

/**
 * What is true: the share of a light that each pixel of a picture sees, found by tracing rays with
 * Embree. It reads the scene that the renderer draws, and shares nothing else with it.
 *
 * The surface of a pixel is the nearest one on the ray through its centre. The light is a disc that
 * faces that point, as a sphere shows itself; a directional light is a disc at infinity. Every
 * object that casts is in its way.
 */
struct reference {
	uint32_t width, height;
	float *visibility; /**< owned, rows from the top: visible share of the light in [0, 1]; NAN
			      where it is not judged: nothing is seen, the object receives no
			      shadow, part of the light is below the surface or within .02 (sine) of
			      it, or the point is beside a spot's square screen */
};

#define REFERENCE_SAMPLES 1024
#define REFERENCE_SAMPLES_MOST 65536
#define REFERENCE_SIZE_MOST 16384

struct reference_request {
	const struct sm_scene *scene; /**< unchanged until it is traced */
	struct sm_camera camera;
	uint32_t width, height; /**< pixels, 1 to REFERENCE_SIZE_MOST */
	uint32_t light;         /**< index */
	uint32_t samples;       /**< of the light where it is seen in part, rounded up to a square,
				     to REFERENCE_SAMPLES_MOST; 0: REFERENCE_SAMPLES */
	uint32_t threads;       /**< 0: one a processor */
	const char *cache;      /**< folder of finished references, made where it is missing; NULL:
				     none is kept */
	/** Hears of the share that is done, growing to 1, on the calling thread; of nothing where
	 *  the cache has it. May be NULL. */
	void (*progress)(void *data, double share);
	void *progress_data;
};

/** Whether this build can trace. */
bool reference_is_built(void);

/**
 * Traces a reference, or reads a finished one from the cache. The same request gives the same bits,
 * whatever the number of threads. A cache that cannot be read or written is no failure.
 * Fails (INPUT) on a camera, light, size or count out of range, (MACHINE) for lack of memory or in
 * a build without Embree; *reference is then empty.
 */
bool reference_trace(struct reference *reference, const struct reference_request *request,
	struct sm_error *error);
void reference_finish(struct reference *reference);

#endif
