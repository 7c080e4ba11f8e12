/* SPDX-License-Identifier: MIT */
#include "gles/raster_grid.h"
#include "gles/target.h"

/* Texels a side of what is drawn. */
#define SIDE 32
/* The texel in whose middle left edges are tried. */
#define TRIED (SIDE / 2)
/* Each number of bits below the most is tried on both sides of the middle. */
#define ROWS (2 * (RASTER_BITS_MAX - 1))

#define ROW_VERTICES 6

/* A corner of row i: texels from the lower left become clip coordinates, without rounding. */
static void put(GLfloat corner[3], float x, int row)
{
	corner[0] = x * (2.0f / SIDE) - 1.0f;
	corner[1] = (float)row * (2.0f / SIDE) - 1.0f;
	corner[2] = 0.0f;
}

/* From three eighths of a step right of the middle, or left of it, to the right border. With that
 * grid, or a coarser one, both edges are moved to the middle, which then is in both rows or in
 * neither; without it, in the left one alone. */
static void fill_rows(GLfloat corners[ROWS * ROW_VERTICES][3])
{
	for (int row = 0; row < ROWS; row++) {
		float off = 0.375f / (float)(2 << (row / 2));
		float left = TRIED + 0.5f + (row % 2 == 0 ? off : -off);
		GLfloat(*corner)[3] = &corners[row * ROW_VERTICES];
		put(corner[0], left, row);
		put(corner[1], SIDE, row);
		put(corner[2], SIDE, row + 1);
		put(corner[3], left, row);
		put(corner[4], SIDE, row + 1);
		put(corner[5], left, row + 1);
	}
}

static bool draw_rows(struct gpu *gpu)
{
	static const GLuint none[4] = {0, 0, 0, 0};
	static const GLfloat identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
	struct gl *gl = &gpu->gl;
	GLfloat corners[ROWS * ROW_VERTICES][3];
	struct program_key key = {PROGRAM_LAYER, 0};
	const struct program *program = program_use(&gpu->programs, gl, key, NULL);
	if (program == NULL)
		return false;
	GLuint array = gl_create_vertex_array(gl), buffer = gl_create_buffer(gl, STORAGE_PROBES);
	fill_rows(corners);
	gl->BindVertexArray(array);
	gl_fill_buffer(gl, GL_ARRAY_BUFFER, buffer, sizeof(corners), corners, GL_STREAM_DRAW);
	gl->EnableVertexAttribArray(ATTRIBUTE_POSITION);
	gl->VertexAttribPointer(ATTRIBUTE_POSITION, 3, GL_FLOAT, GL_FALSE, 0, NULL);
	gl->Disable(GL_DEPTH_TEST);
	gl->ClearBufferuiv(GL_COLOR, 0, none);
	gl->UniformMatrix4fv(program->uniform.object_to_clip, 1, GL_FALSE, identity);
	gl->DrawArrays(GL_TRIANGLES, 0, ROWS * ROW_VERTICES);
	gl->BindVertexArray(0);
	gl->BindBuffer(GL_ARRAY_BUFFER, 0);
	gl_delete_vertex_array(gl, &array);
	gl_delete_buffer(gl, &buffer);
	return true;
}

static uint32_t read_bits(struct gl *gl)
{
	GLuint texels[ROWS][4] = {{0}};
	uint32_t bits = 1;
	gl->ReadPixels(TRIED, 0, 1, ROWS, GL_RGBA_INTEGER, GL_UNSIGNED_INT, texels);
	while (bits < RASTER_BITS_MAX) {
		bool right = texels[2 * bits - 2][0] != 0, left = texels[2 * bits - 1][0] != 0;
		if (right == left)
			break;
		bits++;
	}
	return bits;
}

/* What the driver says, where nothing can be drawn to find out. */
static uint32_t promised_bits(struct gl *gl)
{
	GLint bits = 0;
	gl->GetIntegerv(GL_SUBPIXEL_BITS, &bits);
	return bits < 1 ? 1 : bits > RASTER_BITS_MAX ? RASTER_BITS_MAX : (uint32_t)bits;
}

uint32_t raster_grid_bits(struct gpu *gpu)
{
	struct gl *gl = &gpu->gl;
	struct target target = {0};
	GLint drawn, read, viewport[4];
	if (gpu->raster_bits != 0)
		return gpu->raster_bits;
	gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawn);
	gl->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
	gl->GetIntegerv(GL_VIEWPORT, viewport);
	bool made = target_init(
		&target, gl, STORAGE_PROBES, SIDE, GL_RG32UI, GL_COLOR_ATTACHMENT0, NULL);
	if (made)
		target_bind(&target, gl);
	gpu->raster_bits = made && draw_rows(gpu) ? read_bits(gl) : promised_bits(gl);
	target_finish(&target, gl);
	gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)drawn);
	gl->BindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)read);
	gl->Viewport(viewport[0], viewport[1], viewport[2], viewport[3]);
	return gpu->raster_bits;
}
