/* SPDX-License-Identifier: MIT */
#include "tiles.h"

/* A gap of fewer tiles than this between two runs costs less to shade than to leave out. */
#define GAP_MIN 8

/* Pixels of a picture's height, below which fewer rows save too few pixels. */
#define FINE_HEIGHT_MIN 512

/* Of a triangle cut by the near plane and a tile's four sides. A cut adds one, but where corners
 * lie in a plane rounding may put every second one outside: 4, 6, 9, 13, 19. */
#define CORNERS_MAX 20

/* A point of a surface in two clip spaces. Both are linear over a triangle, so that cutting it in
 * one is cutting it in the other. */
struct corner {
	vec4 view, light;
};

struct polygon {
	struct corner corners[CORNERS_MAX];
	int count;
};

/* Keeps what of a convex polygon has dot(plane, view) >= 0 (Sutherland & Hodgman 1974). */
static void cut(const struct polygon *polygon, const vec4 plane, struct polygon *kept)
{
	kept->count = 0;
	for (int i = 0; i < polygon->count; i++) {
		const struct corner *p = &polygon->corners[i];
		const struct corner *q = &polygon->corners[(i + 1) % polygon->count];
		float inside_p = glm_vec4_dot((float *)plane, (float *)p->view);
		float inside_q = glm_vec4_dot((float *)plane, (float *)q->view);
		if (inside_p >= 0.0f)
			kept->corners[kept->count++] = *p;
		if ((inside_p >= 0.0f) == (inside_q >= 0.0f))
			continue;
		/* One is below 0 and the other is not: the divisor is neither's 0. */
		float share = inside_p / (inside_p - inside_q);
		struct corner *between = &kept->corners[kept->count++];
		glm_vec4_lerp((float *)p->view, (float *)q->view, share, between->view);
		glm_vec4_lerp((float *)p->light, (float *)q->light, share, between->light);
	}
}

/* Keeps what is between two values of x / w (axis 0) or y / w (axis 1), w > 0. */
static void cut_between(
	const struct polygon *polygon, int axis, float from, float to, struct polygon *kept)
{
	struct polygon half;
	vec4 lower = {0.0f, 0.0f, 0.0f, -from}, upper = {0.0f, 0.0f, 0.0f, to};
	lower[axis] = 1.0f;
	upper[axis] = -1.0f;
	cut(polygon, lower, &half);
	cut(&half, upper, kept);
}

static enum need need_of_polygon(const struct need_map *map, const struct polygon *polygon)
{
	float min[3] = {INFINITY, INFINITY, INFINITY};
	float max[3] = {-INFINITY, -INFINITY, -INFINITY};
	int behind = 0;
	for (int i = 0; i < polygon->count; i++) {
		const float *p = polygon->corners[i].light;
		/* The light shines the other way there; false for NaN too. */
		if (!(p[3] > 0.0f)) {
			behind++;
			continue;
		}
		for (int axis = 0; axis < 3; axis++) {
			min[axis] = fminf(min[axis], p[axis] / p[3]);
			max[axis] = fmaxf(max[axis], p[axis] / p[3]);
		}
	}
	if (behind > 0)
		return behind == polygon->count ? NEED_AMBIENT : NEED_TECHNIQUE;
	return need_of_space(map, min, max);
}

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

/* NDC of the left or lower side of a tile. */
static float side_of(int tile)
{
	return (float)tile * (2.0f / SCREEN_GRID_SIZE) - 1.0f;
}

/* What is cut to tiles. */
struct search {
	const struct need_map *map;
	const struct polygon *seen; /* [count] triangles */
	size_t count;
	float margin[2]; /* NDC by which a tile's pixels may reach beyond it */
};

/* Rows that are alike. */
struct band {
	int row, end;
};

/* Marks, for each need, those of the given tiles in a band where a triangle has it. */
static void mark_triangle(const struct search *search, const struct polygon *triangle,
	struct band rows, uint64_t tiles, uint64_t marked[NEED_COUNT])
{
	const float *margin = search->margin;
	struct polygon band, tile;
	cut_between(
		triangle, 1, side_of(rows.row) - margin[1], side_of(rows.end) + margin[1], &band);
	for (int x = 0; x < SCREEN_GRID_SIZE && band.count > 0; x++) {
		if (!(tiles >> x & 1))
			continue;
		cut_between(&band, 0, side_of(x) - margin[0], side_of(x + 1) + margin[0], &tile);
		if (tile.count > 0)
			marked[need_of_polygon(search->map, &tile)] |= (uint64_t)1 << x;
	}
}

static void mark(
	const struct search *search, struct band rows, uint64_t tiles, uint64_t marked[NEED_COUNT])
{
	for (size_t i = 0; i < search->count; i++)
		mark_triangle(search, &search->seen[i], rows, tiles, marked);
}

/* Each tile goes to the greatest need alone. */
static void set_band(struct tiles *tiles, struct band rows, const uint64_t marked[NEED_COUNT])
{
	uint64_t taken = 0;
	for (int need = NEED_COUNT - 1; need >= 0; need--) {
		uint64_t row = need > 0 ? close_gaps(marked[need] | taken) : ~(uint64_t)0;
		for (int i = rows.row; i < rows.end; i++)
			tiles->of[need].rows[i] = row & ~taken;
		taken = row;
	}
}

/* The tiles of a band that need the technique are found again by fewer rows. */
static void set_finely(struct tiles *tiles, const struct search *search, struct band rows,
	const uint64_t marked[NEED_COUNT])
{
	uint64_t costly = marked[NEED_BEHIND] | marked[NEED_TECHNIQUE];
	for (int row = rows.row; row < rows.end; row += TILE_BAND_FINE) {
		const struct band part = {row, row + TILE_BAND_FINE};
		uint64_t here[NEED_COUNT];
		for (int need = 0; need < NEED_COUNT; need++)
			here[need] = marked[need] & ~costly;
		mark(search, part, costly, here);
		set_band(tiles, part, here);
	}
}

static bool see_triangle(struct polygon *seen, const struct mesh *mesh, size_t triangle,
	mat4 to_clip, mat4 to_light_clip)
{
	/* z >= -w, and w above 0 with it, since the near plane is in front of the eye. */
	static const vec4 near_plane = {0.0f, 0.0f, 1.0f, 1.0f};
	struct polygon whole = {.count = 3};
	for (int i = 0; i < 3; i++) {
		vec4 p;
		glm_vec4(mesh->positions[mesh->indices[3 * triangle + (size_t)i]], 1.0f, p);
		glm_mat4_mulv(to_clip, p, whole.corners[i].view);
		glm_mat4_mulv(to_light_clip, p, whole.corners[i].light);
	}
	cut(&whole, near_plane, seen);
	return seen->count > 0;
}

void tiles_find(struct tiles *tiles, const struct need_map *map, const struct mesh *mesh,
	uint32_t width, uint32_t height, mat4 to_clip, mat4 to_light_clip)
{
	struct polygon seen[TILE_TRIANGLES_MAX];
	/* One pixel: half for the one that a tile's side cuts, half for where it is shaded. */
	struct search search = {map, seen, 0, {2.0f / (float)width, 2.0f / (float)height}};
	/* Behind what casters reach is known where pixels walk along edges, which costs ten times
	 * what the rest of them does. */
	bool fine = map->farthest != NULL && height >= FINE_HEIGHT_MIN;
	for (size_t i = 0; i < mesh->index_count / 3; i++)
		search.count += see_triangle(&seen[search.count], mesh, i, to_clip, to_light_clip);
	for (int row = 0; row < SCREEN_GRID_SIZE; row += TILE_BAND) {
		const struct band rows = {row, row + TILE_BAND};
		uint64_t marked[NEED_COUNT] = {0};
		mark(&search, rows, ~(uint64_t)0, marked);
		if (fine && (marked[NEED_BEHIND] | marked[NEED_TECHNIQUE]) != 0)
			set_finely(tiles, &search, rows, marked);
		else
			set_band(tiles, rows, marked);
	}
}
