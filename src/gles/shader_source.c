/* SPDX-License-Identifier: MIT */
#include "gles/shader_source.h"
#include "geom/fin.h"
#include <assert.h>
#include <stdio.h>
#include <string.h>

static const struct {
	uint64_t flag;
	const char *name, *define;
} flag_names[] = {
#define FLAG(name)                                        \
	{                                                 \
		FLAG_##name, #name, "#define " #name "\n" \
	}
	FLAG(SINUSOID),
	FLAG(DEPTH_ONLY),
	FLAG(RECEIVER_MAP),
	FLAG(LIT),
	FLAG(SHADOWED),
	FLAG(HARD),
	FLAG(SMOOTHIE),
	FLAG(SEPARATE_DEPTH),
	FLAG(GATHER),
	FLAG(TEXTURED),
	FLAG(VISIBILITY),
	FLAG(ENCODE_SRGB),
	FLAG(DITHER),
	FLAG(WIDEN),
	FLAG(STORED),
	FLAG(TWO_SIDED),
	FLAG(CONE),
	FLAG(BICUBIC),
	FLAG(PCSS),
	FLAG(MAPS),
	FLAG(VSM),
	FLAG(FOUR_FETCHES),
	FLAG(FROM_DEPTH),
	FLAG(ALPHA_DEPTH),
	FLAG(FETCH),
	FLAG(DEPTH_FLOAT),
	FLAG(DEPTH_HALF),
	FLAG(DEPTH_PACKED),
	FLAG(SPLIT),
	FLAG(FIXED12),
	FLAG(SEEN),
	FLAG(EDGES),
	FLAG(PEEL),
	FLAG(POINTS),
	FLAG(CELLS),
	FLAG(RUNS),
	FLAG(RECEIVERS),
	FLAG(FOUND),
	FLAG(COARSE),
	FLAG(BEHIND),
	FLAG(WORDS),
	FLAG(TWO_LAYERS),
	FLAG(HOLLOWS),
	FLAG(SAMPLES),
	FLAG(FLAT_INPUTS),
	FLAG(FUSED),
	FLAG(IMAGES),
#undef FLAG
};

#define FLAG_COUNT (sizeof(flag_names) / sizeof(flag_names[0]))

/* Each a way to make shadows. */
/* clang-format off */
#define SHADOW_FLAGS \
	(FLAG_HARD | FLAG_SMOOTHIE | FLAG_TWO_SIDED | \
	FLAG_BICUBIC | FLAG_PCSS | FLAG_MAPS | FLAG_VSM | FLAG_SEEN | \
	FLAG_EDGES | FLAG_FOUND)
/* clang-format on */

/* Those that look up four texels apart; or that compare at four, blended. */
#define TAP_FLAGS (FLAG_SMOOTHIE | FLAG_TWO_SIDED | FLAG_BICUBIC)
#define COMPARE_FLAGS (FLAG_HARD | FLAG_PCSS | FLAG_MAPS)

/* Surfaces that read where they are on a light's screen; and what gather does besides. */
#define SCREEN_FLAGS (SHADOW_FLAGS | FLAG_RECEIVERS)
#define GATHER_FLAGS (FLAG_EDGES | FLAG_RECEIVERS)

/* In which form plain depths are read. */
#define PLAIN_FLAGS (FLAG_DEPTH_HALF | FLAG_DEPTH_PACKED)

#define STAGE_FILES_MAX 40

/* Files of a stage, in order; one with flags is left out unless one of them is on, and where one is
 * that it is the other choice of. */
struct part {
	const char *file;
	uint64_t flags, without;
};

/* What smoothie_fin.vert shares with C. */
#define VALUE_TEXT(value) #value
#define DEFINE(name) "#define " #name " " VALUE_TEXT(name) "\n"
#define FIN_DEFINES DEFINE(BLOCK_FINS) DEFINE(FIN_NDC_LIMIT) DEFINE(FIN_SIDE_BIT)

static const struct {
	const char *name;
	uint64_t flags;      /* that mean something */
	const char *defines; /* in all variants; may be NULL */
	struct part parts[2][STAGE_FILES_MAX];
} programs[PROGRAM_KINDS] = {
	[PROGRAM_DEPTH_MAP] =
		{
			.name = "depth-map",
			.flags = FLAG_DEPTH_FLOAT | PLAIN_FLAGS,
			.parts =
				{
					{{"depth_map.vert"}},
					{
						{"common_light_depth.glsl", FLAG_DEPTH_HALF},
						{"common_plain_depth.glsl",
							FLAG_DEPTH_FLOAT | PLAIN_FLAGS},
						{"depth_map.frag"},
					},
				},
		},
	[PROGRAM_LAYER] =
		{
			.name = "layer",
			.flags = FLAG_PEEL | FLAG_COARSE,
			.parts =
				{
					{{"depth_map.vert"}},
					{{"common_depth_step.glsl"}, {"gather_sheet.glsl"},
						{"common_middle.glsl", FLAG_COARSE},
						{"gather_layer.frag"}},
				},
		},
	[PROGRAM_FIN] =
		{
			.name = "fin",
			.flags = FLAG_SINUSOID | FLAG_DEPTH_ONLY | FLAG_RECEIVER_MAP | FLAG_CONE |
				 FLAG_ALPHA_DEPTH | FLAG_FETCH | FLAG_FUSED | PLAIN_FLAGS,
			.defines = FIN_DEFINES,
			.parts =
				{
					{{"smoothie_fin.vert"}},
					{{"common_light_depth.glsl"}, {"common_plain_depth.glsl"},
						{"smoothie_word.glsl", FLAG_FUSED},
						{"smoothie_fin.frag"}},
				},
		},
	[PROGRAM_BLUR] =
		{
			.name = "blur",
			.flags = FLAG_FROM_DEPTH | FLAG_RECEIVER_MAP | PLAIN_FLAGS | FLAG_SPLIT,
			.parts =
				{
					{{"copy.vert"}},
					{{"common_light_depth.glsl"}, {"common_plain_depth.glsl"},
						{"common_moments.glsl"}, {"vsm_blur.frag"}},
				},
		},
	[PROGRAM_TWO_SIDED_FIN] =
		{
			.name = "two-sided-fin",
			.flags = FLAG_RECEIVER_MAP | PLAIN_FLAGS,
			.defines = FIN_DEFINES,
			.parts =
				{
					{{"smoothie_fin.vert"}},
					{
						{"common_light_depth.glsl", FLAG_DEPTH_HALF},
						{"common_plain_depth.glsl"},
						{"common_depth_step.glsl"},
						{"two_sided_fin.frag"},
					},
				},
		},
	[PROGRAM_SURFACE] =
		{
			.name = "surface",
			.flags = FLAG_LIT | FLAG_SHADOWED | SHADOW_FLAGS | FLAG_SEPARATE_DEPTH |
				 FLAG_GATHER | FLAG_FOUR_FETCHES | FLAG_TEXTURED | FLAG_VISIBILITY |
				 FLAG_ENCODE_SRGB | FLAG_ALPHA_DEPTH | PLAIN_FLAGS | FLAG_SPLIT |
				 FLAG_POINTS | FLAG_CELLS | FLAG_RUNS | FLAG_RECEIVERS |
				 FLAG_COARSE | FLAG_BEHIND | FLAG_WORDS | FLAG_TWO_LAYERS |
				 FLAG_HOLLOWS | FLAG_SAMPLES | FLAG_FLAT_INPUTS | FLAG_FUSED |
				 FLAG_IMAGES,
			.parts =
				{
					{
						{"shadow_screen.glsl", SCREEN_FLAGS},
						{"gather_uniforms.glsl", GATHER_FLAGS},
						{"screen_flat_out.glsl", SCREEN_FLAGS},
						{"gather_flat_out.glsl", GATHER_FLAGS},
						{"surface_uniforms.glsl", FLAG_FLAT_INPUTS},
						{"surface_flat_out.glsl", FLAG_FLAT_INPUTS},
						{"surface.vert"},
					},
					{
						{"common_srgb.glsl", FLAG_ENCODE_SRGB},
						{"screen_flat_in.glsl", SCREEN_FLAGS},
						{"gather_flat_in.glsl", GATHER_FLAGS},
						{"common_light_depth.glsl",
							FLAG_SMOOTHIE | FLAG_VSM | FLAG_DEPTH_HALF},
						{"common_plain_depth.glsl",
							TAP_FLAGS | COMPARE_FLAGS},
						{"common_depth_step.glsl", SCREEN_FLAGS},
						{"shadow_screen.glsl", SCREEN_FLAGS,
							FLAG_FLAT_INPUTS},
						{"gather_uniforms.glsl", GATHER_FLAGS,
							FLAG_FLAT_INPUTS},
						{"shadow_receiver.glsl", SCREEN_FLAGS},
						{"shadow_depth.glsl", SHADOW_FLAGS, GATHER_FLAGS},
						{"shadow_taps.glsl", TAP_FLAGS | COMPARE_FLAGS},
						{"shadow_compare.glsl", FLAG_HARD | FLAG_PCSS},
						{"shadow_hard.glsl", FLAG_HARD},
						{"smoothie_word.glsl", FLAG_FUSED},
						{"shadow_smoothie.glsl", FLAG_SMOOTHIE},
						{"shadow_two_sided.glsl", FLAG_TWO_SIDED},
						{"shadow_bicubic.glsl", FLAG_BICUBIC},
						{"shadow_pcss.glsl", FLAG_PCSS},
						{"shadow_maps.glsl", FLAG_MAPS},
						{"common_moments.glsl", FLAG_VSM},
						{"shadow_vsm.glsl", FLAG_VSM},
						{"gather_sheet.glsl", FLAG_EDGES | FLAG_RECEIVERS},
						{"gather_disc.glsl", FLAG_EDGES},
						{"gather_images.glsl", FLAG_IMAGES},
						{"gather_textures.glsl", FLAG_EDGES, FLAG_IMAGES},
						{"shadow_gather.glsl", FLAG_EDGES},
						{"sparse_cell.glsl", FLAG_CELLS},
						{"sparse_between.glsl", FLAG_CELLS},
						{"sparse_visibility.glsl", FLAG_CELLS},
						{"exact_seen.glsl", FLAG_SEEN},
						{"deferred_seen.glsl", FLAG_FOUND},
						{"shadow_seen.glsl", FLAG_SEEN | FLAG_SAMPLES},
						{"common_middle.glsl", FLAG_COARSE},
						{"surface_uniforms.glsl", 0, FLAG_FLAT_INPUTS},
						{"surface_flat_in.glsl", FLAG_FLAT_INPUTS},
						{"surface.frag"},
					},
				},
		},
	[PROGRAM_CELLS] =
		{
			.name = "cells",
			.parts = {{{"copy.vert"}}, {{"sparse_cell.glsl"}, {"sparse_cells.frag"}}},
		},
	[PROGRAM_KNOWN] =
		{
			.name = "known",
			.flags = FLAG_CELLS | FLAG_FLAT_INPUTS,
			.parts =
				{
					{{"shadow_screen.glsl"}, {"gather_uniforms.glsl"},
						{"screen_flat_out.glsl"}, {"gather_flat_out.glsl"},
						{"copy.vert"}},
					{{"sparse_cell.glsl", FLAG_CELLS},
						{"sparse_between.glsl", FLAG_CELLS},
						{"screen_flat_in.glsl"}, {"gather_flat_in.glsl"},
						{"deferred_receivers.glsl"},
						{"deferred_known.frag"}},
				},
		},
	[PROGRAM_FIND] =
		{
			.name = "find",
			.flags = FLAG_RECEIVERS | FLAG_RUNS | FLAG_COARSE | FLAG_POINTS |
				 FLAG_TWO_LAYERS | FLAG_HOLLOWS | FLAG_FLAT_INPUTS | FLAG_IMAGES,
			.parts =
				{
					{{"shadow_screen.glsl"}, {"gather_uniforms.glsl"},
						{"screen_flat_out.glsl"}, {"gather_flat_out.glsl"},
						{"copy.vert"}},
					{{"common_depth_step.glsl"}, {"screen_flat_in.glsl"},
						{"gather_flat_in.glsl"}, {"shadow_receiver.glsl"},
						{"gather_sheet.glsl"}, {"gather_disc.glsl"},
						{"gather_images.glsl", FLAG_IMAGES},
						{"gather_textures.glsl", 0, FLAG_IMAGES},
						{"shadow_gather.glsl"}, {"deferred_receivers.glsl"},
						{"deferred_find.frag"}},
				},
		},
	[PROGRAM_COPY] =
		{
			.name = "copy",
			.parts = {{{"copy.vert"}}, {{"common_srgb.glsl"}, {"copy.frag"}}},
		},
	[PROGRAM_WORD] =
		{
			.name = "word",
			.parts = {{{"copy.vert"}}, {{"smoothie_word.frag"}}},
		},
	[PROGRAM_SCREEN] =
		{
			.name = "screen",
			.flags = FLAG_DITHER | FLAG_WIDEN | FLAG_STORED,
			.parts = {{{"copy.vert"}}, {{"screen.frag"}}},
		},
	[PROGRAM_PROBE_DRAW] =
		{
			.name = "probe-draw",
			.flags = FLAG_ALPHA_DEPTH | FLAG_FETCH | FLAG_FUSED,
			.parts = {{{"copy.vert"}}, {{"probe_draw.frag"}}},
		},
	[PROGRAM_PROBE_READ] =
		{
			.name = "probe-read",
			.flags = FLAG_GATHER,
			.parts = {{{"copy.vert"}}, {{"probe_read.frag"}}},
		},
	[PROGRAM_PROBE_BRANCH] =
		{
			.name = "probe-branch",
			.parts = {{{"copy.vert"}}, {{"probe_branch.frag"}}},
		},
	[PROGRAM_EXACT_DEPTH] =
		{
			.name = "exact-depth",
			.parts =
				{
					{{"exact_blocker.glsl"}, {"exact_raster.vert"}},
					{{"exact_blocker.glsl"}, {"exact_common.glsl"},
						{"exact_depth.frag"}},
				},
		},
	[PROGRAM_EXACT_FIN] =
		{
			.name = "exact-fin",
			.flags = FLAG_FIXED12 | FLAG_DEPTH_ONLY | FLAG_RECEIVER_MAP | FLAG_SINUSOID,
			.parts =
				{
					{{"exact_smoothie.glsl"}, {"exact_raster.vert"}},
					{
						{"exact_smoothie.glsl"},
						{"exact_common.glsl"},
						{"exact_number.glsl"},
						{"exact_half.glsl", 0, FLAG_FIXED12},
						{"exact_fixed12.glsl", FLAG_FIXED12},
						{"exact_fin.frag"},
					},
				},
		},
	[PROGRAM_EXACT_SURFACE] =
		{
			.name = "exact-surface",
			.flags = FLAG_FIXED12 | FLAG_VISIBILITY,
			.parts =
				{
					{{"exact_receiver.glsl"}, {"exact_raster.vert"}},
					{
						{"exact_receiver.glsl"},
						{"exact_common.glsl"},
						{"exact_number.glsl"},
						{"exact_half.glsl", 0, FLAG_FIXED12},
						{"exact_fixed12.glsl", FLAG_FIXED12},
						{"exact_surface.frag"},
					},
				},
		},
	[PROGRAM_EXACT_COPY] =
		{
			.name = "exact-copy",
			.parts = {{{"copy.vert"}}, {{"exact_seen.glsl"}, {"exact_copy.frag"}}},
		},
};

static bool implies(uint64_t flags, uint64_t flag, uint64_t needed)
{
	return !(flags & flag) || (flags & needed) == needed;
}

static bool are_several(uint64_t bits)
{
	return (bits & (bits - 1)) != 0;
}

static bool excludes(uint64_t flags, uint64_t flag, uint64_t other)
{
	return !(flags & flag) || !(flags & other);
}

/* Whether surfaces with these flags read depths without comparing. */
static bool reads_plainly(uint64_t flags)
{
	return flags & FLAG_PCSS || (flags & TAP_FLAGS && !(flags & FLAG_GATHER)) ||
	       (flags & COMPARE_FLAGS && flags & FLAG_FOUR_FETCHES);
}

/* Receivers are drawn for any way alike. */
static bool receivers_are_complete(uint64_t flags)
{
	return implies(flags, FLAG_COARSE, FLAG_SHADOWED) &&
	       implies(flags, FLAG_SHADOWED, FLAG_LIT);
}

static bool surface_is_complete(uint64_t flags)
{
	bool shadowed = (flags & FLAG_SHADOWED) != 0;
	return ((flags & (SHADOW_FLAGS | FLAG_CELLS)) != 0) == shadowed &&
	       implies(flags, FLAG_SHADOWED, FLAG_LIT) &&
	       implies(flags, FLAG_SEPARATE_DEPTH, FLAG_SMOOTHIE) &&
	       implies(flags, FLAG_ALPHA_DEPTH, FLAG_SEPARATE_DEPTH) &&
	       implies(flags, FLAG_WORDS, FLAG_SMOOTHIE | FLAG_GATHER) &&
	       implies(flags, FLAG_FUSED, FLAG_SMOOTHIE | FLAG_GATHER) &&
	       implies(flags, FLAG_SPLIT, FLAG_VSM) &&
	       implies(flags, FLAG_POINTS, FLAG_VISIBILITY) &&
	       implies(flags, FLAG_RUNS, FLAG_EDGES) && implies(flags, FLAG_COARSE, FLAG_EDGES) &&
	       implies(flags, FLAG_BEHIND, FLAG_EDGES) &&
	       implies(flags, FLAG_TWO_LAYERS, FLAG_EDGES) &&
	       implies(flags, FLAG_HOLLOWS, FLAG_EDGES) &&
	       implies(flags, FLAG_IMAGES, FLAG_EDGES) &&
	       implies(flags, FLAG_SAMPLES, FLAG_FOUND) &&
	       (!(flags & FLAG_GATHER) || flags & (TAP_FLAGS | COMPARE_FLAGS)) &&
	       (!(flags & FLAG_FOUR_FETCHES) || flags & (FLAG_VSM | COMPARE_FLAGS)) &&
	       (!(flags & PLAIN_FLAGS) || reads_plainly(flags));
}

/* Whether each flag has those that it needs. */
static bool is_complete(struct program_key key)
{
	uint64_t flags = key.flags;
	switch (key.kind) {
	case PROGRAM_SURFACE:
		return flags & FLAG_RECEIVERS ? receivers_are_complete(flags)
					      : surface_is_complete(flags);
	/* Three vertices hand on what they will. */
	case PROGRAM_KNOWN:
		return (flags & FLAG_FLAT_INPUTS) != 0;
	case PROGRAM_FIND:
		return flags & FLAG_RECEIVERS && flags & FLAG_FLAT_INPUTS;
	case PROGRAM_FIN:
	case PROGRAM_PROBE_DRAW:
		return implies(flags, FLAG_FUSED, FLAG_FETCH);
	case PROGRAM_BLUR:
		return !(flags & (FLAG_RECEIVER_MAP | PLAIN_FLAGS)) || flags & FLAG_FROM_DEPTH;
	default:
		return true;
	}
}

static bool surface_conflicts(uint64_t flags)
{
	return are_several(flags & SHADOW_FLAGS) ||
	       /* Cells are a way by themselves, or come before edges. */
	       !excludes(flags, FLAG_CELLS, SHADOW_FLAGS & ~FLAG_EDGES) ||
	       !excludes(flags, FLAG_RECEIVERS,
		       ~(FLAG_RECEIVERS | FLAG_LIT | FLAG_SHADOWED | FLAG_VISIBILITY | FLAG_COARSE |
			       FLAG_FLAT_INPUTS)) ||
	       !excludes(flags, FLAG_POINTS, FLAG_CELLS | (SHADOW_FLAGS & ~FLAG_EDGES)) ||
	       !excludes(flags, FLAG_BEHIND, FLAG_TWO_LAYERS | FLAG_HOLLOWS) ||
	       !excludes(flags, FLAG_WORDS, FLAG_SEPARATE_DEPTH) ||
	       !excludes(flags, FLAG_FUSED, FLAG_SEPARATE_DEPTH | FLAG_WORDS) ||
	       !excludes(flags, FLAG_GATHER, FLAG_FOUR_FETCHES) ||
	       !excludes(flags, FLAG_VISIBILITY, FLAG_TEXTURED | FLAG_ENCODE_SRGB | FLAG_SEEN);
}

/* Whether some flags are not had together: no flag more makes that good. */
static bool conflicts(struct program_key key)
{
	uint64_t flags = key.flags;
	if (are_several(flags & (FLAG_DEPTH_FLOAT | PLAIN_FLAGS)) ||
		!excludes(flags, FLAG_ALPHA_DEPTH, FLAG_FETCH))
		return true;
	switch (key.kind) {
	case PROGRAM_SURFACE:
		return surface_conflicts(flags);
	case PROGRAM_FIN:
		return !excludes(flags, FLAG_DEPTH_ONLY,
			FLAG_SINUSOID | FLAG_CONE | FLAG_ALPHA_DEPTH | FLAG_FETCH);
	case PROGRAM_EXACT_FIN:
		return !excludes(flags, FLAG_DEPTH_ONLY, FLAG_SINUSOID);
	case PROGRAM_SCREEN:
		return !excludes(flags, FLAG_DITHER, FLAG_WIDEN);
	default:
		return false;
	}
}

bool program_key_is_valid(struct program_key key)
{
	return !(key.flags & ~programs[key.kind].flags) && !conflicts(key) && is_complete(key);
}

bool program_key_next(struct program_key *key)
{
	uint64_t all = programs[key->kind].flags;
	do {
		/* All that follow until its lowest flag goes have the conflict, too. */
		if (conflicts(*key))
			key->flags |= (key->flags & -key->flags) - 1;
		key->flags = ((key->flags | ~all) + 1) & all;
	} while (key->flags != 0 && !program_key_is_valid(*key));
	return key->flags != 0;
}

uint64_t program_kind_flags(enum program_kind kind)
{
	return programs[kind].flags;
}

static const char *file_text(const char *name)
{
	for (const struct shader_file *file = shader_files; file->name != NULL; file++)
		if (strcmp(file->name, name) == 0)
			return file->text;
	assert(!"a shader file that is not in shaders_es/meson.build");
	return "";
}

size_t shader_parts(
	struct program_key key, enum shader_stage stage, const char *parts[SHADER_PARTS_MAX])
{
	size_t count = 0;
	/* textureGather() and images came with 3.1; all else is 3.0. */
	parts[count++] =
		key.flags & (FLAG_GATHER | FLAG_IMAGES) ? "#version 310 es\n" : "#version 300 es\n";
	if (key.flags & FLAG_FETCH && stage == STAGE_FRAGMENT)
		parts[count++] = "#extension GL_EXT_shader_framebuffer_fetch : require\n";
	parts[count++] = file_text("common_precision.glsl");
	for (size_t i = 0; i < FLAG_COUNT; i++)
		if (key.flags & flag_names[i].flag)
			parts[count++] = flag_names[i].define;
	if (programs[key.kind].defines != NULL)
		parts[count++] = programs[key.kind].defines;
	const struct part *part = programs[key.kind].parts[stage];
	for (const struct part *end = part + STAGE_FILES_MAX; part < end && part->file != NULL;
		part++)
		if ((part->flags == 0 || key.flags & part->flags) && !(key.flags & part->without))
			parts[count++] = file_text(part->file);
	assert(count <= SHADER_PARTS_MAX);
	return count;
}

const char *program_key_name(struct program_key key, char *text, size_t size)
{
	int used = snprintf(text, size, "%s", programs[key.kind].name);
	for (size_t i = 0; i < FLAG_COUNT && used >= 0 && (size_t)used < size; i++)
		if (key.flags & flag_names[i].flag)
			used += snprintf(
				text + used, size - (size_t)used, " %s", flag_names[i].name);
	return text;
}
