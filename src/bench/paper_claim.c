/* SPDX-License-Identifier: MIT */
#include "bench/paper_claim.h"
#include "bench/paper_fit.h"
#include "bench/statistics.h"
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define LARGEST (PAPER_MAPS - 1)
#define VALUES_MAX (PAPER_SCENES_MAX * PAPER_MAPS)

/* A frame every 50 ms; to two papers of 2003, what real time is. */
#define REAL_TIME_MS 50

const char *verdict_name(enum verdict verdict)
{
	static const char *const names[] = {"holds", "in part", "does not hold", "not measured"};
	return names[verdict];
}

/* Numbers of several scenes, and how many of them are as claimed. */
struct poll {
	double values[VALUES_MAX];
	size_t count, held;
};

static void poll_add(struct poll *poll, double value, bool held)
{
	if (!isfinite(value))
		return;
	poll->values[poll->count++] = value;
	poll->held += held;
}

static enum verdict poll_verdict(const struct poll *poll)
{
	if (poll->count == 0)
		return VERDICT_UNMEASURED;
	return poll->held == poll->count ? VERDICT_HOLDS
	       : poll->held > 0          ? VERDICT_PARTLY
					 : VERDICT_FAILS;
}

/* "NAME LEAST to MOST, median MIDDLE; in HELD of COUNT" */
static enum verdict poll_judge(
	struct poll *poll, const char *name, const char *what, char *evidence)
{
	enum verdict verdict = poll_verdict(poll);
	if (verdict == VERDICT_UNMEASURED)
		return verdict;
	double median = statistics_median(poll->values, poll->count);
	snprintf(evidence, PAPER_EVIDENCE_MAX, "%s %.3g to %.3g, median %.3g; %s in %zu of %zu",
		name, poll->values[0], poll->values[poll->count - 1], median, what, poll->held,
		poll->count);
	return verdict;
}

/* How much longer one technique's frames take than another's, over scenes and maps. */
static enum verdict judge_slower(const struct paper_result *result, enum paper_technique slow,
	enum paper_technique fast, char *evidence)
{
	struct poll poll = {.count = 0};
	for (size_t i = 0; i < result->scene_count; i++)
		for (int map = 0; map < PAPER_MAPS; map++) {
			const struct paper_scene *scene = &result->scenes[i];
			double ratio = scene->ms[slow][map] / scene->ms[fast][map];
			poll_add(&poll, ratio, ratio > 1);
		}
	char name[64];
	snprintf(name, sizeof(name), "%s / %s", paper_technique_names[slow],
		paper_technique_names[fast]);
	return poll_judge(&poll, name, "above 1", evidence);
}

static enum verdict judge_hard(const struct paper_result *result, char *evidence)
{
	return judge_slower(result, PAPER_SMOOTHIE, PAPER_HARD, evidence);
}

static enum verdict judge_bicubic(const struct paper_result *result, char *evidence)
{
	return judge_slower(result, PAPER_BICUBIC, PAPER_SMOOTHIE, evidence);
}

static enum verdict judge_width(const struct paper_result *result, char *evidence)
{
	struct poll poll = {.count = 0};
	for (size_t i = 0; i < result->scene_count; i++) {
		const double *ms = result->scenes[i].width_ms;
		double most = 0;
		for (int w = 1; w < PAPER_WIDTHS; w++)
			most = fmax(most, ms[w] / ms[0]);
		/* fmax() passes NAN over. */
		poll_add(&poll, most > 0 ? most : NAN, most <= 1.15);
	}
	return poll_judge(&poll, "slowest of t = .05, .1, .2 / t = .02:", "at most 1.15", evidence);
}

/* What silhouettes and what triangles have to do with the time above hard shadows. */
static enum verdict judge_scaling(
	const struct paper_result *result, double (*ms)(const struct paper_scene *), char *evidence)
{
	double extra[PAPER_SCENES_MAX], silhouettes[PAPER_SCENES_MAX], triangles[PAPER_SCENES_MAX];
	for (size_t i = 0; i < result->scene_count; i++) {
		const struct paper_scene *scene = &result->scenes[i];
		extra[i] = ms(scene) - scene->ms[PAPER_HARD][LARGEST];
		silhouettes[i] = (double)scene->silhouette_edges;
		triangles[i] = (double)scene->triangles;
	}
	double by_silhouettes = fit_correlation(silhouettes, extra, result->scene_count);
	double by_triangles = fit_correlation(triangles, extra, result->scene_count);
	if (isnan(by_silhouettes) || isnan(by_triangles))
		return VERDICT_UNMEASURED;
	snprintf(evidence, PAPER_EVIDENCE_MAX,
		"correlation of ms above hard, map of %u, over %zu scenes: %.2f with silhouette "
		"edges (wanted: .9 and more than with triangles), %.2f with triangles",
		paper_maps[LARGEST], result->scene_count, by_silhouettes, by_triangles);
	if (by_silhouettes <= by_triangles)
		return VERDICT_FAILS;
	return by_silhouettes >= .9 ? VERDICT_HOLDS : VERDICT_PARTLY;
}

static double smoothie_ms(const struct paper_scene *scene)
{
	return scene->ms[PAPER_SMOOTHIE][LARGEST];
}

static double penumbra_map_ms(const struct paper_scene *scene)
{
	return scene->penumbra_map_ms;
}

static enum verdict judge_smoothie_scaling(const struct paper_result *result, char *evidence)
{
	return judge_scaling(result, smoothie_ms, evidence);
}

static enum verdict judge_penumbra_scaling(const struct paper_result *result, char *evidence)
{
	return judge_scaling(result, penumbra_map_ms, evidence);
}

static enum verdict judge_real_time(
	const struct paper_result *result, double (*ms)(const struct paper_scene *), char *evidence)
{
	struct poll poll = {.count = 0};
	for (size_t i = 0; i < result->scene_count; i++)
		poll_add(&poll, ms(&result->scenes[i]), ms(&result->scenes[i]) <= REAL_TIME_MS);
	return poll_judge(&poll, "ms a frame, map of 1024:", "20 frames a second", evidence);
}

static enum verdict judge_smoothie_real_time(const struct paper_result *result, char *evidence)
{
	return judge_real_time(result, smoothie_ms, evidence);
}

static enum verdict judge_penumbra_real_time(const struct paper_result *result, char *evidence)
{
	return judge_real_time(result, penumbra_map_ms, evidence);
}

static enum verdict judge_dense(const struct paper_result *result, char *evidence)
{
	struct poll poll = {.count = 0};
	for (size_t i = 0; i < result->scene_count; i++) {
		double ratio =
			result->scenes[i].ms[PAPER_SMOOTHIE][1] / result->scenes[i].many_maps_ms;
		poll_add(&poll, ratio, ratio <= .5);
	}
	return poll_judge(&poll, "smoothie / 16 shadow maps, 512:", "at most half", evidence);
}

static enum verdict judge_quality(
	const struct paper_result *result, size_t offset, const char *name, char *evidence)
{
	struct poll poll = {.count = 0};
	for (size_t i = 0; i < result->scene_count; i++) {
		struct paper_quality quality;
		memcpy(&quality, (const char *)&result->scenes[i] + offset, sizeof(quality));
		double ratio = quality.smoothie / quality.hard;
		poll_add(&poll, ratio, ratio <= .5);
	}
	return poll_judge(&poll, name, "at most half", evidence);
}

static enum verdict judge_aliasing(const struct paper_result *result, char *evidence)
{
	return judge_quality(result, offsetof(struct paper_scene, aliasing),
		"RMSE of a map of 512 against one of 4096, smoothie / hard:", evidence);
}

static enum verdict judge_popping(const struct paper_result *result, char *evidence)
{
	return judge_quality(result, offsetof(struct paper_scene, popping),
		"RMS change a frame under a light that turns, smoothie / hard:", evidence);
}

static enum verdict judge_meshes(const struct paper_result *result, char *evidence)
{
	struct poll poll = {.count = 0};
	uint64_t open = 0, odd = 0;
	for (size_t i = 0; i < result->scene_count; i++) {
		const struct paper_scene *scene = &result->scenes[i];
		poll_add(
			&poll, (double)scene->fins, scene->silhouette_edges > 0 && scene->fins > 0);
		open += scene->open_edges > 0;
		odd += scene->odd_edges > 0;
	}
	if (poll.count == 0)
		return VERDICT_UNMEASURED;
	snprintf(evidence, PAPER_EVIDENCE_MAX,
		"fins were made in %zu of %zu scenes; %" PRIu64 " have open edges, %" PRIu64
		" edges of more than two triangles, and those are drawn too",
		poll.held, poll.count, open, odd);
	return poll_verdict(&poll);
}

static enum verdict judge_soft(const struct paper_result *result, char *evidence)
{
	double hard = result->hard.rmse, soft = result->linear.rmse;
	if (isnan(hard) || isnan(soft))
		return VERDICT_UNMEASURED;
	snprintf(evidence, PAPER_EVIDENCE_MAX,
		"penumbra RMSE against ray tracing, study scenes: %.3f, hard %.3f; bias %+.3f, "
		"hard %+.3f",
		soft, hard, result->linear.bias, result->hard.bias);
	return soft < hard ? VERDICT_HOLDS : VERDICT_FAILS;
}

static enum verdict judge_sinusoid(const struct paper_result *result, char *evidence)
{
	double linear = result->linear.rmse, sinusoid = result->sinusoid.rmse;
	if (isnan(linear) || isnan(sinusoid))
		return VERDICT_UNMEASURED;
	snprintf(evidence, PAPER_EVIDENCE_MAX,
		"looks are not measured; penumbra RMSE against ray tracing %.3f, linear %.3f",
		sinusoid, linear);
	return sinusoid < linear ? VERDICT_HOLDS : VERDICT_FAILS;
}

/* Whatever a pixel takes is in 12 bits, not the buffer alone. */
static enum verdict judge_fixed(const struct paper_result *result, char *evidence)
{
	const struct paper_precision *fixed = &result->fixed12, *half = &result->half;
	double floats = result->linear.rmse;
	if (isnan(fixed->error.rmse) || isnan(half->error.rmse) || isnan(floats))
		return VERDICT_UNMEASURED;
	snprintf(evidence, PAPER_EVIDENCE_MAX,
		"penumbra RMSE against ray tracing in fixed12 %.4f, half %.4f, floats %.4f "
		"(wanted: at most 1 %% above floats); mean difference of visibility from floats "
		"%.5f, half %.5f (wanted: at most half a step of 8 bits, .00196)",
		fixed->error.rmse, half->error.rmse, floats, fixed->difference, half->difference);
	bool near = fixed->error.rmse <= 1.01 * floats, unseen = fixed->difference <= .5 / 255;
	return near && unseen ? VERDICT_HOLDS : near || unseen ? VERDICT_PARTLY : VERDICT_FAILS;
}

/* Of meshes of one shape from `first` on, with 10,000 edges and more: below that, what every frame
 * costs counts too. Returns the first of another shape. */
static size_t shape_exponent(const struct paper_result *result, size_t first, double *exponent)
{
	double edges[PAPER_MESHES_MAX], ms[PAPER_MESHES_MAX];
	size_t i = first, count = 0;
	for (; i < result->mesh_count; i++) {
		const struct paper_mesh *mesh = &result->meshes[i];
		if (strcmp(mesh->shape, result->meshes[first].shape) != 0)
			break;
		if (mesh->edges < 10000)
			continue;
		edges[count] = (double)mesh->edges;
		ms[count++] = mesh->ms;
	}
	*exponent = fit_exponent(edges, ms, count);
	return i;
}

static enum verdict judge_linear(const struct paper_result *result, char *evidence)
{
	struct poll poll = {.count = 0};
	size_t used = 0;
	for (size_t i = 0; i < result->mesh_count;) {
		const char *shape = result->meshes[i].shape;
		double exponent;
		i = shape_exponent(result, i, &exponent);
		poll_add(&poll, exponent, exponent >= .8 && exponent <= 1.2);
		if (isfinite(exponent) && used < PAPER_EVIDENCE_MAX)
			used += (size_t)snprintf(evidence + used, PAPER_EVIDENCE_MAX - used,
				"%s%s: edges^%.2f", used > 0 ? ", " : "time grows as: ", shape,
				exponent);
	}
	if (poll.count > 0 && used < PAPER_EVIDENCE_MAX)
		snprintf(evidence + used, PAPER_EVIDENCE_MAX - used,
			" (wanted: .8 to 1.2 from 10,000 edges on)");
	return poll_verdict(&poll);
}

static enum verdict judge_buffers(const struct paper_result *result, char *evidence)
{
	struct poll below = {.count = 0}, above = {.count = 0};
	for (size_t i = 0; i < result->size_count; i++) {
		const struct paper_size *size = &result->sizes[i];
		double share = size->buffers / size->shadow_map;
		poll_add(size->map < 4096 ? &below : &above, share,
			size->map < 4096 ? share <= .25 : share > .25);
	}
	if (below.count == 0 || above.count == 0)
		return VERDICT_UNMEASURED;
	double low = statistics_median(below.values, below.count);
	double high = statistics_median(above.values, above.count);
	snprintf(evidence, PAPER_EVIDENCE_MAX,
		"above the shadow map alone: %.0f to %.0f %% below a map of 4096 (median %.0f; "
		"wanted: at most 25), %.0f to %.0f %% from there on (median %.0f; wanted: more)",
		100 * below.values[0], 100 * below.values[below.count - 1], 100 * low,
		100 * above.values[0], 100 * above.values[above.count - 1], 100 * high);
	struct poll both = {.count = below.count + above.count, .held = below.held + above.held};
	return poll_verdict(&both);
}

static enum verdict judge_snapping(const struct paper_result *result, char *evidence)
{
	double coarse = result->snapping_coarse, fine = result->snapping_fine;
	if (isnan(coarse) || isnan(fine))
		return VERDICT_UNMEASURED;
	snprintf(evidence, PAPER_EVIDENCE_MAX,
		"largest RMS change of a frame / median, under a light that turns, t = .1: %.2f "
		"with few triangles, %.2f with many (wanted: 1.5 times as much)",
		coarse, fine);
	return coarse >= 1.5 * fine ? VERDICT_HOLDS
	       : coarse > fine      ? VERDICT_PARTLY
				    : VERDICT_FAILS;
}

static enum verdict judge_openings(const struct paper_result *result, char *evidence)
{
	struct paper_error thin = result->thin, thick = result->thick;
	if (isnan(thin.rmse) || isnan(thick.rmse))
		return VERDICT_UNMEASURED;
	snprintf(evidence, PAPER_EVIDENCE_MAX,
		"penumbra RMSE behind a fence, t = .02 and .08: %.3f and %.3f, bias %+.3f and "
		"%+.3f",
		thin.rmse, thick.rmse, thin.bias, thick.bias);
	return thin.rmse < thick.rmse && thin.bias > thick.bias ? VERDICT_HOLDS : VERDICT_FAILS;
}

static const char chan[] = "Chan & Durand 2003", volokh[] = "Volokh",
		  wyman[] = "Wyman & Hansen 2003";

static const struct {
	const char *source, *text;
	enum verdict (*judge)(const struct paper_result *result, char *evidence);
	const char *unmeasured; /* why, or what is missing */
} claims_known[] = {
	{chan, "Smoothies are drawn in real time.", judge_smoothie_real_time, "no times"},
	{chan, "They cost more than the shadow map that they are added to.", judge_hard,
		"no times"},
	{chan, "They are faster than bicubic percentage-closer filtering.", judge_bicubic,
		"this build has no pcf of 16 samples"},
	{chan, "The width t costs little: .2 at most 15 % more than .02.", judge_width, "no times"},
	{chan, "What they cost goes with the silhouette edges, not with the triangles.",
		judge_smoothie_scaling, "too few scenes"},
	{chan, "They do without the cost of sampling an area light densely.", judge_dense,
		"this build has no maps of 16 samples"},
	{chan, "Their soft edges hide the aliasing of shadow maps.", judge_aliasing, "no pictures"},
	{chan, "They move smoothly, without popping, as light and objects do.", judge_popping,
		"no pictures"},
	{chan, "Their shadows look like soft ones.", judge_soft, "this build has no reference"},
	{chan, "A sinusoid looks better than a linear falloff.", judge_sinusoid,
		"this build has no reference"},
	{chan, "Any edge-manifold mesh may cast them.", judge_meshes, "no scenes"},
	{chan, "Fixed point of 12 bits suffices for the smoothie buffer.", judge_fixed,
		"this build has no reference"},
	{volokh, "The time for silhouettes and fins is linear in the edges.", judge_linear,
		"no meshes"},
	{volokh,
		"Smoothie buffers add little to a shadow map below 4096 texels, and much from "
		"there on.",
		judge_buffers, "no maps of such sizes"},
	{volokh, "Thick smoothies of meshes with few triangles snap as a light moves.",
		judge_snapping, "no pictures"},
	{volokh, "Before small openings thin smoothies are better; thick ones are too dark.",
		judge_openings, "this build has no reference"},
	{wyman, "Penumbra maps are drawn in real time.", judge_penumbra_real_time,
		"this build has no penumbra-map"},
	{wyman, "What they cost goes with the silhouette edges, not with the triangles.",
		judge_penumbra_scaling, "this build has no penumbra-map, or too few scenes"},
};
_Static_assert(COUNT(claims_known) <= PAPER_CLAIMS_MAX, "room for every claim");

size_t paper_claims_judge(
	const struct paper_result *result, struct paper_claim claims[PAPER_CLAIMS_MAX])
{
	for (size_t i = 0; i < COUNT(claims_known); i++) {
		claims[i] = (struct paper_claim){
			.source = claims_known[i].source, .text = claims_known[i].text};
		claims[i].verdict = claims_known[i].judge(result, claims[i].evidence);
		if (claims[i].verdict == VERDICT_UNMEASURED)
			snprintf(claims[i].evidence, PAPER_EVIDENCE_MAX, "%s",
				claims_known[i].unmeasured);
	}
	return COUNT(claims_known);
}
