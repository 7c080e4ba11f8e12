/* SPDX-License-Identifier: MIT */
/* Penumbrae from silhouette edges (docs/gather.md): the share of the light's disc that blockers
 * cover, of the sheets before its centre and a term for each edge. */
#include "base/array.h"
#include "base/error.h"
#include "model/layers.h"
#include "model/technique.h"
#include "scene/edge_grid.h"
#include "technique/disc_mask.h"
#include <stdlib.h>
#include <string.h>

/* How far off its own sheet the receiver may take a sheet for it, and one that is alone at its
 * texel; below which no farther texel is tried; by how much of that one has to be better; and what
 * none is as bad as. */
#define STRANGE_MAX 1.0
#define STRANGE_ALONE 2.0
#define STRANGE_NONE 0.02
#define STRANGE_GAIN 0.2
#define NOT_FOUND 3.0

struct gather {
	struct model_light light; /* with the size of the layers */
	struct edge_grid grid;
	struct layers layers;
	uint32_t (*masks)[2]; /* of disc_mask_table(), owned */
	void *hard;           /* state of model_hard, for a point; owned */
	double snap;          /* by how much points of edges and sheets are moved */
	double raster_snap;   /* and by a coarse raster grid, which the outlines of sheets follow */
};

static bool init_point(
	struct gather *gather, const struct model_light *light, struct sm_error *error)
{
	gather->hard = calloc(1, model_hard.state_size);
	if (gather->hard == NULL)
		return error_no_memory(error);
	return model_hard.init(gather->hard, light, error);
}

static bool init(void *state, const struct model_light *light, struct sm_error *error)
{
	struct gather *gather = state;
	gather->light = *light;
	if (light->frame.disc == 0.0f)
		return init_point(gather, light, error);
	gather->light.size = (int)gather_layer_size((uint32_t)gather->light.size);
	uint32_t bits = light->snap_bits > 0 ? (uint32_t)light->snap_bits : 8;
	const struct edge_grid_options options = {
		.tiles = gather_tiles(light->scene, &light->frame),
		.map_size = (uint32_t)gather->light.size,
		.subpixel_bits = bits,
		.finer_bits = edge_finer_bits(bits),
		.room = GATHER_ROOM,
	};
	gather->raster_snap = ldexp(0.5 / gather->light.size, -(int)bits);
	gather->snap = ldexp(gather->raster_snap, -(int)options.finer_bits);
	gather->masks = array_alloc(DISC_MASK_ANGLES * DISC_MASK_DISTANCES, sizeof(*gather->masks));
	bool made = gather->masks != NULL &&
		    edge_grid_find(&gather->grid, light->scene, &light->frame, &options) &&
		    edge_grid_find_stretches(&gather->grid);
	made = made && layers_init(&gather->layers, &gather->light);
	if (made)
		disc_mask_table(gather->masks);
	return made || error_no_memory(error);
}

static void finish(void *state)
{
	struct gather *gather = state;
	if (gather->hard != NULL)
		model_hard.finish(gather->hard);
	free(gather->hard);
	free(gather->masks);
	layers_finish(&gather->layers);
	edge_grid_finish(&gather->grid);
}

static double dot(const double a[2], const double b[2])
{
	return a[0] * b[0] + a[1] * b[1];
}

static double cross(const double a[2], const double b[2])
{
	return a[0] * b[1] - a[1] * b[0];
}

static double length_1(const double v[2])
{
	return fabs(v[0]) + fabs(v[1]);
}

/* A receiver and how it sees the disc: along (e, 1) from a spot. What is beside it by v on the
 * light's screen is beside the disc's centre by v - k e (e v) over the depth before the plane
 * through the receiver that the disc is parallel to. */
struct eye {
	const struct receiver *receiver;
	double noise; /* of depths on the receiver's plane */
	double e[2], k;
	double tilt[2]; /* slope of the plane parallel to the disc */
	double scale;   /* radius of the disc, window x or y, for each unit of depth */
};

static struct eye eye_of(const struct gather *gather, const struct receiver *receiver)
{
	const struct light_frame *frame = &gather->light.frame;
	struct eye eye = {.receiver = receiver, .scale = disc_scale(frame)};
	double tangent = frame->parallel ? 0.0 : 2.0 * (double)frame->half_extent;
	for (int i = 0; i < 2; i++)
		eye.e[i] = (receiver->at[i] - 0.5) * tangent;
	double square = 1.0 + dot(eye.e, eye.e);
	eye.k = 1.0 / (square + sqrt(square));
	for (int i = 0; i < 2; i++)
		eye.tilt[i] = eye.e[i] * tangent * (frame->pole - receiver->depth) / square;
	eye.noise = DEPTH_STEP + gather->snap * receiver_rise(receiver);
	return eye;
}

/* A point that the winding number is carried from to the receiver, along a plane. */
struct origin {
	double at[2];
	int winding;
	int winding_beside; /* the same, where the receiver's own sheet begins on the way */
	bool of_all;        /* sheets at any depth; else of those before the receiver */
	double slope[2];
};

/* A texel beside the receiver. */
struct texel {
	size_t index;
	double at[2], off[2]; /* its centre, and how that is beside the receiver */
};

static struct texel texel_at(const struct gather *gather, const struct eye *eye, const int at[2])
{
	int size = gather->light.size, kept[2];
	struct texel texel;
	for (int i = 0; i < 2; i++) {
		kept[i] = at[i] < 0 ? 0 : at[i] < size ? at[i] : size - 1;
		texel.at[i] = (kept[i] + 0.5) / size;
		texel.off[i] = texel.at[i] - eye->receiver->at[i];
	}
	texel.index = (size_t)kept[1] * (size_t)size + (size_t)kept[0];
	return texel;
}

/* Which of the four texels around the receiver, nearest first. */
static struct texel near_texel(const struct gather *gather, const struct eye *eye, int rank)
{
	int at[2], step[2];
	double off[2];
	for (int i = 0; i < 2; i++) {
		double place = eye->receiver->at[i] * gather->light.size;
		at[i] = (int)floor(place);
		off[i] = place - at[i] - 0.5;
		step[i] = off[i] < 0.0 ? -1 : 1;
	}
	int nearer = fabs(off[0]) < fabs(off[1]); /* axis of the second nearest */
	if (rank == 1 || rank == 3)
		at[nearer] += step[nearer];
	if (rank >= 2)
		at[1 - nearer] += step[1 - nearer];
	return texel_at(gather, eye, at);
}

/* How far a sheet at a texel is before the receiver: followed along its own plane, and from the
 * receiver's plane there. On the way both planes turn away from each other by the difference, or by
 * at most `turn` where the turns along x and y work against each other. */
struct lead {
	double here, there, turn;
	double noise; /* of depths on both planes */
};

static struct lead lead_of(const struct gather *gather, const struct eye *eye,
	const struct texel *texel, const struct sheet *sheet)
{
	const double *slope = eye->receiver->slope;
	double before = eye->receiver->depth - sheet->depth;
	struct lead lead = {
		.here = before + dot(sheet->slope, texel->off),
		.there = before + dot(slope, texel->off),
		.noise = eye->noise + gather->snap * length_1(sheet->slope),
	};
	for (int i = 0; i < 2; i++)
		lead.turn += fabs((sheet->slope[i] - slope[i]) * texel->off[i]);
	return lead;
}

/* Those of the layers at a texel. */
struct leads {
	struct lead of[GATHER_LAYERS];
	bool alone; /* there is one sheet at most */
};

static struct leads leads_at(
	const struct gather *gather, const struct eye *eye, const struct texel *texel)
{
	struct leads leads;
	for (int i = 0; i < GATHER_LAYERS; i++)
		leads.of[i] = lead_of(gather, eye, texel, &gather->layers.of[i][texel->index]);
	leads.alone = gather->layers.of[1][texel->index].depth > 1.0f;
	return leads;
}

/* How far a sheet is from where the receiver's own would be, over what it may be: one that bends
 * once on the way is behind the receiver's plane, or before it, by none to all of its turn. */
static double strangeness(const struct lead *lead, double noise)
{
	double apart = fabs(0.75 * lead->there + 0.25 * lead->here);
	return fmax(apart - noise, 0.0) / (lead->turn + noise);
}

/* Before the receiver on its own plane, which leaves a floor beside a wall lit, and as seen from
 * the receiver's, which leaves a curved surface lit. */
static bool blocks(const struct lead *lead, double noise)
{
	return fmin(lead->here, lead->there) > noise;
}

/* How doubtful that is: where both are not far apart they may meet on the way without an edge. */
static double doubt(const struct lead *lead, double noise)
{
	double sure = fmin(lead->here, lead->there) / (lead->turn + noise);
	return fmax(lead->here, lead->there) > noise ? 1.0 - fmin(fmax(sure, 0.0), 1.0) : 0.0;
}

/* Which layer the receiver's own sheet is, and at which texel. */
struct own {
	struct texel texel;
	struct leads leads;
	int layer; /* -1: not found */
	double strange;
};

/* Of sheets that all but lie on each other the layers tell the order. */
static double noise_of(const struct own *own, const struct eye *eye, int layer)
{
	return layer < own->layer ? eye->noise : own->leads.of[layer].noise;
}

static struct own find_own_at(
	const struct gather *gather, const struct eye *eye, const struct texel *texel)
{
	struct own own = {*texel, leads_at(gather, eye, texel), -1, NOT_FOUND};
	double most = own.leads.alone ? STRANGE_ALONE : STRANGE_MAX;
	for (int i = 0; i < GATHER_LAYERS && eye->receiver->casts; i++) {
		double strange = strangeness(&own.leads.of[i], eye->noise);
		if (strange <= most && strange < own.strange) {
			own.layer = i;
			own.strange = strange;
		}
	}
	return own;
}

static double score_of(const struct own *own, const struct eye *eye)
{
	double most = 0.0;
	if (own->layer < 0)
		return NOT_FOUND;
	for (int i = 0; i < GATHER_LAYERS; i++)
		if (i != own->layer)
			most = fmax(most, doubt(&own->leads.of[i], noise_of(own, eye, i)));
	return own->strange + most;
}

static struct own find_own(const struct gather *gather, const struct eye *eye)
{
	struct texel texel = near_texel(gather, eye, 0);
	struct own own = find_own_at(gather, eye, &texel);
	double best = score_of(&own, eye);
	for (int rank = 1; rank < 4 && eye->receiver->casts && best >= STRANGE_NONE; rank++) {
		texel = near_texel(gather, eye, rank);
		struct own other = find_own_at(gather, eye, &texel);
		double score = score_of(&other, eye);
		if (score < best - STRANGE_GAIN) {
			own = other;
			best = score;
		}
	}
	return own;
}

/* Beside its own sheet the receiver's plane means nothing. */
static struct origin origin_of_layers(
	const struct gather *gather, const struct eye *eye, bool *full)
{
	const struct receiver *receiver = eye->receiver;
	struct own own = find_own(gather, eye);
	struct origin origin = {.at = {own.texel.at[0], own.texel.at[1]},
		.slope = {receiver->slope[0], receiver->slope[1]}};
	double rise = fmin(dot(receiver->slope, own.texel.off), 0.0);
	for (int i = 0; i < GATHER_LAYERS; i++) {
		const struct lead *lead = &own.leads.of[i];
		double noise = noise_of(&own, eye, i);
		origin.winding += i != own.layer && blocks(lead, noise);
		origin.winding_beside += fmin(lead->here, lead->there - rise) > noise;
	}
	*full = origin.winding == GATHER_LAYERS;
	if (!receiver->casts)
		origin.winding_beside = origin.winding;
	return origin;
}

/* The middle of the tile, for receivers behind all that casts there: no layer is looked at. */
static struct origin origin_of_tile(const struct gather *gather, const int at[2])
{
	uint32_t tiles = gather->grid.tiles;
	int winding = edge_tile_winding(&gather->grid.of[(size_t)at[1] * tiles + (size_t)at[0]]);
	return (struct origin){
		.at = {(at[0] + 0.5) / tiles, (at[1] + 0.5) / tiles},
		.winding = winding,
		.winding_beside = winding,
		.of_all = true,
	};
}

/* An end of an edge, beside the receiver. */
struct end {
	double off[2], depth;
	double before; /* depth from the plane parallel to the disc through the receiver */
};

static struct end end_of(const struct eye *eye, const struct edge_vertex *vertex)
{
	const struct receiver *receiver = eye->receiver;
	struct end end = {
		{vertex->x - receiver->at[0], vertex->y - receiver->at[1]}, vertex->depth, 0.0};
	end.before = receiver->depth - end.depth - dot(eye->tilt, end.off);
	return end;
}

/* What the edges sum up to. */
struct sums {
	int winding;
	int own; /* how often the receiver's own sheet begins on the way, less how often it ends */
	double behind;                    /* shares of the disc */
	int8_t sheets[DISC_MASK_SAMPLES]; /* at each sample, beside `winding` */
};

/* Origins are on the raster grid, as ends of edges are. One on an edge or at its end is where
 * rasterisers have it, and edge_winding.h: a little to the right, and less upwards; of half a step.
 */
static const double beside[2] = {1.0 / 128.0, 1.0 / 8192.0};

/* Whether the origin is on the side of the edge's sheet: `side` is, but for `beside`, a whole
 * number of squares of the raster grid. */
static bool has_origin(const double a[2], const double b[2], double side, double snap)
{
	bool runs_down = a[1] != b[1] ? a[1] > b[1] : a[0] < b[0];
	double half = 2.0 * snap * snap;
	return side >= (runs_down ? -half : half);
}

/* Where an end is on the grid that the origin's sheets are told by, beside the receiver: of a
 * texel, where the rasteriser has it. */
static void find_told(const struct eye *eye, const struct end *end, double snap, double told[2])
{
	for (int i = 0; i < 2; i++) {
		double at = eye->receiver->at[i];
		told[i] = floor((at + end->off[i]) / (2.0 * snap) + 0.5) * 2.0 * snap - at;
	}
}

/* Where the way from the origin passes an edge. A sheet begins or ends there that is before the
 * receiver, if the edge is: both before the receiver's plane and before its depth. If it is before
 * one of them it is the receiver's own, which bends on the way. */
static void cross_edge(struct sums *sums, const struct gather *gather, const struct eye *eye,
	const struct origin *origin, const struct end *a, const struct end *b, int sheets)
{
	const struct receiver *receiver = eye->receiver;
	double snap = origin->of_all ? gather->snap : gather->raster_snap;
	double path[2], told_a[2], told_b[2];
	for (int i = 0; i < 2; i++)
		path[i] = receiver->at[i] - origin->at[i] - snap * beside[i];
	find_told(eye, a, snap, told_a);
	find_told(eye, b, snap, told_b);
	double across_a = cross(path, told_a), across_b = cross(path, told_b);
	if ((across_a < 0.0) == (across_b < 0.0))
		return;
	double share = across_a / (across_a - across_b), off[2];
	for (int i = 0; i < 2; i++)
		off[i] = a->off[i] + share * (b->off[i] - a->off[i]);
	double depth = a->depth + share * (b->depth - a->depth);
	double flat = receiver->depth - depth, plane = flat + dot(origin->slope, off);
	double side_origin = cross(told_a, told_b) - across_a + across_b;
	int begun = sheets * ((cross(a->off, b->off) >= 0.0) -
				     has_origin(told_a, told_b, side_origin, snap));
	if (origin->of_all || fmin(flat, plane) > eye->noise)
		sums->winding += begun;
	else if (fmax(flat, plane) >= -eye->noise)
		sums->own += begun;
}

/* The part of an edge that is before the disc, on the disc. */
struct chord {
	double u[2]; /* direction */
	double h;    /* distance from the disc's centre, the sheet's side above 0 */
	double t[2]; /* ends along u, from the foot of the centre */
};

static bool find_chord(
	struct chord *chord, const struct eye *eye, const struct end *a, const struct end *b)
{
	double seen[2][2], along[2];
	const struct end *ends[2] = {a, b};
	for (int end = 0; end < 2; end++) {
		const double *off = ends[end]->off;
		for (int i = 0; i < 2; i++)
			seen[end][i] = off[i] - eye->k * eye->e[i] * dot(eye->e, off);
	}
	for (int i = 0; i < 2; i++)
		along[i] = a->before * seen[1][i] - b->before * seen[0][i];
	double length = sqrt(dot(along, along));
	if (fmax(a->before, b->before) <= 0.0 || length == 0.0)
		return false;
	chord->h = cross(seen[0], seen[1]) / (eye->scale * length);
	if (fabs(chord->h) >= 1.0)
		return false;
	double half = sqrt(1.0 - chord->h * chord->h);
	for (int end = 0; end < 2; end++) {
		chord->u[end] = along[end] / length;
		chord->t[end] = end == 0 ? -half : half;
	}
	/* An end behind the receiver's plane is infinitely far off. */
	if (a->before > 0.0)
		chord->t[0] = fmax(dot(seen[0], chord->u) / (eye->scale * a->before), -half);
	if (b->before > 0.0)
		chord->t[1] = fmin(dot(seen[1], chord->u) / (eye->scale * b->before), half);
	return chord->t[0] < chord->t[1];
}

/* Bits of the samples at angles from a on. */
static int sample_from(double angle)
{
	return (int)ceil(angle * DISC_MASK_SAMPLES / (2.0 * GLM_PI) - 0.5);
}

static uint64_t samples_beyond(const struct gather *gather, double angle, double distance)
{
	double turns = angle / (2.0 * GLM_PI);
	int column = (int)((turns - floor(turns)) * DISC_MASK_ANGLES) % DISC_MASK_ANGLES;
	int row = (int)(distance * DISC_MASK_DISTANCES);
	const uint32_t *words = gather->masks[row * DISC_MASK_ANGLES + column];
	return words[0] | (uint64_t)words[1] << 32;
}

/* Behind an edge is the sector between its ends less the triangle before it. */
static void add_chord(
	struct sums *sums, const struct gather *gather, const struct chord *chord, int sheets)
{
	double h = fabs(chord->h), sign = chord->h >= 0.0 ? 1.0 : -1.0;
	double low = atan2(chord->t[0], h), high = atan2(chord->t[1], h);
	double foot = atan2(-sign * chord->u[0], sign * chord->u[1]);
	sums->behind +=
		sheets * sign * (high - low - (chord->t[1] - chord->t[0]) * h) / (2.0 * GLM_PI);
	int first = sample_from(sign > 0.0 ? foot + low : foot - high);
	int end = sample_from(sign > 0.0 ? foot + high : foot - low);
	uint64_t mask = samples_beyond(gather, foot, h) & disc_mask_sector(first, end);
	for (int i = 0; i < DISC_MASK_SAMPLES; i++)
		if (mask >> i & 1)
			sums->sheets[i] = (int8_t)(sums->sheets[i] - sheets * (int)sign);
}

/* Boxes of runs and their order, which let one leave edges out that have no part in it, are not
 * looked at. */
static void walk(struct sums *sums, const struct gather *gather, const struct eye *eye,
	const struct origin *origin, const struct edge_tile *tile)
{
	for (uint32_t i = 0; i < edge_tile_stretches(&gather->grid, tile); i++) {
		struct edge_stretch stretch = edge_tile_stretch(&gather->grid, tile, i);
		struct end a, b = end_of(eye, &stretch.vertices[0]);
		for (uint32_t k = 1; k <= stretch.edges; k++) {
			struct chord chord;
			a = b;
			b = end_of(eye, &stretch.vertices[k]);
			int sheets = (int)stretch.vertices[k].sheets;
			cross_edge(sums, gather, eye, origin, &a, &b, sheets);
			if (find_chord(&chord, eye, &a, &b))
				add_chord(sums, gather, &chord, sheets > 0 ? sheets : 1);
		}
	}
}

/* Whether a triangle over a hollow counts for the receiver. */
static bool is_over(
	const struct gather *gather, const struct eye *eye, const struct edge_texel *texel)
{
	struct hollow_plane plane;
	memcpy(&plane, texel, sizeof(plane));
	const struct receiver *receiver = eye->receiver;
	double steps = 0.5 / gather->snap, depth = receiver->depth;
	double at = plane.start;
	for (int i = 0; i < 2; i++)
		at += (double)plane.slope[i] * (receiver->at[i] - 0.5) * steps;
	return at > depth * EDGE_DEPTH_STEPS && depth * 65536.0 > plane.near &&
	       depth * 65536.0 < plane.far;
}

static struct end end_of_texel(
	const struct gather *gather, const struct eye *eye, const uint32_t words[2])
{
	const double step = 2.0 * gather->snap;
	uint32_t mask = (1u << EDGE_DEPTH_BITS) - 1;
	uint32_t depth = (words[0] & mask) << EDGE_DEPTH_BITS | (words[1] & mask & ~1u);
	const struct edge_vertex vertex = {
		.x = (float)(0.5 + step * ((int32_t)words[0] >> EDGE_DEPTH_BITS)),
		.y = (float)(0.5 + step * ((int32_t)words[1] >> EDGE_DEPTH_BITS)),
		.depth = (float)depth / EDGE_DEPTH_STEPS,
	};
	return end_of(eye, &vertex);
}

/* Adds the triangles over hollows that count. */
static void add_hollows(struct sums *sums, const struct gather *gather, const struct eye *eye,
	const struct edge_tile *tile)
{
	uint32_t count = edge_tile_hollows(tile);
	const struct edge_texel *texels =
		&gather->grid.texels[gather->grid.hollow_base +
				     HOLLOW_TEXELS * (size_t)edge_tile_first_hollow(tile)];
	for (uint32_t i = 0; i < 3 * count; i++) {
		struct chord chord;
		struct end a = end_of_texel(gather, eye, &texels[i].words[0]);
		struct end b = end_of_texel(gather, eye, &texels[i].words[2]);
		if (is_over(gather, eye, &texels[3 * count + i / 3]) &&
			find_chord(&chord, eye, &a, &b))
			add_chord(sums, gather, &chord, 1);
	}
}

/* How edges that border on other blockers count against those that border on what is free. */
#define INNER_EDGES 1.5

/* Of all blockers together: the share of the samples that any covers, and what the samples missed
 * of the edges as far as those are not hidden in other blockers: edges grow with the roots of what
 * they enclose. */
static double covered(const struct sums *sums)
{
	int any = 0, more = 0, sum = 0;
	for (int i = 0; i < DISC_MASK_SAMPLES; i++) {
		int sheets = sums->winding + sums->sheets[i];
		any += sheets > 0;
		more += sheets > 1 || sheets < 0;
		sum += sheets;
	}
	double outer = sqrt(DISC_MASK_SAMPLES - any), inner = INNER_EDGES * sqrt(more);
	double missed = sums->winding - sums->behind - (double)sum / DISC_MASK_SAMPLES;
	double exposed = more > 0 ? outer / (outer + inner) : 1.0;
	return any / (double)DISC_MASK_SAMPLES + missed * exposed;
}

static double visibility(const void *state, const struct receiver *receiver)
{
	const struct gather *gather = state;
	if (gather->hard != NULL)
		return model_hard.visibility(gather->hard, receiver);
	int at[2];
	for (int i = 0; i < 2; i++) {
		if (!(receiver->at[i] >= 0.0 && receiver->at[i] < 1.0))
			return 1.0;
		at[i] = (int)(receiver->at[i] * gather->grid.tiles);
	}
	const struct edge_tile *tile =
		&gather->grid.of[(size_t)at[1] * gather->grid.tiles + (size_t)at[0]];
	struct eye eye = eye_of(gather, receiver);
	bool full = false;
	struct origin origin = origin_of_layers(gather, &eye, &full);
	bool behind_all = receiver->depth > tile->farthest;
	if (full && receiver->casts && !behind_all)
		return 0.0;
	if (full || behind_all)
		origin = origin_of_tile(gather, at);
	struct sums sums = {.winding = origin.winding};
	if (receiver->depth > tile->nearest)
		walk(&sums, gather, &eye, &origin, tile);
	if (!behind_all)
		add_hollows(&sums, gather, &eye, tile);
	if (sums.own > 0)
		sums.winding += origin.winding_beside - origin.winding;
	if (sums.winding < 0)
		sums.winding = 0;
	return 1.0 - fmin(fmax(covered(&sums), 0.0), 1.0);
}

const struct model_technique model_gather = {
	.name = "gather",
	.state_size = sizeof(struct gather),
	.fits = true,
	.finds_middle = true,
	.init = init,
	.finish = finish,
	.visibility = visibility,
};
