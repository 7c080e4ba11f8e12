/* SPDX-License-Identifier: MIT */
/**
 * smoothie: soft shadows on OpenGL ES 3.
 *
 * A scene is plain data and needs no GL. A renderer lives in the GL context that is current when
 * it is created, and draws scenes into framebuffers that the caller owns.
 *
 *	scene    = sm_scene_create();
 *	           sm_scene_add_mesh(), sm_scene_add_object(), sm_scene_add_light() ...
 *	renderer = sm_renderer_create(get_proc, &error);
 *	           sm_renderer_draw(renderer, scene, &view, &error);
 *
 * Conventions
 * - Lengths are in the scene's own unit, angles in degrees, colours linear with Rec. 709 primaries.
 * - Space is right-handed; matrices are column-major and multiply column vectors (p' = M p).
 * - A triangle faces the side from which its corners are seen counter-clockwise.
 * - Handles (mesh, image, object, light) are indices counted from 0 in the order of creation.
 * - A function that can fail returns false and fills *error; error may be NULL.
 * - Nothing here is thread-safe for one scene or one renderer; different ones are independent.
 */
#ifndef SMOOTHIE_H
#define SMOOTHIE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define SM_API __attribute__((visibility("default")))
#else
#define SM_API
#endif

/** No image, no light: an absent handle. */
#define SM_NONE UINT32_MAX

/** What went wrong; the values are the exit statuses of the program. */
enum sm_status {
	SM_OK = 0,
	SM_ERROR_MACHINE = 1, /**< out of memory, driver, disk: the same input may work elsewhere */
	SM_ERROR_INPUT = 2,   /**< what the caller gave cannot be used anywhere */
};

/** One line for a person, without a newline: place, cause, what to do. */
struct sm_error {
	enum sm_status status;
	char text[600];
};

/* ---------------------------------------------------------------------------------------------
 * Scene
 */

struct sm_scene;

/** An empty scene, or NULL when out of memory. Destroy with sm_scene_destroy(). */
SM_API struct sm_scene *sm_scene_create(void);
/** Frees the scene and all it holds; NULL is fine. Renderers that drew it must not draw it again,
 *  but may be destroyed later. */
SM_API void sm_scene_destroy(struct sm_scene *scene);

/** Triangles as plain arrays; copied, so the caller may free them afterwards. */
struct sm_mesh_desc {
	const char *name;       /**< for error messages; may be NULL */
	const float *positions; /**< [vertex_count][3], finite */
	const float *normals;   /**< [vertex_count][3]; NULL: flat, from the triangles */
	const float *uvs;       /**< [vertex_count][2], (0,0) = first texel; may be NULL */
	size_t vertex_count;
	const uint32_t *indices; /**< [index_count], each < vertex_count */
	size_t index_count;      /**< a multiple of 3, below 3 * 2^31 */
};

/** Adds a mesh: vertices are welded by position, edges packed. Fails (INPUT) on an index out of
 *  range, a vertex that is not finite, or no triangle. */
SM_API bool sm_scene_add_mesh(struct sm_scene *scene, const struct sm_mesh_desc *desc,
	uint32_t *mesh, struct sm_error *error);

/**
 * Moves the vertices of a mesh, of all objects that have it.
 *
 * positions: [vertex_count][3], finite, of the vertices that sm_mesh_desc had. normals: likewise;
 * NULL, or one without direction: the mean of the triangles around. Indices and uvs stay, and so
 * does what was welded: vertices that coincided in position cast their shadow as one, at the place
 * of one of them, and those that were the same in normal and uv, too, are drawn as one. Linear
 * time. Fails (INPUT) on an unknown mesh, a position that is not finite or an object that would
 * reach farther than floats do; nothing changes then.
 */
SM_API bool sm_scene_set_vertices(struct sm_scene *scene, uint32_t mesh, const float *positions,
	const float *normals, struct sm_error *error);

/** Facts about one mesh after welding. */
struct sm_mesh_stats {
	size_t triangles;
	size_t repeated_triangles;   /**< between the same vertices as another: cast no shadow */
	size_t degenerate_triangles; /**< of the others; no area: they face nowhere */
	size_t vertices;             /**< as given, identical ones merged */
	size_t welded_vertices;      /**< distinct positions */
	size_t edges;      /**< distinct pairs of welded vertices joined by a triangle side */
	size_t open_edges; /**< with one triangle */
	size_t non_manifold_edges; /**< with more than two */
	size_t inverted_edges;     /**< with two triangles that run through it the same way */
	/** A part hangs together over edges with two triangles. A closed one, without a rim, casts
	 *  its shadow as a solid, an open one as a sheet, from either side. */
	size_t closed_parts, open_parts;
	size_t turned_triangles; /**< as they cast shadows: each part is wound one way */
	size_t edge_bytes;       /**< packed edge table */
	size_t plane_bytes;      /**< face planes and cones for the facing test */
};

SM_API void sm_scene_get_mesh_stats(
	const struct sm_scene *scene, uint32_t mesh, struct sm_mesh_stats *stats);

/** Adds an sRGB picture, width x height texels of R,G,B,A bytes, rows from v = 0; copied.
 *  Fails (INPUT) on a size of 0 or above 16384. */
SM_API bool sm_scene_add_image(struct sm_scene *scene, uint32_t width, uint32_t height,
	const uint8_t *rgba, uint32_t *image, struct sm_error *error);

struct sm_object_desc {
	const char *name; /**< may be NULL */
	uint32_t mesh;
	float transform[16]; /**< object to world, column-major, affine, finite, as is the result */
	float base_color[4]; /**< linear; alpha is not used */
	uint32_t image;      /**< multiplies base_color; SM_NONE for none */
	bool casts, receives; /**< shadows */
	bool single_sided;    /**< its back is not seen; its shadow is the same */
};

SM_API bool sm_scene_add_object(struct sm_scene *scene, const struct sm_object_desc *desc,
	uint32_t *object, struct sm_error *error);
/** transform: as in sm_object_desc. */
SM_API bool sm_scene_set_transform(
	struct sm_scene *scene, uint32_t object, const float transform[16], struct sm_error *error);

enum sm_light_type {
	SM_LIGHT_SPOT,        /**< a cone from position towards target */
	SM_LIGHT_DIRECTIONAL, /**< parallel, along position -> target; covers the whole scene */
};

struct sm_light_desc {
	const char *name; /**< may be NULL */
	enum sm_light_type type;
	float position[3];
	float target[3]; /**< differs from position */
	float radius;    /**< of the luminous disc at position, >= 0; 0: a point */
	float angle;     /**< spot: full angle of the cone, (0, 170] degrees */
	float softness;  /**< spot: share of the cone's half angle over which light fades, [0, 1] */
	float color[3];  /**< linear, >= 0 */
	float intensity; /**< illuminance at target; 1 shows a white surface that faces the
			      light as white. Spots fall off with the distance squared. */
};

SM_API bool sm_scene_add_light(struct sm_scene *scene, const struct sm_light_desc *desc,
	uint32_t *light, struct sm_error *error);
SM_API bool sm_scene_set_light(struct sm_scene *scene, uint32_t light,
	const struct sm_light_desc *desc, struct sm_error *error);

/** Light that comes from everywhere, and what is seen where there is nothing. Linear. */
struct sm_environment {
	float sky[3];    /**< ambient light from +y */
	float ground[3]; /**< ambient light from -y */
	float background[3];
};

SM_API void sm_scene_set_environment(
	struct sm_scene *scene, const struct sm_environment *environment);

SM_API uint32_t sm_scene_mesh_count(const struct sm_scene *scene);
SM_API uint32_t sm_scene_object_count(const struct sm_scene *scene);
SM_API uint32_t sm_scene_light_count(const struct sm_scene *scene);

/** World-space box around all objects, or around the casters alone; false if there are none. */
SM_API bool sm_scene_get_bounds(
	const struct sm_scene *scene, bool casters_only, float min[3], float max[3]);

/* ---------------------------------------------------------------------------------------------
 * Renderer
 */

struct sm_renderer;

/** Looks a GL function up by name, as eglGetProcAddress does. */
typedef void (*(*sm_get_proc)(const char *name))(void);

/** A renderer in the current context, which must be OpenGL ES 3.0 or later; the context must be
 *  current whenever the renderer is used or destroyed. */
SM_API struct sm_renderer *sm_renderer_create(sm_get_proc get_proc, struct sm_error *error);

/** What of the driver a renderer uses. Zero: all of it, each need met in the best way. */
struct sm_driver_options {
	/** "-NAME,+NAME...": caps taken away, and given back where the driver has them, in order;
	 *  names as sm_renderer_describe() lists them. NULL: none. */
	const char *caps;
	/** [path_count] "NEED=WAY" each: a need met in that way and no other. Of paths of one need
	 *  the last counts. */
	const char *const *paths;
	size_t path_count;
};

/** As sm_renderer_create(). Fails (INPUT) on an unknown cap, need or way, (MACHINE) where the
 *  driver lacks what a way takes. That is found out by drawing, so that with paths state is
 * expected and left as by sm_renderer_describe(). A way of a need that the technique or precision
 * does not have changes nothing. Nothing of *options is kept. */
SM_API struct sm_renderer *sm_renderer_create_with(
	sm_get_proc get_proc, const struct sm_driver_options *options, struct sm_error *error);
/** What techniques need of a driver and get in one of several ways; NULL past the last. */
SM_API const char *sm_need_name(size_t index);
/** The ways of a need, best first; NULL past the last, or when `need` is past the last need. */
SM_API const char *sm_way_name(size_t need, size_t index);
/** Frees every GL object the renderer made; NULL is fine. */
SM_API void sm_renderer_destroy(struct sm_renderer *renderer);

/**
 * Where the caller keeps compiled programs, so that a later renderer on the same driver need not
 * compile them. Entries are bytes under a name of 32 hexadecimal digits. Each tells the driver and
 * the sources that it is of, and is checked: a store may lose, cut, mix up or damage them.
 * The functions are called within sm_renderer_draw() and sm_renderer_copy_to_screen().
 */
struct sm_program_store {
	void *data; /**< the caller's, handed to both functions */
	/** Returns the size of an entry, or 0 when there is none, and writes it to `bytes` if that
	 *  is no more than `capacity`. NULL: nothing is loaded. */
	size_t (*load)(void *data, const char *name, void *bytes, size_t capacity);
	/** Keeps an entry, in the place of one of that name; it may fail to. NULL: nothing is
	 *  saved. */
	void (*save)(void *data, const char *name, const void *bytes, size_t size);
};

/** Sets the store for programs that are made from now on; NULL, the default, for none. *store is
 *  copied; its data must live until another store is set or the renderer is destroyed. Where the
 *  driver has no program binaries, the store is not used. */
SM_API void sm_renderer_set_program_store(
	struct sm_renderer *renderer, const struct sm_program_store *store);

enum sm_falloff {
	SM_FALLOFF_DEFAULT,
	SM_FALLOFF_LINEAR,
	/** smoothie: (1 - cos(pi a)) / 2, from a table (Chan & Durand 2003, section 4);
	 *  penumbra-map: 3 a^2 - 2 a^3 */
	SM_FALLOFF_SINUSOID,
};

/** In which arithmetic shadows are computed, pixel by pixel. */
enum sm_precision {
	SM_PRECISION_DEFAULT,
	SM_PRECISION_FLOAT, /**< the GL's floats, rounded as the driver does it */
	/** Integers alone, so that every driver draws the same bits: each step rounded to 16-bit
	 *  floats (IEEE 754 binary16). */
	SM_PRECISION_HALF,
	/** Likewise, to 12-bit fixed point, s1.10: steps of 1/1024 in [-2, 2). */
	SM_PRECISION_FIXED12,
};

/** For which pixels of a picture the technique finds the light's visibility. */
enum sm_sampling {
	SM_SAMPLING_DEFAULT, /**< whichever costs less, for each light and frame */
	SM_SAMPLING_DENSE,   /**< each */
	/** One of four by four, and those between them where a surface's edge is, or a penumbra too
	 *  narrow for that; else it is interpolated. */
	SM_SAMPLING_SPARSE,
	/** Each, once it is known which surface is seen there. Dense with drivers that do not
	 *  read depths. */
	SM_SAMPLING_DEFERRED,
	/** As sparse, once it is known which surface is seen at each pixel. Sparse with drivers
	 *  that do not read depths. */
	SM_SAMPLING_DEFERRED_SPARSE,
};

/** Pixels of the picture and texels of the map a side, at most, in half and fixed12: what they
 *  compute stays within 32 bits. */
#define SM_EXACT_SIZE_MAX 2047

/** How shadows are made. Zero in a field means the default. A field that the technique does not
 *  use must stay zero: setting it is an error. */
struct sm_shadow_options {
	/** A name of sm_technique_name(). NULL: the first that uses every field that is not zero,
	 * of width, falloff, passes, precision and sampling: "auto" if all but the last are, else
	 *  "smoothie". */
	const char *technique;
	uint32_t map_size; /**< texels a side of the shadow map, 1 to the driver's limit; up to 2
				show no shadow, since border texels stay clear, but with
				"gather", which looks up no more than what casts itself, and
				uses a power of two up to 512; default 1024 */
	float width;       /**< smoothie: t of the paper, the fins' width as a share of the
				light's screen, (0, 1]; default: from the light's radius */
	enum sm_falloff falloff; /**< smoothie, penumbra-map: default linear */
	uint32_t samples; /**< one of sm_technique_samples(): how many look-ups or shadow maps
			       a pixel takes, or vsm: the blur's width in texels; default the
			       first of them */
	uint32_t passes;  /**< smoothie: 2 fills the smoothie buffer in two passes, nearest
			       depth and then minimum alpha, as the paper does; default 1 */
	/** Default float. half and fixed12: smoothie alone, always in two passes; map and picture
	 *  have at most SM_EXACT_SIZE_MAX texels a side. */
	enum sm_precision precision;
	enum sm_sampling sampling; /**< gather and auto: default whichever costs less */
};

SM_API bool sm_renderer_set_shadows(struct sm_renderer *renderer,
	const struct sm_shadow_options *options, struct sm_error *error);

/** The technique's name and one line about it, or NULL when index is past the last one. */
SM_API const char *sm_technique_name(size_t index);
SM_API const char *sm_technique_summary(size_t index);
/** What sm_shadow_options.samples may be with the technique, the default first; 0 past the last
 *  choice, or when index is past the last technique. */
SM_API uint32_t sm_technique_samples(size_t index, size_t choice);
/** "float", "half" and "fixed12" for 0 to 2, the enum less 1; NULL past the last. */
SM_API const char *sm_precision_name(size_t index);

struct sm_camera {
	float eye[3];
	float target[3]; /**< differs from eye */
	float up[3];     /**< not parallel to the view */
	float fov;       /**< vertical, (0, 179) degrees */
	float near, far; /**< 0 < near < far; both 0: from the scene's bounds */
};

/** What to draw, and where to. */
struct sm_view {
	struct sm_camera camera;
	uint32_t framebuffer;   /**< GL name, complete, with colour and depth; 0: the context's own.
				     Written as sRGB whether or not its format is sRGB. */
	uint32_t width, height; /**< viewport, from (0, 0) of the framebuffer */
	/** A light, or SM_NONE for the picture. The share of that light that reaches the nearest
	 *  surface, v in [0, 1], is written instead of a picture: R = high byte, G = low byte of
	 *  round(65535 v), B = 0, A = 1; 65535 where there is no surface. Needs a framebuffer that
	 *  is not sRGB, with 8 bits a channel and one sample. */
	uint32_t visibility_of;
	/** Whether the picture is the same whatever was drawn before. If not, what is chosen frame
	 * by frame ("auto", SM_SAMPLING_DEFAULT) stays as it was until another choice is clearly
	 * better, so that what wavers does not flicker. */
	bool alone;
};

/** Draws shadows and frame. Expects GL's state at its defaults, but for the viewport and what is
 *  bound as program, framebuffer, vertex array, array buffer and 2D textures; leaves at the
 *  defaults what it changed, also when it fails, but for framebuffer and viewport, which are the
 *  view's, and the scissor box. */
SM_API bool sm_renderer_draw(struct sm_renderer *renderer, const struct sm_scene *scene,
	const struct sm_view *view, struct sm_error *error);

/** Whether the last sm_renderer_draw() drew just what it would draw now, so that there is no need
 * to, nor to show it again: it succeeded, with this scene, which has not changed since, and this
 * view, and with the same shadows. Takes no call of GL. That what it drew is still in the
 * framebuffer is for the caller to know. Always false while the skip "frame" is off. */
SM_API bool sm_renderer_is_current(
	struct sm_renderer *renderer, const struct sm_scene *scene, const struct sm_view *view);

/** A finished picture, and the screen that is to show it. */
struct sm_screen {
	uint32_t texture;       /**< GL name, complete, GL_SRGB8_ALPHA8, of width x height texels */
	uint32_t width, height; /**< of the picture */
	uint32_t framebuffer;   /**< GL name, complete, not sRGB; 0: the context's own. As large as
				     the picture, turned: height x width for 90 and 270 degrees. */
	uint32_t rotation;      /**< degrees clockwise by which the screen shows the picture turned:
				     0, 90, 180 or 270 */
	uint8_t bits[3];        /**< of R, G and B in the framebuffer: 5,6,5; 8,8,8 or 10,10,10 */
};

/** Copies a picture to a screen, pixel by pixel: its very bytes to channels of 8 bits, the nearest
 *  values to 10, and to fewer by ordered dithering, the same each time. State is expected and left
 *  as by sm_renderer_draw(), with the screen's framebuffer and viewport. Fails (INPUT) on another
 *  rotation, other bits, no texture, an sRGB framebuffer, or a size that the driver does not draw;
 *  (MACHINE) when the driver fails. */
SM_API bool sm_renderer_copy_to_screen(
	struct sm_renderer *renderer, const struct sm_screen *screen, struct sm_error *error);

/** What the last sm_renderer_draw() did: what it skipped does not count. */
struct sm_frame_stats {
	uint32_t draw_calls;
	uint32_t lights;           /**< shown with shadows */
	uint32_t hard_lights;      /**< of these: by "auto", as "hard" */
	uint32_t sparse_lights;    /**< of these: _SPARSE or _DEFERRED_SPARSE */
	uint32_t deferred_lights;  /**< likewise, _DEFERRED or _DEFERRED_SPARSE */
	uint64_t triangles;        /**< submitted, all passes */
	uint64_t silhouette_edges; /**< all lights whose silhouettes were looked for */
	uint64_t edges_left_out;   /**< by "gather": an edge counts for each part of the light's
				      screen whose list had no room for it, nearer edges first */
	uint64_t fin_vertices;
	uint64_t fins_left_out; /**< of the silhouette edges: nowhere wider than half a texel, so
				     that they have none */
	uint64_t fin_bytes; /**< uploaded for fins, whose silhouettes may be of a frame before */
	uint64_t uploaded_bytes; /**< for everything */
	double silhouette_ms; /**< processor time for silhouettes and fins; with another precision
				   than float, for all polygons */
	/** Since the renderer was created, also for screens: programs compiled from source, and
	 *  loaded from the store instead. */
	uint32_t programs_compiled, programs_loaded;
};

SM_API void sm_renderer_get_stats(const struct sm_renderer *renderer, struct sm_frame_stats *stats);

/** What a renderer does not do again, or not at all, where every pixel is the same without it: the
 *  name and one line about it, or NULL when index is past the last one. */
SM_API const char *sm_skip_name(size_t index);
SM_API const char *sm_skip_summary(size_t index);

/** "-NAME,+NAME...": skips turned off, and on again, in order; "all" is each of them. All are on to
 *  begin with. Fails (INPUT) on an unknown name, and then changes nothing. */
SM_API bool sm_renderer_set_skips(
	struct sm_renderer *renderer, const char *skips, struct sm_error *error);

/** How many threads, the calling one among them, search meshes of 200,000 triangles and more for
 * the silhouettes of fins: up to 8; 0, as it is to begin with, for one a processor. With two or
 * more, `gather` finds edges on another while the calling one draws, where that takes long. They
 * start when first there is work for them, and sleep between. The picture is the same with any
 * number. */
SM_API void sm_renderer_set_threads(struct sm_renderer *renderer, uint32_t count);

/** Since the renderer was created. While a skip is off nothing is counted. */
struct sm_skip_stats {
	uint64_t tested;
	uint64_t skipped; /**< of these: left out, or kept as it was */
	uint64_t redrawn; /**< the others: done, or done again */
};

/** Those of the skip of that index, which is one of sm_skip_name(). */
SM_API void sm_renderer_get_skip_stats(
	const struct sm_renderer *renderer, size_t index, struct sm_skip_stats *stats);

/** Is told where passes begin and end, in their order, during sm_renderer_draw(): "shadow map",
 *  "silhouettes" or "surfaces", say. A pass ends with the framebuffer still bound that it drew to.
 *  The functions may wait for GL and read from that framebuffer; they must not change GL's state.
 */
struct sm_pass_observer {
	void *data; /**< the caller's, handed to both functions */
	void (*begin)(void *data, const char *pass);
	void (*end)(void *data, const char *pass);
};

/** *observer is copied; NULL, the default, for none. */
SM_API void sm_renderer_set_pass_observer(
	struct sm_renderer *renderer, const struct sm_pass_observer *observer);

/** Bytes that are in use, now. */
struct sm_memory {
	uint64_t processor; /**< all that renderer and scene have allocated */
	uint64_t geometry;  /**< of those: casters as silhouettes are searched in them, and what is
				 kept of them for lights */
	uint64_t gl;      /**< all textures and buffers of the renderer, their texels 4 bytes where
			       GL has depths of 24 bits; what the driver adds is not known */
	uint64_t targets; /**< of those: what the renderer draws into, on the way */
};

SM_API void sm_renderer_get_memory(
	const struct sm_renderer *renderer, const struct sm_scene *scene, struct sm_memory *memory);

enum sm_memory_kind { SM_MEMORY_PROCESSOR, SM_MEMORY_GL };

/** What one owner has of it. */
struct sm_memory_part {
	enum sm_memory_kind kind;
	const char *owner; /**< "shadow maps", say; static */
	uint32_t light; /**< that it serves alone, counted among those of the last view; SM_NONE: it
			     serves all, or none */
	uint64_t bytes; /**< above 0 */
};

/** Tells all parts of sm_memory.processor and sm_memory.gl, in a fixed order; an owner may come
 *  more than once. */
typedef void (*sm_memory_sink)(void *data, const struct sm_memory_part *part);
SM_API void sm_renderer_list_memory(const struct sm_renderer *renderer,
	const struct sm_scene *scene, sm_memory_sink sink, void *data);

/** Facts about driver and chosen paths as key and value, in a fixed order. Caps that nothing drawn
 *  so far took are found out by drawing: state is expected and left as by sm_renderer_draw(), with
 *  framebuffer and viewport as they were. */
typedef void (*sm_fact)(void *data, const char *key, const char *value);
SM_API void sm_renderer_describe(struct sm_renderer *renderer, sm_fact fact, void *data);

/* ---------------------------------------------------------------------------------------------
 * Model
 */

/**
 * The share of a light that reaches each pixel, computed without GL, on the processor: what a
 * driver that makes no mistake draws for sm_view.visibility_of. With SM_PRECISION_HALF and
 * SM_PRECISION_FIXED12 it is bit for bit what every driver must draw; with SM_PRECISION_FLOAT it is
 * what they draw but for rounding.
 *
 * view: framebuffer is not used; visibility_of is a light. values: [height][width], steps of
 * 1/65535, rows from the top. Fails (INPUT) as sm_renderer_set_shadows() and sm_renderer_draw() do,
 * (MACHINE) without memory.
 */
SM_API bool sm_model_visibility(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, uint16_t *values, struct sm_error *error);

/** The same, in float, of a driver that moves the corners of triangles to multiples of 2^-bits of a
 *  pixel, 1 to 8, and interpolates from there, as GL_SUBPIXEL_BITS allows. Others let a grid, of 8
 *  bits here, only decide which pixels a triangle covers, as "gather" does by itself on one below 6
 *  bits. Fails (INPUT) also with other precisions, which have a grid of their own. */
SM_API bool sm_model_visibility_snapped(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, uint32_t bits, uint16_t *values,
	struct sm_error *error);

/* ---------------------------------------------------------------------------------------------
 * Log
 */

enum sm_log_level { SM_LOG_ERROR, SM_LOG_WARNING, SM_LOG_INFO, SM_LOG_DEBUG };
typedef void (*sm_log)(void *data, enum sm_log_level level, const char *line);

/** Where the library's messages go, for the whole process; NULL silences them, as does not calling
 *  this. */
SM_API void sm_set_log(sm_log log, void *data);

/** "MAJOR.MINOR.PATCH" */
SM_API const char *sm_version(void);

#ifdef __cplusplus
}
#endif

#endif
