/* SPDX-License-Identifier: MIT */
#include "load/solid.h"
#include "base/array.h"
#include <cglm/cglm.h>
#include <stdlib.h>
#include <string.h>

/** A mesh under construction, in memory of exactly its size. */
struct surface {
	float (*positions)[3];
	float (*normals)[3]; /* NULL: flat */
	uint32_t *indices;
	size_t vertex_count, index_count;
};

static bool surface_init(struct surface *surface, struct model *model, size_t vertices,
	size_t triangles, bool smooth)
{
	*surface = (struct surface){
		.positions = model_alloc(model, vertices, sizeof(*surface->positions)),
		.indices = model_alloc(model, triangles, 3 * sizeof(*surface->indices)),
	};
	if (smooth)
		surface->normals = model_alloc(model, vertices, sizeof(*surface->normals));
	return surface->positions != NULL && surface->indices != NULL &&
	       (!smooth || surface->normals != NULL);
}

static void add_triangle(struct surface *surface, uint32_t a, uint32_t b, uint32_t c)
{
	surface->indices[surface->index_count++] = a;
	surface->indices[surface->index_count++] = b;
	surface->indices[surface->index_count++] = c;
}

static uint32_t add_vertex(struct surface *surface, const float position[3])
{
	memcpy(surface->positions[surface->vertex_count], position, 3 * sizeof(float));
	return (uint32_t)surface->vertex_count++;
}

static struct sm_object_desc *surface_finish(const struct surface *surface, struct model *model)
{
	uint32_t mesh = (uint32_t)model->mesh_count++;
	model->meshes[mesh] = (struct sm_mesh_desc){
		.positions = *surface->positions,
		.normals = surface->normals != NULL ? *surface->normals : NULL,
		.vertex_count = surface->vertex_count,
		.indices = surface->indices,
		.index_count = surface->index_count,
	};
	struct sm_object_desc *object = &model->objects[model->object_count++];
	*object = (struct sm_object_desc){
		.mesh = mesh,
		.transform = {[0] = 1, [5] = 1, [10] = 1, [15] = 1},
		.base_color = {1, 1, 1, 1},
		.image = SM_NONE,
		.casts = true,
		.receives = true,
	};
	return object;
}

static void add_box(struct surface *surface, const struct solid_box_desc *box)
{
	/* Corner i lies on the positive side of the axes whose bits are set in i. */
	static const uint8_t quads[6][4] = {
		{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
	uint32_t first = (uint32_t)surface->vertex_count;
	for (int i = 0; i < 8; i++) {
		float corner[3];
		memcpy(corner, box->center, sizeof(corner));
		for (int axis = 0; axis < 3; axis++)
			glm_vec3_muladds(
				(float *)box->half_axes[axis], i >> axis & 1 ? 1 : -1, corner);
		add_vertex(surface, corner);
	}
	for (int i = 0; i < 6; i++) {
		const uint8_t *quad = quads[i];
		add_triangle(surface, first + quad[0], first + quad[1], first + quad[2]);
		add_triangle(surface, first + quad[0], first + quad[2], first + quad[3]);
	}
}

struct sm_object_desc *solid_boxes(
	struct model *model, const struct solid_box_desc *boxes, size_t count)
{
	struct surface surface;
	if (!surface_init(&surface, model, 8 * count, 12 * count, false))
		return NULL;
	for (size_t i = 0; i < count; i++)
		add_box(&surface, &boxes[i]);
	return surface_finish(&surface, model);
}

struct sm_object_desc *solid_box(
	struct model *model, const float center[3], const float half_axes[3][3])
{
	struct solid_box_desc box;
	memcpy(box.center, center, sizeof(box.center));
	memcpy(box.half_axes, half_axes, sizeof(box.half_axes));
	return solid_boxes(model, &box, 1);
}

/** A ring of vertices, the first at +x and the second towards -z: counter-clockwise from above. */
static void add_ring(struct surface *surface, const struct solid_point *point, uint32_t sides)
{
	for (uint32_t i = 0; i < sides; i++) {
		float angle = 2 * GLM_PIf * (float)i / (float)sides;
		float x = cosf(angle), z = -sinf(angle);
		float normal[3] = {
			x * point->normal_radius, point->normal_y, z * point->normal_radius};
		memcpy(surface->normals[surface->vertex_count], normal, sizeof(normal));
		add_vertex(surface, (float[3]){x * point->radius, point->y, z * point->radius});
	}
}

struct sm_object_desc *solid_lathe(
	struct model *model, const struct solid_point *profile, size_t point_count, uint32_t sides)
{
	struct surface surface;
	if (!surface_init(&surface, model, point_count * sides, point_count * sides, true))
		return NULL;
	for (size_t k = 0; k < point_count; k++)
		add_ring(&surface, &profile[k], sides);
	for (uint32_t k = 0; k < point_count; k += 2) {
		for (uint32_t i = 0; i < sides; i++) {
			uint32_t first = k * sides, second = first + sides, next = (i + 1) % sides;
			if (profile[k].radius > 0)
				add_triangle(&surface, first + i, first + next, second + next);
			if (profile[k + 1].radius > 0)
				add_triangle(&surface, first + i, second + next, second + i);
		}
	}
	return surface_finish(&surface, model);
}

/** Ring of a tube in the plane across the curve, starting on its level right. */
static void add_tube_ring(struct surface *surface, const float center[3], solid_curve curve,
	float t, float radius, uint32_t sides)
{
	/* The step of the files of truth, in radians; a smaller one drowns in rounding. */
	const float step = 1e-3f;
	vec3 point, before, direction, out, across;
	curve(t - step, before);
	curve(t + step, direction);
	glm_vec3_sub(direction, before, direction);
	glm_vec3_normalize(direction);
	glm_vec3_crossn(direction, GLM_YUP, out);
	glm_vec3_cross(out, direction, across);
	curve(t, point);
	glm_vec3_add(point, (float *)center, point);
	for (uint32_t i = 0; i < sides; i++) {
		float angle = 2 * GLM_PIf * (float)i / (float)sides;
		vec3 normal, position;
		glm_vec3_scale(out, cosf(angle), normal);
		glm_vec3_muladds(across, sinf(angle), normal);
		memcpy(surface->normals[surface->vertex_count], normal, sizeof(normal));
		glm_vec3_copy(point, position);
		glm_vec3_muladds(normal, radius, position);
		add_vertex(surface, position);
	}
}

struct sm_object_desc *solid_tube(struct model *model, const float center[3], solid_curve curve,
	float radius, uint32_t segments, uint32_t sides)
{
	struct surface surface;
	size_t quads = (size_t)segments * sides;
	if (!surface_init(&surface, model, quads, 2 * quads, true))
		return NULL;
	for (uint32_t i = 0; i < segments; i++) {
		float t = 2 * GLM_PIf * (float)i / (float)segments;
		add_tube_ring(&surface, center, curve, t, radius, sides);
	}
	for (uint32_t i = 0; i < segments; i++) {
		for (uint32_t j = 0; j < sides; j++) {
			uint32_t ring = i * sides, ahead = (i + 1) % segments * sides;
			uint32_t next = (j + 1) % sides;
			add_triangle(&surface, ring + j, ahead + j, ahead + next);
			add_triangle(&surface, ring + j, ahead + next, ring + next);
		}
	}
	return surface_finish(&surface, model);
}

/** Midpoints by the edge that they halve, so that both faces of an edge share one. */
struct midpoint {
	uint64_t edge; /* lower end << 32 | upper end; 0: free, as no edge has both ends at 0 */
	uint32_t vertex;
};

struct midpoint_table {
	struct midpoint *slots;
	size_t size; /* a power of two, at least twice the edges */
};

static uint32_t midpoint(
	struct midpoint_table *table, struct surface *surface, uint32_t a, uint32_t b)
{
	uint64_t edge = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
	size_t i = (edge * 0x9e3779b97f4a7c15u >> 32) & (table->size - 1);
	while (table->slots[i].edge != 0 && table->slots[i].edge != edge)
		i = (i + 1) & (table->size - 1);
	if (table->slots[i].edge == 0) {
		vec3 middle;
		glm_vec3_add(surface->positions[a], surface->positions[b], middle);
		glm_vec3_normalize(middle);
		table->slots[i] = (struct midpoint){edge, add_vertex(surface, middle)};
	}
	return table->slots[i].vertex;
}

/** Splits the faces in four, from the last to the first, each into room behind those before it. */
static bool split_faces(struct surface *surface)
{
	size_t faces = surface->index_count / 3;
	struct midpoint_table table = {.size = 64};
	while (table.size < 3 * faces)
		table.size *= 2;
	table.slots = array_zalloc(table.size, sizeof(*table.slots));
	if (table.slots == NULL)
		return false;
	for (size_t face = faces; face-- > 0;) {
		uint32_t corners[3];
		memcpy(corners, surface->indices + 3 * face, sizeof(corners));
		uint32_t ab = midpoint(&table, surface, corners[0], corners[1]);
		uint32_t bc = midpoint(&table, surface, corners[1], corners[2]);
		uint32_t ca = midpoint(&table, surface, corners[2], corners[0]);
		surface->index_count = 12 * face;
		add_triangle(surface, corners[0], ab, ca);
		add_triangle(surface, corners[1], bc, ab);
		add_triangle(surface, corners[2], ca, bc);
		add_triangle(surface, ab, bc, ca);
	}
	surface->index_count = 12 * faces;
	free(table.slots);
	return true;
}

/** Normals from the triangles about each vertex, weighted by their area. */
static void smooth_normals(struct surface *surface)
{
	for (size_t i = 0; i < surface->index_count; i += 3) {
		const uint32_t *corners = surface->indices + i;
		vec3 ab, ac, cross;
		glm_vec3_sub(surface->positions[corners[1]], surface->positions[corners[0]], ab);
		glm_vec3_sub(surface->positions[corners[2]], surface->positions[corners[0]], ac);
		glm_vec3_cross(ab, ac, cross);
		for (int k = 0; k < 3; k++)
			glm_vec3_add(
				surface->normals[corners[k]], cross, surface->normals[corners[k]]);
	}
	for (size_t i = 0; i < surface->vertex_count; i++)
		glm_vec3_normalize(surface->normals[i]);
}

static void add_icosahedron(struct surface *surface)
{
	/* Three golden rectangles, by the axes of their short and long sides. */
	static const uint8_t axes[3][2] = {{0, 2}, {2, 1}, {1, 0}};
	static const uint8_t faces[20][3] = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10},
		{0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8}, {3, 9, 4},
		{3, 4, 2}, {3, 2, 6}, {3, 6, 8}, {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10},
		{8, 6, 7}, {9, 8, 1}};
	const float golden = (1 + sqrtf(5)) / 2;
	for (int i = 0; i < 12; i++) {
		vec3 corner = {0};
		corner[axes[i / 4][0]] = i & 1 ? 1 : -1;
		corner[axes[i / 4][1]] = i & 2 ? -golden : golden;
		corner[2] = -corner[2];
		glm_vec3_normalize(corner);
		add_vertex(surface, corner);
	}
	for (int i = 0; i < 20; i++)
		add_triangle(surface, faces[i][0], faces[i][1], faces[i][2]);
}

/** Pushes the vertices of a sphere about the origin, of radius 1, to where they belong. */
static void place_sphere(
	struct surface *surface, const float center[3], solid_radius radius, const void *data)
{
	for (size_t i = 0; i < surface->vertex_count; i++) {
		float *position = surface->positions[i];
		glm_vec3_scale(position, radius(data, position), position);
		glm_vec3_add(position, (float *)center, position);
	}
}

struct sm_object_desc *solid_icosphere(struct model *model, const float center[3], uint32_t levels,
	solid_radius radius, const void *data)
{
	size_t faces = (size_t)20 << 2 * levels;
	struct surface surface;
	/* Euler: a closed surface of F triangles has F / 2 + 2 vertices. */
	if (!surface_init(&surface, model, faces / 2 + 2, faces, levels > 0))
		return NULL;
	add_icosahedron(&surface);
	for (uint32_t level = 0; level < levels; level++)
		if (!split_faces(&surface))
			return NULL;
	place_sphere(&surface, center, radius, data);
	if (levels > 0)
		smooth_normals(&surface);
	return surface_finish(&surface, model);
}

/** Rings of an octahedron, split: ring i of 0 .. 2 * splits has 4 vertices for each step that the
 *  nearer tip is away, the first at +x and the next ones towards -z, and the tips have one. */
static uint32_t ring_steps(uint32_t ring, uint32_t splits)
{
	return ring <= splits ? ring : 2 * splits - ring;
}

static void add_octahedron_ring(struct surface *surface, uint32_t ring, uint32_t splits)
{
	static const float corners[5][2] = {{1, 0}, {0, -1}, {-1, 0}, {0, 1}, {1, 0}};
	uint32_t steps = ring_steps(ring, splits);
	float height = 1 - (float)ring / (float)splits;
	for (uint32_t i = 0; i < 4 * steps || i == 0; i++) {
		vec3 position = {0, height, 0};
		if (steps > 0) {
			const float *a = corners[i / steps], *b = corners[i / steps + 1];
			float from = (float)(steps - i % steps) / (float)splits;
			float to = (float)(i % steps) / (float)splits;
			position[0] = from * a[0] + to * b[0];
			position[2] = from * a[1] + to * b[1];
		}
		glm_vec3_normalize(position);
		add_vertex(surface, position);
	}
}

/** The triangles between a ring of `steps` and its wider neighbour, from the first of each. */
static void add_octahedron_band(
	struct surface *surface, uint32_t narrow, uint32_t wide, uint32_t steps)
{
	bool narrow_above = narrow < wide;
	uint32_t narrow_count = steps > 0 ? 4 * steps : 1, wide_count = 4 * (steps + 1);
	for (uint32_t quarter = 0; quarter < 4; quarter++) {
		for (uint32_t i = 0; i <= steps; i++) {
			uint32_t n = narrow + (quarter * steps + i) % narrow_count;
			uint32_t n_next = narrow + (quarter * steps + i + 1) % narrow_count;
			uint32_t w = wide + quarter * (steps + 1) + i;
			uint32_t w_next = wide + (quarter * (steps + 1) + i + 1) % wide_count;
			add_triangle(
				surface, n, narrow_above ? w : w_next, narrow_above ? w_next : w);
			if (i < steps)
				add_triangle(surface, w_next, narrow_above ? n_next : n,
					narrow_above ? n : n_next);
		}
	}
}

struct sm_object_desc *solid_octasphere(struct model *model, const float center[3], uint32_t splits,
	solid_radius radius, const void *data)
{
	size_t faces = (size_t)8 * splits * splits;
	struct surface surface;
	if (!surface_init(&surface, model, faces / 2 + 2, faces, true))
		return NULL;
	uint32_t first = 0;
	add_octahedron_ring(&surface, 0, splits);
	for (uint32_t ring = 1; ring <= 2 * splits; ring++) {
		uint32_t next = (uint32_t)surface.vertex_count;
		add_octahedron_ring(&surface, ring, splits);
		if (ring <= splits)
			add_octahedron_band(&surface, first, next, ring - 1);
		else
			add_octahedron_band(&surface, next, first, 2 * splits - ring);
		first = next;
	}
	place_sphere(&surface, center, radius, data);
	smooth_normals(&surface);
	return surface_finish(&surface, model);
}
