/* SPDX-License-Identifier: MIT */
#include "geom/mesh.h"
#include "base/array.h"
#include "base/error.h"
#include "geom/solid.h"
#include <math.h>
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>

/* Corner numbers of a mesh without normals must fit an index, and meshoptimizer keeps the last
 * value for itself. */
#define VERTICES_MAX (UINT32_MAX - 1)
#define TRIANGLES_MAX INT32_MAX

static bool is_finite(const float *values, size_t count)
{
	for (size_t i = 0; i < count; i++)
		if (!isfinite(values[i]))
			return false;
	return true;
}

static const char *name_of(const char *name)
{
	return name != NULL ? name : "(unnamed)";
}

static bool check_counts(const struct sm_mesh_desc *desc, const char *name, struct sm_error *error)
{
	if (desc->index_count == 0)
		return error_set(error, SM_ERROR_INPUT, "mesh %s: no triangle", name);
	if (desc->index_count % 3 != 0)
		return error_set(error, SM_ERROR_INPUT, "mesh %s: %zu indices, not a multiple of 3",
			name, desc->index_count);
	if (desc->index_count / 3 > TRIANGLES_MAX)
		return error_set(error, SM_ERROR_INPUT, "mesh %s: %zu triangles, above %d", name,
			desc->index_count / 3, TRIANGLES_MAX);
	if (desc->vertex_count > VERTICES_MAX)
		return error_set(error, SM_ERROR_INPUT, "mesh %s: %zu vertices, above %u", name,
			desc->vertex_count, VERTICES_MAX);
	if (desc->normals == NULL && desc->index_count > VERTICES_MAX)
		return error_set(error, SM_ERROR_INPUT,
			"mesh %s: %zu corners without normals, above %u", name, desc->index_count,
			VERTICES_MAX);
	return true;
}

static bool check_positions(
	const float *positions, size_t count, const char *name, struct sm_error *error)
{
	for (size_t v = 0; v < count; v++)
		if (!is_finite(&positions[3 * v], 3))
			return error_set(error, SM_ERROR_INPUT,
				"mesh %s: the position of vertex %zu is not finite", name, v);
	return true;
}

static bool check_desc(const struct sm_mesh_desc *desc, struct sm_error *error)
{
	const char *name = name_of(desc->name);
	if (!check_counts(desc, name, error))
		return false;
	for (size_t i = 0; i < desc->index_count; i++)
		if (desc->indices[i] >= desc->vertex_count)
			return error_set(error, SM_ERROR_INPUT,
				"mesh %s: index %zu is %u, but there are %zu vertices", name, i,
				desc->indices[i], desc->vertex_count);
	return check_positions(desc->positions, desc->vertex_count, name, error);
}

/* False, and v unchanged, when it has no direction. */
static bool normalise(double v[3])
{
	double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
	if (!(length > 0.0) || !isfinite(length))
		return false;
	for (int i = 0; i < 3; i++)
		v[i] /= length;
	return true;
}

/* Whether that changes *out. -0 + 0 = 0: equal values become equal bits, which merging looks at. */
static bool store(float *out, const float *in, int count)
{
	bool changed = false;
	for (int i = 0; i < count; i++) {
		float value = in[i] + 0.0f;
		changed = changed || out[i] != value;
		out[i] = value;
	}
	return changed;
}

/* Into a unit normal, +z for what has no direction; whether that changes it. */
static bool store_normal(double v[3], float normal[3])
{
	float unit[3] = {0.0f, 0.0f, 1.0f};
	if (normalise(v))
		for (int i = 0; i < 3; i++)
			unit[i] = (float)v[i];
	return store(normal, unit, 3);
}

/* Adds the triangle's unit normal, nothing for one without area. */
static void add_face_normal(const struct mesh *mesh, size_t triangle, double sum[3])
{
	const uint32_t *v = &mesh->indices[3 * triangle];
	double normal[3];
	face_normal(mesh->positions[v[0]], mesh->positions[v[1]], mesh->positions[v[2]], normal);
	if (!normalise(normal))
		return;
	for (int i = 0; i < 3; i++)
		sum[i] += normal[i];
}

/* The unit normal that is given for a drawn vertex; false: there is none, or no direction. given:
 * of the description's vertices, or NULL. */
static bool given_normal(
	const struct mesh *mesh, size_t vertex, const float *given, double normal[3])
{
	if (given == NULL)
		return false;
	for (int i = 0; i < 3; i++)
		normal[i] = given[3 * (size_t)mesh->sources[vertex] + (size_t)i];
	return normalise(normal);
}

/* Room for what find_normals() sums up: *sums stays NULL where every normal is given. */
static bool reserve_sums(const struct mesh *mesh, const float *given, double (**sums)[3])
{
	double normal[3];
	*sums = NULL;
	for (size_t v = 0; v < mesh->vertex_count; v++) {
		if (given_normal(mesh, v, given, normal))
			continue;
		*sums = array_zalloc(mesh->vertex_count, sizeof(**sums));
		return *sums != NULL;
	}
	return true;
}

/* Those that are given, and else the mean of the triangles around; whether that changes any. */
static bool find_normals(struct mesh *mesh, const float *given, double (*sums)[3])
{
	bool changed = false;
	double normal[3];
	for (size_t i = 0; sums != NULL && i < mesh->index_count; i++)
		add_face_normal(mesh, i / 3, sums[mesh->indices[i]]);
	for (size_t v = 0; v < mesh->vertex_count; v++) {
		double *found = given_normal(mesh, v, given, normal) ? normal : sums[v];
		changed = store_normal(found, mesh->normals[v]) || changed;
	}
	return changed;
}

static bool reserve_vertices(struct mesh *mesh, size_t vertex_count, size_t index_count)
{
	mesh->vertex_count = vertex_count;
	mesh->index_count = index_count;
	mesh->positions = array_zalloc(vertex_count, sizeof(*mesh->positions));
	mesh->normals = array_zalloc(vertex_count, sizeof(*mesh->normals));
	mesh->uvs = array_zalloc(vertex_count, sizeof(*mesh->uvs));
	mesh->sources = array_alloc(vertex_count, sizeof(*mesh->sources));
	mesh->indices = array_alloc(index_count, sizeof(*mesh->indices));
	return mesh->positions != NULL && mesh->normals != NULL && mesh->uvs != NULL &&
	       mesh->sources != NULL && mesh->indices != NULL;
}

static void copy_vertex(
	struct mesh *mesh, size_t vertex, const struct sm_mesh_desc *desc, size_t source)
{
	mesh->sources[vertex] = (uint32_t)source;
	store(mesh->positions[vertex], &desc->positions[3 * source], 3);
	if (desc->uvs != NULL && is_finite(&desc->uvs[2 * source], 2))
		store(mesh->uvs[vertex], &desc->uvs[2 * source], 2);
}

/* Without normals each corner becomes a vertex, with its triangle's. */
static bool copy_desc(struct mesh *mesh, const struct sm_mesh_desc *desc)
{
	bool flat = desc->normals == NULL;
	size_t vertex_count = flat ? desc->index_count : desc->vertex_count;
	double(*sums)[3];
	mesh->source_count = desc->vertex_count;
	if (!reserve_vertices(mesh, vertex_count, desc->index_count))
		return false;
	for (size_t v = 0; v < vertex_count; v++)
		copy_vertex(mesh, v, desc, flat ? desc->indices[v] : v);
	for (size_t i = 0; i < desc->index_count; i++)
		mesh->indices[i] = flat ? (uint32_t)i : desc->indices[i];
	if (!reserve_sums(mesh, desc->normals, &sums))
		return false;
	find_normals(mesh, desc->normals, sums);
	free(sums);
	return true;
}

static void move_vertices(struct mesh *mesh, size_t new_count, const uint32_t *remap)
{
	size_t count = mesh->vertex_count;
	meshopt_remapIndexBuffer(mesh->indices, mesh->indices, mesh->index_count, remap);
	meshopt_remapVertexBuffer(
		mesh->positions, mesh->positions, count, sizeof(*mesh->positions), remap);
	meshopt_remapVertexBuffer(
		mesh->normals, mesh->normals, count, sizeof(*mesh->normals), remap);
	meshopt_remapVertexBuffer(mesh->uvs, mesh->uvs, count, sizeof(*mesh->uvs), remap);
	meshopt_remapVertexBuffer(
		mesh->sources, mesh->sources, count, sizeof(*mesh->sources), remap);
	mesh->vertex_count = new_count;
}

/* Leaves out triangles between fewer than three vertices, so that what is found of a mesh, such as
 * how deep its parts lie, is the same without them; none, if there are no others. */
static void drop_empty_triangles(struct mesh *mesh)
{
	size_t kept = 0;
	for (size_t i = 0; i < mesh->index_count; i += 3) {
		const uint32_t *v = &mesh->indices[i];
		if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
			continue;
		memmove(&mesh->indices[kept], v, 3 * sizeof(*v));
		kept += 3;
	}
	if (kept == 0)
		return;
	mesh->empty_count = (mesh->index_count - kept) / 3;
	mesh->index_count = kept;
}

/* Merges identical vertices, drops unused ones and orders what is left for the GPU. */
static bool optimise(struct mesh *mesh)
{
	uint32_t *remap = array_alloc(mesh->vertex_count, sizeof(*remap));
	if (remap == NULL)
		return false;
	const struct meshopt_Stream streams[] = {
		{mesh->positions, sizeof(*mesh->positions), sizeof(*mesh->positions)},
		{mesh->normals, sizeof(*mesh->normals), sizeof(*mesh->normals)},
		{mesh->uvs, sizeof(*mesh->uvs), sizeof(*mesh->uvs)},
	};
	size_t count = meshopt_generateVertexRemapMulti(
		remap, mesh->indices, mesh->index_count, mesh->vertex_count, streams, 3);
	move_vertices(mesh, count, remap);

	drop_empty_triangles(mesh);
	meshopt_optimizeVertexCache(
		mesh->indices, mesh->indices, mesh->index_count, mesh->vertex_count);
	count = meshopt_optimizeVertexFetchRemap(
		remap, mesh->indices, mesh->index_count, mesh->vertex_count);
	move_vertices(mesh, count, remap);
	free(remap);
	mesh->positions = array_trim(mesh->positions, count, sizeof(*mesh->positions));
	mesh->normals = array_trim(mesh->normals, count, sizeof(*mesh->normals));
	mesh->uvs = array_trim(mesh->uvs, count, sizeof(*mesh->uvs));
	mesh->sources = array_trim(mesh->sources, count, sizeof(*mesh->sources));
	mesh->indices = array_trim(mesh->indices, mesh->index_count, sizeof(*mesh->indices));
	return true;
}

static void grow_box(const float point[3], float min[3], float max[3])
{
	for (int i = 0; i < 3; i++) {
		min[i] = fminf(min[i], point[i]);
		max[i] = fmaxf(max[i], point[i]);
	}
}

static void find_box(struct mesh *mesh)
{
	memcpy(mesh->min, mesh->positions[0], sizeof(mesh->min));
	memcpy(mesh->max, mesh->positions[0], sizeof(mesh->max));
	for (size_t v = 1; v < mesh->vertex_count; v++)
		grow_box(mesh->positions[v], mesh->min, mesh->max);
}

void mesh_box_of(const struct mesh *mesh, const float *positions, float min[3], float max[3])
{
	memcpy(min, &positions[3 * (size_t)mesh->sources[0]], 3 * sizeof(*min));
	memcpy(max, min, 3 * sizeof(*max));
	for (size_t v = 1; v < mesh->vertex_count; v++)
		grow_box(&positions[3 * (size_t)mesh->sources[v]], min, max);
}

static void count_up(struct mesh *mesh)
{
	const struct caster *caster = &mesh->caster;
	mesh->stats = (struct sm_mesh_stats){
		.triangles = mesh->index_count / 3 + mesh->empty_count,
		.repeated_triangles = caster->found.repeated,
		.degenerate_triangles = caster->planes.degenerate + mesh->empty_count,
		.vertices = mesh->vertex_count,
		.welded_vertices = caster->vertex_count,
		.edges = caster->found.edges.edges,
		.open_edges = caster->found.edges.open,
		.non_manifold_edges = caster->found.edges.non_manifold,
		.inverted_edges = caster->found.edges.inverted,
		.closed_parts = caster->found.closed_parts,
		.open_parts = caster->found.open_parts,
		.turned_triangles = caster->found.turned,
		.edge_bytes = edge_table_bytes(&caster->edges),
		.plane_bytes =
			face_planes_bytes(&caster->planes) + face_cones_bytes(&caster->cones),
	};
}

bool mesh_init(struct mesh *mesh, const struct sm_mesh_desc *desc, struct sm_error *error)
{
	*mesh = (struct mesh){0};
	if (!check_desc(desc, error))
		return false;
	if (desc->name != NULL) {
		mesh->name = array_copy(desc->name, strlen(desc->name) + 1, 1);
		if (mesh->name == NULL)
			goto no_memory;
	}
	if (!copy_desc(mesh, desc))
		goto no_memory;
	if (!optimise(mesh))
		goto no_memory;
	find_box(mesh);
	if (!caster_init(&mesh->caster, (const float(*)[3])mesh->positions, mesh->vertex_count,
		    mesh->indices, mesh->index_count / 3))
		goto no_memory;
	mesh->solid = caster_is_solid(&mesh->caster);
	count_up(mesh);
	return true;
no_memory:
	mesh_finish(mesh);
	return error_no_memory(error);
}

bool mesh_set_vertices(struct mesh *mesh, const float *positions, const float *normals,
	bool *changed, struct sm_error *error)
{
	double(*sums)[3];
	*changed = false;
	if (!check_positions(positions, mesh->source_count, name_of(mesh->name), error))
		return false;
	if (!caster_let_move(&mesh->caster) || !reserve_sums(mesh, normals, &sums))
		return error_no_memory(error);
	bool moved = false;
	for (size_t v = 0; v < mesh->vertex_count; v++) {
		const float *position = &positions[3 * (size_t)mesh->sources[v]];
		moved = store(mesh->positions[v], position, 3) || moved;
	}
	/* Whether it hides its back shows in no picture but by rounding; yet what a picture shows
	 * is not to depend on whether the vertices were elsewhere meanwhile. */
	*changed = find_normals(mesh, normals, sums) || moved || mesh->solid;
	mesh->solid = false;
	free(sums);
	if (!moved)
		return true;
	find_box(mesh);
	caster_move(&mesh->caster, (const float(*)[3])mesh->positions);
	mesh->stats.degenerate_triangles = mesh->caster.planes.degenerate + mesh->empty_count;
	return true;
}

void mesh_finish(struct mesh *mesh)
{
	free(mesh->name);
	free(mesh->positions);
	free(mesh->normals);
	free(mesh->uvs);
	free(mesh->sources);
	free(mesh->indices);
	caster_finish(&mesh->caster);
	*mesh = (struct mesh){0};
}
