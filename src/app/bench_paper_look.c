/* SPDX-License-Identifier: MIT */
/* What can be seen of shadows, in numbers: aliasing, how they move, and how far they are off. */
#include "app/bench_paper_part.h"
#include "app/bench_view.h"
#include "bench/statistics.h"
#include "bench/visibility_error.h"
#include "platform.h"
#include "ref/reference.h"
#include <math.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define LOOK_MAP 512   /* texels a side */
#define MOVE_CHANGES 7 /* as the light turns by a tenth of a degree each */

/* As it turns by half a degree each, so that many edges come to be silhouettes and cease. */
#define SNAP_SECONDS 5
#define SNAP_CHANGES_MAX 40

/* Two pictures of one scene, and what draws them. */
struct look {
	struct platform *platform;
	struct bench_view view;
	struct sm_renderer *renderer;
};

static uint32_t look_side(const struct paper_options *options)
{
	return options->tiny ? 64 : 512;
}

/* Texels a side where hardly one is seen. */
static uint32_t fine_map(const struct paper_options *options)
{
	return options->tiny ? 1024 : 4096;
}

static bool look_init(struct look *look, const struct paper_part *part, const char *source,
	uint32_t side, struct sm_error *error)
{
	*look = (struct look){0};
	if (!paper_stage_load(&look->view.stage, source, side, error) ||
		(look->platform = paper_open(part, error)) == NULL ||
		!bench_view_init(&look->view, error))
		return false;
	look->renderer = sm_renderer_create_with(platform_get_proc, &part->options->driver, error);
	return look->renderer != NULL;
}

static void look_finish(struct look *look)
{
	sm_renderer_destroy(look->renderer);
	bench_view_finish(&look->view);
	platform_destroy(look->platform);
}

/* Draws one of the two pictures. */
static bool look_draw(struct look *look, const struct paper_part *part, int which, double seconds,
	struct sm_error *error)
{
	if (!bench_view_draw(&look->view, look->renderer, which, seconds, error))
		return false;
	paper_step((void *)part);
	return true;
}

static double mean_square(const struct look *look)
{
	double sum = 0;
	for (size_t i = 0; i < look->view.pixels; i++) {
		double change = (double)look->view.seen[1][i] - (double)look->view.seen[0][i];
		sum += change * change;
	}
	/* A picture has pixels. */
	return sum / (double)look->view.pixels;
}

static double mean_change(const struct look *look)
{
	double sum = 0;
	for (size_t i = 0; i < look->view.pixels; i++)
		sum += fabs((double)look->view.seen[1][i] - (double)look->view.seen[0][i]);
	return sum / (double)look->view.pixels;
}

static bool measure_aliasing(struct look *look, const struct paper_part *part,
	struct sm_shadow_options shadow, double *rmse, struct sm_error *error)
{
	for (int i = 0; i < 2; i++) {
		shadow.map_size = i == 0 ? LOOK_MAP : fine_map(part->options);
		if (!sm_renderer_set_shadows(look->renderer, &shadow, error) ||
			!look_draw(look, part, i, 0, error))
			return false;
	}
	*rmse = sqrt(mean_square(look));
	return true;
}

/* Mean squares of what changes from each of `frames` + 1 frames to the next. */
static bool measure_changes(struct look *look, const struct paper_part *part,
	struct sm_shadow_options shadow, double seconds, double *changes, int frames,
	struct sm_error *error)
{
	shadow.map_size = LOOK_MAP;
	if (!sm_renderer_set_shadows(look->renderer, &shadow, error) ||
		!look_draw(look, part, 0, 0, error))
		return false;
	for (int frame = 1; frame <= frames; frame++) {
		if (!look_draw(look, part, frame % 2, frame * seconds, error))
			return false;
		changes[frame - 1] = mean_square(look);
	}
	return true;
}

static bool measure_popping(struct look *look, const struct paper_part *part,
	struct sm_shadow_options shadow, double *rms, struct sm_error *error)
{
	double changes[MOVE_CHANGES], sum = 0;
	if (!measure_changes(look, part, shadow, 1, changes, MOVE_CHANGES, error))
		return false;
	for (int i = 0; i < MOVE_CHANGES; i++)
		sum += changes[i];
	*rms = sqrt(sum / MOVE_CHANGES);
	return true;
}

bool paper_look_at_scene(const struct paper_part *part, const char *source, struct sm_error *error)
{
	static const struct sm_shadow_options hard = {.technique = "hard"},
					      smoothie = {.technique = "smoothie"};
	struct paper_scene *scene = &part->result->scenes[part->scene];
	struct look look;
	bool seen = look_init(&look, part, source, look_side(part->options), error) &&
		    measure_aliasing(&look, part, hard, &scene->aliasing.hard, error) &&
		    measure_aliasing(&look, part, smoothie, &scene->aliasing.smoothie, error) &&
		    measure_popping(&look, part, hard, &scene->popping.hard, error) &&
		    measure_popping(&look, part, smoothie, &scene->popping.smoothie, error);
	look_finish(&look);
	return seen;
}

uint32_t paper_look_at_scene_steps(const struct paper_options *options)
{
	(void)options;
	return 2 * (2 + MOVE_CHANGES + 1);
}

static int snap_changes(const struct paper_options *options)
{
	return options->tiny ? 5 : SNAP_CHANGES_MAX;
}

static bool measure_snapping(
	const struct paper_part *part, const char *source, double *ratio, struct sm_error *error)
{
	const struct sm_shadow_options thick = {.technique = "smoothie", .width = .1f};
	int count = snap_changes(part->options);
	double changes[SNAP_CHANGES_MAX];
	struct look look;
	bool seen = look_init(&look, part, source, look_side(part->options) / 2, error) &&
		    measure_changes(&look, part, thick, SNAP_SECONDS, changes, count, error);
	look_finish(&look);
	if (!seen)
		return false;
	double median = statistics_median(changes, (size_t)count);
	/* Nothing that moves: nothing that snaps. */
	*ratio = median > 0 ? sqrt(changes[count - 1] / median) : NAN;
	return true;
}

#define WAYS_MAX 5

/* Ways to draw one scene, and sums of what each is off over scenes. */
struct comparison {
	const struct sm_shadow_options *shadow; /* [count] */
	size_t count;
	struct paper_error sum[WAYS_MAX];
	double difference[WAYS_MAX]; /* mean |change of visibility| from the first */
};

static bool compare(struct look *look, const struct paper_part *part, struct comparison *comparison,
	double weight, struct sm_error *error)
{
	struct reference truth;
	struct reference_request request = {
		.scene = look->view.stage.scene,
		.camera = look->view.stage.camera,
		.width = look->view.target.width,
		.height = look->view.target.height,
		.samples = 256,
	};
	bool compared = reference_trace(&truth, &request, error);
	paper_step((void *)part);
	for (size_t i = 0; i < comparison->count && compared; i++) {
		struct error_summary off[REGIONS];
		int which = i > 0; /* the first is kept */
		compared = sm_renderer_set_shadows(look->renderer, &comparison->shadow[i], error) &&
			   look_draw(look, part, which, 0, error) &&
			   visibility_error(look->view.seen[which], truth.visibility,
				   look->view.pixels, off, error);
		if (compared) {
			comparison->sum[i].rmse += weight * off[REGION_PENUMBRA].rmse;
			comparison->sum[i].bias += weight * off[REGION_PENUMBRA].bias;
			comparison->difference[i] += i > 0 ? weight * mean_change(look) : 0;
		}
	}
	reference_finish(&truth);
	return compared;
}

/* Finds means over the scenes, for each way. */
static bool compare_all(const struct paper_part *part, const char *const *sources, size_t count,
	struct comparison *comparison, struct sm_error *error)
{
	bool compared = true;
	for (size_t i = 0; i < count && compared; i++) {
		struct look look;
		compared =
			look_init(&look, part, sources[i], look_side(part->options) / 2, error) &&
			compare(&look, part, comparison, 1.0 / (double)count, error);
		look_finish(&look);
	}
	return compared;
}

static const char *const study[] = {"builtin:cylinder", "builtin:boxes", "builtin:fence",
	"builtin:knot", "builtin:urchin", "builtin:debris"};

static size_t study_count(const struct paper_options *options)
{
	return options->tiny ? 1 : COUNT(study);
}

static bool measure_errors(const struct paper_part *part, struct sm_error *error)
{
	static const char *const fence[] = {"builtin:fence"};
	enum { LINEAR, HARD, SINUSOID, HALF, FIXED12, SOFT };
	static const struct sm_shadow_options soft[SOFT] = {
		[LINEAR] = {.technique = "smoothie", .map_size = LOOK_MAP},
		[HARD] = {.technique = "hard", .map_size = LOOK_MAP},
		[SINUSOID] = {.technique = "smoothie",
			.map_size = LOOK_MAP,
			.falloff = SM_FALLOFF_SINUSOID},
		[HALF] = {.technique = "smoothie",
			.map_size = LOOK_MAP,
			.precision = SM_PRECISION_HALF},
		[FIXED12] = {.technique = "smoothie",
			.map_size = LOOK_MAP,
			.precision = SM_PRECISION_FIXED12}};
	static const struct sm_shadow_options widths[] = {
		{.technique = "smoothie", .map_size = LOOK_MAP, .width = .02f},
		{.technique = "smoothie", .map_size = LOOK_MAP, .width = .08f}};
	_Static_assert(SOFT <= WAYS_MAX && COUNT(widths) <= WAYS_MAX, "room for every way");
	struct paper_result *result = part->result;
	struct comparison of_soft = {.shadow = soft, .count = SOFT};
	struct comparison of_widths = {.shadow = widths, .count = COUNT(widths)};
	/* Sums of some scenes are no means: the result gets whole ones. */
	if (!compare_all(part, study, study_count(part->options), &of_soft, error))
		return false;
	result->hard = of_soft.sum[HARD];
	result->linear = of_soft.sum[LINEAR];
	result->sinusoid = of_soft.sum[SINUSOID];
	result->half = (struct paper_precision){of_soft.sum[HALF], of_soft.difference[HALF]};
	result->fixed12 =
		(struct paper_precision){of_soft.sum[FIXED12], of_soft.difference[FIXED12]};
	if (!compare_all(part, fence, 1, &of_widths, error))
		return false;
	result->thin = of_widths.sum[0];
	result->thick = of_widths.sum[1];
	return true;
}

bool paper_look_closer(const struct paper_part *part, struct sm_error *error)
{
	struct paper_result *result = part->result;
	return measure_snapping(part, "builtin:knot:500", &result->snapping_coarse, error) &&
	       measure_snapping(part, "builtin:knot:50000", &result->snapping_fine, error) &&
	       (!reference_is_built() || measure_errors(part, error));
}

uint32_t paper_look_closer_steps(const struct paper_options *options)
{
	uint32_t errors = 6 * (uint32_t)study_count(options) + 3;
	return 2 * (uint32_t)(snap_changes(options) + 1) + (reference_is_built() ? errors : 0);
}
