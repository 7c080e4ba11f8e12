/* SPDX-License-Identifier: MIT */
/*
 * Six scenes against ray-traced ground truth: how far shadows of a light of radius R at distance d
 * are off. What is expected was found by an independent study of the techniques on a processor.
 */
#include "gles/raster_grid.h"
#include "load/stage.h"
#include "renderer.h"
#include "truth.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#define SIZE 512
#define DISTANCE 5.73149 /* d, of all scenes */
#define TOLERANCE 0.15   /* of the study's error */

static const char *const scenes[] = {"cylinder", "boxes", "fence", "knot", "urchin", "debris"};
#define SCENES (sizeof(scenes) / sizeof(scenes[0]))

/* R / d, as the files of the ground truth have it. */
static const char *const shares[] = {"0.01", "0.03", "0.10"};
#define SHARES (sizeof(shares) / sizeof(shares[0]))
#define SHARE_03 1

/* Root mean square error over the penumbra, with a shadow map of 512 texels. */
struct study {
	const char *technique, *setting; /* the second may be NULL */
	double means[SHARES];            /* of the six scenes */
	double at_03[SCENES]; /* by scene at R / d = .03; 0: the study has the mean alone */
	bool or_better;       /* ours may be less wrong */
	/* Most pixels beside the penumbra that may be off by .1, at R / d = .03: a fifth more than
	 * there are. Thin posts and spikes lose parts of their shadows between texels. */
	uint32_t outside_wrong[SCENES];
};

static const struct study hard = {
	.technique = "shadow.technique=hard",
	.means = {0.293, 0.273, 0.283},
	.at_03 = {0.262, 0.267, 0.284, 0.265, 0.274, 0.288},
	.outside_wrong = {20, 5, 650, 12, 120, 115},
};

static const struct study pcf = {
	.technique = "shadow.technique=pcf",
	.means = {0.191, 0.232, 0.268},
	.at_03 = {0.235, 0.227, 0.218, 0.228, 0.228, 0.254},
	.outside_wrong = {20, 5, 650, 12, 120, 115},
};

static const struct study bicubic = {
	.technique = "shadow.technique=pcf",
	.setting = "shadow.samples=16",
	.means = {0.146, 0.212, 0.261},
	.at_03 = {0.221, 0.206, 0.199, 0.206, 0.204, 0.236},
	.outside_wrong = {30, 5, 780, 12, 120, 215},
};

static const struct study linear = {
	.technique = "shadow.technique=smoothie",
	.setting = "shadow.falloff=linear",
	.means = {0.185, 0.219, 0.247},
	.at_03 = {0.224, 0.222, 0.198, 0.215, 0.215, 0.239},
	.outside_wrong = {20, 5, 650, 12, 120, 115},
};

static const struct study sinusoid = {
	.technique = "shadow.technique=smoothie",
	.setting = "shadow.falloff=sinusoid",
	.means = {0.212, 0.235, 0.260},
	.at_03 = {0.240, 0.235, 0.217, 0.233, 0.232, 0.255},
	.outside_wrong = {20, 5, 650, 12, 120, 115},
};

/* Blockers of several depths are taken for one, and the region may hold others than those that
 * darken: light in the core. */
static const struct study pcss_16 = {
	.technique = "shadow.technique=pcss",
	.setting = "shadow.samples=16",
	.means = {0.085, 0.070, 0.091},
	.or_better = true,
	.outside_wrong = {90, 215, 890, 40, 240, 2700},
};

static const struct study pcss_32 = {
	.technique = "shadow.technique=pcss",
	.setting = "shadow.samples=32",
	.means = {0.078, 0.060, 0.083},
	.or_better = true,
	.outside_wrong = {90, 215, 890, 40, 240, 2700},
};

/* Where blockers overlap the bound lets light through. */
static const struct study vsm_5 = {
	.technique = "shadow.technique=vsm",
	.setting = "shadow.samples=5",
	.means = {0.141, 0.153, 0.234},
	.outside_wrong = {65, 10, 1390, 20, 380, 2420},
};

static const struct study vsm_9 = {
	.technique = "shadow.technique=vsm",
	.setting = "shadow.samples=9",
	.means = {0.217, 0.128, 0.205},
	.outside_wrong = {190, 280, 2440, 135, 1710, 5600},
};

static const struct study maps_4 = {
	.technique = "shadow.technique=maps",
	.setting = "shadow.samples=4",
	.means = {0.155, 0.130, 0.131},
	.or_better = true,
	.outside_wrong = {25, 10, 810, 12, 120, 125},
};

static const struct study maps_16 = {
	.technique = "shadow.technique=maps",
	.setting = "shadow.samples=16",
	.means = {0.071, 0.050, 0.045},
	.or_better = true,
	.outside_wrong = {25, 5, 810, 12, 120, 115},
};

static const struct study maps_64 = {
	.technique = "shadow.technique=maps",
	.setting = "shadow.samples=64",
	.means = {0.050, 0.028, 0.022},
	.or_better = true,
	.outside_wrong = {25, 5, 810, 12, 120, 115},
};

/* Where penumbrae meet, one edge alone leaves light in the umbra. */
static const struct study two_sided = {
	.technique = "shadow.technique=smoothie-two-sided",
	.means = {0.069, 0.081, 0.117},
	.at_03 = {0.013, 0.059, 0.156, 0.038, 0.087, 0.132},
	.outside_wrong = {18, 41, 524, 12, 135, 960},
	.or_better = true,
};

/* Texels that were found for a deeper surface darken the one beside it. */
static const struct study penumbra_map = {
	.technique = "shadow.technique=penumbra-map",
	.means = {0.305, 0.321, 0.357},
	.at_03 = {0.330, 0.332, 0.292, 0.308, 0.318, 0.346},
	.outside_wrong = {20, 28, 1084, 65, 324, 521},
};

/* The study knew two layers of sheets, and no way to tell a caster's own sheet. Its rays start a
 * little above surfaces: by a reference that does without, the urchin has one pixel less. */
static const struct study gather = {
	.technique = "shadow.technique=gather",
	.means = {0.014, 0.013, 0.027},
	.outside_wrong = {20, 20, 20, 20, 21, 20},
	.or_better = true,
};

/* Pixels more that may be so on a raster grid of 4 bits, a fifth more than there are: the same with
 * each technique, 13 of the knot and 38 of the debris. Corners are moved by up to 1/32 of a pixel
 * there, and where a surface is seen edge on that takes pixels of it deep into its own shadow. */
static const uint32_t coarse_wrong[SCENES] = {[3] = 16, [5] = 46};
#define COARSE_BITS 4

static void draw_scene(struct visibility *seen, struct rig *rig, const struct study *study,
	const char *scene, double share)
{
	char source[64], radius[64];
	snprintf(source, sizeof(source), "builtin:%s", scene);
	snprintf(radius, sizeof(radius), "light.radius=%.7g", share * DISTANCE);
	const char *settings[] = {radius, "shadow.map=512", study->technique, study->setting};
	struct stage stage;
	struct sm_error error;
	if (!stage_load(&stage, source, settings, study->setting != NULL ? 4 : 3, &error))
		fail_msg("%s", error.text);
	rig_set_shadows(rig, &stage.shadow);
	visibility_draw(seen, rig, stage.scene, &stage.camera, SIZE, SIZE);
	stage_finish(&stage);
}

/* Skips the test where there is no ground truth. */
static struct difference measure(
	struct rig *rig, const struct study *study, const char *scene, const char *share)
{
	char path[512];
	struct truth truth;
	struct visibility seen;
	snprintf(path, sizeof(path), SMOOTHIE_SHARED "/scenes/%s-%s.pgm.gz", scene, share);
	if (!truth_read(&truth, path))
		skip();
	assert_true(truth.width == SIZE && truth.height == SIZE);
	draw_scene(&seen, rig, study, scene, strtod(share, NULL));
	struct difference difference = truth_compare(&truth, &seen);
	visibility_finish(&seen);
	truth_finish(&truth);
	assert_true(difference.penumbra_pixels > 1000);
	return difference;
}

static void check_error(const char *what, double error, double expected, bool or_better)
{
	print_message("%-12s %.3f, study %.3f\n", what, error, expected);
	double least = or_better ? 0 : expected * (1 - TOLERANCE);
	if (!(error > least && error < expected * (1 + TOLERANCE)))
		fail_msg("%s: error %.3f, not %.3f", what, error, expected);
}

static void check_scene(
	struct rig *rig, const struct study *study, size_t scene, const struct difference *found)
{
	bool coarse = raster_grid_bits(&rig->renderer->gpu) <= COARSE_BITS;
	uint32_t most = study->outside_wrong[scene] + (coarse ? coarse_wrong[scene] : 0);
	print_message("%-12s %.3f, and %u of %u pixels wrong beside the penumbra\n", scenes[scene],
		found->penumbra_rmse, found->outside_wrong, SIZE * SIZE - found->penumbra_pixels);
	if (study->at_03[scene] > 0)
		check_error(
			scenes[scene], found->penumbra_rmse, study->at_03[scene], study->or_better);
	if (found->outside_wrong > most)
		fail_msg("%s: %u pixels are wrong beside the penumbra", scenes[scene],
			found->outside_wrong);
}

static void check_study(struct rig *rig, const struct study *study)
{
	print_message("%s %s\n", study->technique, study->setting != NULL ? study->setting : "");
	for (size_t i = 0; i < SHARES; i++) {
		double sum = 0;
		for (size_t scene = 0; scene < SCENES; scene++) {
			struct difference found = measure(rig, study, scenes[scene], shares[i]);
			sum += found.penumbra_rmse;
			if (i == SHARE_03)
				check_scene(rig, study, scene, &found);
		}
		check_error(shares[i], sum / SCENES, study->means[i], study->or_better);
	}
}

static void hard_shadows_are_as_wrong_as_in_the_study(void **state)
{
	check_study(*state, &hard);
}

static void filtered_shadows_are_as_wrong_as_in_the_study(void **state)
{
	check_study(*state, &pcf);
}

static void bicubic_shadows_are_as_wrong_as_in_the_study(void **state)
{
	check_study(*state, &bicubic);
}

static void linear_smoothies_are_as_wrong_as_in_the_study(void **state)
{
	check_study(*state, &linear);
}

static void sinusoid_smoothies_are_as_wrong_as_in_the_study(void **state)
{
	check_study(*state, &sinusoid);
}

static void pcss_with_16_samples_is_no_worse_than_in_the_study(void **state)
{
	check_study(*state, &pcss_16);
}

static void pcss_with_32_samples_is_no_worse_than_in_the_study(void **state)
{
	check_study(*state, &pcss_32);
}

static void variance_maps_blurred_by_5_are_as_wrong_as_in_the_study(void **state)
{
	if (!rig_can_draw("vsm"))
		skip();
	check_study(*state, &vsm_5);
}

static void variance_maps_blurred_by_9_are_as_wrong_as_in_the_study(void **state)
{
	if (!rig_can_draw("vsm"))
		skip();
	check_study(*state, &vsm_9);
}

static void four_maps_are_no_worse_than_in_the_study(void **state)
{
	check_study(*state, &maps_4);
}

static void sixteen_maps_are_no_worse_than_in_the_study(void **state)
{
	check_study(*state, &maps_16);
}

static void sixty_four_maps_are_no_worse_than_in_the_study(void **state)
{
	check_study(*state, &maps_64);
}

static void two_sided_smoothies_are_no_more_wrong_than_in_the_study(void **state)
{
	check_study(*state, &two_sided);
}

static void penumbra_maps_are_as_wrong_as_in_the_study(void **state)
{
	check_study(*state, &penumbra_map);
}

static void gather_is_no_more_wrong_than_in_the_study(void **state)
{
	check_study(*state, &gather);
}

/* With the sheets that the light's centre sees alone it is .0128, beside the cylinder's foot. */
static void gather_ends_wide_penumbrae_by_grazing_triangles(void **state)
{
	struct difference found = measure(*state, &gather, "cylinder", "0.10");
	print_message("cylinder %.4f\n", found.penumbra_rmse);
	assert_true(found.penumbra_rmse < 0.0100);
}

/* Of a mesh of many triangles those over hollows, which show the light's centre their fronts and
 * hide a part of the disc from what lies beside them: without them 55 pixels beside the feet of
 * spikes are dark and drawn as lit in part, and it is .0145. */
static void gather_hides_by_triangles_over_hollows(void **state)
{
	struct difference found = measure(*state, &gather, "urchin", "0.10");
	print_message("urchin %.4f, %u wrong\n", found.penumbra_rmse, found.outside_wrong);
	assert_true(found.penumbra_rmse < 0.0125);
	assert_true(found.outside_wrong <= 20);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(hard_shadows_are_as_wrong_as_in_the_study),
		rig_test(filtered_shadows_are_as_wrong_as_in_the_study),
		rig_test(bicubic_shadows_are_as_wrong_as_in_the_study),
		rig_test(linear_smoothies_are_as_wrong_as_in_the_study),
		rig_test(sinusoid_smoothies_are_as_wrong_as_in_the_study),
		rig_test(pcss_with_16_samples_is_no_worse_than_in_the_study),
		rig_test(pcss_with_32_samples_is_no_worse_than_in_the_study),
		rig_test(variance_maps_blurred_by_5_are_as_wrong_as_in_the_study),
		rig_test(variance_maps_blurred_by_9_are_as_wrong_as_in_the_study),
		rig_test(four_maps_are_no_worse_than_in_the_study),
		rig_test(sixteen_maps_are_no_worse_than_in_the_study),
		rig_test(sixty_four_maps_are_no_worse_than_in_the_study),
		rig_test(two_sided_smoothies_are_no_more_wrong_than_in_the_study),
		rig_test(penumbra_maps_are_as_wrong_as_in_the_study),
		rig_test(gather_is_no_more_wrong_than_in_the_study),
		rig_test(gather_ends_wide_penumbrae_by_grazing_triangles),
		rig_test(gather_hides_by_triangles_over_hollows),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
