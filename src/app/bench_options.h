/* SPDX-License-Identifier: MIT */
#ifndef APP_BENCH_OPTIONS_H
#define APP_BENCH_OPTIONS_H

#include "app/driver_options.h"

#define BENCH_SCENES_MAX 64
#define BENCH_TECHNIQUES_MAX 64
#define BENCH_RADII_MAX 16
#define BENCH_MAPS_MAX 16

/** A technique, and how many samples it takes. */
struct bench_technique {
	char name[32];         /**< "pcss-16" where there are several choices, else "pcss" */
	const char *technique; /**< of sm_technique_name() */
	uint32_t samples;      /**< as sm_shadow_options */
	enum sm_precision precision;
};

struct bench_size {
	uint32_t width, height; /**< pixels */
};

/** What to measure: every technique on every scene, at every radius and size of map. */
struct bench_options {
	struct common_options common;
	struct driver_options driver;
	const char *scenes[BENCH_SCENES_MAX];
	struct bench_technique techniques[BENCH_TECHNIQUES_MAX];
	double radii[BENCH_RADII_MAX]; /**< of the light, as shares of its distance */
	uint32_t maps[BENCH_MAPS_MAX]; /**< texels a side */
	size_t scene_count, technique_count, radius_count, map_count;
	uint32_t precisions; /**< bits: 1 << enum sm_precision */
	struct bench_size time_size, error_size;
	uint32_t rounds;              /**< frames timed of each technique */
	uint32_t samples;             /**< of the reference, in mixed pixels */
	const char *out;              /**< folder of what is written */
	const char *compare;          /**< results.csv of another run; NULL: none */
	bool paper;                   /**< the papers' own tables instead: bench_paper.h */
	const char *models;           /**< folder for these; may be NULL */
	bool stress;                  /**< numerical stress instead: bench_stress.h */
	const char *sweep;            /**< the only one of it; NULL: all */
	uint32_t seed, random_scenes; /**< of it; 0: the default */
	bool errors;                  /**< no times, no memory */
	bool quick;                   /**< a part that takes minutes instead of an hour */
};

/** The run of the command (bench.c). */
bool bench_run(int argc, char **argv, struct sm_error *error);

/** Reads the command line and fills in the defaults. Fails (INPUT); then, too, finish is to be
 *  called. */
bool bench_options_read(
	struct bench_options *options, int argc, char **argv, struct sm_error *error);
void bench_options_finish(struct bench_options *options);

#endif
