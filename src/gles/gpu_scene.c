/* SPDX-License-Identifier: MIT */
#include "gles/gpu_scene.h"
#include "base/array.h"
#include "geom/averted.h"
#include <stdlib.h>
#include <string.h>

static void attribute(
	struct gl *gl, enum attribute location, GLint size, size_t stride, size_t offset)
{
	gl->EnableVertexAttribArray(location);
	gl->VertexAttribPointer(
		location, size, GL_FLOAT, GL_FALSE, (GLsizei)stride, (const void *)offset);
}

/* The buffer's storage is a new one, so that a frame that is still being drawn keeps the old. */
static void upload_vertices(struct gl *gl, GLuint buffer, const void *data, size_t bytes,
	GLenum usage, uint64_t *uploaded)
{
	gl_fill_buffer(gl, GL_ARRAY_BUFFER, buffer, bytes, data, usage);
	*uploaded += bytes;
}

/* 16-bit indices halve what the vertex stage reads; a mesh with more vertices needs 32. */
static bool upload_indices(struct gl *gl, GLuint buffer, const uint32_t *indices, size_t count,
	size_t vertex_count, GLenum *type, uint64_t *uploaded)
{
	if (vertex_count > UINT16_MAX) {
		size_t bytes = count * sizeof(uint32_t);
		*type = GL_UNSIGNED_INT;
		gl_fill_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, buffer, bytes, indices, GL_STATIC_DRAW);
		*uploaded += bytes;
		return true;
	}
	uint16_t *narrow = array_alloc(count, sizeof(*narrow));
	if (narrow == NULL)
		return false;
	for (size_t i = 0; i < count; i++)
		narrow[i] = (uint16_t)indices[i];
	size_t bytes = count * sizeof(*narrow);
	*type = GL_UNSIGNED_SHORT;
	gl_fill_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, buffer, bytes, narrow, GL_STATIC_DRAW);
	*uploaded += bytes;
	free(narrow);
	return true;
}

/* vertices: [vertex_count] */
static void interleave(const struct mesh *mesh, struct surface_vertex *vertices)
{
	for (size_t i = 0; i < mesh->vertex_count; i++) {
		memcpy(vertices[i].position, mesh->positions[i], sizeof(vertices[i].position));
		memcpy(vertices[i].normal, mesh->normals[i], sizeof(vertices[i].normal));
		memcpy(vertices[i].uv, mesh->uvs[i], sizeof(vertices[i].uv));
	}
}

static bool upload_surface(
	struct gpu_mesh *gpu, struct gl *gl, const struct mesh *mesh, uint64_t *uploaded)
{
	struct surface_vertex *vertices = array_alloc(mesh->vertex_count, sizeof(*vertices));
	if (vertices == NULL)
		return false;
	interleave(mesh, vertices);
	gpu->surface = gl_create_vertex_array(gl);
	gpu->surface_vertices = gl_create_buffer(gl, STORAGE_SURFACES);
	gpu->surface_indices = gl_create_buffer(gl, STORAGE_SURFACES);
	gl->BindVertexArray(gpu->surface);
	upload_vertices(gl, gpu->surface_vertices, vertices, mesh->vertex_count * sizeof(*vertices),
		GL_STATIC_DRAW, uploaded);
	free(vertices);
	size_t stride = sizeof(struct surface_vertex);
	attribute(gl, ATTRIBUTE_POSITION, 3, stride, offsetof(struct surface_vertex, position));
	attribute(gl, ATTRIBUTE_NORMAL, 3, stride, offsetof(struct surface_vertex, normal));
	attribute(gl, ATTRIBUTE_UV, 2, stride, offsetof(struct surface_vertex, uv));
	gpu->surface_count = (GLsizei)mesh->index_count;
	return upload_indices(gl, gpu->surface_indices, mesh->indices, mesh->index_count,
		mesh->vertex_count, &gpu->surface_type, uploaded);
}

static bool upload_caster(
	struct gpu_mesh *gpu, struct gl *gl, const struct caster *caster, uint64_t *uploaded)
{
	gpu->caster = gl_create_vertex_array(gl);
	gpu->caster_vertices = gl_create_buffer(gl, STORAGE_CASTERS);
	gpu->caster_indices = gl_create_buffer(gl, STORAGE_CASTERS);
	gl->BindVertexArray(gpu->caster);
	upload_vertices(gl, gpu->caster_vertices, caster->positions,
		caster->vertex_count * sizeof(*caster->positions), GL_STATIC_DRAW, uploaded);
	attribute(gl, ATTRIBUTE_POSITION, 3, sizeof(*caster->positions), 0);
	size_t count = caster->triangle_count * 3;
	gpu->caster_count = (GLsizei)count;
	return upload_indices(gl, gpu->caster_indices, caster->indices, count, caster->vertex_count,
		&gpu->caster_type, uploaded);
}

static void find_clusters(struct gpu_mesh *gpu, const struct mesh *mesh)
{
	const float(*positions)[3] = (const float(*)[3])mesh->positions;
	clusters_find(positions, mesh->indices, mesh->index_count / 3, gpu->clusters);
	averted_rises(positions, (const float(*)[3])mesh->normals, mesh->vertex_count,
		mesh->indices, mesh->index_count / 3, gpu->rises);
}

static bool make_clusters(struct gpu_mesh *gpu, const struct mesh *mesh)
{
	gpu->cluster_count = clusters_count(mesh->index_count / 3);
	gpu->vertex_count = mesh->vertex_count;
	gpu->clusters = array_alloc(gpu->cluster_count, sizeof(*gpu->clusters));
	gpu->rises = array_alloc(mesh->vertex_count, sizeof(*gpu->rises));
	if (gpu->clusters == NULL || gpu->rises == NULL)
		return false;
	find_clusters(gpu, mesh);
	return true;
}

static void mesh_delete(struct gpu_mesh *gpu, struct gl *gl)
{
	gl_delete_vertex_array(gl, &gpu->surface);
	gl_delete_buffer(gl, &gpu->surface_vertices);
	gl_delete_buffer(gl, &gpu->surface_indices);
	gl_delete_vertex_array(gl, &gpu->caster);
	gl_delete_buffer(gl, &gpu->caster_vertices);
	gl_delete_buffer(gl, &gpu->caster_indices);
	free(gpu->clusters);
	free(gpu->rises);
}

static bool fail_full(const struct mesh *mesh, struct sm_error *error)
{
	return error_set(error, SM_ERROR_MACHINE, "mesh %s: not enough memory for the GPU",
		mesh->name != NULL ? mesh->name : "without a name");
}

static bool mesh_upload(struct gpu_mesh *gpu, struct gl *gl, const struct mesh *mesh,
	uint64_t *uploaded, struct sm_error *error)
{
	if (mesh->index_count > INT32_MAX || mesh->caster.triangle_count > INT32_MAX / 3)
		return error_set(error, SM_ERROR_INPUT, "mesh %s: too large for one GL draw call",
			mesh->name != NULL ? mesh->name : "without a name");
	*gpu = (struct gpu_mesh){.version = mesh->version};
	bool done = upload_surface(gpu, gl, mesh, uploaded) &&
		    upload_caster(gpu, gl, &mesh->caster, uploaded) && make_clusters(gpu, mesh);
	gl->BindVertexArray(0);
	if (done && gl_take_error(gl) == NULL)
		return true;
	mesh_delete(gpu, gl);
	return fail_full(mesh, error);
}

/* The vertices, where they have moved. */
static bool mesh_update(struct gpu_scene *scene, struct gpu_mesh *gpu, struct gl *gl,
	const struct mesh *mesh, uint64_t *uploaded, struct sm_error *error)
{
	if (gpu->version == mesh->version)
		return true;
	if (!array_reserve((void **)&scene->vertices, &scene->vertex_capacity, mesh->vertex_count,
		    sizeof(*scene->vertices)))
		return error_no_memory(error);
	interleave(mesh, scene->vertices);
	upload_vertices(gl, gpu->surface_vertices, scene->vertices,
		mesh->vertex_count * sizeof(*scene->vertices), GL_STREAM_DRAW, uploaded);
	const struct caster *caster = &mesh->caster;
	upload_vertices(gl, gpu->caster_vertices, caster->positions,
		caster->vertex_count * sizeof(*caster->positions), GL_STREAM_DRAW, uploaded);
	if (gl_take_error(gl) != NULL)
		return fail_full(mesh, error);
	find_clusters(gpu, mesh);
	gpu->version = mesh->version;
	return true;
}

static bool image_upload(GLuint *texture, struct gl *gl, const struct image *image,
	uint64_t *uploaded, struct sm_error *error)
{
	static const struct texel_format as = {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE};
	*texture = gl_create_texture(gl, STORAGE_IMAGES);
	gl->ActiveTexture(GL_TEXTURE0);
	gl_fill_levels(
		gl, *texture, &as, (GLsizei)image->width, (GLsizei)image->height, image->rgba);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
	*uploaded += (uint64_t)image->width * image->height * 4;
	const char *problem = gl_take_error(gl);
	if (problem == NULL)
		return true;
	gl_delete_texture(gl, texture);
	return error_set(error, SM_ERROR_MACHINE, "no texture for an image of %ux%u texels: %s",
		image->width, image->height, problem);
}

bool gpu_scene_update(struct gpu_scene *gpu, struct gl *gl, const struct sm_scene *scene,
	uint64_t *uploaded, struct sm_error *error)
{
	if (gpu->scene_id != scene->id) {
		gpu_scene_finish(gpu, gl);
		gpu->scene_id = scene->id;
	}
	for (size_t i = 0; i < gpu->mesh_count; i++)
		if (!mesh_update(gpu, &gpu->meshes[i], gl, &scene->meshes[i], uploaded, error))
			return false;
	if (gpu->mesh_count == scene->mesh_count && gpu->image_count == scene->image_count)
		return true;
	if (!array_reserve((void **)&gpu->meshes, &gpu->mesh_capacity, scene->mesh_count,
		    sizeof(*gpu->meshes)) ||
		!array_reserve((void **)&gpu->images, &gpu->image_capacity, scene->image_count,
			sizeof(*gpu->images)))
		return error_no_memory(error);
	gl_take_error(gl);
	for (; gpu->mesh_count < scene->mesh_count; gpu->mesh_count++)
		if (!mesh_upload(&gpu->meshes[gpu->mesh_count], gl, &scene->meshes[gpu->mesh_count],
			    uploaded, error))
			return false;
	for (; gpu->image_count < scene->image_count; gpu->image_count++)
		if (!image_upload(&gpu->images[gpu->image_count], gl,
			    &scene->images[gpu->image_count], uploaded, error))
			return false;
	return true;
}

void gpu_scene_finish(struct gpu_scene *gpu, struct gl *gl)
{
	for (size_t i = 0; i < gpu->mesh_count; i++)
		mesh_delete(&gpu->meshes[i], gl);
	for (size_t i = 0; i < gpu->image_count; i++)
		gl_delete_texture(gl, &gpu->images[i]);
	free(gpu->meshes);
	free(gpu->images);
	free(gpu->vertices);
	*gpu = (struct gpu_scene){0};
}
