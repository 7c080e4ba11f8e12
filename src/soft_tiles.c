/* SPDX-License-Identifier: MIT */
#include "soft_tiles.h"

/* The pyramid or prism of light behind a rectangle of the light's screen: four rays from the near
 * plane to the far one. */
struct beam {
	vec3 from[4], to[4];
};

/* False when the frame has no inverse there. */
static bool unproject(mat4 clip_to_world, float x, float y, float z, vec3 world)
{
	vec4 p = {x, y, z, 1.0f};
	glm_mat4_mulv(clip_to_world, p, p);
	if (!(fabsf(p[3]) > 0.0f))
		return false;
	glm_vec3_scale(p, 1.0f / p[3], world);
	return true;
}

static bool beam_init(struct beam *beam, mat4 clip_to_world, const float min[2], const float max[2])
{
	for (int i = 0; i < 4; i++) {
		float x = i & 1 ? max[0] : min[0], y = i & 2 ? max[1] : min[1];
		if (!unproject(clip_to_world, x, y, -1.0f, beam->from[i]) ||
			!unproject(clip_to_world, x, y, 1.0f, beam->to[i]))
			return false;
	}
	return true;
}

/* Where a ray leaves a box, as a share of its length, and through which side (axis and sign), or
 * -1 if it ends inside. */
static float exit_of(const vec3 from, const vec3 to, vec3 box[2], int *side)
{
	float exit = 1.0f;
	*side = -1;
	for (int axis = 0; axis < 3; axis++) {
		float step = to[axis] - from[axis];
		/* A ray along the side never meets it. */
		if (step == 0.0f)
			continue;
		float share = (box[step > 0.0f][axis] - from[axis]) / step;
		if (share < exit) {
			exit = share;
			*side = 2 * axis + (step > 0.0f);
		}
	}
	return exit;
}

/* Ends the beam where the scene ends, if its rays all leave the box through one side: then so does
 * all that is between them. */
static void cut_beam(struct beam *beam, vec3 box[2])
{
	float exits[4];
	int sides[4];
	for (int i = 0; i < 4; i++) {
		exits[i] = exit_of(beam->from[i], beam->to[i], box, &sides[i]);
		if (sides[i] < 0 || sides[i] != sides[0])
			return;
	}
	for (int i = 0; i < 4; i++)
		glm_vec3_lerp(beam->from[i], beam->to[i], fmaxf(exits[i], 0.0f), beam->to[i]);
}

static bool project(mat4 world_to_clip, vec3 world, struct screen_point *point)
{
	vec4 p;
	glm_vec4(world, 1.0f, p);
	glm_mat4_mulv(world_to_clip, p, p);
	/* At the eye or behind it; false for NaN too. */
	if (!(p[3] > 0.0f))
		return false;
	*point = (struct screen_point){p[0] / p[3], p[1] / p[3]};
	return true;
}

static void add_beam(struct screen_grid *tiles, struct beam *beam, mat4 world_to_clip)
{
	static const uint8_t edges[12][2] = {{0, 1}, {1, 3}, {3, 2}, {2, 0}, {4, 5}, {5, 7}, {7, 6},
		{6, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
	struct screen_point points[8];
	for (int i = 0; i < 4; i++) {
		if (!project(world_to_clip, beam->from[i], &points[i]) ||
			!project(world_to_clip, beam->to[i], &points[4 + i])) {
			screen_grid_fill(tiles);
			return;
		}
	}
	/* A hundredth of a tile, for rounding. */
	screen_grid_add(tiles, points, edges, 12, 0.01f);
}

/* A gap of fewer tiles than this between two runs costs less to shade than to leave out. */
#define GAP_MIN 8

static uint64_t close_gaps(uint64_t row)
{
	for (int gap = 1; gap < GAP_MIN; gap++) {
		uint64_t between = ~(uint64_t)0;
		for (int i = 1; i <= gap; i++)
			between &= ~(row >> i);
		/* Bit x: tile x is marked, the next `gap` are not, and the one behind them is. */
		uint64_t found = row & between & row >> (gap + 1);
		for (int i = 1; i <= gap; i++)
			row |= found << i;
	}
	return row;
}

static void round_up(struct screen_grid *tiles)
{
	for (int first = 0; first < SCREEN_GRID_SIZE; first += SOFT_TILES_BAND) {
		uint64_t band = 0;
		for (int row = first; row < first + SOFT_TILES_BAND; row++)
			band |= tiles->rows[row];
		for (int row = first; row < first + SOFT_TILES_BAND; row++)
			tiles->rows[row] = close_gaps(band);
	}
}

static void find_tiles(struct screen_grid *tiles, const struct screen_grid *cells,
	const struct light_frame *frame, const struct sm_scene *scene, mat4 world_to_clip)
{
	mat4 clip_to_world;
	vec3 box[2];
	screen_grid_clear(tiles);
	if (!sm_scene_get_bounds(scene, false, box[0], box[1]))
		return;
	glm_mat4_inv((vec4 *)frame->world_to_clip, clip_to_world);
	const float cell = 2.0f / SCREEN_GRID_SIZE;
	for (int row = 0; row < SCREEN_GRID_SIZE; row++) {
		for (int x = 0, end; x < SCREEN_GRID_SIZE; x = end) {
			struct beam beam;
			end = screen_grid_run_end(cells, x, row);
			if (!screen_grid_has(cells, x, row))
				continue;
			float min[2] = {(float)x * cell - 1.0f, (float)row * cell - 1.0f};
			float max[2] = {(float)end * cell - 1.0f, min[1] + cell};
			if (!beam_init(&beam, clip_to_world, min, max)) {
				screen_grid_fill(tiles);
				return;
			}
			cut_beam(&beam, box);
			add_beam(tiles, &beam, world_to_clip);
		}
	}
}

void soft_tiles_find(struct screen_grid *tiles, const struct screen_grid *cells,
	const struct light_frame *frame, const struct sm_scene *scene, mat4 world_to_clip)
{
	find_tiles(tiles, cells, frame, scene, world_to_clip);
	round_up(tiles);
}
