/* SPDX-License-Identifier: MIT */
#ifndef APP_BENCH_PAPER_PART_H
#define APP_BENCH_PAPER_PART_H

#include "app/bench_paper.h"
#include "bench/paper_result.h"
#include "load/stage.h"

/** What bench_paper.c has measured, each part in a process of its own. */
struct paper_part {
	const struct paper_options *options;
	struct paper_result *result; /**< shared with the parent, as steps is */
	_Atomic uint32_t *steps;     /**< counts frames and pictures as they are drawn */
	size_t scene;                /**< of the result's */
};

/** Loads a SCENE whose light turns by a tenth of a degree a second. side: pixels. */
bool paper_stage_load(
	struct stage *stage, const char *source, uint32_t side, struct sm_error *error);

/** Makes a context current, for the part's end to destroy. Model files are loaded before. */
struct platform *paper_open(const struct paper_part *part, struct sm_error *error);

/** One more step; a struct paper_part as data. */
void paper_step(void *data);

/* bench_paper_time.c. The `steps` functions say how many steps the other one takes. */
bool paper_time_scene(const struct paper_part *part, const char *source, struct sm_error *error);
uint32_t paper_time_scene_steps(const struct paper_options *options);
bool paper_time_meshes(const struct paper_part *part, struct sm_error *error);
uint32_t paper_time_meshes_steps(const struct paper_options *options);
bool paper_time_sizes(const struct paper_part *part, struct sm_error *error);
uint32_t paper_time_sizes_steps(const struct paper_options *options);

/* bench_paper_look.c */
bool paper_look_at_scene(const struct paper_part *part, const char *source, struct sm_error *error);
uint32_t paper_look_at_scene_steps(const struct paper_options *options);
/** Errors against the reference, and how shapes of few triangles snap. */
bool paper_look_closer(const struct paper_part *part, struct sm_error *error);
uint32_t paper_look_closer_steps(const struct paper_options *options);

#endif
