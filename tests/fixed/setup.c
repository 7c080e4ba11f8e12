/* SPDX-License-Identifier: MIT */
/* What set-up makes of triangles: who has which pixel, and with what values. */
#include "fixed/setup.h"
#include "fixed/span.h"
#include "random.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define DEPTH_ONE 1073741824.0 /* of a depth plane */

static struct fixed_blockers blockers_of(const double clip[3][4], const struct fixed_screen *screen)
{
	struct fixed_blockers blockers = {0};
	assert_true(fixed_add_blocker(&blockers, screen, clip, FIXED_BOTH_SIDES));
	return blockers;
}

static void count_pixels(const struct fixed_cover *cover, int32_t width, uint8_t *counts)
{
	struct fixed_span span = fixed_span_before(cover);
	while (fixed_span_next(cover, &span))
		for (int32_t x = span.left; x < span.right; x++)
			counts[span.y * width + x]++;
}

/* ---- coverage */

#define CELLS 9
#define CORNERS (CELLS + 1)

struct mesh {
	double corners[CORNERS][CORNERS][4]; /* clip space */
};

/* Cells that reach beyond the screen by half of it on each side, with corners moved at random by
 * less than would turn a triangle over, at depths and distances of their own. */
static struct mesh random_mesh(struct random *random)
{
	struct mesh mesh;
	for (int i = 0; i < CORNERS; i++)
		for (int j = 0; j < CORNERS; j++) {
			double w = exp(random_between(random, -3, 3));
			double x = (i + random_between(random, -0.2, 0.2)) * 3 / CELLS - 1.5;
			double y = (j + random_between(random, -0.2, 0.2)) * 3 / CELLS - 1.5;
			const double corner[4] = {
				x * w, y * w, random_between(random, -0.99, 0.99) * w, w};
			memcpy(mesh.corners[i][j], corner, sizeof(corner));
		}
	return mesh;
}

static void count_triangle(const double *a, const double *b, const double *c,
	const struct fixed_screen *screen, uint8_t *counts)
{
	double clip[3][4];
	memcpy(clip[0], a, sizeof(clip[0]));
	memcpy(clip[1], b, sizeof(clip[1]));
	memcpy(clip[2], c, sizeof(clip[2]));
	struct fixed_blockers blockers = blockers_of(clip, screen);
	for (size_t i = 0; i < blockers.count; i++)
		count_pixels(&blockers.items[i].cover, screen->width, counts);
	fixed_blockers_finish(&blockers);
}

static void each_pixel_is_covered_once(void **state)
{
	(void)state;
	static const struct fixed_screen screens[] = {
		{16, 16, 0}, {75, 31, 0}, {256, 256, 1}, {300, 200, 0}, {1, 1, 0}};
	struct random random = {1};
	for (int run = 0; run < 60; run++) {
		const struct fixed_screen *screen = &screens[run % 5];
		int32_t width = screen->width, height = screen->height, border = screen->border;
		uint8_t *counts = calloc((size_t)(width * height), 1);
		assert_non_null(counts);
		struct mesh mesh = random_mesh(&random);
		for (int i = 0; i < CELLS; i++)
			for (int j = 0; j < CELLS; j++) {
				const double *a = mesh.corners[i][j], *b = mesh.corners[i + 1][j];
				const double *c = mesh.corners[i + 1][j + 1];
				const double *d = mesh.corners[i][j + 1];
				count_triangle(a, b, c, screen, counts);
				/* Of the other orientation. */
				count_triangle(a, d, c, screen, counts);
			}
		for (int32_t y = 0; y < height; y++)
			for (int32_t x = 0; x < width; x++) {
				bool inside = x >= border && y >= border && x < width - border &&
					      y < height - border;
				assert_int_equal(counts[y * width + x], inside);
			}
		free(counts);
	}
}

/* A plane through the eye's near plane, to far beyond the screen: none twice, and up to its horizon
 * all. */
static void what_is_cut_by_the_near_plane_has_no_seams(void **state)
{
	(void)state;
	const struct fixed_screen screen = {128, 128, 0};
	const double near = 0.1, far = 1000;
	struct random random = {2};
	for (int run = 0; run < 20; run++) {
		uint8_t counts[128 * 128] = {0};
		double corners[CORNERS][CORNERS][4];
		double height = random_between(&random, 0.2, 2);
		for (int i = 0; i < CORNERS; i++)
			for (int j = 0; j < CORNERS; j++) {
				double x = (i + random_between(&random, -0.2, 0.2) - 4.5) * 300;
				double z = (j + random_between(&random, -0.2, 0.2) - 4.5) * 40;
				const double corner[4] = {x, -height,
					(z * (far + near) - 2 * far * near) / (far - near), z};
				memcpy(corners[i][j], corner, sizeof(corner));
			}
		for (int i = 0; i < CELLS; i++)
			for (int j = 0; j < CELLS; j++) {
				count_triangle(corners[i][j], corners[i + 1][j],
					corners[i + 1][j + 1], &screen, counts);
				count_triangle(corners[i][j], corners[i + 1][j + 1],
					corners[i][j + 1], &screen, counts);
			}
		for (int y = 0; y < 128; y++)
			for (int x = 0; x < 128; x++) {
				double distance = height / (1 - (y + 0.5) / 64);
				bool seen = distance > near * 1.1 && distance < 150;
				assert_true(counts[y * 128 + x] <= 1);
				if (seen)
					assert_int_equal(counts[y * 128 + x], 1);
			}
	}
}

/* ---- values */

struct triangle {
	double pixels[3][2], depths[3];
};

/* Of all three corners on the screen. */
static struct triangle random_triangle(struct random *random, double reach, double clip[3][4])
{
	struct triangle triangle;
	double center[2] = {random_between(random, -0.9, 0.9), random_between(random, -0.9, 0.9)};
	for (int i = 0; i < 3; i++) {
		double w = exp(random_between(random, -1, 1));
		triangle.depths[i] = random_between(random, 0.1, 0.9);
		for (int axis = 0; axis < 2; axis++) {
			double p = center[axis] + random_between(random, -reach, reach);
			p = fmin(fmax(p, -1), 1);
			clip[i][axis] = p * w;
			triangle.pixels[i][axis] = (p + 1) * 128;
		}
		clip[i][2] = (2 * triangle.depths[i] - 1) * w;
		clip[i][3] = w;
	}
	return triangle;
}

static double turn(const double *a, const double *b, double x, double y)
{
	return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

static double area_of(const struct triangle *triangle)
{
	const double(*p)[2] = triangle->pixels;
	return turn(p[0], p[1], p[2][0], p[2][1]);
}

/* Window depth is affine on the screen, whatever w. */
static double depth_at(const struct triangle *triangle, double x, double y)
{
	const double(*p)[2] = triangle->pixels;
	double area = area_of(triangle), depth = 0;
	for (int i = 0; i < 3; i++)
		depth += triangle->depths[i] * turn(p[(i + 1) % 3], p[(i + 2) % 3], x, y) / area;
	return depth;
}

static void compare_depths(const struct triangle *triangle, const struct fixed_blocker *blocker)
{
	const int32_t *rect = blocker->cover.rect;
	int32_t middle[2] = {(rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2};
	struct fixed_span span = fixed_span_before(&blocker->cover);
	while (fixed_span_next(&blocker->cover, &span))
		for (int32_t x = span.left; x < span.right; x++) {
			double expected = depth_at(triangle, x + 0.5, span.y + 0.5) * DEPTH_ONE;
			double found = fixed_plane_at(&blocker->depth, x, span.y);
			double steps = 1 + abs(x - middle[0]) + abs(span.y - middle[1]);
			assert_true(fabs(found - expected) <= 0.5 * steps + 0.01);
		}
}

static void planes_are_rounded_to_half_a_step_a_pixel(void **state)
{
	(void)state;
	const struct fixed_screen screen = {256, 256, 0};
	struct random random = {3};
	for (int run = 0; run < 2000; run++) {
		double clip[3][4];
		struct triangle triangle =
			random_triangle(&random, exp(random_between(&random, -3, 1)), clip);
		/* Slivers are another matter. */
		if (fabs(area_of(&triangle)) < 100)
			continue;
		struct fixed_blockers blockers = blockers_of(clip, &screen);
		assert_true(blockers.count > 0);
		for (size_t i = 0; i < blockers.count; i++)
			compare_depths(&triangle, &blockers.items[i]);
		fixed_blockers_finish(&blockers);
	}
}

static void slivers_keep_to_their_depths(void **state)
{
	(void)state;
	const struct fixed_screen screen = {256, 256, 0};
	struct random random = {4};
	int pixels = 0;
	for (int run = 0; run < 20000; run++) {
		double clip[3][4];
		struct triangle triangle = random_triangle(&random, 0.5, clip);
		/* Corner 2 almost on the line of the others. */
		double t = random_between(&random, 0, 1), w = clip[2][3];
		double off = random_between(&random, -1e-3, 1e-3) * random_between(&random, 0, 1);
		for (int axis = 0; axis < 2; axis++) {
			double p = triangle.pixels[0][axis] / 128 - 1;
			p += t * (triangle.pixels[1][axis] - triangle.pixels[0][axis]) / 128;
			clip[2][axis] = fmin(fmax(p + off, -1), 1) * w;
		}
		double low = fmin(fmin(triangle.depths[0], triangle.depths[1]), triangle.depths[2]);
		double high =
			fmax(fmax(triangle.depths[0], triangle.depths[1]), triangle.depths[2]);
		double slack = (high - low) / 4 + 1e-6;
		struct fixed_blockers blockers = blockers_of(clip, &screen);
		for (size_t i = 0; i < blockers.count; i++) {
			struct fixed_span span = fixed_span_before(&blockers.items[i].cover);
			while (fixed_span_next(&blockers.items[i].cover, &span))
				for (int32_t x = span.left; x < span.right; x++, pixels++) {
					double depth = fixed_plane_at(&blockers.items[i].depth, x,
							       span.y) /
						       DEPTH_ONE;
					assert_true(depth >= low - slack && depth <= high + slack);
				}
		}
		fixed_blockers_finish(&blockers);
	}
	assert_true(pixels > 10000);
}

/* ---- whatever is given */

static double odd_number(struct random *random)
{
	static const double odd[] = {0, -0.0, 1, -1, 1e-38, -1e38, 1e38, 3e-300, 1e300, NAN,
		INFINITY, -INFINITY, 0.5, 1 + 1e-16, -1 - 1e-12};
	uint32_t choice = random_below(random, 400);
	if (choice < sizeof(odd) / sizeof(odd[0]))
		return odd[choice];
	return random_between(random, -2, 2) * exp(random_between(random, -8, 8));
}

static void check_cover(const struct fixed_cover *cover, const struct fixed_screen *screen)
{
	const int32_t *rect = cover->rect;
	assert_true(rect[0] >= screen->border && rect[1] >= screen->border);
	assert_true(rect[2] <= screen->width - screen->border);
	assert_true(rect[3] <= screen->height - screen->border);
	assert_true(rect[0] < rect[2] && rect[1] < rect[3]);
	assert_true(rect[2] - rect[0] <= FIXED_TILE && rect[3] - rect[1] <= FIXED_TILE);
	for (int i = 0; i < 4; i++)
		for (int corner = 0; corner < 4; corner++) {
			const struct fixed_plane *edge = &cover->edges[i];
			int32_t x = corner & 1 ? rect[2] - 1 : rect[0];
			int32_t y = corner & 2 ? rect[3] - 1 : rect[1];
			int64_t exact = edge->at + (int64_t)edge->dx * x + (int64_t)edge->dy * y;
			assert_int_equal(exact, fixed_plane_at(edge, x, y));
		}
}

static void check_receiver(const struct fixed_receiver *receiver)
{
	struct fixed_span span = fixed_span_before(&receiver->cover);
	while (fixed_span_next(&receiver->cover, &span))
		for (int32_t x = span.left; x < span.right; x++) {
			const struct fixed_plane *planes[] = {
				&receiver->x, &receiver->y, &receiver->z, &receiver->w};
			for (int i = 0; i < 4; i++)
				assert_true(labs((long)fixed_plane_at(planes[i], x, span.y)) <=
					    1L << 30);
		}
	assert_true(receiver->bias >= 0 && receiver->bias <= (1 << FIXED_DEPTH_BITS) + 2);
}

static void receivers_fit_whatever_is_given(void **state)
{
	(void)state;
	static const struct fixed_screen screens[] = {{64, 40, 0}, {2047, 2047, 0}, {1, 1, 0}};
	const struct fixed_bias bias = {1.05 / 512, {100, -50}};
	struct random random = {5};
	size_t found = 0;
	for (int run = 0; run < 30000; run++) {
		const struct fixed_screen *screen = &screens[run % 50 == 0 ? 1 : run % 3 ? 0 : 2];
		struct fixed_surface surface = {.receives = true};
		struct fixed_receivers receivers = {0};
		for (int i = 0; i < 3; i++)
			for (int c = 0; c < 4; c++) {
				surface.clip[i][c] = odd_number(&random);
				surface.light[i][c] = odd_number(&random);
			}
		assert_true(fixed_add_receiver(&receivers, screen, &surface, &bias));
		for (size_t i = 0; i < receivers.count; i++) {
			check_cover(&receivers.items[i].cover, screen);
			check_receiver(&receivers.items[i]);
		}
		found += receivers.count;
		fixed_receivers_finish(&receivers);
	}
	assert_true(found > 5000);
}

static void fins_fit_whatever_is_given(void **state)
{
	(void)state;
	const struct fixed_screen screen = {512, 512, 1};
	struct random random = {6};
	size_t found = 0;
	for (int run = 0; run < 10000; run++) {
		struct fixed_fin_corner corners[4];
		struct fixed_fins fins = {0};
		for (int i = 0; i < 4; i++) {
			float *p = corners[i].position, *o = corners[i].offset;
			for (int c = 0; c < 3; c++)
				p[c] = (float)fmin(fmax(odd_number(&random), -1024), 1024);
			p[2] = fminf(fmaxf(p[2], -1), 1);
			for (int c = 0; c < 2; c++)
				o[c] = (float)odd_number(&random);
			corners[i].width = (float)odd_number(&random);
		}
		assert_true(fixed_add_fin(&fins, &screen, corners));
		for (size_t i = 0; i < fins.count; i++)
			check_cover(&fins.items[i].cover, &screen);
		found += fins.count;
		fixed_fins_finish(&fins);
	}
	assert_true(found > 1000);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(each_pixel_is_covered_once),
		cmocka_unit_test(what_is_cut_by_the_near_plane_has_no_seams),
		cmocka_unit_test(planes_are_rounded_to_half_a_step_a_pixel),
		cmocka_unit_test(slivers_keep_to_their_depths),
		cmocka_unit_test(receivers_fit_whatever_is_given),
		cmocka_unit_test(fins_fit_whatever_is_given),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
