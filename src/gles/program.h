/* SPDX-License-Identifier: MIT */
#ifndef GLES_PROGRAM_H
#define GLES_PROGRAM_H

#include "gles/program_binary.h"

/* Every uniform any program has; a program lacks those its variant does not use. */
/* clang-format off */
#define UNIFORMS(X) \
	X(object_to_clip) X(object_to_light) X(normal_to_light) X(up) \
	X(base_color) X(base_texture) X(ambient_sky) X(ambient_ground) \
	X(light_is_point) X(light_color) X(light_reach) X(light_cone) \
	X(screen_w) X(screen_scale) X(screen_depth) X(map_size) X(lookup_reach) X(bias_limit) \
	X(depth_compare) X(depth_map) X(receiver_map) X(smoothie_map) X(smoothie_words) \
	X(smoothie_depth) X(fin_law) X(fin_quads) X(both_sides) X(fin_map) X(spread) X(apron) \
	X(falloff) X(near_to_far) X(pole) X(quarter_turns) X(screen_max) \
	X(disc_points) X(disc_count) X(disc_scale) X(depth_layers) X(plain_layers) \
	X(moment_map) X(blur_radius) X(min_variance) X(probe_value) \
	X(primitives) X(pixel_size) X(pole_depth) X(map_texels) X(visibility_map) X(visibility_depth) \
	X(point_map) X(cell_map) X(cell_scale) X(cell_depth) \
	X(edge_tiles) X(edge_runs) X(edge_map) X(hollow_base) X(front_layer) X(second_layer) X(third_layer) X(layer_count) X(disc_masks) X(tile_count) \
	X(disc_facing) X(casts) X(snap) X(raster_snap) X(depth_noise)
/* clang-format on */

/** A linked program and where its uniforms are: -1 (which GL ignores) for absent ones. */
struct program {
	struct program_key key;
	GLuint name;
	struct {
#define UNIFORM_MEMBER(name) GLint name;
		UNIFORMS(UNIFORM_MEMBER)
#undef UNIFORM_MEMBER
	} uniform;
};

struct program_cache {
	struct program **programs; /* owned, each on its own so that pointers stay */
	size_t count, capacity;
	struct program_binaries binaries;
	uint32_t compiled, loaded; /* programs, by where they came from */
};

/** The program of that variant, made on first use and put in use; owned by the cache. NULL on
 *  failure (MACHINE), with the driver's log and the numbered source in the log. */
const struct program *program_use(
	struct program_cache *cache, struct gl *gl, struct program_key key, struct sm_error *error);
/** Fine on a zeroed cache. */
void program_cache_finish(struct program_cache *cache, struct gl *gl);

#endif
