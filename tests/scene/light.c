/* SPDX-License-Identifier: MIT */
/* The light's screen and depth range, and the formulas of scene/light.h in plain doubles. */
#include "scene/light.h"
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void add_cube(struct sm_scene *scene, bool casts, float half, const float center[3])
{
	static const uint32_t indices[] = {0, 1, 2, 1, 2, 3, 4, 5, 6, 5, 6, 7};
	float positions[8][3];
	for (int i = 0; i < 8; i++)
		for (int axis = 0; axis < 3; axis++)
			positions[i][axis] = i >> axis & 1 ? half : -half;
	struct sm_mesh_desc mesh = {.positions = positions[0],
		.vertex_count = 8,
		.indices = indices,
		.index_count = 12};
	struct sm_object_desc object = {
		.transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, center[0], center[1], center[2],
			1},
		.image = SM_NONE,
		.casts = casts,
		.receives = true,
	};
	uint32_t handle;
	assert_true(sm_scene_add_mesh(scene, &mesh, &object.mesh, NULL));
	assert_true(sm_scene_add_object(scene, &object, &handle, NULL));
}

static struct sm_light_desc light_at(enum sm_light_type type, float x, float y, float z)
{
	return (struct sm_light_desc){
		.type = type, .position = {x, y, z}, .radius = 0.5f, .angle = 50};
}

/* Homogeneous light clip space. */
static void project(const struct light_frame *frame, const double p[3], double clip[4])
{
	for (int row = 0; row < 4; row++) {
		clip[row] = frame->world_to_clip[3][row];
		for (int column = 0; column < 3; column++)
			clip[row] += (double)frame->world_to_clip[column][row] * p[column];
	}
}

/* Points of a grid on each face of the object's box: those on the light's screen have a depth in
 * [0, 1]; all are on it if they have to. Returns how many are. */
static int assert_inside(const struct light_frame *frame, const struct object *object, bool all)
{
	int on_screen = 0;
	for (int i = 0; i < 3 * 2 * 9 * 9; i++) {
		const int face = i / 81, axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
		double p[3], clip[4], share[3];
		share[axis] = face % 2;
		share[u] = i % 9 / 8.0;
		share[v] = i / 9 % 9 / 8.0;
		for (int k = 0; k < 3; k++)
			p[k] = object->min[k] +
			       share[k] * ((double)object->max[k] - object->min[k]);
		project(frame, p, clip);
		bool inside = clip[3] > 0 && fabs(clip[0]) <= clip[3] && fabs(clip[1]) <= clip[3];
		assert_true(inside || !all);
		assert_true(!inside || fabs(clip[2]) <= clip[3]);
		on_screen += inside;
	}
	return on_screen;
}

static void the_depth_range_holds_casters_and_receivers(void **state)
{
	(void)state;
	static const float scales[] = {1e-3f, 1, 1e4f};
	static const float positions[][3] = {{0, 8, 0}, {1, 8, 2}, {-6, 7, 1}, {3, 9, -4}};
	for (size_t s = 0; s < sizeof(scales) / sizeof(scales[0]); s++) {
		float k = scales[s];
		struct sm_scene *scene = sm_scene_create();
		assert_non_null(scene);
		add_cube(scene, true, 0.7f * k, (const float[]){0.3f * k, k, 0});
		add_cube(scene, true, 0.2f * k, (const float[]){-k, 2 * k, 0.5f * k});
		add_cube(scene, false, 2 * k, (const float[]){0, -2 * k, 0});
		for (size_t i = 0; i < sizeof(positions) / sizeof(positions[0]); i++) {
			const float *p = positions[i];
			struct light_frame frame;
			struct sm_light_desc light =
				light_at(SM_LIGHT_SPOT, p[0] * k, p[1] * k, p[2] * k);
			light_frame_init(&frame, &light, scene);
			for (size_t o = 0; o < 3; o++)
				assert_true(assert_inside(&frame, &scene->objects[o], false) > 0);
			light.type = SM_LIGHT_DIRECTIONAL;
			light_frame_init(&frame, &light, scene);
			/* What only receives may lie beside the screen: it is lit there. */
			for (size_t o = 0; o < 2; o++)
				assert_inside(&frame, &scene->objects[o], true);
			assert_true(frame.far > frame.near);
		}
		sm_scene_destroy(scene);
	}
}

/* Two cubes on the axis of a light at (0, 10, 0): a caster down from `top`, and a floor. */
static struct sm_scene *tower(float top)
{
	struct sm_scene *scene = sm_scene_create();
	assert_non_null(scene);
	add_cube(scene, true, 0.5f, (const float[]){0, top - 0.5f, 0});
	add_cube(scene, false, 1, (const float[]){0, -1, 0});
	return scene;
}

static void the_near_plane_is_tight_but_not_too_near(void **state)
{
	(void)state;
	static const struct {
		float top, near;
	} cases[] = {
		{6, 4}, /* just above the caster */
		{9.9f, 0.1f},
		{9.9999f, 0.012f}, /* a thousandth of the far plane's distance, which is 12 */
		{10.2f, 0.012f},   /* around the light: what it holds may be as near */
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_scene *scene = tower(cases[i].top);
		struct sm_light_desc light = light_at(SM_LIGHT_SPOT, 0, 10, 0);
		struct light_frame frame;
		light_frame_init(&frame, &light, scene);
		assert_float_equal(frame.near, cases[i].near, 0.002f * cases[i].near);
		assert_float_equal(frame.far, 12, 0.002f * 12);
		sm_scene_destroy(scene);
	}
}

static void scenes_without_casters_or_objects_have_a_range_too(void **state)
{
	(void)state;
	struct sm_scene *empty = sm_scene_create(), *floor = sm_scene_create();
	assert_true(empty != NULL && floor != NULL);
	add_cube(floor, false, 1, (const float[]){0, -1, 0});
	const struct sm_scene *scenes[] = {empty, floor};
	for (int i = 0; i < 4; i++) {
		/* Towards what there is, or away from it. */
		struct sm_light_desc light =
			light_at(i % 2 == 0 ? SM_LIGHT_SPOT : SM_LIGHT_DIRECTIONAL, 0, 5, 0);
		light.target[1] = i < 2 ? 0 : 9;
		for (int s = 0; s < 2; s++) {
			struct light_frame frame;
			light_frame_init(&frame, &light, scenes[s]);
			assert_true(frame.far > frame.near && isfinite(frame.far));
			assert_true(frame.half_extent > 0 && isfinite(frame.half_extent));
			for (int j = 0; j < 16; j++)
				assert_true(isfinite(frame.world_to_clip[j / 4][j % 4]));
		}
	}
	sm_scene_destroy(empty);
	sm_scene_destroy(floor);
}

/* Window depth at distance z along the axis, as GL has it. */
static double window_depth(const struct light_frame *frame, double z)
{
	double near_plane = frame->near, far_plane = frame->far;
	double linear = (z - near_plane) / (far_plane - near_plane);
	return frame->parallel ? linear : linear * far_plane / z;
}

/* Steps over the whole depth range, closest to the near plane where the depth map is finest. */
#define DEPTHS 200

static double distance_at(const struct light_frame *frame, int step)
{
	double t = (double)step / DEPTHS;
	return frame->near + t * t * ((double)frame->far - frame->near);
}

/* So that a scene four times as large looks the same to the last bit. */
static void the_range_of_an_empty_cone_grows_with_the_scene(void **state)
{
	(void)state;
	struct sm_scene *scene = sm_scene_create();
	struct sm_light_desc light = light_at(SM_LIGHT_SPOT, 0.0f, 3.0f, 0.0f);
	struct light_frame once, fourfold;
	light_frame_init(&once, &light, scene);
	light.position[1] *= 4.0f;
	light_frame_init(&fourfold, &light, scene);
	assert_true(once.far > once.near && once.near > 0.0f);
	assert_true(fourfold.near == 4.0f * once.near && fourfold.far == 4.0f * once.far);
	sm_scene_destroy(scene);
}

static void assert_formulas(const struct light_frame *frame)
{
	double k = frame->near_to_far, range = (double)frame->far - frame->near;
	for (int i = 0; i <= DEPTHS; i++) {
		double r = distance_at(frame, i), d_r = window_depth(frame, r);
		double linear = d_r * k / (1 - d_r * (1 - k));
		assert_true(fabs(linear - (r - frame->near) / range) < 1e-6);
		for (int j = 0; j < i; j++) {
			double b = distance_at(frame, j), d_b = window_depth(frame, b);
			double share = (d_r - d_b) / (frame->pole - d_b);
			double exact = frame->parallel ? (r - b) / (frame->far - b) : 1 - b / r;
			/* pole is a float next to 1, and d_b may be near to it. */
			assert_true(
				fabs(share - exact) < FLT_EPSILON / (frame->pole - d_b) + 1e-12);
		}
	}
}

/* The matrices give the distance and the depth that the formulas start from; the axis is -y. */
static void assert_matrices(const struct light_frame *frame)
{
	double start = frame->world_to_light[3][2];
	for (int i = 0; i <= DEPTHS; i++) {
		double z = distance_at(frame, i), clip[4];
		project(frame, (double[]){0, start - z, 0}, clip);
		double d = 0.5 + 0.5 * clip[2] / clip[3];
		/* Rounding of the matrix, in front of a depth that runs as near / z^2. */
		double slope = frame->parallel ? 1 : fmax(1, frame->far / z * frame->near / z);
		assert_true(fabs(d - window_depth(frame, z)) < 2e-6 * slope);
		assert_true(fabs(clip[0] / clip[3]) < 1e-5 && fabs(clip[1] / clip[3]) < 1e-5);
	}
	assert_float_equal(frame->world_to_light[1][2], -1, 1e-6f);
}

static void window_depth_gives_linear_depth_and_the_share_of_the_penumbra(void **state)
{
	(void)state;
	/* near / far from a thousandth up to a half, its two limits. */
	static const float tops[] = {9.999f, 9.5f, 8, 4, 1, 0.5f};
	for (size_t i = 0; i < sizeof(tops) / sizeof(tops[0]); i++) {
		struct sm_scene *scene = tower(tops[i]);
		struct sm_light_desc light = light_at(SM_LIGHT_SPOT, 0, 10, 0);
		struct light_frame frame;
		light_frame_init(&frame, &light, scene);
		assert_float_equal(frame.half_extent, tanf(glm_rad(25)), 1e-6f);
		assert_float_equal(frame.disc, 0.5f, 0);
		assert_formulas(&frame);
		assert_matrices(&frame);
		light.type = SM_LIGHT_DIRECTIONAL;
		light_frame_init(&frame, &light, scene);
		assert_float_equal(frame.disc, 0.05f, 1e-8f); /* radius over distance */
		assert_formulas(&frame);
		assert_matrices(&frame);
		sm_scene_destroy(scene);
	}
}

static void the_origin_is_a_position_or_a_direction(void **state)
{
	(void)state;
	struct sm_scene *scene = tower(4);
	struct light_frame frame;
	struct sm_light_desc light = light_at(SM_LIGHT_SPOT, 3, 4, 0);
	light_frame_init(&frame, &light, scene);
	assert_memory_equal(frame.origin, ((float[]){3, 4, 0, 1}), 4 * sizeof(float));
	light.type = SM_LIGHT_DIRECTIONAL;
	light_frame_init(&frame, &light, scene);
	static const float towards[4] = {0.6f, 0.8f, 0, 0};
	for (int i = 0; i < 4; i++)
		assert_float_equal(frame.origin[i], towards[i], 1e-6f);
	sm_scene_destroy(scene);
}

/* What of a floor is beside its screen costs a directional light neither texels nor depth. */
static void a_wide_floor_leaves_a_directional_light_its_screen(void **state)
{
	(void)state;
	static const float halves[] = {10, 100, 1e4f};
	struct light_frame first;
	for (size_t i = 0; i < sizeof(halves) / sizeof(halves[0]); i++) {
		struct sm_scene *scene = sm_scene_create();
		struct sm_light_desc light = light_at(SM_LIGHT_DIRECTIONAL, 3, 4, 0);
		struct light_frame frame;
		add_cube(scene, true, 1, (float[]){0, 2, 0});
		add_cube(scene, false, halves[i], (float[]){0, 0, 0});
		static const float flat[16] = {[0] = 1, [10] = 1, [15] = 1};
		assert_true(sm_scene_set_transform(scene, 1, flat, NULL));
		light_frame_init(&frame, &light, scene);
		if (i == 0)
			first = frame;
		assert_float_equal(frame.half_extent, first.half_extent, 1e-2f);
		assert_true(assert_inside(&frame, &scene->objects[0], true) > 0);
		sm_scene_destroy(scene);
	}
}

/* The axis comes of the difference of two places, which may be far from the origin. */
static void the_axis_is_as_exact_anywhere(void **state)
{
	(void)state;
	static const float axis[3] = {-0.6f, -0.8f, 0}, offsets[] = {0, 1e3f, 1e5f, 1e6f};
	struct sm_scene *scene = tower(4);
	for (size_t i = 0; i < sizeof(offsets) / sizeof(offsets[0]); i++) {
		float at = offsets[i];
		struct sm_light_desc light = light_at(SM_LIGHT_SPOT, at + 3, at + 4, at);
		struct light_frame frame;
		glm_vec3_broadcast(at, light.target);
		light_frame_init(&frame, &light, scene);
		for (int column = 0; column < 3; column++)
			assert_float_equal(frame.world_to_light[column][2], axis[column], 1e-6f);
	}
	sm_scene_destroy(scene);
}

/* Where a ray from the light's disc, at an angle of its rim, meets a receiver behind a caster's
 * corner: `share` of the way from the corner to four times its distance. */
static void shadow_point(const struct sm_light_desc *light, const double corner[3], double angle,
	double share, double point[3])
{
	/* The disc faces the corner. */
	double axis[3], side[3], up[3], length = 0, width = 0;
	for (int k = 0; k < 3; k++)
		axis[k] = corner[k] - light->position[k];
	for (int k = 0; k < 3; k++)
		length += axis[k] * axis[k];
	const double not_along[3] = {1, 0, 0};
	for (int k = 0; k < 3; k++)
		side[k] = axis[(k + 1) % 3] * not_along[(k + 2) % 3] -
			  axis[(k + 2) % 3] * not_along[(k + 1) % 3];
	for (int k = 0; k < 3; k++)
		width += side[k] * side[k];
	for (int k = 0; k < 3; k++)
		up[k] = (axis[(k + 1) % 3] * side[(k + 2) % 3] -
				axis[(k + 2) % 3] * side[(k + 1) % 3]) /
			sqrt(length * width);
	for (int k = 0; k < 3; k++) {
		double rim = light->position[k] +
			     (double)light->radius *
				     (cos(angle) * side[k] / sqrt(width) + sin(angle) * up[k]);
		point[k] = corner[k] + 3.0 * share * (corner[k] - rim);
	}
}

static void a_fitted_screen_holds_all_shadows(void **state)
{
	(void)state;
	static const float radii[] = {0.01f, 0.3f, 1.0f};
	for (size_t i = 0; i < 3 * 5; i++) {
		struct sm_scene *scene = sm_scene_create();
		assert_non_null(scene);
		add_cube(scene, true, 0.3f, (const float[]){0.2f * (float)(i / 3), 1, -0.4f});
		add_cube(scene, true, 0.2f, (const float[]){-0.3f, 2.5f, 0.1f * (float)(i / 3)});
		add_cube(scene, false, 9, (const float[]){0, -9, 0});
		struct sm_light_desc light = light_at(SM_LIGHT_SPOT, 1, 7, 0.5f);
		light.radius = radii[i % 3];
		light.angle = 80;
		struct light_frame whole, fitted;
		light_frame_init(&whole, &light, scene);
		light_frame_fit(&fitted, &light, scene);
		assert_true(fitted.half_extent <= whole.half_extent * (i % 3 == 0 ? 0.7f : 1.0f));
		for (int k = 0; k < 2 * 8 * 16 * 5; k++) {
			const struct object *object = &scene->objects[k / 640];
			double corner[3], point[3], clip[4];
			for (int axis = 0; axis < 3; axis++)
				corner[axis] =
					k / 80 >> axis & 1 ? object->max[axis] : object->min[axis];
			shadow_point(&light, corner, k % 16 * 0.3927, k / 16 % 5 / 4.0, point);
			project(&fitted, point, clip);
			assert_true(fabs(clip[0]) <= clip[3] && fabs(clip[1]) <= clip[3]);
		}
		sm_scene_destroy(scene);
	}
}

/* The widths of a frame and of that of init(), which it holds. */
static void assert_is_little_wider(
	const struct light_frame *fitted, const struct light_frame *whole, float most)
{
	assert_true(fitted->half_extent <= whole->half_extent * most);
	assert_true(fitted->far - fitted->near >= whole->far - whole->near);
	assert_true(fitted->far - fitted->near <= (whole->far - whole->near) * most);
}

/* Each of its corners that the other one shows shows, too. */
static void assert_shows(const struct light_frame *fitted, const struct light_frame *whole,
	const struct object *object)
{
	for (int i = 0; i < 8; i++) {
		double clip[4], corner[3];
		for (int axis = 0; axis < 3; axis++)
			corner[axis] = i >> axis & 1 ? object->max[axis] : object->min[axis];
		project(whole, corner, clip);
		bool shows = true;
		for (int axis = 0; axis < 3; axis++)
			shows = shows && fabs(clip[axis]) <= clip[3];
		project(fitted, corner, clip);
		for (int axis = 0; axis < 3; axis++)
			assert_true(!shows || fabs(clip[axis]) <= clip[3]);
	}
}

/* A caster that goes around another one, above a floor. */
static struct sm_scene *make_orbit(double turn)
{
	const float at[3] = {2.0f * (float)cos(turn), 1.5f + 0.5f * (float)sin(3 * turn),
		2.0f * (float)sin(turn)};
	struct sm_scene *scene = sm_scene_create();
	assert_non_null(scene);
	add_cube(scene, true, 0.3f, at);
	add_cube(scene, true, 0.5f, (const float[]){0, 1, 0});
	add_cube(scene, false, 9, (const float[]){0, -9, 0});
	return scene;
}

static void a_fitted_frame_mostly_stays_while_a_caster_moves(void **state)
{
	(void)state;
	static const enum sm_light_type types[] = {SM_LIGHT_SPOT, SM_LIGHT_DIRECTIONAL};
	enum { STEPS = 2000 };
	for (int type = 0; type < 2; type++) {
		struct light_frame before = {0}, whole, fitted;
		struct sm_light_desc light = light_at(types[type], 1, 7, 0.5f);
		int same = 0;
		light.radius = 0.1f;
		light.angle = 90;
		for (int i = 0; i < STEPS; i++) {
			struct sm_scene *scene = make_orbit(i * 6.2831853 / STEPS);
			light_frame_init(&whole, &light, scene);
			light_frame_fit(&fitted, &light, scene);
			assert_is_little_wider(&fitted, &whole, 1.2f);
			for (int object = 0; object < 2; object++)
				assert_shows(&fitted, &whole, &scene->objects[object]);
			same += light_frame_is_same(&before, &fitted);
			before = fitted;
			sm_scene_destroy(scene);
		}
		assert_true(same > STEPS * 7 / 8 && same < STEPS);
	}
}

static void what_cannot_be_fitted_is_left_as_it_is(void **state)
{
	(void)state;
	static const struct {
		enum sm_light_type type;
		float radius, height;
	} rows[] = {
		{SM_LIGHT_SPOT, 0.0f, 7},    /* a point light has no penumbrae */
		{SM_LIGHT_SPOT, 0.5f, 0.2f}, /* inside of the caster */
		{SM_LIGHT_SPOT, 4.0f, 7},    /* wider than the caster is far */
	};
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct sm_scene *scene = sm_scene_create();
		assert_non_null(scene);
		add_cube(scene, true, 0.3f, (const float[]){0, 0, 0});
		struct sm_light_desc light = light_at(rows[i].type, 0, rows[i].height, 0.1f);
		light.radius = rows[i].radius;
		struct light_frame whole, fitted;
		light_frame_init(&whole, &light, scene);
		light_frame_fit(&fitted, &light, scene);
		assert_true(fitted.half_extent == whole.half_extent);
		assert_is_little_wider(&fitted, &whole, 1.2f);
		sm_scene_destroy(scene);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_depth_range_holds_casters_and_receivers),
		cmocka_unit_test(the_near_plane_is_tight_but_not_too_near),
		cmocka_unit_test(scenes_without_casters_or_objects_have_a_range_too),
		cmocka_unit_test(the_range_of_an_empty_cone_grows_with_the_scene),
		cmocka_unit_test(window_depth_gives_linear_depth_and_the_share_of_the_penumbra),
		cmocka_unit_test(the_origin_is_a_position_or_a_direction),
		cmocka_unit_test(a_wide_floor_leaves_a_directional_light_its_screen),
		cmocka_unit_test(the_axis_is_as_exact_anywhere),
		cmocka_unit_test(a_fitted_screen_holds_all_shadows),
		cmocka_unit_test(a_fitted_frame_mostly_stays_while_a_caster_moves),
		cmocka_unit_test(what_cannot_be_fitted_is_left_as_it_is),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
