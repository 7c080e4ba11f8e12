/* SPDX-License-Identifier: MIT */
#ifndef GLES_GL_H
#define GLES_GL_H

#include "gles/storage.h"

/* Extension tokens, from the Khronos registry; Debian's gl2ext.h wants gl2.h before it. */
#define GL_TEXTURE_SRGB_DECODE_EXT 0x8A48
#define GL_SKIP_DECODE_EXT 0x8A4A
#define GL_DEBUG_OUTPUT_KHR 0x92E0
#define GL_DEBUG_OUTPUT_SYNCHRONOUS_KHR 0x8242
#define GL_DEBUG_TYPE_ERROR_KHR 0x824C
#define GL_DEBUG_TYPE_PERFORMANCE_KHR 0x8250
#define GL_DEBUG_SEVERITY_HIGH_KHR 0x9146
#define GL_DEBUG_SOURCE_APPLICATION_KHR 0x824A

/* Of OpenGL ES 3.1. */
#define GL_READ_ONLY 0x88B8
#define GL_MAX_FRAGMENT_IMAGE_UNIFORMS 0x90CE

typedef void(GL_APIENTRY *gl_debug_callback)(GLenum source, GLenum type, GLuint id, GLenum severity,
	GLsizei length, const GLchar *message, const void *data);
typedef void(GL_APIENTRY *gl_debug_message_callback)(gl_debug_callback callback, const void *data);
typedef void(GL_APIENTRY *gl_push_debug_group)(
	GLenum source, GLuint id, GLsizei length, const GLchar *message);
typedef void(GL_APIENTRY *gl_pop_debug_group)(void);
typedef void(GL_APIENTRY *gl_bind_image_texture)(GLuint unit, GLuint texture, GLint level,
	GLboolean layered, GLint layer, GLenum access, GLenum format);
typedef void(GL_APIENTRY *gl_texture_view)(GLuint texture, GLenum target, GLuint of,
	GLenum internal_format, GLuint first_level, GLuint levels, GLuint first_layer,
	GLuint layers);

/* clang-format off */
#define GL_FUNCTIONS(X) \
	X(ACTIVETEXTURE, ActiveTexture) \
	X(ATTACHSHADER, AttachShader) \
	X(BINDATTRIBLOCATION, BindAttribLocation) \
	X(BINDBUFFER, BindBuffer) \
	X(BINDBUFFERBASE, BindBufferBase) \
	X(BINDBUFFERRANGE, BindBufferRange) \
	X(BINDFRAMEBUFFER, BindFramebuffer) \
	X(BINDSAMPLER, BindSampler) \
	X(BINDTEXTURE, BindTexture) \
	X(BINDVERTEXARRAY, BindVertexArray) \
	X(BLENDEQUATION, BlendEquation) \
	X(BLENDFUNC, BlendFunc) \
	X(BUFFERDATA, BufferData) \
	X(BUFFERSUBDATA, BufferSubData) \
	X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus) \
	X(CLEARBUFFERFV, ClearBufferfv) \
	X(CLEARBUFFERIV, ClearBufferiv) \
	X(CLEARBUFFERUIV, ClearBufferuiv) \
	X(CLIENTWAITSYNC, ClientWaitSync) \
	X(COMPILESHADER, CompileShader) \
	X(CREATEPROGRAM, CreateProgram) \
	X(CREATESHADER, CreateShader) \
	X(DELETEBUFFERS, DeleteBuffers) \
	X(DELETEFRAMEBUFFERS, DeleteFramebuffers) \
	X(DELETEPROGRAM, DeleteProgram) \
	X(DELETESAMPLERS, DeleteSamplers) \
	X(DELETESHADER, DeleteShader) \
	X(DELETESYNC, DeleteSync) \
	X(DELETETEXTURES, DeleteTextures) \
	X(DELETEVERTEXARRAYS, DeleteVertexArrays) \
	X(DEPTHFUNC, DepthFunc) \
	X(DEPTHMASK, DepthMask) \
	X(DEPTHRANGEF, DepthRangef) \
	X(DISABLE, Disable) \
	X(DRAWARRAYS, DrawArrays) \
	X(DRAWBUFFERS, DrawBuffers) \
	X(DRAWELEMENTS, DrawElements) \
	X(ENABLE, Enable) \
	X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray) \
	X(FENCESYNC, FenceSync) \
	X(FINISH, Finish) \
	X(FLUSH, Flush) \
	X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D) \
	X(FRAMEBUFFERTEXTURELAYER, FramebufferTextureLayer) \
	X(FRONTFACE, FrontFace) \
	X(GENBUFFERS, GenBuffers) \
	X(GENERATEMIPMAP, GenerateMipmap) \
	X(GENFRAMEBUFFERS, GenFramebuffers) \
	X(GENSAMPLERS, GenSamplers) \
	X(GENTEXTURES, GenTextures) \
	X(GENVERTEXARRAYS, GenVertexArrays) \
	X(GETERROR, GetError) \
	X(GETFRAMEBUFFERATTACHMENTPARAMETERIV, GetFramebufferAttachmentParameteriv) \
	X(GETINTEGERV, GetIntegerv) \
	X(GETPROGRAMBINARY, GetProgramBinary) \
	X(GETPROGRAMINFOLOG, GetProgramInfoLog) \
	X(GETPROGRAMIV, GetProgramiv) \
	X(GETSHADERINFOLOG, GetShaderInfoLog) \
	X(GETSHADERIV, GetShaderiv) \
	X(GETSTRING, GetString) \
	X(GETSTRINGI, GetStringi) \
	X(GETUNIFORMLOCATION, GetUniformLocation) \
	X(LINKPROGRAM, LinkProgram) \
	X(PROGRAMBINARY, ProgramBinary) \
	X(PROGRAMPARAMETERI, ProgramParameteri) \
	X(READBUFFER, ReadBuffer) \
	X(READPIXELS, ReadPixels) \
	X(SAMPLERPARAMETERI, SamplerParameteri) \
	X(SCISSOR, Scissor) \
	X(SHADERSOURCE, ShaderSource) \
	X(TEXIMAGE2D, TexImage2D) \
	X(TEXPARAMETERI, TexParameteri) \
	X(TEXSTORAGE2D, TexStorage2D) \
	X(TEXSTORAGE3D, TexStorage3D) \
	X(TEXSUBIMAGE2D, TexSubImage2D) \
	X(UNIFORM1F, Uniform1f) \
	X(UNIFORM1I, Uniform1i) \
	X(UNIFORM1UI, Uniform1ui) \
	X(UNIFORM2F, Uniform2f) \
	X(UNIFORM2FV, Uniform2fv) \
	X(UNIFORM3F, Uniform3f) \
	X(UNIFORM4F, Uniform4f) \
	X(UNIFORMMATRIX3FV, UniformMatrix3fv) \
	X(UNIFORMMATRIX4FV, UniformMatrix4fv) \
	X(USEPROGRAM, UseProgram) \
	X(VERTEXATTRIBPOINTER, VertexAttribPointer) \
	X(VIEWPORT, Viewport)
/* clang-format on */

/** The GL entry points of one context, and what was made through them. */
struct gl {
#define GL_MEMBER(upper, name) PFNGL##upper##PROC name;
	GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
	gl_debug_message_callback DebugMessageCallback; /* the next three: NULL without KHR_debug */
	gl_push_debug_group PushDebugGroup;
	gl_pop_debug_group PopDebugGroup;
	gl_texture_view TextureView;            /* NULL without EXT_texture_view */
	gl_bind_image_texture BindImageTexture; /* of OpenGL ES 3.1: before, anything */
	int objects;                            /* made and not yet deleted */
	struct sm_pass_observer observer;
	const char *group; /* that is open; NULL: none */
	struct storages storages;
	uint32_t light;       /* that textures and buffers are made for; SM_NONE: none alone */
	bool finishes_passes; /* that were begun, before what follows them */
	bool has_passes;      /* begun and not finished since */
	struct shared_target *shared_targets; /* of target.h, a list; owned by those who use them */
};

/** Resolves the ES 3.0 functions; fails (MACHINE) naming the first that is missing. */
bool gl_load(struct gl *gl, sm_get_proc get_proc, struct sm_error *error);

/** Resolves KHR_debug's functions under the names OpenGL ES gives them, and has the log receive
 *  its messages. Call only when the extension string is there. */
void gl_load_debug(struct gl *gl, sm_get_proc get_proc);

/** Resolves EXT_texture_view's function. Call only when the extension string is there. */
void gl_load_texture_view(struct gl *gl, sm_get_proc get_proc);

/** Bracket a pass, for debuggers (KHR_debug) and the observer. Passes do not nest. */
void gl_push_group(struct gl *gl, const char *name);
void gl_pop_group(struct gl *gl);

/** Before a pass binds the textures that it draws into: finishes what was drawn before, where the
 *  driver would wait for it in the midst of the pass. */
void gl_begin_pass(struct gl *gl);

/** Before what such passes were drawn for: finishes them, likewise. */
void gl_finish_passes(struct gl *gl);

/* Objects are counted, so that a leak is noticed when the renderer goes. Deleting 0 is fine, and
 * sets *name to 0. Textures and buffers are 0 without memory, and GL then refuses to fill them. */
GLuint gl_create_buffer(struct gl *gl, enum storage_owner owner);
void gl_delete_buffer(struct gl *gl, GLuint *name);
GLuint gl_create_vertex_array(struct gl *gl);
void gl_delete_vertex_array(struct gl *gl, GLuint *name);
GLuint gl_create_texture(struct gl *gl, enum storage_owner owner);
void gl_delete_texture(struct gl *gl, GLuint *name);
GLuint gl_create_sampler(struct gl *gl);
void gl_delete_sampler(struct gl *gl, GLuint *name);
GLuint gl_create_framebuffer(struct gl *gl);
void gl_delete_framebuffer(struct gl *gl, GLuint *name);
GLuint gl_create_program(struct gl *gl);
void gl_delete_program(struct gl *gl, GLuint *name);
/** After all commands so far. NULL if the driver makes none. */
GLsync gl_create_fence(struct gl *gl);
void gl_delete_fence(struct gl *gl, GLsync *fence);

/* What gives textures and buffers their memory is counted, and goes through these alone. All bind
 * what they fill; textures at the unit that is active. */

/** How texels are stored, and how they come. */
struct texel_format {
	GLenum internal, format, type;
};

void gl_fill_buffer(
	struct gl *gl, GLenum target, GLuint buffer, size_t bytes, const void *data, GLenum usage);
void gl_store_texture(
	struct gl *gl, GLuint texture, GLenum internal_format, GLsizei width, GLsizei height);
void gl_store_layers(
	struct gl *gl, GLuint texture, GLenum internal_format, GLsizei size, GLsizei layers);
/** texels: NULL for any. */
void gl_fill_texture(struct gl *gl, GLuint texture, const struct texel_format *as, GLsizei width,
	GLsizei height, const void *texels);
/** The same, with all smaller levels. */
void gl_fill_levels(struct gl *gl, GLuint texture, const struct texel_format *as, GLsizei width,
	GLsizei height, const void *texels);

/** Whether the framebuffer, which is bound under this name, encodes what is written as sRGB. */
bool gl_framebuffer_is_srgb(struct gl *gl, uint32_t framebuffer);

/** The oldest error since the last call, named, or NULL; the others are forgotten. */
const char *gl_take_error(struct gl *gl);

#endif
