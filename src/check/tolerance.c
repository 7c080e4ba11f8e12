/* SPDX-License-Identifier: MIT */
#include "check/tolerance.h"
#include <math.h>
#include <string.h>

/* Of pictures of 256 pixels a side and more; see grow(). The model was found to be apart by a mean
 * of 6e-5, and by more than .02 in 9 pixels of 65536, with llvmpipe, softpipe and SwiftShader:
 * pixels whose middle is on an edge but for rounding. Each driver has edges of its own: thrice
 * that. GPUs have coarser reciprocals and filters. */
static const struct check_tolerance classes[CHECK_CLASS_COUNT] = {
	[CHECK_LLVMPIPE] = {.02, 4e-4, 2e-4},
	[CHECK_SOFTPIPE] = {.02, 4e-4, 2e-4},
	[CHECK_ZINK] = {.02, 4e-4, 2e-4},
	[CHECK_SWIFTSHADER] = {.02, 4e-4, 2e-4},
	[CHECK_HARDWARE] = {.02, 2e-3, 5e-4},
};

/* Ways that keep fewer digits: 14 such pixels were found, and a mean of 8e-5. */
static const char *const coarse_ways[] = {"smoothie=rgb10_a2", "smoothie=rgba8", "depth=r16f",
	"moments=rgba16f", "moments=rgba16f-fetch"};
static const double coarseness = 2;

static bool is_coarse(const char *way)
{
	for (size_t i = 0; i < sizeof(coarse_ways) / sizeof(coarse_ways[0]); i++)
		if (strcmp(coarse_ways[i], way) == 0)
			return true;
	return false;
}

struct check_tolerance check_tolerance_find(enum check_class class, const char *way)
{
	struct check_tolerance tolerance = classes[class];
	if (way != NULL && is_coarse(way)) {
		tolerance.share *= coarseness;
		tolerance.mean *= coarseness;
	}
	return tolerance;
}

/* What is off are lines, edges of things: the fewer pixels, the more of them these are. */
static double grow(size_t count)
{
	return fmax(1, 256 / sqrt((double)count));
}

void check_tolerance_judge(const struct check_tolerance *tolerance, const uint16_t *drawn,
	const uint16_t *wanted, size_t count, struct check_result *result)
{
	struct check_difference *difference = &result->difference;
	double mean = tolerance->mean * grow(count);
	check_compare(result, drawn, wanted, count, tolerance->pixel);
	difference->budget = (uint64_t)ceil(tolerance->share * grow(count) * (double)count);
	unsigned long long failing = difference->failing, budget = difference->budget;
	if (failing > budget)
		check_fail(result,
			"%llu of %zu pixels off by more than %g, %llu may be; mean %.2g, at most "
			"%.3f",
			failing, count, tolerance->pixel, budget, difference->mean,
			difference->max);
	else if (difference->mean > mean)
		check_fail(
			result, "off by %.2g on average, %.2g is allowed", difference->mean, mean);
	else
		check_pass(result,
			"%llu of %zu pixels off by more than %g, %llu may be; mean %.2g of %.2g",
			failing, count, tolerance->pixel, budget, difference->mean, mean);
}
