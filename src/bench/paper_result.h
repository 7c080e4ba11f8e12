/* SPDX-License-Identifier: MIT */
#ifndef BENCH_PAPER_RESULT_H
#define BENCH_PAPER_RESULT_H

#include "bench/run_facts.h"
#include <stdint.h>

/*
 * What the tables of two reports about smoothies hold, measured here:
 * Chan & Durand 2003, "Rendering Fake Soft Shadows with Smoothies", and
 * Volokh, "Implementation of Rendering Fake Soft Shadows with Smoothies"
 * (github.com/svolokh/FakeSoftShadows). NAN is what was not measured.
 */

enum paper_technique { PAPER_HARD, PAPER_SMOOTHIE, PAPER_BICUBIC, PAPER_TECHNIQUES };
#define PAPER_MAPS 3
#define PAPER_WIDTHS 4
#define PAPER_WIDTH_MAP 1 /* which of the maps they are timed with */
#define PAPER_SCENES_MAX 8
#define PAPER_MESHES_MAX 32
#define PAPER_SIZES_MAX 8

extern const uint32_t paper_maps[PAPER_MAPS];   /* texels a side */
extern const double paper_widths[PAPER_WIDTHS]; /* t, the fins' width, the least first */
extern const char *const paper_technique_names[PAPER_TECHNIQUES];

/** How a picture changes that should not; of hard shadows and of smoothies. */
struct paper_quality {
	double hard, smoothie;
};

/** One scene of Chan & Durand's table: whole frames, ms. */
struct paper_scene {
	char name[64];
	uint32_t wanted;                                  /* triangles of the paper's scene */
	uint64_t triangles, edges, open_edges, odd_edges; /* odd: of more than two triangles */
	uint64_t silhouette_edges, fins;
	double ms[PAPER_TECHNIQUES][PAPER_MAPS];
	double width_ms[PAPER_WIDTHS]; /* smoothies of paper_widths */
	double many_maps_ms;           /* 16 hard shadows averaged, map of 512 */
	double penumbra_map_ms;        /* Wyman & Hansen 2003, the largest map */
	struct paper_quality aliasing; /* RMSE of visibility, map of 512 against one of 4096 */
	struct paper_quality popping;  /* RMS change of visibility from frame to frame */
};

/** A mesh of Volokh's Figure 4: ms of the processor to find silhouettes and make fins. */
struct paper_mesh {
	char shape[16];
	uint64_t edges, silhouette_edges, fins;
	double ms;
};

/** A size of shadow map of Volokh's Figure 5, ms. */
struct paper_size {
	uint32_t map;      /* texels a side */
	double shadow_map; /* the pass alone */
	double buffers;    /* what smoothies draw besides, their geometry being there */
	double hard_frame, smoothie_frame;
};

/** Penumbra RMSE and mean signed error of visibility against a ray-traced reference. */
struct paper_error {
	double rmse, bias;
};

/** Smoothies in another arithmetic than floats. */
struct paper_precision {
	struct paper_error error;
	double difference; /* mean |change of visibility| from floats, in all pixels */
};

struct paper_result {
	struct run_facts facts;
	char renderer[160], driver[160]; /* as the driver calls itself, and its version */
	uint32_t picture;                /* pixels a side of the scenes */
	uint32_t rounds;                 /* frames that medians are of */
	struct paper_scene scenes[PAPER_SCENES_MAX];
	size_t scene_count;
	struct paper_mesh meshes[PAPER_MESHES_MAX]; /* each shape's together, by edges */
	size_t mesh_count;
	uint64_t size_edges; /* of the scene with which sizes are */
	struct paper_size sizes[PAPER_SIZES_MAX];
	size_t size_count;
	struct paper_error hard, linear, sinusoid; /* means of the study scenes */
	struct paper_precision half, fixed12;      /* likewise */
	struct paper_error thin, thick;            /* t of .02 and .08, a fence */
	/* The largest change of a frame over the median one, with thick fins under a light that
	 * turns: of a shape of few triangles and of many. */
	double snapping_coarse, snapping_fine;
	double seconds; /* that all took */
};

#endif
