/* SPDX-License-Identifier: MIT */
#include "scene/light.h"
#include <string.h>

/* A caster that reaches nearer to a spot than this share of its range is cut off there. Wider
 * ranges cost the 24-bit depth map its precision at the far end (2^-24 / k of the range). */
#define NEAR_TO_FAR_MIN (1.0f / 1000.0f)

/* Steepest receiver, against the light's rays, that is biased by all of its slope: at 50 to 1 the
 * light comes in at 1.1 degrees and adds 2 % of its strength. */
#define SLOPE_MAX 50.0f

bool light_frame_is_same(const struct light_frame *a, const struct light_frame *b)
{
	const float plain_a[] = {a->near, a->far, a->near_to_far, a->pole, a->half_extent, a->disc};
	const float plain_b[] = {b->near, b->far, b->near_to_far, b->pole, b->half_extent, b->disc};
	return memcmp(a->world_to_light, b->world_to_light, sizeof(a->world_to_light)) == 0 &&
	       memcmp(a->world_to_clip, b->world_to_clip, sizeof(a->world_to_clip)) == 0 &&
	       a->parallel == b->parallel && memcmp(plain_a, plain_b, sizeof(plain_a)) == 0 &&
	       memcmp(a->origin, b->origin, sizeof(a->origin)) == 0;
}

static void light_view(const struct sm_light_desc *light, mat4 view)
{
	vec3 axis;
	glm_vec3_sub((float *)light->target, (float *)light->position, axis);
	glm_vec3_normalize(axis);
	vec3 up = {0.0f, 1.0f, 0.0f};
	if (fabsf(axis[1]) > 0.9f)
		glm_vec3_copy((vec3){0.0f, 0.0f, 1.0f}, up);
	vec3 side;
	glm_vec3_crossn(axis, up, side);
	glm_vec3_cross(side, axis, up);
	/* glm_look() would add the axis to the position, and lose it where that is far away. */
	glm_mat4_identity(view);
	for (int column = 0; column < 3; column++) {
		view[column][0] = side[column];
		view[column][1] = up[column];
		view[column][2] = -axis[column];
	}
	view[3][0] = -glm_vec3_dot(side, (float *)light->position);
	view[3][1] = -glm_vec3_dot(up, (float *)light->position);
	view[3][2] = glm_vec3_dot(axis, (float *)light->position);
}

static void view_box(const struct object *object, mat4 view, vec3 box[2])
{
	glm_vec3_copy((float *)object->min, box[0]);
	glm_vec3_copy((float *)object->max, box[1]);
	glm_aabb_transform(box, view, box);
}

/* Box of the casters in view space; false if there are none. */
static bool casters_box(const struct sm_scene *scene, mat4 view, vec3 box[2])
{
	glm_aabb_invalidate(box);
	bool found = false;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		if (!object->casts)
			continue;
		vec3 part[2];
		view_box(object, view, part);
		glm_aabb_merge(box, part, box);
		found = true;
	}
	return found;
}

/* Nearest and farthest distance along the axis, so far. */
struct depth_range {
	float near, far;
};

/* Of a quad cut by four planes. Each adds one, but where corners lie in a plane rounding may put
 * every second one outside: 6, 9, 13, 19. */
#define FACE_CORNERS_MAX 20

/* A light's screen in view space: |p[axis] - center[axis]| <= extent - slope p.z. */
struct screen {
	float center[2], extent, slope;
};

/* How far inside one side of the screen a point is. */
static float inside_by(const struct screen *screen, const float p[3], int axis, float sign)
{
	return screen->extent - screen->slope * p[2] - sign * (p[axis] - screen->center[axis]);
}

/* Keeps what of a convex polygon is inside one side of the screen (Sutherland & Hodgman 1974).
 * Returns the number of corners. */
static int clip_face(const struct screen *screen, vec3 *corners, int count, int axis, float sign,
	vec3 clipped[FACE_CORNERS_MAX])
{
	int kept = 0;
	for (int i = 0; i < count; i++) {
		float *p = corners[i], *q = corners[(i + 1) % count];
		float inside_p = inside_by(screen, p, axis, sign);
		float inside_q = inside_by(screen, q, axis, sign);
		if (inside_p >= 0.0f)
			glm_vec3_copy(p, clipped[kept++]);
		/* One is below 0 and the other is not: the divisor is neither's 0. */
		if ((inside_p >= 0.0f) != (inside_q >= 0.0f))
			glm_vec3_lerp(p, q, inside_p / (inside_p - inside_q), clipped[kept++]);
	}
	return kept;
}

static void widen_by_face(struct depth_range *range, const struct screen *screen, vec3 quad[4])
{
	vec3 corners[2][FACE_CORNERS_MAX];
	int count = 4, from = 0;
	memcpy(corners[0], quad, 4 * sizeof(vec3));
	for (int side = 0; side < 4 && count > 0; side++, from = 1 - from)
		count = clip_face(screen, corners[from], count, side / 2, side % 2 ? -1.0f : 1.0f,
			corners[1 - from]);
	for (int i = 0; i < count; i++) {
		range->near = fminf(range->near, -corners[from][i][2]);
		range->far = fmaxf(range->far, -corners[from][i][2]);
	}
}

/* Depths of the part of a world-space box that is on the screen. A corner of that part lies on a
 * face of the box, or is the tip of a spot's cone. */
static void widen_by_box(struct depth_range *range, const struct screen *screen,
	const struct object *object, mat4 view)
{
	vec3 corners[8];
	vec3 box[2] = {{object->min[0], object->min[1], object->min[2]},
		{object->max[0], object->max[1], object->max[2]}};
	for (int i = 0; i < 8; i++) {
		vec3 p;
		for (int axis = 0; axis < 3; axis++)
			p[axis] = box[i >> axis & 1][axis];
		glm_mat4_mulv3(view, p, 1.0f, corners[i]);
	}
	static const int faces[6][4] = {
		{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
	for (int face = 0; face < 6; face++) {
		vec3 quad[4];
		for (int i = 0; i < 4; i++)
			glm_vec3_copy(corners[faces[face][i]], quad[i]);
		widen_by_face(range, screen, quad);
	}
}

static bool is_in_box(const struct object *object, const float point[3])
{
	vec3 box[2] = {{object->min[0], object->min[1], object->min[2]},
		{object->max[0], object->max[1], object->max[2]}};
	return glm_aabb_point(box, (float *)point);
}

/* Widens ranges to the depths of all objects, and of the casters, that are in a spot's cone. */
static void widen_to_cone(struct depth_range *all, struct depth_range *casters,
	const struct sm_light_desc *light, const struct sm_scene *scene, mat4 view)
{
	/* A thousandth more for rounding. */
	const struct screen screen = {.slope = tanf(glm_rad(light->angle) / 2.0f) * 1.001f};
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		struct depth_range range = {FLT_MAX, 0.0f};
		widen_by_box(&range, &screen, object, view);
		if (is_in_box(object, light->position))
			range.near = 0.0f;
		for (int k = 0; k < (object->casts ? 2 : 1); k++) {
			struct depth_range *widened = k == 0 ? all : casters;
			widened->near = fminf(widened->near, range.near);
			widened->far = fmaxf(widened->far, range.far);
		}
	}
}

/* Whether a far plane is at a distance that it and the nearest of near planes can be divided by. */
static bool is_range(float far_plane)
{
	return far_plane > FLT_MIN / NEAR_TO_FAR_MIN && isfinite(far_plane);
}

/* The nearest number to a positive one, up or down, of 17 to 32 steps of a power of two: what
 * changes a little mostly has the same. */
static float step_up(float size)
{
	int exponent;
	float part = frexpf(size, &exponent);
	return ldexpf(ceilf(part * 32.0f) / 32.0f, exponent);
}

static float step_down(float size)
{
	int exponent;
	float part = frexpf(size, &exponent);
	return ldexpf(floorf(part * 32.0f) / 32.0f, exponent);
}

/* Widths of screens are no round numbers: what lies at round coordinates would have its edges run
 * through texels' centres, which are in doubt. */
#define UNEVEN 1.0137f

/* steady: the same range for depths that are about the same. */
static void spot_frame(struct light_frame *frame, const struct sm_light_desc *light,
	const struct sm_scene *scene, mat4 view, bool steady)
{
	struct depth_range casters = {FLT_MAX, 0.0f}, all = {FLT_MAX, 0.0f};
	widen_to_cone(&all, &casters, light, scene, view);
	if (steady) {
		casters.near = step_down(casters.near);
		all.far = step_up(all.far);
	}
	/* A thousandth of the range more on either side, and what distances are rounded by. */
	float slack = fmaxf(all.far - casters.near, 0.0f) * 1e-3f + all.far * 8.0f * FLT_EPSILON;
	float far_plane = all.far + slack;
	/* With nothing in the cone any range will do that grows with the scene; where position and
	 * target have met, any. */
	if (!is_range(far_plane))
		far_plane = glm_vec3_distance((float *)light->position, (float *)light->target);
	if (!is_range(far_plane))
		far_plane = 1.0f;
	float near_plane = casters.near - fminf(slack, casters.near * 1e-3f);
	near_plane = fmaxf(near_plane, far_plane * NEAR_TO_FAR_MIN);
	/* At least half of the range, so that 1 - k keeps its digits. */
	near_plane = fminf(near_plane, far_plane * 0.5f);
	frame->near = near_plane;
	frame->far = far_plane;
	frame->near_to_far = near_plane / far_plane;
	frame->pole = 1.0f / (1.0f - frame->near_to_far);
	frame->half_extent = tanf(glm_rad(light->angle) / 2.0f);
	frame->disc = light->radius;
	mat4 projection;
	glm_perspective(glm_rad(light->angle), 1.0f, near_plane, far_plane, projection);
	glm_mat4_mul(projection, view, frame->world_to_clip);
	glm_vec3_copy((float *)light->position, frame->origin);
	frame->origin[3] = 1.0f;
	glm_mat4_copy(view, frame->world_to_light);
}

/* Farthest depth of what is on a directional light's screen, at least that of its casters. */
static float farthest_on_screen(
	const struct screen *screen, const struct sm_scene *scene, mat4 view, float casters_far)
{
	struct depth_range range = {FLT_MAX, casters_far};
	for (size_t i = 0; i < scene->object_count; i++) {
		vec3 box[2];
		view_box(&scene->objects[i], view, box);
		/* Most are not behind all casters. */
		if (-box[0][2] > range.far)
			widen_by_box(&range, screen, &scene->objects[i], view);
	}
	return range.far;
}

/* Of what is at a coordinate: 1 where the size is nothing, an eighth of the coordinate's float step
 * at least, or has no inverse. */
static float size_or_one(float size, float coordinate)
{
	float nothing = fmaxf(fabsf(coordinate) * (FLT_EPSILON / 8.0f), FLT_MIN);
	return size > nothing && isfinite(size) ? size : 1.0f;
}

/* A screen that holds the casters and their penumbras, on what is behind them. The wider it is, the
 * farther may a receiver go on it: after so many steps what is added to the width is small, but on
 * receivers that the light hardly grazes. A wide floor takes no more of it than its part there. */
#define WIDENING_STEPS 3

static void fit_directional_screen(
	struct screen *screen, const struct sm_scene *scene, mat4 view, vec3 casters[2], float disc)
{
	float half = fmaxf(casters[1][0] - casters[0][0], casters[1][1] - casters[0][1]) / 2.0f;
	vec3 center;
	glm_aabb_center(casters, center);
	*screen = (struct screen){.center = {center[0], center[1]}, .extent = half * 1.01f};
	for (int step = 0; step < WIDENING_STEPS; step++) {
		float far = farthest_on_screen(screen, scene, view, -casters[0][2]);
		screen->extent = half * 1.01f + disc * (far + casters[1][2]);
	}
	screen->extent = size_or_one(screen->extent, fmaxf(fabsf(center[0]), fabsf(center[1])));
}

/* A box around another, of the larger of its width and height, up to an eighth wider, and deeper by
 * two sixteenths: mostly the same where that changes a little. Where a size is nothing, or has no
 * sixteenth there, it stays. */
static void steady_box(vec3 box[2])
{
	float width = fmaxf(box[1][0] - box[0][0], box[1][1] - box[0][1]);
	float step = step_up(width) / 16.0f, half = step_up(width / 2.0f + step / 2.0f);
	for (int axis = 0; axis < 2 && step > FLT_MIN && isfinite(half); axis++) {
		float center = (box[0][axis] + box[1][axis]) / 2.0f;
		center = roundf(center / step) * step;
		box[0][axis] = fminf(box[0][axis], center - half);
		box[1][axis] = fmaxf(box[1][axis], center + half);
	}
	step = step_up(box[1][2] - box[0][2]) / 16.0f;
	if (step > FLT_MIN && isfinite(step)) {
		box[0][2] = fminf(box[0][2], floorf(box[0][2] / step) * step);
		box[1][2] = fmaxf(box[1][2], ceilf(box[1][2] / step) * step);
	}
}

/* steady: the same screen and range for casters that are about where they were. */
static void directional_frame(struct light_frame *frame, const struct sm_light_desc *light,
	const struct sm_scene *scene, mat4 view, bool steady)
{
	vec3 path;
	/* With nothing to cast a shadow any box will do. */
	vec3 casters[2] = {{-1.0f, -1.0f, -2.0f}, {1.0f, 1.0f, -1.0f}}, found[2];
	if (casters_box(scene, view, found))
		memcpy(casters, found, sizeof(casters));
	if (steady)
		steady_box(casters);
	glm_vec3_sub((float *)light->position, (float *)light->target, path);
	/* Positions that differ may be one where they are counted from far away. */
	float length = glm_vec3_norm(path);
	frame->disc = length > 0.0f ? light->radius / length : 0.0f;
	struct screen screen;
	fit_directional_screen(&screen, scene, view, casters, frame->disc);
	if (steady)
		screen.extent = UNEVEN * step_up(screen.extent);
	float far = farthest_on_screen(&screen, scene, view, -casters[0][2]);
	float depth = size_or_one(far + casters[1][2], casters[1][2]);
	if (steady)
		depth = step_up(depth);
	frame->parallel = true;
	frame->half_extent = screen.extent;
	/* From the near plane on: counted from a light that may be far away, depths would lose the
	 * digits that tell them apart. */
	float start = -casters[1][2] - depth * 0.001f;
	frame->near = 0.0f;
	frame->far = depth * 1.002f;
	frame->near_to_far = 1.0f;
	frame->pole = 1.0f;
	mat4 projection, to_center = GLM_MAT4_IDENTITY_INIT;
	glm_translate(to_center, (vec3){-screen.center[0], -screen.center[1], start});
	glm_mat4_mul(to_center, view, frame->world_to_light);
	glm_ortho(-screen.extent, screen.extent, -screen.extent, screen.extent, frame->near,
		frame->far, projection);
	glm_mat4_mul(projection, frame->world_to_light, frame->world_to_clip);
	glm_vec3_normalize_to(path, frame->origin);
	frame->origin[3] = 0.0f;
}

static void make_frame(struct light_frame *frame, const struct sm_light_desc *light,
	const struct sm_scene *scene, bool steady)
{
	*frame = (struct light_frame){0};
	mat4 view;
	light_view(light, view);
	if (light->type == SM_LIGHT_SPOT)
		spot_frame(frame, light, scene, view, steady);
	else
		directional_frame(frame, light, scene, view, steady);
	/* Views look along -z; here z grows away from the light. */
	for (int column = 0; column < 4; column++)
		frame->world_to_light[column][2] *= -1.0f;
}

void light_frame_init(
	struct light_frame *frame, const struct sm_light_desc *light, const struct sm_scene *scene)
{
	make_frame(frame, light, scene, false);
}

/* Widens *slope to that of the ray to the farthest corner of a box from the axis, and *nearest to
 * that of the nearest. False where one is beside the light or behind it. */
static bool widen_slope(const struct object *object, mat4 view, float *slope, float *nearest)
{
	for (int i = 0; i < 8; i++) {
		vec3 p = {i & 1 ? object->max[0] : object->min[0],
			i & 2 ? object->max[1] : object->min[1],
			i & 4 ? object->max[2] : object->min[2]};
		glm_mat4_mulv3(view, p, 1.0f, p);
		if (!(p[2] < 0.0f))
			return false;
		*slope = fmaxf(*slope, fmaxf(fabsf(p[0]), fabsf(p[1])) / -p[2]);
		*nearest = fminf(*nearest, -p[2]);
	}
	return true;
}

/* The slope of a ray to the axis that no penumbra of a caster lies beyond; INFINITY where casters
 * are so near that nothing is. A ray from the rim of the disc by a blocker at b meets a receiver
 * R (1/b - 1/r) from where one from its middle does, and by the slants of both farther. */
static float shadowed_slope(
	const struct sm_light_desc *light, const struct sm_scene *scene, float screen)
{
	mat4 view;
	float slope = 0.0f, nearest = FLT_MAX;
	light_view(light, view);
	for (size_t i = 0; i < scene->object_count; i++)
		if (scene->objects[i].casts &&
			!widen_slope(&scene->objects[i], view, &slope, &nearest))
			return INFINITY;
	/* The disc is turned by no more than the corner of the screen is off the axis. */
	float slant = sqrtf(1.0f + 2.0f * screen * screen);
	float turned = light->radius / nearest;
	if (!(turned < 0.5f))
		return INFINITY;
	float spread = light->radius * (1.0f / nearest) * slant / (1.0f - turned);
	return (slope + spread) * 1.01f;
}

/* Narrower screens would be all of one shadow's edge. */
#define NARROWED_MIN (1.0f / 64.0f)

void light_frame_fit(
	struct light_frame *frame, const struct sm_light_desc *light, const struct sm_scene *scene)
{
	struct sm_light_desc fitted = *light;
	if (light->type == SM_LIGHT_SPOT && light->radius > 0.0f) {
		float screen = tanf(glm_rad(light->angle) / 2.0f);
		float slope = shadowed_slope(light, scene, screen);
		slope = UNEVEN * step_up(fmaxf(slope, screen * NARROWED_MIN));
		if (slope < screen)
			fitted.angle = 2.0f * glm_deg(atanf(slope));
	}
	make_frame(frame, &fitted, scene, true);
}

/* SLOPE_MAX times the width of a texel there. For a spot the width grows with the distance, and
 * window depth flattens with its square. */
void light_frame_bias_limit(const struct light_frame *frame, float size, float limit[2])
{
	float most = SLOPE_MAX * 2.0f * frame->half_extent / size;
	limit[0] = frame->parallel ? most / (frame->far - frame->near) : most * frame->pole;
	limit[1] = frame->parallel ? 0.0f : -most;
}

/* R (1/b - 1/r) at distance 1 of a spot; 1/z is (K - d) / (K near) at window depth d. For a
 * directional light R (r - b). The screen is 2 half_extent wide. Finite, so that a difference of 0
 * gives 0, also times the texels of a map: a disc of 1e6 before a near plane of 1e-30 is not. */
float disc_scale(const struct light_frame *frame)
{
	float per_depth = frame->parallel ? frame->far - frame->near
					  : 1.0f / (frame->pole * frame->near); /* near > 0 */
	return fminf(frame->disc * per_depth / (2.0f * frame->half_extent), 1e30f);
}
