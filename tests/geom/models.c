/* SPDX-License-Identifier: MIT */
#include "models.h"
#include "base/array.h"
#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void model_finish(struct model *model)
{
	free(model->positions);
	free(model->indices);
	*model = (struct model){0};
}

struct sm_mesh_desc model_desc(const struct model *model, const char *name)
{
	return (struct sm_mesh_desc){
		.name = name,
		.positions = &model->positions[0][0],
		.vertex_count = model->vertex_count,
		.indices = model->indices,
		.index_count = model->index_count,
	};
}

static struct model model_alloc(size_t vertex_count, size_t triangle_count)
{
	struct model model = {
		.vertex_count = vertex_count,
		.positions = array_zalloc(vertex_count, sizeof(*model.positions)),
		.index_count = 3 * triangle_count,
		.indices = array_zalloc(triangle_count, 3 * sizeof(*model.indices)),
	};
	if (model.positions == NULL || model.indices == NULL)
		abort();
	return model;
}

static struct model model_copy(const float (*positions)[3], size_t vertex_count,
	const uint32_t (*triangles)[3], size_t triangle_count)
{
	struct model model = model_alloc(vertex_count, triangle_count);
	memcpy(model.positions, positions, vertex_count * sizeof(*positions));
	memcpy(model.indices, triangles, triangle_count * sizeof(*triangles));
	return model;
}

struct model model_tetrahedron(void)
{
	static const float positions[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
	static const uint32_t triangles[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
	return model_copy(positions, 4, triangles, 4);
}

/* Corner i of the cube has bit 0 of i for x, 1 for y, 2 for z. */
static const float cube_positions[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
	{-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}};
static const uint32_t cube_triangles[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
	{0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

struct model model_cube(void)
{
	return model_copy(cube_positions, 8, cube_triangles, 12);
}

struct model model_doubled(bool turned)
{
	struct model model = model_alloc(8, 24);
	memcpy(model.positions, cube_positions, sizeof(cube_positions));
	for (size_t t = 0; t < 12; t++) {
		const uint32_t *v = cube_triangles[t];
		memcpy(&model.indices[3 * t], v, sizeof(cube_triangles[t]));
		memcpy(&model.indices[3 * (t + 12)],
			(const uint32_t[3]){v[0], v[turned ? 2 : 1], v[turned ? 1 : 2]},
			sizeof(cube_triangles[t]));
	}
	return model;
}

/* Equal for (a, b) and (b, a), so that neighbours weld. */
static void middle(const float a[3], const float b[3], float m[3])
{
	float length = 0.0f;
	for (int i = 0; i < 3; i++) {
		m[i] = a[i] + b[i];
		length += m[i] * m[i];
	}
	for (int i = 0; i < 3; i++)
		m[i] /= sqrtf(length);
}

/* Appends 9 floats for each of 4^levels triangles to out; returns its new end. */
static float *subdivide(
	const float a[3], const float b[3], const float c[3], unsigned levels, float *out)
{
	if (levels == 0) {
		memcpy(out, a, 3 * sizeof(*out));
		memcpy(out + 3, b, 3 * sizeof(*out));
		memcpy(out + 6, c, 3 * sizeof(*out));
		return out + 9;
	}
	float ab[3], bc[3], ca[3];
	middle(a, b, ab);
	middle(b, c, bc);
	middle(c, a, ca);
	out = subdivide(a, ab, ca, levels - 1, out);
	out = subdivide(ab, b, bc, levels - 1, out);
	out = subdivide(ca, bc, c, levels - 1, out);
	return subdivide(ab, bc, ca, levels - 1, out);
}

struct model model_sphere(unsigned levels)
{
	size_t triangle_count = (size_t)8 << 2 * levels;
	struct model model = model_alloc(3 * triangle_count, triangle_count);
	float *out = &model.positions[0][0];
	for (int octant = 0; octant < 8; octant++) {
		float x = octant & 1 ? -1.0f : 1.0f;
		float y = octant & 2 ? -1.0f : 1.0f;
		float z = octant & 4 ? -1.0f : 1.0f;
		bool mirrored = x * y * z < 0.0f;
		const float axes[3][3] = {{x, 0, 0}, {0, y, 0}, {0, 0, z}};
		out = subdivide(
			axes[0], axes[mirrored ? 2 : 1], axes[mirrored ? 1 : 2], levels, out);
	}
	for (size_t i = 0; i < model.index_count; i++)
		model.indices[i] = (uint32_t)i;
	return model;
}

struct model model_grid(unsigned size)
{
	uint32_t row = size + 1;
	struct model model = model_alloc((size_t)row * row, (size_t)2 * size * size);
	for (uint32_t v = 0; v < row * row; v++) {
		float x = (float)(v % row) / (float)size, y = (float)(v / row) / (float)size;
		memcpy(model.positions[v], (float[3]){x, y, 0.1f * sinf(9.0f * x) * cosf(7.0f * y)},
			sizeof(model.positions[v]));
	}
	uint32_t *index = model.indices;
	for (uint32_t y = 0; y < size; y++) {
		for (uint32_t x = 0; x < size; x++, index += 6) {
			uint32_t v = y * row + x;
			memcpy(index, (uint32_t[]){v, v + 1, v + row, v + 1, v + row + 1, v + row},
				6 * sizeof(*index));
		}
	}
	return model;
}

struct model model_strip(void)
{
	struct model model = model_alloc(102, 100);
	for (uint32_t v = 0; v < 102; v++)
		memcpy(model.positions[v],
			(float[3]){(float)(v / 2) / 50.0f, (float)(v % 2), sinf((float)(v / 2))},
			sizeof(model.positions[v]));
	for (uint32_t t = 0; t < 100; t++)
		memcpy(&model.indices[3 * t], (uint32_t[3]){t, t + 1 + t % 2, t + 2 - t % 2},
			3 * sizeof(*model.indices));
	return model;
}

struct model model_fan(void)
{
	static const float positions[7][3] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {0.3f, 0.9f, 0},
		{-0.8f, 0.6f, 0}, {-0.8f, -0.6f, 0}, {0.3f, -0.9f, 0}};
	static const uint32_t triangles[5][3] = {
		{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {0, 1, 5}, {1, 0, 6}};
	return model_copy(positions, 7, triangles, 5);
}

struct model model_moebius(void)
{
	const uint32_t turns = 40;
	struct model model = model_alloc(2 * turns, 2 * turns);
	for (uint32_t v = 0; v < 2 * turns; v++) {
		float angle = (float)(v / 2) * 6.2831853f / (float)turns;
		float half = v % 2 == 0 ? 0.3f : -0.3f;
		float r = 1.0f + half * cosf(angle / 2.0f);
		memcpy(model.positions[v],
			(float[3]){r * cosf(angle), r * sinf(angle), half * sinf(angle / 2.0f)},
			sizeof(model.positions[v]));
	}
	for (uint32_t i = 0; i < turns; i++) {
		uint32_t a = 2 * i, b = a + 1;
		uint32_t c = i + 1 < turns ? a + 2 : 1, d = i + 1 < turns ? a + 3 : 0;
		memcpy(&model.indices[6 * i], (uint32_t[6]){a, c, b, b, c, d},
			6 * sizeof(*model.indices));
	}
	return model;
}

struct model model_soup(size_t vertex_count, size_t triangle_count)
{
	uint64_t state = 1;
	struct model model = model_alloc(vertex_count, triangle_count);
	for (size_t v = 0; v < vertex_count; v++)
		for (int i = 0; i < 3; i++)
			model.positions[v][i] = random_signed(&state);
	for (size_t i = 0; i < model.index_count; i++)
		model.indices[i] = random_next(&state) % (uint32_t)vertex_count;
	for (size_t t = 0; t < triangle_count; t += 50)
		model.indices[3 * t + 2] = model.indices[3 * t];
	return model;
}

/* A point of a triangle, where `at` sums up to `parts`; the same one from both sides of an edge. */
static void split_point(const struct model *model, const uint32_t v[3], const unsigned at[3],
	unsigned parts, float point[3])
{
	for (int i = 0; i < 3; i++) {
		/* Sums of floats times small integers are exact, whatever their order. */
		double sum = 0.0;
		for (int k = 0; k < 3; k++)
			sum += (double)at[k] * model->positions[v[k]][i];
		point[i] = (float)(sum / parts);
	}
}

/* Appends a triangle between corners of a triangle's grid. */
static void split_triangle(struct model *split, const struct model *model, const uint32_t v[3],
	const unsigned corners[3][2], unsigned parts)
{
	for (int k = 0; k < 3; k++) {
		unsigned i = corners[k][0], j = corners[k][1];
		split_point(model, v, (unsigned[3]){parts - i - j, i, j}, parts,
			split->positions[split->vertex_count]);
		split->indices[split->index_count++] = (uint32_t)split->vertex_count++;
	}
}

struct model model_split(const struct model *model, unsigned parts)
{
	size_t triangles = model->index_count / 3 * parts * parts;
	struct model split = model_alloc(3 * triangles, triangles);
	split.vertex_count = split.index_count = 0;
	for (size_t t = 0; t < model->index_count; t += 3) {
		for (unsigned i = 0; i < parts; i++) {
			for (unsigned j = 0; i + j < parts; j++) {
				const unsigned ahead[3][2] = {{i, j}, {i + 1, j}, {i, j + 1}};
				const unsigned back[3][2] = {
					{i + 1, j}, {i + 1, j + 1}, {i, j + 1}};
				split_triangle(&split, model, &model->indices[t], ahead, parts);
				if (i + j + 1 < parts)
					split_triangle(
						&split, model, &model->indices[t], back, parts);
			}
		}
	}
	return split;
}

static void visit_and_finish(const char *name, struct model model,
	void (*visit)(const char *name, const struct model *model))
{
	visit(name, &model);
	model_finish(&model);
}

static void visit_files(
	const char *folder, void (*visit)(const char *name, const struct model *model))
{
	char pattern[4096];
	snprintf(pattern, sizeof(pattern), "%s/models/*.glb", folder);
	glob_t files = {0};
	if (folder[0] != '\0' && glob(pattern, 0, NULL, &files) == 0) {
		for (size_t i = 0; i < files.gl_pathc; i++) {
			struct model model;
			if (model_load(&model, files.gl_pathv[i]))
				visit_and_finish(strrchr(files.gl_pathv[i], '/') + 1, model, visit);
		}
	}
	globfree(&files);
}

void models_visit(const char *folder, void (*visit)(const char *name, const struct model *model))
{
	visit_and_finish("tetrahedron", model_tetrahedron(), visit);
	visit_and_finish("cube", model_cube(), visit);
	visit_and_finish("strip", model_strip(), visit);
	visit_and_finish("fan", model_fan(), visit);
	visit_and_finish("moebius", model_moebius(), visit);
	visit_and_finish("doubled", model_doubled(false), visit);
	visit_and_finish("doubled, turned", model_doubled(true), visit);
	visit_and_finish("dense soup", model_soup(40, 3000), visit);
	visit_and_finish("sparse soup", model_soup(1000000, 5000), visit);
	visit_and_finish("tangled soup", model_soup(700, 200000), visit);
	visit_and_finish("grid", model_grid(300), visit);
	visit_and_finish("sphere", model_sphere(8), visit);
	visit_files(folder, visit);
}

void models_visit_extremes(void (*visit)(const char *name, const struct model *model))
{
	static const struct {
		float scale, offset;
	} cases[] = {{1e-30f, 0}, {1e-38f, 0}, {1e-44f, 0}, {1e30f, 0}, {1e38f, 0}, {1, 1e4f},
		{1, 1e6f}, {1, 1e8f}, {1e30f, -2e38f}, {1e-30f, 1e-28f}};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct model model = model_sphere(4);
		for (size_t v = 0; v < model.vertex_count; v++)
			for (int c = 0; c < 3; c++)
				model.positions[v][c] =
					cases[i].scale * model.positions[v][c] + cases[i].offset;
		visit("sphere", &model);
		model_finish(&model);
	}
}

uint32_t random_next(uint64_t *state)
{
	/* xorshift64* (Vigna 2016, "An experimental exploration of Marsaglia's xorshift
	 * generators, scrambled") */
	*state ^= *state >> 12;
	*state ^= *state << 25;
	*state ^= *state >> 27;
	return (uint32_t)(*state * UINT64_C(2685821657736338717) >> 32);
}

float random_signed(uint64_t *state)
{
	return (float)(random_next(state) >> 8) * 0x1p-23f - 1.0f;
}
