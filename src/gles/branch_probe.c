/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L /* clock_gettime() */
#include "gles/branch_probe.h"
#include "gles/target.h"
#include <math.h>
#include <time.h>

/* Pixels a side: less than a tile of a software driver, so that one thread draws it. */
#define SIDE 32
/* Each time is the least of so many. */
#define ROUNDS 5
/* Draws that are timed together are doubled, up to so many, until all pixels' work takes so long.
 */
#define DRAWS_MAX 64
#define WORK_MS 0.5
/* The name in the store, after the driver's. */
#define FACT "branch: percent that half of the pixels takes"

/* Where pixels are so quick that draws take longer than all their work, it matters to no one. */
#define WORK_SHARE_MIN 0.25
/* Half of the pixels take half of the work where a branch passes over it, and all of it where it
 * does not. */
#define SLOW_PERCENT 75

/* What is drawn: nothing but the pixels, or work in none, half or all of them. */
enum load { LOAD_PLAIN, LOAD_HALF, LOAD_ALL, LOADS };

static double now_ms(void)
{
	struct timespec time = {0};
	clock_gettime(CLOCK_MONOTONIC, &time);
	return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

static double draw_ms(
	struct gl *gl, const struct program *const programs[LOADS], enum load load, int draws)
{
	gl->UseProgram(programs[load]->name);
	gl->Uniform4f(programs[load]->uniform.probe_value, (float)load, 0.0f, 0.0f, 0.0f);
	double start = now_ms();
	for (int i = 0; i < draws; i++)
		gl->DrawArrays(GL_TRIANGLES, 0, 3);
	gl->Finish();
	return now_ms() - start;
}

/* The least times, all loads in turn so that what else the machine does concerns each. */
static void time_loads(
	struct gl *gl, const struct program *const programs[LOADS], int draws, double ms[LOADS])
{
	for (int round = 0; round < ROUNDS; round++)
		for (enum load load = 0; load < LOADS; load++) {
			double time = draw_ms(gl, programs, load, draws);
			ms[load] = round == 0 ? time : fmin(ms[load], time);
		}
}

/* What half of the pixels take of all pixels' work, percent; 0 where that is too little to tell. */
static uint32_t half_percent(const double ms[LOADS])
{
	double work = ms[LOAD_ALL] - ms[LOAD_PLAIN];
	if (!(work > WORK_SHARE_MIN * ms[LOAD_ALL]))
		return 0;
	return (uint32_t)lround(
		100.0 * fmax(fmin((ms[LOAD_HALF] - ms[LOAD_PLAIN]) / work, 2.0), 0.0));
}

static bool measure(struct gpu *gpu, uint32_t *percent)
{
	struct gl *gl = &gpu->gl;
	struct target target = {0};
	struct program_key plain = {PROGRAM_PROBE_DRAW, 0}, branch = {PROGRAM_PROBE_BRANCH, 0};
	const struct program *programs[LOADS] = {program_use(&gpu->programs, gl, plain, NULL)};
	programs[LOAD_HALF] = programs[LOAD_ALL] = program_use(&gpu->programs, gl, branch, NULL);
	double ms[LOADS];
	bool made = programs[LOAD_PLAIN] != NULL && programs[LOAD_ALL] != NULL &&
		    target_init(&target, gl, STORAGE_PROBES, SIDE, GL_RGBA8, GL_COLOR_ATTACHMENT0,
			    NULL);
	if (made) {
		target_bind(&target, gl);
		gl->BindVertexArray(0);
		int draws = 1;
		time_loads(gl, programs, draws, ms);
		while (draws < DRAWS_MAX && ms[LOAD_ALL] < WORK_MS)
			time_loads(gl, programs, draws *= 2, ms);
		*percent = half_percent(ms);
	}
	target_finish(&target, gl);
	return made && gl_take_error(gl) == NULL;
}

void branch_probe_run(struct gpu *gpu)
{
	const struct program_binaries *store = &gpu->programs.binaries;
	uint32_t percent;
	bool kept = program_fact_load(store, FACT, &percent);
	if (!kept && !measure(gpu, &percent)) {
		caps_note(&gpu->caps, CAP_SLOW_BRANCH, false, "it cannot be drawn");
		return;
	}
	if (!kept && percent > 0)
		program_fact_save(store, FACT, percent);
	if (percent == 0)
		caps_note(&gpu->caps, CAP_SLOW_BRANCH, false, "too quick to tell");
	else
		caps_note(&gpu->caps, CAP_SLOW_BRANCH, percent > SLOW_PERCENT,
			"%s, half of the pixels take %u %% of all", kept ? "kept" : "timed",
			percent);
}
