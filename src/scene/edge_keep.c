/* SPDX-License-Identifier: MIT */
#include "scene/edge_keep.h"
#include "base/array.h"
#include "scene/light_reach.h"
#include <assert.h>
#include <stdlib.h>

void edge_keep_finish(struct edge_keep *keep)
{
	object_watch_finish(&keep->watch);
	free(keep->parts);
	free(keep->before);
	free(keep->hollows_before);
	*keep = (struct edge_keep){0};
}

void edge_keep_forget(struct edge_keep *keep)
{
	object_watch_forget(&keep->watch);
	keep->looked = false;
}

static bool is_caster(const struct object *object)
{
	return object->casts;
}

/* What a search is for. */
struct search {
	struct edge_keep *keep;
	struct edge_chains *chains;
	struct tile_depths *depths;
	const struct sm_scene *scene;
	const struct light_frame *frame;
	struct screen_box cast, received; /* where depths are found anew */
};

/* A box of which a corner is before the near plane counts for all tiles, as deep as can be. */
static struct screen_box find_reach(const struct search *search, const struct object *object)
{
	const struct mesh *mesh = &search->scene->meshes[object->mesh];
	vec4 *transform = (vec4 *)object->transform, *world_to_clip;
	struct screen_box box;
	mat4 to_clip;
	world_to_clip = (vec4 *)search->frame->world_to_clip;
	glm_mat4_mul(world_to_clip, transform, to_clip);
	if (!mesh_beyond_near(mesh, to_clip))
		return screen_box_all();
	mesh_screen_box(mesh, transform, world_to_clip, &box);
	return box;
}

/* Where depths change: where what has changed was, and is. */
static void find_changes(struct search *search)
{
	search->cast = search->received = screen_box_none();
	for (size_t i = 0; i < search->scene->object_count; i++) {
		const struct object *object = &search->scene->objects[i];
		struct edge_part *part = &search->keep->parts[i];
		if (!search->keep->watch.objects[i].changed)
			continue;
		struct screen_box changed =
			i < search->keep->known ? part->reach : screen_box_none();
		part->reach = find_reach(search, object);
		screen_box_add(&changed, &part->reach);
		if (object->casts)
			screen_box_add(&search->cast, &changed);
		if (object->receives)
			screen_box_add(&search->received, &changed);
	}
}

static void count_casters(struct edge_keep *keep)
{
	keep->caster_count = keep->kept_count = 0;
	for (size_t i = 0; i < keep->watch.count; i++) {
		const struct watched_object *object = &keep->watch.objects[i];
		keep->caster_count += object->shown;
		keep->kept_count += object->shown && !object->changed;
	}
}

/* Has the points that some are kept of out of the way. */
static void set_aside(struct edge_keep *keep, struct edge_chains *chains)
{
	struct chain_point *points = chains->points;
	struct chain_hollow *hollows = chains->hollows;
	size_t capacity = chains->point_capacity, hollow_capacity = chains->hollow_capacity;
	edge_chains_clear(chains);
	count_casters(keep);
	if (keep->kept_count == 0) {
		free(keep->before);
		free(keep->hollows_before);
		keep->before = NULL;
		keep->hollows_before = NULL;
		keep->before_capacity = keep->hollow_capacity = 0;
		return;
	}
	chains->points = keep->before;
	chains->point_capacity = keep->before_capacity;
	chains->hollows = keep->hollows_before;
	chains->hollow_capacity = keep->hollow_capacity;
	keep->before = points;
	keep->before_capacity = capacity;
	keep->hollows_before = hollows;
	keep->hollow_capacity = hollow_capacity;
}

/* Adds a caster's chains, kept or found anew. view: of one that is seen; else NULL. */
static bool add_chains(struct search *search, size_t index, const struct caster_view *view)
{
	struct edge_chains *chains = search->chains;
	const struct edge_raster *raster = &search->keep->raster;
	struct edge_part *part = &search->keep->parts[index];
	size_t first = chains->count, edges = chains->edge_count, hollows = chains->hollow_count;
	bool added = search->keep->watch.objects[index].changed
			     ? edge_chains_add(chains, view, raster->screen, raster->step)
			     : edge_chains_keep(chains, search->keep->before + part->first,
				       part->count, part->edge_count) &&
				       edge_chains_keep_hollows(chains,
					       search->keep->hollows_before + part->first_hollow,
					       part->hollow_count);
	if (!added)
		return false;
	part->first = first;
	part->count = chains->count - first;
	part->edge_count = chains->edge_count - edges;
	part->first_hollow = hollows;
	part->hollow_count = chains->hollow_count - hollows;
	return true;
}

static bool add_caster(struct search *search, size_t index)
{
	struct edge_keep *keep = search->keep;
	const struct object *object = &search->scene->objects[index];
	struct caster_view view;
	bool deep = keep->watch.objects[index].changed ||
		    screen_box_touches(&keep->parts[index].reach, &search->cast);
	if (deep && !edge_chains_see(search->chains, search->scene, object, search->frame, &view))
		return false;
	return add_chains(search, index, deep ? &view : NULL) &&
	       (!deep || tile_depths_add_caster(search->depths, search->scene, object, &view,
				 keep->raster.margin));
}

/* Those that cast as well, or those that do not. */
static bool add_receivers(struct search *search, bool casting)
{
	for (size_t i = 0; i < search->scene->object_count; i++) {
		const struct object *object = &search->scene->objects[i];
		if (object->receives && object->casts == casting &&
			screen_box_touches(&search->keep->parts[i].reach, &search->received) &&
			!tile_depths_add_receiver(
				search->depths, search->scene, object, search->frame))
			return false;
	}
	return true;
}

/* All of them, where nothing is known. */
static void clear_depths(struct search *search)
{
	if (search->keep->known == 0)
		search->cast = search->received = screen_box_all();
	search->cast = tile_depths_clear_casters(
		search->depths, &search->cast, search->keep->raster.margin);
	search->received = tile_depths_clear_receivers(search->depths, &search->received);
}

static bool find(struct search *search)
{
	struct edge_keep *keep = search->keep;
	if (!array_reserve((void **)&keep->parts, &keep->part_capacity, search->scene->object_count,
		    sizeof(*keep->parts)))
		return false;
	find_changes(search);
	clear_depths(search);
	set_aside(keep, search->chains);
	for (size_t i = 0; i < search->scene->object_count; i++)
		if (search->scene->objects[i].casts && !add_caster(search, i))
			return false;
	/* What only receives is mostly ground, and casters before it are quickly done with. */
	return add_receivers(search, false) && add_receivers(search, true);
}

static bool is_same_raster(const struct edge_raster *a, const struct edge_raster *b)
{
	return a->tiles == b->tiles && a->screen == b->screen && a->step == b->step &&
	       a->margin == b->margin;
}

bool edge_keep_look(struct edge_keep *keep, const struct sm_scene *scene,
	const struct light_frame *frame, const struct edge_raster *raster)
{
	/* What an earlier look has seen change, no search has found. */
	if (keep->looked || !is_same_raster(&keep->raster, raster))
		edge_keep_forget(keep);
	keep->raster = *raster;
	keep->known = keep->watch.count;
	struct disc_box changed;
	keep->looked = object_watch_look(&keep->watch, scene, frame, is_caster, &changed);
	keep->changed = changed.box;
	if (keep->looked && screen_box_is_all(&keep->changed))
		keep->known = 0;
	return keep->looked;
}

bool edge_keep_find(struct edge_keep *keep, struct edge_chains *chains, struct tile_depths *depths,
	const struct sm_scene *scene, const struct light_frame *frame)
{
	struct search search = {keep, chains, depths, scene, frame, {{0}, {0}}, {{0}, {0}}};
	assert(keep->looked);
	bool found = tile_depths_reserve(depths, scene, keep->raster.tiles) && find(&search);
	keep->looked = false;
	if (!found)
		edge_keep_forget(keep);
	return found;
}

size_t edge_keep_bytes(const struct edge_keep *keep)
{
	return keep->watch.capacity * sizeof(*keep->watch.objects) +
	       keep->part_capacity * sizeof(*keep->parts) +
	       keep->before_capacity * sizeof(*keep->before) +
	       keep->hollow_capacity * sizeof(*keep->hollows_before);
}
