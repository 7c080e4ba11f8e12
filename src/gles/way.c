/* SPDX-License-Identifier: MIT */
#include "gles/way.h"
#include "base/log.h"
#include "gles/probe.h"
#include <stdio.h>
#include <string.h>

#define WAYS_MAX 7

/* clang-format off */
/* Best first. */
static const struct {
	const char *name;
	const char *what;
	struct driver_way ways[WAYS_MAX]; /* up to one without a name */
} needs[DRIVER_NEEDS] = {
	/* RG16F: 11 bits at any scale; embedded GPUs blend it, and no wider float. RGB10_A2 is core
	 * OpenGL ES 3.0: 10 bits of depth over the light's range, 10 of alpha. Framebuffer fetch
	 * comes last since it was not seen to be faster. */
	[DRIVER_SMOOTHIE] = {"smoothie", "a smoothie buffer", {
		[SMOOTHIE_RG16F] = {"rg16f", "MIN blending in RG16F",
			CAP_BIT(MIN_RG16F), GL_RG16F},
		[SMOOTHIE_RG32F] = {"rg32f", "MIN blending in RG32F",
			CAP_BIT(MIN_RG32F), GL_RG32F},
		[SMOOTHIE_RGB10_A2] = {"rgb10_a2", "MIN blending in RGB10_A2",
			CAP_BIT(MIN_RGB10_A2), GL_RGB10_A2},
		[SMOOTHIE_RGBA8] = {"rgba8", "MIN blending of alpha in RGBA8, depth by its test",
			CAP_BIT(MIN_RGBA8) | CAP_BIT(DEPTH_FETCH), GL_RGBA8},
		[SMOOTHIE_DEPTH_TEST] = {"depth-test", "alpha by the depth test, and depth",
			CAP_BIT(FRAG_DEPTH_MIN) | CAP_BIT(DEPTH_FETCH), GL_DEPTH_COMPONENT24},
		[SMOOTHIE_FETCH] = {"fetch", "a minimum that shaders take in RG16F",
			CAP_BIT(FETCH_RG16F), GL_RG16F},
	}},
	[DRIVER_DEPTH] = {"depth", "depths of a shadow map read without comparing", {
		[DEPTH_TEXTURE] = {"texture", "from the depth texture, by near and far",
			CAP_BIT(DEPTH_FETCH), 0},
		[DEPTH_R32F] = {"r32f", "R32F beside it",
			CAP_BIT(RENDER_R32F) | CAP_BIT(HIGHP_SAMPLER), GL_R32F},
		[DEPTH_R16F] = {"r16f", "linear in R16F beside it, from the middle",
			CAP_BIT(RENDER_R16F), GL_R16F},
		[DEPTH_RGBA8] = {"rgba8", "32 bits in RGBA8 beside it", 0, GL_RGBA8},
	}},
	[DRIVER_COMPARISON] = {"comparison", "comparisons at four texels, blended", {
		[COMPARISON_SAMPLER] = {"sampler", "sampler2DShadow", CAP_BIT(SHADOW_FILTER), 0},
		[COMPARISON_GATHER] = {"gather", "textureGather", CAP_BIT(TEXTURE_GATHER), 0},
		[COMPARISON_FETCH] = {"fetch", "four fetches", 0, 0},
	}},
	[DRIVER_TAPS] = {"taps", "four texels apart", {
		[TAPS_GATHER] = {"gather", "textureGather", CAP_BIT(TEXTURE_GATHER), 0},
		[TAPS_FETCH] = {"fetch", "four fetches", 0, 0},
	}},
	[DRIVER_PAIRS] = {"pairs", "smoothies at four texels", {
		[PAIRS_FUSED] = {"fused", "textureGather of integers with the shadow map in them",
			CAP_BIT(FETCH_R32I) | CAP_BIT(TEXTURE_GATHER) | CAP_BIT(DEPTH_FETCH),
			GL_R32I, CAP_BIT(SLOW_LOOKUPS)},
		[PAIRS_WORDS] = {"words", "textureGather of both as an integer",
			CAP_BIT(HALF_WORDS) | CAP_BIT(TEXTURE_GATHER), 0},
		[PAIRS_APART] = {"apart", "each as taps are", 0, 0},
	}},
	/* The square of a depth takes twice its digits: in 16 bits alone it would tell no two depths
	 * apart that are nearer than a hundredth of the light's range. */
	[DRIVER_MOMENTS] = {"moments", "the moments of depth of vsm", {
		[MOMENTS_RG32F] = {"rg32f", "RG32F, filtered",
			CAP_BIT(FILTER_RG32F), GL_RG32F},
		[MOMENTS_RG32F_FETCH] = {"rg32f-fetch", "RG32F, four fetches",
			CAP_BIT(RENDER_RG32F), GL_RG32F},
		[MOMENTS_RGBA16F] = {"rgba16f", "RGBA16F, two channels each, filtered",
			CAP_BIT(FILTER_RGBA16F), GL_RGBA16F},
		[MOMENTS_RGBA16F_FETCH] = {"rgba16f-fetch",
			"RGBA16F, two channels each, four fetches",
			CAP_BIT(RENDER_RGBA16F), GL_RGBA16F},
	}},
	[DRIVER_COPY] = {"copy", "a copy to a screen", {
		[COPY_STORED] = {"stored", "as stored", CAP_BIT(SRGB_STORED), 0},
		[COPY_ENCODE] = {"encode", "decoded and encoded again", 0, 0},
	}},
	/* Where lanes of a processor share a branch, what one of them takes all of them wait for;
	 * blocks of pixels that a first pass has drawn are passed over whole. */
	[DRIVER_BRANCH] = {"branch", "pixels that know visibility beside those that find it", {
		[BRANCH_EARLY_DEPTH] = {"early-depth", "in two passes, by the depth test",
			0, 0, CAP_BIT(SLOW_BRANCH)},
		[BRANCH_SHADER] = {"shader", "in one pass, by a branch", 0, 0},
	}},
	/* A driver that waits anyway is to do so before a pass, not in its midst, where that tears
	 * its clear off: each tile is then stored and loaded once more. */
	[DRIVER_PASSES] = {"passes", "passes whose textures others draw", {
		[PASSES_FINISHED] = {"finished", "each begun when those before it are done",
			0, 0, CAP_BIT(LATE_WAIT)},
		[PASSES_QUEUED] = {"queued", "one after the other", 0, 0},
	}},
	[DRIVER_CONSTANTS] = {"constants", "what all pixels of a light read", {
		[CONSTANTS_FLAT] = {"flat", "from vertices, the same at each",
			0, 0, CAP_BIT(SLOW_UNIFORMS)},
		[CONSTANTS_UNIFORMS] = {"uniforms", "from uniforms", 0, 0},
	}},
	[DRIVER_TABLES] = {"tables", "lists of edges", {
		[TABLES_IMAGES] = {"images", "loaded from images",
			CAP_BIT(FRAGMENT_IMAGES), 0, CAP_BIT(SLOW_LOOKUPS)},
		[TABLES_TEXTURES] = {"textures", "looked up in textures", 0, 0},
	}},
};
/* clang-format on */

const char *need_name(size_t index)
{
	return index < DRIVER_NEEDS ? needs[index].name : NULL;
}

const struct driver_way *way_at(enum driver_need need, size_t index)
{
	if (need >= DRIVER_NEEDS || index >= WAYS_MAX || needs[need].ways[index].name == NULL)
		return NULL;
	return &needs[need].ways[index];
}

/* The first of a set of caps that the driver lacks; CAP_COUNT: none. */
static enum cap lacking_cap(struct gpu *gpu, uint64_t caps)
{
	enum cap cap = 0;
	while (cap < CAP_COUNT && (!(caps >> cap & 1) || gpu_has(gpu, cap)))
		cap++;
	return cap;
}

/* The first cap for whose want a way is not taken unless it is forced. */
static enum cap wanted_cap(struct gpu *gpu, const struct driver_way *way)
{
	return lacking_cap(gpu, way->caps | way->pays);
}

static bool refuse_need(const char *path, size_t length, struct sm_error *error)
{
	char names[200];
	size_t used = 0;
	for (size_t i = 0; need_name(i) != NULL; i++)
		used += (size_t)snprintf(names + used, sizeof(names) - used, "%s%s",
			i > 0 ? ", " : "", need_name(i));
	return error_set(error, SM_ERROR_INPUT, "no need \"%.*s\"; there are: %s",
		(int)(length < 40 ? length : 40), path, names);
}

static bool refuse_way(enum driver_need need, const char *name, struct sm_error *error)
{
	char names[200];
	size_t used = 0;
	const struct driver_way *way;
	for (size_t i = 0; (way = way_at(need, i)) != NULL; i++)
		used += (size_t)snprintf(
			names + used, sizeof(names) - used, "%s%s", i > 0 ? ", " : "", way->name);
	return error_set(error, SM_ERROR_INPUT, "no way \"%.40s\" of the need %s; there are: %s",
		name, needs[need].name, names);
}

static bool force(struct gpu *gpu, const char *path, struct sm_error *error)
{
	size_t length = strcspn(path, "="), index = 0;
	enum driver_need need = 0;
	const struct driver_way *way;
	if (path[length] == '\0')
		return error_set(error, SM_ERROR_INPUT,
			"path \"%.40s\": NEED=WAY is wanted, such as smoothie=rgb10_a2", path);
	while (need < DRIVER_NEEDS && (strlen(needs[need].name) != length ||
					      strncmp(needs[need].name, path, length) != 0))
		need++;
	if (need == DRIVER_NEEDS)
		return refuse_need(path, length, error);
	while ((way = way_at(need, index)) != NULL && strcmp(way->name, path + length + 1) != 0)
		index++;
	if (way == NULL)
		return refuse_way(need, path + length + 1, error);
	enum cap cap = lacking_cap(gpu, way->caps);
	if (cap != CAP_COUNT)
		return error_set(error, SM_ERROR_MACHINE,
			"the path %.60s takes %s, which is not there: %s", path, cap_name(cap),
			gpu->caps.found[cap].why);
	gpu->ways.forced[need] = (uint8_t)(index + 1);
	return true;
}

bool ways_force(
	struct gpu *gpu, const char *const *paths, size_t path_count, struct sm_error *error)
{
	for (size_t i = 0; i < path_count; i++)
		if (!force(gpu, paths[i], error))
			return false;
	return true;
}

static int choose(struct gpu *gpu, enum driver_need need)
{
	const struct driver_way *way;
	if (gpu->ways.forced[need] != 0)
		return gpu->ways.forced[need];
	for (size_t i = 0; (way = way_at(need, i)) != NULL; i++) {
		enum cap cap = wanted_cap(gpu, way);
		if (cap == CAP_COUNT)
			return (int)i + 1;
		log_info("need %s: not %s, for want of %s", needs[need].name, way->name,
			cap_name(cap));
	}
	return 0;
}

int way_choose(struct gpu *gpu, enum driver_need need, struct sm_error *error)
{
	if (gpu->ways.chosen[need] == 0)
		gpu->ways.chosen[need] = (uint8_t)choose(gpu, need);
	if (gpu->ways.chosen[need] == 0)
		error_set(error, SM_ERROR_MACHINE, "%s has no way to have %s; see smoothie info",
			gpu->caps.renderer, needs[need].what);
	return gpu->ways.chosen[need] - 1;
}

/* "rgb10_a2 (MIN blending in RGB10_A2); rg16f was not taken because min_rg16f: taken away" */
static void describe(struct gpu *gpu, enum driver_need need, char *text, size_t size)
{
	int index = way_choose(gpu, need, NULL);
	const struct driver_way *way = index >= 0 ? way_at(need, (size_t)index) : NULL;
	bool forced = gpu->ways.forced[need] != 0;
	size_t used = (size_t)snprintf(
		text, size, "%s%s", way != NULL ? way->name : "none", forced ? ", forced" : "");
	if (way != NULL)
		used += (size_t)snprintf(text + used, size - used, " (%s)", way->summary);
	for (size_t i = 0; !forced && way_at(need, i) != way && used < size; i++) {
		enum cap cap = wanted_cap(gpu, way_at(need, i));
		used += (size_t)snprintf(text + used, size - used,
			"; %s was not taken because %s: %s", way_at(need, i)->name, cap_name(cap),
			gpu->caps.found[cap].why);
	}
}

void ways_describe(struct gpu *gpu, sm_fact fact, void *data)
{
	for (enum driver_need need = 0; need < DRIVER_NEEDS; need++) {
		char key[32], value[900];
		snprintf(key, sizeof(key), "need %s", needs[need].name);
		describe(gpu, need, value, sizeof(value));
		fact(data, key, value);
	}
}
