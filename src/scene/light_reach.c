/* SPDX-License-Identifier: MIT */
#include "scene/light_reach.h"
#include <float.h>

/* By how much the view and cones are widened, of their size at a place, and by how much of the
 * coordinates there: floats are rounded in other ways where surfaces are drawn. */
#define WIDENING 1e-3f
#define ROUNDING 1e-5f

/* Of a quad cut by six planes: each adds one, and rounding may double that. */
#define FACE_CORNERS_MAX 32
/* Of all faces, and of the view. */
#define PART_CORNERS_MAX (6 * FACE_CORNERS_MAX + 8)
_Static_assert(PART_CORNERS_MAX <= VIEW_PART_CORNERS_MAX, "room for a part");

/* Where the planes w = s[axis] p[axis] of clip space meet, by Cramer's rule. */
static void find_corner(mat4 m, const int s[3], vec3 corner)
{
	double plane[3][4];
	for (int axis = 0; axis < 3; axis++)
		for (int column = 0; column < 4; column++)
			plane[axis][column] = (double)m[column][axis] * s[axis] - m[column][3];
	double cross[3][3];
	for (int i = 0; i < 3; i++) {
		const double *a = plane[(i + 1) % 3], *b = plane[(i + 2) % 3];
		for (int j = 0; j < 3; j++)
			cross[i][j] =
				a[(j + 1) % 3] * b[(j + 2) % 3] - a[(j + 2) % 3] * b[(j + 1) % 3];
	}
	double det =
		plane[0][0] * cross[0][0] + plane[0][1] * cross[0][1] + plane[0][2] * cross[0][2];
	for (int j = 0; j < 3; j++) {
		double sum = 0.0;
		for (int i = 0; i < 3; i++)
			sum -= plane[i][3] * cross[i][j];
		corner[j] = det != 0.0 ? (float)(sum / det) : NAN;
	}
}

void view_volume_init(struct view_volume *volume, mat4 world_to_clip)
{
	vec4 *m = world_to_clip;
	for (int i = 0; i < 8; i++) {
		const int s[3] = {i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1};
		find_corner(m, s, volume->corners[i]);
	}
	/* w + p[axis] >= 0 or w - p[axis] >= 0 of clip space. */
	for (int side = 0; side < 6; side++) {
		int axis = side / 2;
		float sign = side % 2 ? -1.0f : 1.0f;
		for (int column = 0; column < 4; column++)
			volume->sides[side][column] =
				(1.0f + WIDENING) * m[column][3] + sign * m[column][axis];
		volume->sides[side][3] += ROUNDING * (fabsf(m[3][3]) + fabsf(m[3][axis]));
	}
}

/* A convex part of space: what is on the positive side of planes. */
struct solid {
	const vec4 *sides;
	int side_count;
	const vec3 *corners; /* where three sides meet */
	int corner_count;
};

static float inside_of(const float side[4], const float p[3])
{
	return side[0] * p[0] + side[1] * p[1] + side[2] * p[2] + side[3];
}

/* Keeps what of a convex polygon is inside a plane (Sutherland & Hodgman 1974). */
static int clip_face(const float side[4], vec3 *corners, int count, vec3 clipped[FACE_CORNERS_MAX])
{
	int kept = 0;
	for (int i = 0; i < count && kept + 2 <= FACE_CORNERS_MAX; i++) {
		float *p = corners[i], *q = corners[(i + 1) % count];
		float inside_p = inside_of(side, p), inside_q = inside_of(side, q);
		if (inside_p >= 0.0f)
			glm_vec3_copy(p, clipped[kept++]);
		/* One is below 0 and the other is not: the divisor is neither's 0. */
		if ((inside_p >= 0.0f) != (inside_q >= 0.0f))
			glm_vec3_lerp(p, q, inside_p / (inside_p - inside_q), clipped[kept++]);
	}
	return kept;
}

/* What of one face of an object's box is in a solid; returns the number of corners. */
static int cut_face(const struct solid *solid, const struct object *object, int face,
	vec3 part[FACE_CORNERS_MAX])
{
	vec3 corners[2][FACE_CORNERS_MAX];
	int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3, count = 4;
	for (int i = 0; i < 4; i++) {
		corners[0][i][axis] = face % 2 ? object->max[axis] : object->min[axis];
		corners[0][i][u] = i == 1 || i == 2 ? object->max[u] : object->min[u];
		corners[0][i][v] = i >= 2 ? object->max[v] : object->min[v];
	}
	for (int side = 0; side < solid->side_count && count > 0; side++)
		count = clip_face(
			solid->sides[side], corners[side % 2], count, corners[1 - side % 2]);
	for (int i = 0; i < count; i++)
		glm_vec3_copy(corners[solid->side_count % 2][i], part[i]);
	return count;
}

/* True for NaN too. */
static bool is_in_box(const struct object *object, const float p[3])
{
	for (int axis = 0; axis < 3; axis++) {
		float slack = WIDENING * (object->max[axis] - object->min[axis]) +
			      ROUNDING * fabsf(p[axis]);
		if (p[axis] < object->min[axis] - slack || p[axis] > object->max[axis] + slack)
			return false;
	}
	return true;
}

/* Corners of the convex part of an object's box that is in a solid: of the box's faces, and of the
 * solid, where they lie in the box. Returns their number. */
static int cut_box(
	const struct solid *solid, const struct object *object, vec3 part[PART_CORNERS_MAX])
{
	int count = 0;
	for (int face = 0; face < 6; face++)
		count += cut_face(solid, object, face, &part[count]);
	for (int i = 0; i < solid->corner_count; i++)
		if (is_in_box(object, solid->corners[i]))
			glm_vec3_copy((float *)solid->corners[i], part[count++]);
	return count;
}

static struct solid solid_of(const struct view_volume *volume)
{
	return (struct solid){volume->sides, 6, volume->corners, 8};
}

int view_volume_cut(const struct view_volume *volume, const struct object *object,
	vec3 part[VIEW_PART_CORNERS_MAX])
{
	const struct solid view = solid_of(volume);
	return cut_box(&view, object, part);
}

/* Whether the part of an object's box that is in one solid is beside one side of the other. */
static bool are_apart(const struct solid *a, const struct solid *b, const struct object *object)
{
	vec3 points[PART_CORNERS_MAX];
	int count = cut_box(a, object, points);
	for (int side = 0; side < b->side_count; side++) {
		bool all = true;
		for (int i = 0; i < count && all; i++)
			all = inside_of(b->sides[side], points[i]) < 0.0f;
		if (all)
			return true;
	}
	return count == 0;
}

/* The planes of a spot's cone, made flat, and the one through the light. size: of coordinates. */
static void cone_sides(const struct sm_light_desc *light, const struct light_frame *frame,
	float size, vec4 sides[5])
{
	const vec4 *m = frame->world_to_light;
	float slope = (1.0f + WIDENING) * tanf(glm_rad(light->angle) / 2.0f);
	float start = glm_vec3_norm_inf((float *)light->position);
	float slack = ROUNDING * (1.0f + slope) * (start + size);
	for (int side = 0; side < 5; side++) {
		int axis = side / 2;
		float along = side == 4 ? 0.0f : side % 2 ? -1.0f : 1.0f;
		for (int column = 0; column < 4; column++)
			sides[side][column] =
				side == 4 ? m[column][2]
					  : slope * m[column][2] + along * m[column][axis];
		sides[side][3] += slack;
	}
}

/* Illuminance at the nearest point of a box, or a bound on it, of a light of intensity 1. */
static float strongest_at(const struct sm_light_desc *light, const struct object *object)
{
	float distance2 = 0.0f;
	if (light->type == SM_LIGHT_DIRECTIONAL)
		return 1.0f;
	for (int axis = 0; axis < 3; axis++) {
		float p = light->position[axis];
		float slack = ROUNDING * fmaxf(fabsf(p), fmaxf(fabsf(object->min[axis]),
								 fabsf(object->max[axis])));
		float away =
			fmaxf(fmaxf(object->min[axis] - p, p - object->max[axis]) - slack, 0.0f);
		distance2 += away * away;
	}
	float reach = glm_vec3_distance2((float *)light->target, (float *)light->position);
	/* The bound of surface.frag. */
	return fminf(1.01f * reach / fmaxf(distance2, FLT_MIN), 1e6f);
}

static float brightest_of(const float color[3])
{
	return fmaxf(fabsf(color[0]), fmaxf(fabsf(color[1]), fabsf(color[2])));
}

/* Whether some of the object may be seen and, of a spot, in the cone. */
static bool may_show(const struct sm_light_desc *light, const struct light_frame *frame,
	const struct object *object, const struct view_volume *volume)
{
	static const struct solid all;
	const struct solid view = solid_of(volume);
	vec4 sides[5];
	if (light->type == SM_LIGHT_DIRECTIONAL)
		return !are_apart(&view, &all, object);
	float size = fmaxf(
		glm_vec3_norm_inf((float *)object->min), glm_vec3_norm_inf((float *)object->max));
	cone_sides(light, frame, size, sides);
	const struct solid cone = {sides, 5, (const vec3 *)&light->position, 1};
	return !are_apart(&view, &cone, object) && !are_apart(&cone, &view, object);
}

float light_brightest(const struct sm_light_desc *light, const struct light_frame *frame,
	const struct sm_scene *scene, const struct view_volume *volume, float enough)
{
	float strength = fabsf(light->intensity) * brightest_of(light->color), most = 0.0f;
	for (size_t i = 0; i < scene->object_count && most < enough; i++) {
		const struct object *object = &scene->objects[i];
		float here =
			strength * brightest_of(object->base_color) * strongest_at(light, object);
		/* Not for NaN, which infinity times 0 is. */
		if (!(here <= most) && may_show(light, frame, object, volume))
			most = here > most ? here : INFINITY;
	}
	return most;
}

/* Replaces sizes of coordinates by sums of the sizes of all that is added up where a matrix is
 * applied to them. */
static void add_sizes(mat4 matrix, vec4 sizes)
{
	vec4 sums;
	for (int row = 0; row < 4; row++) {
		sums[row] = 0.0f;
		for (int column = 0; column < 4; column++)
			sums[row] += fabsf(matrix[column][row]) * sizes[column];
	}
	glm_vec4_copy(sums, sizes);
}

/* Corners of a mesh's box in clip space, and the sizes of what is added up for their coordinates.
 */
static void find_corners(
	const struct mesh *mesh, mat4 transform, mat4 world_to_clip, vec4 corners[8], vec4 sizes)
{
	mat4 to_clip;
	for (int axis = 0; axis < 3; axis++)
		sizes[axis] = fmaxf(fabsf(mesh->min[axis]), fabsf(mesh->max[axis]));
	sizes[3] = 1.0f;
	add_sizes(transform, sizes);
	add_sizes(world_to_clip, sizes);
	glm_mat4_mul(world_to_clip, transform, to_clip);
	for (int i = 0; i < 8; i++)
		glm_mat4_mulv(to_clip,
			(vec4){i & 1 ? mesh->max[0] : mesh->min[0],
				i & 2 ? mesh->max[1] : mesh->min[1],
				i & 4 ? mesh->max[2] : mesh->min[2], 1.0f},
			corners[i]);
}

bool mesh_misses_screen(
	const struct mesh *mesh, mat4 transform, mat4 world_to_clip, float reach, bool far_cuts)
{
	/* Axis and sign; the far plane is the last. */
	static const int sides[6][2] = {{0, 1}, {0, -1}, {1, 1}, {1, -1}, {2, -1}, {2, 1}};
	vec4 sizes, corners[8];
	find_corners(mesh, transform, world_to_clip, corners, sizes);
	for (int side = 0; side < (far_cuts ? 6 : 5); side++) {
		int axis = sides[side][0];
		float scale = 1.0f + (axis < 2 ? reach : 0.0f), sign = (float)sides[side][1];
		float slack = ROUNDING * (sizes[axis] + scale * sizes[3]);
		bool all = true;
		for (int i = 0; i < 8 && all; i++)
			all = sign * corners[i][axis] - scale * corners[i][3] > slack;
		if (all)
			return true;
	}
	return false;
}

/* What a mesh is in on a screen. */
struct bounds {
	struct screen_box box;
	float before_far[2]; /* NDC, of what is not before the near plane nor behind the far one */
};

static void add_corner(struct bounds *bounds, const vec4 corner, const vec4 sizes, float w)
{
	float x = corner[0] / w, y = corner[1] / w;
	float z = fminf(fmaxf((corner[3] - corner[2]) / w, 0.0f), 2.0f);
	float slack_x = ROUNDING * (sizes[0] + 4.0f * fabsf(x) * sizes[3]) / w;
	float slack_y = ROUNDING * (sizes[1] + 4.0f * fabsf(y) * sizes[3]) / w;
	float slack_z = ROUNDING * (sizes[2] + (1.0f + 4.0f * z) * sizes[3]) / w;
	/* One that is too large for a float, or NaN, may be anywhere. */
	if (!isfinite(corner[2]))
		slack_z = INFINITY;
	screen_box_add_point(&bounds->box, x - slack_x, y - slack_y);
	screen_box_add_point(&bounds->box, x + slack_x, y + slack_y);
	bounds->before_far[0] = fminf(bounds->before_far[0], z - slack_z);
	bounds->before_far[1] = fmaxf(bounds->before_far[1], z + slack_z);
}

/* False: the mesh may come as near as the light itself. */
static bool find_bounds(
	const struct mesh *mesh, mat4 transform, mat4 world_to_clip, struct bounds *bounds)
{
	vec4 sizes, corners[8];
	find_corners(mesh, transform, world_to_clip, corners, sizes);
	*bounds = (struct bounds){screen_box_none(), {INFINITY, -INFINITY}};
	for (int i = 0; i < 8; i++) {
		/* Rounding leaves half of w at least; true for NaN too. */
		float w = corners[i][3] - 2.0f * ROUNDING * sizes[3];
		if (!(w > 2.0f * ROUNDING * sizes[3]))
			return false;
		add_corner(bounds, corners[i], sizes, w);
	}
	return true;
}

void mesh_screen_box(
	const struct mesh *mesh, mat4 transform, mat4 world_to_clip, struct screen_box *box)
{
	struct bounds bounds;
	bool found = find_bounds(mesh, transform, world_to_clip, &bounds);
	*box = found ? bounds.box : screen_box_all();
}

struct disc_box mesh_disc_box(
	const struct mesh *mesh, mat4 transform, const struct light_frame *frame)
{
	struct bounds bounds;
	if (!find_bounds(mesh, transform, (vec4 *)frame->world_to_clip, &bounds))
		return disc_box_all();
	float scale = disc_scale(frame);
	float least = scale * bounds.before_far[0], most = scale * bounds.before_far[1];
	if (!isfinite(least) || !isfinite(most))
		return disc_box_all();
	return (struct disc_box){bounds.box, {least, most}};
}
