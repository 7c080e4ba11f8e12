/* SPDX-License-Identifier: MIT */
#include "technique/gather.h"
#include "base/float_range.h"
#include "base/log.h"
#include "base/processor_time.h"
#include "gles/raster_grid.h"
#include "scene/edge_grid.h"
#include "scene/penumbra.h"
#include "technique/disc_mask.h"
#include "technique/sheet_layers.h"
#include <float.h>
#include <math.h>

/* Runs or edges in a row of their texture; as in gather_textures.glsl and gather_images.glsl. */
#define TABLE_ROW 1024

/* A texture of runs or edges; 0 where there are none. Its size stays, as that of an image has to.
 */
struct list_table {
	GLuint texture;
	GLsizei rows;
};

/* Penumbrae from the silhouette edges themselves, listed for tiles of the light's screen: each
 * receiver adds up which part of the light's disc lies behind which edge. All textures are of
 * integers: core ES 3.0, whatever a driver makes of floats. */
struct gather {
	struct sheet_layers layers;
	GLuint tiles, masks;
	struct list_table runs, edges;
	bool images; /* or textures are what these are read as */
	struct edge_grid grid;
	struct screen_grid soft;
	float farthest[SCREEN_GRID_SIZE * SCREEN_GRID_SIZE]; /* of casters over a cell; 0: none */
	struct depth_map hard; /* of a light that is a point; made when there is one */
	bool point;
	int sheets;              /* in line, in the last frame */
	double search_ms;        /* that edges took of a processor, likewise */
	bool sparse, long_lists; /* chosen by itself, in the last frame */
	enum sm_sampling sampling;
	float depth_noise;
	bool told;         /* that edges are left out */
	uint64_t scene;    /* that the last frame was of; 0: it does not count */
	uint64_t failures; /* of the GPU so far, when all was drawn */
	uint32_t map_size, subpixel_bits;
};

static GLuint create_table(struct gl *gl, enum storage_owner owner)
{
	GLuint texture = gl_create_texture(gl, owner);
	gl->ActiveTexture(GL_TEXTURE0);
	gl->BindTexture(GL_TEXTURE_2D, texture);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	return texture;
}

static void upload_masks(struct gather *gather, struct gl *gl)
{
	static uint32_t table[DISC_MASK_ANGLES * DISC_MASK_DISTANCES][2];
	disc_mask_table(table);
	static const struct texel_format as = {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT};
	gather->masks = create_table(gl, STORAGE_TABLES);
	gl_fill_texture(gl, gather->masks, &as, DISC_MASK_ANGLES, DISC_MASK_DISTANCES, table);
}

static bool gather_init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	struct gather *gather = state;
	struct gl *gl = &gpu->gl;
	gather->subpixel_bits = raster_grid_bits(gpu);
	gather->map_size = options->map_size;
	gather->sampling = options->sampling;
	GLsizei size = (GLsizei)gather_layer_size(options->map_size);
	if (!sheet_layers_init(&gather->layers, gpu, size, error))
		return false;
	upload_masks(gather, gl);
	gather->tiles = create_table(gl, STORAGE_EDGE_LISTS);
	gather->images = way_choose(gpu, DRIVER_TABLES, NULL) == TABLES_IMAGES;
	return true;
}

static void gather_finish(void *state, struct gpu *gpu)
{
	struct gather *gather = state;
	depth_map_finish(&gather->hard, gpu);
	edge_grid_finish(&gather->grid);
	gl_delete_texture(&gpu->gl, &gather->runs.texture);
	gl_delete_texture(&gpu->gl, &gather->edges.texture);
	gl_delete_texture(&gpu->gl, &gather->tiles);
	gl_delete_texture(&gpu->gl, &gather->masks);
	sheet_layers_finish(&gather->layers, gpu);
}

const struct edge_chains *gather_chains(const void *state)
{
	const struct gather *gather = state;
	return &gather->grid.chains;
}

/* As many layers as there are sheets one behind the other in some tile's middle. */
static int sheets_in_line(const struct edge_grid *grid)
{
	int most = 1;
	for (size_t i = 0; i < (size_t)grid->tiles * grid->tiles && most < GATHER_LAYERS; i++) {
		int winding = edge_tile_winding(&grid->of[i]);
		most = winding > most ? winding : most;
	}
	return most < GATHER_LAYERS ? most : GATHER_LAYERS;
}

/* Of a table of RGBA32UI, TABLE_ROW a row. */
#define TABLE_TEXEL_BYTES 16
_Static_assert(sizeof(struct edge_run) == TABLE_TEXEL_BYTES, "a texel");
_Static_assert(sizeof(struct edge_texel) == TABLE_TEXEL_BYTES, "a texel");

/* Makes room for so many rows, with some to spare, but for `most`. */
static void reserve_rows(struct gl *gl, struct list_table *table, GLsizei rows, GLsizei most)
{
	if (rows > 0 && rows <= table->rows)
		return;
	gl_delete_texture(gl, &table->texture);
	table->rows = rows + rows / 2 < most ? rows + rows / 2 : most;
	if (rows == 0)
		return;
	table->texture = create_table(gl, STORAGE_EDGE_LISTS);
	gl_store_texture(gl, table->texture, GL_RGBA32UI, TABLE_ROW, table->rows);
}

/* Writes texels, at most `most`, a whole number of rows. */
static void upload_table(
	struct gl *gl, struct list_table *table, const void *texels, size_t count, GLsizei most)
{
	GLsizei full = (GLsizei)(count / TABLE_ROW), rest = (GLsizei)(count % TABLE_ROW);
	reserve_rows(gl, table, full + (rest > 0), most / TABLE_ROW);
	gl->BindTexture(GL_TEXTURE_2D, table->texture);
	if (full > 0)
		gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, TABLE_ROW, full, GL_RGBA_INTEGER,
			GL_UNSIGNED_INT, texels);
	if (rest > 0)
		gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, full, rest, 1, GL_RGBA_INTEGER,
			GL_UNSIGNED_INT,
			(const char *)texels + (size_t)full * TABLE_ROW * TABLE_TEXEL_BYTES);
}

/* Returns how many bytes. */
static size_t upload_edges(struct gather *gather, struct gl *gl)
{
	const struct edge_grid *grid = &gather->grid;
	size_t runs = grid->whole ? 0 : grid->run_count;
	upload_table(gl, &gather->runs, grid->runs, runs, GATHER_RUNS_MAX);
	upload_table(gl, &gather->edges, grid->texels, grid->texel_count,
		grid->whole ? GATHER_COPIES_MAX : GATHER_VERTICES_MAX);
	return (runs + grid->texel_count) * TABLE_TEXEL_BYTES;
}

static void upload_tiles(struct gather *gather, struct gpu *gpu)
{
	static const struct texel_format as = {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT};
	GLsizei side = (GLsizei)gather->grid.tiles;
	gl_fill_texture(&gpu->gl, gather->tiles, &as, side, side, gather->grid.of);
}

/* Whether there is an edge to add up or a caster to be behind, and how far casters reach. Tiles are
 * 32, 64 or 128 a side. */
static bool cell_is_soft(const struct edge_grid *grid, int x, int row, float *farthest)
{
	uint32_t tiles = grid->tiles, first[2] = {(uint32_t)x, (uint32_t)row}, end[2];
	for (int axis = 0; axis < 2; axis++) {
		end[axis] = ((first[axis] + 1) * tiles + SCREEN_GRID_SIZE - 1) / SCREEN_GRID_SIZE;
		first[axis] = first[axis] * tiles / SCREEN_GRID_SIZE;
	}
	bool edges = false;
	*farthest = 0.0f;
	for (uint32_t j = first[1]; j < end[1]; j++)
		for (uint32_t i = first[0]; i < end[0]; i++) {
			const struct edge_tile *tile = &grid->of[j * tiles + i];
			edges = edges || edge_tile_count(tile) > 0;
			*farthest = larger(*farthest, tile->farthest);
		}
	return edges || *farthest > 0.0f;
}

static void mark_soft(struct gather *gather)
{
	const struct edge_grid *grid = &gather->grid;
	screen_grid_clear(&gather->soft);
	for (int row = 0; row < SCREEN_GRID_SIZE; row++)
		for (int x = 0; x < SCREEN_GRID_SIZE; x++)
			if (cell_is_soft(
				    grid, x, row, &gather->farthest[row * SCREEN_GRID_SIZE + x]))
				gather->soft.rows[row] |= (uint64_t)1 << x;
}

static void count_edges(struct gather *gather, struct sm_frame_stats *stats)
{
	stats->silhouette_edges += gather->grid.edge_count;
	stats->edges_left_out += gather->grid.dropped;
	if (gather->grid.dropped > 0 && !gather->told)
		log_warning("more silhouette edges than lists have room for: shadows come from the "
			    "nearest ones alone");
	gather->told = gather->told || gather->grid.dropped > 0;
}

static struct edge_grid_options grid_options(
	const struct gather *gather, const struct sm_scene *scene, const struct light_frame *frame)
{
	return (struct edge_grid_options){
		.tiles = gather_tiles(scene, frame),
		.map_size = (uint32_t)gather->layers.depth.size,
		.subpixel_bits = gather->subpixel_bits,
		.finer_bits = edge_finer_bits(gather->subpixel_bits),
		.room = GATHER_ROOM,
	};
}

/* A search of edges that another thread may do. */
struct edge_search {
	struct gather *gather;
	const struct sm_scene *scene;
	const struct light_frame *frame;
	struct edge_grid_options options;
	bool aside, found;
};

/* Of a processor, ms, from which on a search is worth another thread: to wake one, and to have
 * lists come from another processor's caches, takes .7 ms. */
#define ASIDE_MS 2.0

static void find_edges(void *data, unsigned part)
{
	struct edge_search *search = data;
	double start = processor_ms();
	(void)part;
	search->found = edge_grid_find(
		&search->gather->grid, search->scene, search->frame, &search->options);
	search->gather->search_ms = processor_ms() - start;
}

static bool finish_edges(struct edge_search *search, struct gpu *gpu, struct sm_error *error)
{
	struct gather *gather = search->gather;
	gl_push_group(&gpu->gl, "silhouettes");
	if (search->aside)
		workers_wait(&gpu->workers);
	else
		find_edges(search, 0);
	double start = processor_ms();
	if (search->found) {
		mark_soft(gather);
		count_edges(gather, &gpu->stats);
		skip_count(&gpu->skips, SKIP_STATIC, gather->grid.keep.caster_count,
			gather->grid.keep.kept_count);
		const struct edge_chains *chains = &gather->grid.chains;
		skip_count(&gpu->skips, SKIP_TRIANGLE, chains->block_count,
			chains->block_count - chains->tested_count);
		gpu->stats.silhouette_ms += gather->search_ms + processor_ms() - start;
		gpu->gl.ActiveTexture(GL_TEXTURE0);
		upload_tiles(gather, gpu);
		gpu->stats.uploaded_bytes += upload_edges(gather, &gpu->gl) +
					     (uint64_t)gather->grid.tiles * gather->grid.tiles *
						     sizeof(struct edge_tile);
	}
	gl_pop_group(&gpu->gl);
	return search->found || error_no_memory(error);
}

/* Roundings on a vertex's way to its depth, steps of a float in all. */
#define DEPTH_ROUNDINGS 4.0f

/* How far the depths may be apart that two passes find of a caster's place: what its vertices are
 * away from where they are counted from, rounded. Window depth, as if that were linear. */
static float find_depth_noise(const struct sm_scene *scene, const struct light_frame *frame)
{
	float most = 0.0f;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		const struct mesh *mesh = &scene->meshes[object->mesh];
		for (int row = 0; row < 3 && object->casts; row++) {
			float reach = 0.0f;
			for (int axis = 0; axis < 3; axis++)
				reach += fabsf(object->transform[axis][row]) *
					 fmaxf(fabsf(mesh->min[axis]), fabsf(mesh->max[axis]));
			most = fmaxf(most, reach);
		}
	}
	return DEPTH_ROUNDINGS * FLT_EPSILON * most / (frame->far - frame->near);
}

static void forget(struct gather *gather)
{
	edge_grid_forget(&gather->grid);
	sheet_layers_forget(&gather->layers);
}

static bool draw_layers(struct gather *gather, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct screen_box *changed, struct sm_error *error)
{
	return sheet_layers_draw(&gather->layers, gpu, scene, frame, gather->sheets,
		&gather->grid.keep.watch, changed, error);
}

/* Edges tell how many layers there are, but it takes a processor a while to find them: as many as
 * the last frame had are drawn meanwhile, or before, so that a driver has something to do. */
static bool draw_sheets(struct gather *gather, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	struct edge_search search = {gather, scene, frame, grid_options(gather, scene, frame),
		.aside = gather->search_ms >= ASIDE_MS};
	const struct screen_box none = screen_box_none();
	if (!edge_grid_look(&gather->grid, scene, frame, &search.options))
		return error_no_memory(error);
	gather->sheets = gather->sheets > 0 ? gather->sheets : 1;
	gather->grid.chains.tests_all = gpu->skips.off[SKIP_TRIANGLE];
	if (search.aside)
		workers_begin(&gpu->workers, 1, find_edges, &search);
	bool drawn = draw_layers(gather, gpu, scene, frame, &gather->grid.keep.changed, error);
	if (!finish_edges(&search, gpu, error) || !drawn)
		return false;
	gather->sheets = sheets_in_line(&gather->grid);
	return draw_layers(gather, gpu, scene, frame, &none, error);
}

static bool gather_prepare(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	struct gather *gather = state;
	gather->point = frame->disc == 0.0f;
	gather->depth_noise = find_depth_noise(scene, frame);
	if (gpu->skips.off[SKIP_STATIC] || gather->failures != gpu->failures)
		forget(gather);
	/* Tables may lack the memory that was asked for. */
	if (gather->failures != gpu->failures)
		gather->runs.rows = gather->edges.rows = 0;
	gather->failures = gpu->failures;
	if (!gather->point)
		return draw_sheets(gather, gpu, scene, frame, error);
	if (gather->hard.target.texture == 0 &&
		!depth_map_init(
			&gather->hard, gpu, gather->map_size, DEPTH_MAP_NEAREST, false, error)) {
		depth_map_finish(&gather->hard, gpu);
		return false;
	}
	return depth_map_draw(&gather->hard, gpu, scene, frame, error);
}

static uint64_t gather_surface_flags(const void *state)
{
	const struct gather *gather = state;
	if (gather->point)
		return FLAG_HARD;
	return FLAG_EDGES | (gather->grid.whole ? 0 : FLAG_RUNS) |
	       (gather->layers.count > 2 ? 0 : FLAG_TWO_LAYERS) |
	       (gather->grid.hollows.count > 0 ? FLAG_HOLLOWS : 0) |
	       (gather->images ? FLAG_IMAGES : 0) |
	       (raster_is_coarse(gather->subpixel_bits) ? FLAG_COARSE : 0);
}

static const struct screen_grid *gather_soft_grid(const void *state)
{
	const struct gather *gather = state;
	return gather->point ? NULL : &gather->soft;
}

static const float *gather_farthest(const void *state)
{
	const struct gather *gather = state;
	return gather->point ? NULL : gather->farthest;
}

/* The widest penumbra, in pixels where the light's screen is as high as the view, from which on
 * points of the view cost less: as measured, and where lists are long. */
#define WIDTH_SPARSE 100.0f
#define WIDTH_SPARSE_LONG 28.0f

/* Edges of a list, in the mean, from which on a pixel costs so much that it pays to know which are
 * seen, and which need edges. */
#define LIST_LONG 32.0f

/* Pixels to a triangle of the scene, below which a picture is deferred: small triangles are shaded
 * in blocks of more pixels than they have, hidden ones as well. */
#define PIXELS_DEFERRED 16

/* Of a limit: from which down what began above it ends. */
#define SHARE_KEPT 0.8f

static bool is_above(float value, float limit, bool was)
{
	return value > (was ? SHARE_KEPT * limit : limit);
}

static void choose_by_itself(struct gather *gather, float pixels, bool known)
{
	gather->long_lists =
		is_above(gather->grid.mean_list, LIST_LONG, known && gather->long_lists);
	float enough = gather->long_lists ? WIDTH_SPARSE_LONG : WIDTH_SPARSE;
	gather->sparse = is_above(pixels, enough, known && gather->sparse);
}

static enum sm_sampling sampling_of(bool sparse, bool deferred)
{
	if (sparse)
		return deferred ? SM_SAMPLING_DEFERRED_SPARSE : SM_SAMPLING_SPARSE;
	return deferred ? SM_SAMPLING_DEFERRED : SM_SAMPLING_DENSE;
}

static enum sm_sampling gather_sampling(void *state, const struct sm_scene *scene,
	const struct light_frame *frame, const struct technique_view *view)
{
	struct gather *gather = state;
	enum sm_sampling chosen = gather->sampling;
	bool small = (uint64_t)view->width * view->height / PIXELS_DEFERRED < view->triangles;
	/* What another scene had does not count in this one. */
	choose_by_itself(
		gather, penumbra_texels(scene, frame, view->height), gather->scene == scene->id);
	gather->scene = scene->id;
	if (gather->point)
		return SM_SAMPLING_DENSE;
	bool sparse = sampling_is_sparse(chosen), deferred = sampling_is_deferred(chosen);
	if (chosen == SM_SAMPLING_DEFAULT) {
		sparse = gather->sparse;
		deferred = small || gather->long_lists;
	}
	/* Else surfaces find what they cannot look up. */
	return sampling_of(sparse, deferred && view->deferrable);
}

static void gather_leave(void *state)
{
	struct gather *gather = state;
	gather->scene = 0;
}

/* A point's alone: lists of edges, and what is chosen by how long they are, are of all casters. */
static struct object_watch *gather_casters(
	void *state, const struct light_frame *frame, float *reach)
{
	struct gather *gather = state;
	*reach = 0.0f;
	return frame->disc == 0.0f ? &gather->hard.watch : NULL;
}

static void gather_list_memory(const void *state, const struct memory_list *list)
{
	const struct gather *gather = state;
	const struct edge_grid *grid = &gather->grid;
	size_t chains = edge_chains_bytes(&grid->chains), keep = edge_keep_bytes(&grid->keep);
	size_t depths = tile_depths_bytes(&grid->depths), cover = edge_cover_bytes(&grid->cover);
	depth_map_list_memory(&gather->hard, list);
	memory_list_processor(list, "silhouettes: chains", chains);
	memory_list_processor(list, "silhouettes: kept", keep);
	memory_list_processor(list, "tiles: depths", depths);
	memory_list_processor(list, "tiles: reach of edges", cover);
	memory_list_processor(list, "tiles: lists of edges",
		edge_grid_bytes(grid) - chains - keep - depths - cover);
}

/* By how much points are moved to a grid of so many bits of a texel. */
static float half_step(const struct gather *gather, uint32_t bits)
{
	return 0.5f / ((float)gather->layers.depth.size * (float)(1u << bits));
}

static void bind_tables(const struct gather *gather, struct gpu *gpu)
{
	struct gl *gl = &gpu->gl;
	gpu_bind_texture(gpu, UNIT_EDGE_TILES, gather->tiles);
	if (gather->images) {
		gl->BindImageTexture(IMAGE_EDGE_RUNS, gather->runs.texture, 0, GL_FALSE, 0,
			GL_READ_ONLY, GL_RGBA32UI);
		gl->BindImageTexture(IMAGE_EDGES, gather->edges.texture, 0, GL_FALSE, 0,
			GL_READ_ONLY, GL_RGBA32UI);
	} else {
		gpu_bind_texture(gpu, UNIT_EDGE_RUNS, gather->runs.texture);
		gpu_bind_texture(gpu, UNIT_EDGES, gather->edges.texture);
	}
}

static void gather_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	const struct gather *gather = state;
	struct gl *gl = &gpu->gl;
	if (gather->point) {
		depth_map_bind(&gather->hard, gpu, frame, program);
		return;
	}
	static const enum texture_unit units[GATHER_LAYERS] = {
		UNIT_FRONT_LAYER, UNIT_SECOND_LAYER, UNIT_THIRD_LAYER};
	for (int i = 0; i < GATHER_LAYERS; i++) {
		int layer = i < gather->layers.count ? i : 0;
		gpu_bind_texture(gpu, units[i], gather->layers.of[layer].texture);
	}
	gl->Uniform1i(program->uniform.layer_count, gather->layers.count);
	gl->Uniform1i(program->uniform.hollow_base, (GLint)gather->grid.hollow_base);
	bind_tables(gather, gpu);
	gpu_bind_texture(gpu, UNIT_DISC_MASKS, gather->masks);
	depth_map_set_receiver(gpu, gather->layers.depth.size, DEPTH_MAP_NEAREST, frame, program);
	gl->Uniform1f(program->uniform.disc_scale, disc_scale(frame));
	gl->Uniform1f(program->uniform.pole, frame->pole);
	gl->Uniform1f(program->uniform.depth_noise, gather->depth_noise);
	gl->Uniform1f(program->uniform.snap,
		half_step(gather, gather->subpixel_bits + edge_finer_bits(gather->subpixel_bits)));
	gl->Uniform1f(program->uniform.raster_snap, half_step(gather, gather->subpixel_bits));
	gl->Uniform1f(
		program->uniform.disc_facing, frame->parallel ? 0.0f : 2.0f * frame->half_extent);
	gl->Uniform1f(program->uniform.tile_count, (float)gather->grid.tiles);
}

const struct technique technique_gather = {
	.name = "gather",
	.summary = "the light's disc cut by all silhouette edges before it, for each pixel",
	.options = OPTION_SAMPLING,
	.state_size = sizeof(struct gather),
	.reads_receivers = true,
	.fits_screen = true,
	.init = gather_init,
	.finish = gather_finish,
	.leave = gather_leave,
	.prepare = gather_prepare,
	.surface_flags = gather_surface_flags,
	.soft_grid = gather_soft_grid,
	.needs_parts = true,
	.farthest = gather_farthest,
	.soft_is_all = true,
	.sampling = gather_sampling,
	.casters = gather_casters,
	.list_memory = gather_list_memory,
	.bind = gather_bind,
};
