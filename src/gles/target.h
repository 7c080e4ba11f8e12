/* SPDX-License-Identifier: MIT */
#ifndef GLES_TARGET_H
#define GLES_TARGET_H

#include "geom/screen_box.h"
#include "gles/gl.h"

/** A square texture, or layers of such, and the framebuffer that draws into it alone. */
struct target {
	GLenum attachment;
	GLuint texture, framebuffer;
	GLsizei size;                 /* texels a side */
	bool whole;                   /* and not half-made */
	struct shared_target *shared; /* NULL: it is its own */
};

/** Nearest filtering, clamped to the edge. attachment:
 * GL_COLOR_ATTACHMENT0 or GL_DEPTH_ATTACHMENT. Leaves the target bound as framebuffer, and the
 * texture at unit 0. On failure (MACHINE) finish() is still to be called. */
bool target_init(struct target *target, struct gl *gl, enum storage_owner owner, GLsizei size,
	GLenum internal_format, GLenum attachment, struct sm_error *error);
/** The same, as the one that others have made for this owner, of this size and format: for what is
 *  drawn and read before anyone else draws. It serves no light alone, and goes with the last of
 *  those who have it. On failure it is as before. */
bool target_init_shared(struct target *target, struct gl *gl, enum storage_owner owner,
	GLsizei size, GLenum internal_format, GLenum attachment, struct sm_error *error);
/** The same as init() with an array of layers; the first of them is bound. */
bool target_init_layers(struct target *target, struct gl *gl, enum storage_owner owner,
	GLsizei size, GLsizei layers, GLenum internal_format, GLenum attachment,
	struct sm_error *error);
/** A texture, for the caller to delete, that reads what is in the target, whose texture is no
 * array, in another format of as many bits: as EXT_texture_view has it. 0: there is none. */
GLuint target_create_view(const struct target *target, struct gl *gl, enum storage_owner owner,
	GLenum internal_format);
/** Of the processor's memory, what sharing takes. */
size_t targets_shared_bytes(const struct gl *gl);
/** Fine on a half-made or zeroed target. */
void target_finish(struct target *target, struct gl *gl);

/** Binds framebuffer and viewport. */
void target_bind(const struct target *target, struct gl *gl);

/** The same, of one that has layers. */
void target_bind_layer(const struct target *target, struct gl *gl, GLint layer);

/** Texels of a target: left, bottom, width, height. */
struct target_area {
	GLint x, y;
	GLsizei width, height;
};

/** All but the outermost texels: while they stay as they are cleared, look-ups beside the texture,
 *  which are clamped to them, find nothing. */
struct target_area target_inside(const struct target *target);

/** The texels inside that a part of the screen may touch, wherever the rasteriser snaps what is in
 *  it; none: width and height are 0. */
struct target_area target_part(const struct target *target, const struct screen_box *part);

/** The part of the screen that what is drawn into those texels touches. */
struct screen_box target_part_reach(const struct target *target, const struct screen_box *part);

/** Restricts clearing to target_part(); where the part is all, to nothing. */
void target_restrict_clear(
	const struct target *target, const struct screen_box *part, struct gl *gl);

/** Restricts clearing and drawing until the scissor test is disabled. */
void target_restrict(struct target_area area, struct gl *gl);

#endif
