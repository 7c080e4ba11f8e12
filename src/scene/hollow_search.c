/* SPDX-License-Identifier: MIT */
#include "scene/hollow_search.h"
#include "base/float_range.h"
#include <math.h>

/* Where the other triangle is asked what it sees: shares of its vertices at the edge, and of the
 * third. */
#define PLACE_EDGE 0.425f
#define PLACE_FAR 0.15f

/* Of rounded normals, at most. */
#define PLANE_LENGTH (FACE_PLANE_ONE + 1.0f)

/* Of a turn: samples lie on a spiral, evenly. */
#define GOLDEN_ANGLE 2.39996323f

static bool faces(const struct caster_view *view, uint32_t triangle)
{
	return view->facing[triangle / EDGE_BLOCK] >> triangle % EDGE_BLOCK & 1;
}

/* Least values are found side by side. */
#define LANES 8

/* Whether the planes of a block may come near enough to the light's centre, of which it finds how
 * far they are away. */
static bool look_at_block(struct hollow_search *search, size_t block)
{
	const struct face_planes *planes = &search->view->caster->planes;
	const int16_t *values = face_block_values(planes, block);
	size_t size = face_block_size(planes, block);
	float x = search->light[0], y = search->light[1], z = search->light[2];
	float w = search->light[3], least[LANES], nearest = HUGE_VALF;
	search->block = block;
	if (search->view->facing[block] == 0)
		return false;
	for (size_t i = 0; i < size; i++)
		search->off[i] =
			fabsf(x * (float)values[i] + y * (float)values[size + i] +
				z * (float)values[2 * size + i] + w * (float)values[3 * size + i]);
	for (size_t i = size; i < EDGE_BLOCK; i++)
		search->off[i] = HUGE_VALF;
	for (size_t k = 0; k < LANES; k++)
		least[k] = search->off[k];
	for (size_t i = LANES; i < EDGE_BLOCK; i += LANES)
		for (size_t k = 0; k < LANES; k++)
			least[k] = smaller(search->off[i + k], least[k]);
	for (size_t k = 0; k < LANES; k++)
		nearest = smaller(least[k], nearest);
	return nearest < search->off_max;
}

/* Whether the plane of a triangle cuts the light's disc, however that is turned: as far as rounded
 * planes tell. */
static bool is_grazing(const struct hollow_search *search, uint32_t triangle)
{
	const struct caster_view *view = search->view;
	const struct face_planes *planes = &view->caster->planes;
	size_t block = triangle / EDGE_BLOCK, size = face_block_size(planes, block);
	float off = search->off[triangle % EDGE_BLOCK];
	const int16_t *values = face_block_values(planes, block) + triangle % EDGE_BLOCK;
	vec3 normal = {values[0], values[size], values[2 * size]}, turned;
	for (int i = 0; i < 3; i++)
		turned[i] = glm_vec3_dot((float *)search->to_object[i], normal);
	off = view->parallel ? turned[2] : off;
	return off * off < view->disc * view->disc * glm_vec3_norm2(turned);
}

static void to_light(const struct hollow_search *search, const float *position, vec3 seen)
{
	glm_mat4_mulv3((vec4 *)search->view->to_light, (float *)position, 1.0f, seen);
}

static void look_at(struct hollow_search *search, uint32_t triangle)
{
	const struct caster_view *view = search->view;
	const uint32_t *corners = &view->caster->indices[3 * (size_t)triangle];
	vec3 sides[2];
	search->triangle = triangle;
	search->grazing = is_grazing(search, triangle);
	if (!search->grazing)
		return;
	for (int k = 0; k < 3; k++)
		to_light(search, view->caster->positions[corners[k]], search->corners[k]);
	for (int i = 0; i < 2; i++)
		glm_vec3_sub(search->corners[i + 1], search->corners[0], sides[i]);
	glm_vec3_cross(sides[0], sides[1], search->normal);
	search->light_off = view->parallel ? search->normal[2]
					   : glm_vec3_dot(search->normal, search->corners[0]);
	search->beyond = view->disc * glm_vec3_norm(search->normal) - fabsf(search->light_off);
}

/* A place near a hollow's edge, in light space. */
static void place_of(const struct hollow_search *search, const struct hollow *hollow, vec3 place)
{
	const struct caster *caster = search->view->caster;
	const uint32_t *corners = &caster->indices[hollow->corner - hollow->corner % 3];
	vec3 mean = {0.0f, 0.0f, 0.0f};
	for (uint32_t k = 0; k < 3; k++) {
		bool far = k == (hollow->corner + 2) % 3;
		glm_vec3_muladds(
			(float *)caster->positions[corners[k]], far ? PLACE_FAR : PLACE_EDGE, mean);
	}
	to_light(search, mean, place);
}

/* Axes of the disc as it is seen from a place, and the one towards it. */
static void find_axes(const struct caster_view *view, const vec3 place, vec3 axes[3])
{
	glm_mat3_identity(axes);
	float square = glm_vec3_norm2((float *)place);
	if (!view->parallel && square > 0.0f) {
		glm_vec3_copy((vec3){place[2], 0.0f, -place[0]}, axes[0]);
		glm_vec3_normalize(axes[0]);
		glm_vec3_scale((float *)place, 1.0f / sqrtf(square), axes[2]);
		glm_vec3_cross(axes[2], axes[0], axes[1]);
		glm_vec3_scale((float *)place, 1.0f / square, axes[2]);
	}
	glm_vec3_scale(axes[0], 1.0f / view->disc, axes[0]);
	glm_vec3_scale(axes[1], 1.0f / view->disc, axes[1]);
}

/* Whether a place is on the same side of the triangle's plane as the light's centre, and the
 * triangle reaches to where rays to the disc's rim may pass that plane. */
static bool may_hide(const struct hollow_search *search, const vec3 place)
{
	float height = 0.0f, farthest = 0.0f;
	vec3 off, axis = {0.0f, 0.0f, 1.0f};
	if (!search->view->parallel)
		glm_vec3_copy((float *)place, axis);
	for (int k = 0; k < 3; k++) {
		glm_vec3_sub((float *)place, (float *)search->corners[k], off);
		farthest = larger(glm_vec3_dot(off, axis), farthest);
		height = k == 0 ? glm_vec3_dot((float *)search->normal, off) : height;
	}
	if (height * search->light_off >= 0.0f)
		return false;
	height = fabsf(height);
	return height * glm_vec3_norm2(axis) < (height + search->beyond) * farthest;
}

/* Whether the triangle hides a sample of the disc from the place: in homogeneous coordinates of the
 * disc, which hold for vertices beside the place and behind it as well. */
static bool hides(const struct hollow_search *search, const vec3 place)
{
	vec3 axes[3], seen[3], lines[3], off;
	find_axes(search->view, place, axes);
	for (int k = 0; k < 3; k++) {
		glm_vec3_sub((float *)search->corners[k], (float *)place, off);
		for (int i = 0; i < 3; i++)
			seen[k][i] = glm_vec3_dot(axes[i], off) * (i == 2 ? -1.0f : 1.0f);
	}
	for (int k = 0; k < 3; k++)
		glm_vec3_cross(seen[k], seen[(k + 1) % 3], lines[k]);
	float turn = glm_vec3_dot(lines[0], seen[2]) < 0.0f ? -1.0f : 1.0f;
	float inside[HOLLOW_SAMPLES], most = -1.0f;
	for (int i = 0; i < HOLLOW_SAMPLES; i++)
		inside[i] = HUGE_VALF;
	for (int k = 0; k < 3; k++) {
		float x = turn * lines[k][0], y = turn * lines[k][1], z = turn * lines[k][2];
		for (int i = 0; i < HOLLOW_SAMPLES; i++)
			inside[i] =
				smaller(x * search->samples[0][i] + y * search->samples[1][i] + z,
					inside[i]);
	}
	for (int i = 0; i < HOLLOW_SAMPLES; i++)
		most = larger(inside[i], most);
	return most > 0.0f;
}

void hollow_search_begin(struct hollow_search *search, const struct caster_view *view)
{
	*search = (struct hollow_search){.view = view, .block = SIZE_MAX, .triangle = UINT32_MAX};
	glm_mat4_inv((vec4 *)view->to_light, search->to_object);
	const struct face_planes *planes = &view->caster->planes;
	float w = view->light[3], square = 0.0f;
	for (int i = 0; i < 3; i++) {
		search->light[i] = view->light[i] - w * (float)planes->center[i];
		square += glm_vec3_norm2(search->to_object[i]);
	}
	search->light[3] = -w * (float)planes->radius;
	search->off_max = view->parallel ? HUGE_VALF : view->disc * sqrtf(square) * PLANE_LENGTH;
	for (int i = 0; i < HOLLOW_SAMPLES; i++) {
		float radius = sqrtf(((float)i + 0.5f) / HOLLOW_SAMPLES);
		search->samples[0][i] = radius * cosf((float)i * GOLDEN_ANGLE);
		search->samples[1][i] = radius * sinf((float)i * GOLDEN_ANGLE);
	}
}

static bool rises(const struct hollow_search *search, const struct hollow *hollow)
{
	const struct caster *caster = search->view->caster;
	return !caster->hollows.moving ||
	       hollow_rises(hollow, (const float(*)[3])caster->positions, caster->indices);
}

/* Of triangles with planes that may be near enough. */
static bool is_hiding(struct hollow_search *search, const struct hollow *hollow)
{
	const struct caster_view *view = search->view;
	uint32_t triangle = hollow->triangle, beside = hollow->corner / 3;
	vec3 place;
	if (triangle >= view->rule.one_sided || beside >= view->rule.one_sided ||
		!faces(view, triangle) || !faces(view, beside))
		return false;
	if (triangle != search->triangle)
		look_at(search, triangle);
	if (!search->grazing || !rises(search, hollow))
		return false;
	place_of(search, hollow, place);
	return may_hide(search, place) && hides(search, place);
}

const struct hollow *hollow_search_next(struct hollow_search *search)
{
	const struct hollows *hollows = &search->view->caster->hollows;
	while (search->next < hollows->count) {
		const struct hollow *hollow = &hollows->of[search->next++];
		size_t block = hollow->triangle / EDGE_BLOCK;
		if (block != search->block && !look_at_block(search, block))
			search->next = hollows->ends[block];
		else if (search->off[hollow->triangle % EDGE_BLOCK] < search->off_max &&
			 is_hiding(search, hollow))
			return hollow;
	}
	return NULL;
}
