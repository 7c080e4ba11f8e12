/* SPDX-License-Identifier: MIT */
#include "gles/primitives.h"
#include <assert.h>

/* As in exact_raster.vert. */
#define ROW 128

#define TEXEL_BYTES 16

void primitives_finish(struct primitives *primitives, struct gl *gl)
{
	gl_delete_texture(gl, &primitives->texture);
	gl_delete_vertex_array(gl, &primitives->array);
	*primitives = (struct primitives){0};
}

static void make_texture(
	struct primitives *primitives, struct gl *gl, GLsizei width, GLsizei height)
{
	primitives_finish(primitives, gl);
	primitives->array = gl_create_vertex_array(gl);
	primitives->texture = gl_create_texture(gl, STORAGE_PRIMITIVES);
	primitives->width = width;
	primitives->height = height;
	gl_store_texture(gl, primitives->texture, GL_RGBA32I, width, height);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

/* Room for half as many again, so that growing scenes do not make it anew each frame. */
static GLsizei rows_for(size_t count)
{
	size_t rows = (count + ROW - 1) / ROW, more = rows + rows / 2;
	return (GLsizei)(more < PRIMITIVES_MAX / ROW ? more : PRIMITIVES_MAX / ROW);
}

void primitives_upload(struct primitives *primitives, struct gpu *gpu, const void *items,
	size_t count, size_t size)
{
	struct gl *gl = &gpu->gl;
	assert(size % TEXEL_BYTES == 0);
	if (count > PRIMITIVES_MAX)
		count = PRIMITIVES_MAX;
	if (count == 0) {
		primitives->count = 0;
		return;
	}
	GLsizei texels = (GLsizei)(size / TEXEL_BYTES), whole = (GLsizei)(count / ROW);
	GLsizei rest = (GLsizei)(count % ROW);
	gl->ActiveTexture(GL_TEXTURE0 + UNIT_PRIMITIVES);
	if (primitives->width != texels * ROW || primitives->height < whole + (rest > 0))
		make_texture(primitives, gl, texels * ROW, rows_for(count));
	primitives->count = count;
	gl->BindTexture(GL_TEXTURE_2D, primitives->texture);
	if (whole > 0)
		gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, primitives->width, whole, GL_RGBA_INTEGER,
			GL_INT, items);
	if (rest > 0)
		gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, whole, rest * texels, 1, GL_RGBA_INTEGER,
			GL_INT, (const char *)items + (size_t)whole * ROW * size);
	gpu->stats.uploaded_bytes += count * size;
}

bool primitives_draw(const struct primitives *primitives, struct gpu *gpu,
	const struct program *program, GLsizei width, GLsizei height, struct sm_error *error)
{
	if (primitives->count == 0)
		return true;
	gpu_bind_texture(gpu, UNIT_PRIMITIVES, primitives->texture);
	gpu->gl.Uniform2f(program->uniform.pixel_size, 2.0f / (float)width, 2.0f / (float)height);
	gpu->gl.BindVertexArray(primitives->array);
	return gpu_draw_quads(gpu, primitives->count, error);
}
