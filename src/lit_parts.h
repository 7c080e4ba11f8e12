/* SPDX-License-Identifier: MIT */
#ifndef LIT_PARTS_H
#define LIT_PARTS_H

#include "geom/lit_triangles.h"
#include "need.h"
#include "technique/technique.h"

/** A mesh's triangles by what they need, as indices in a buffer. */
struct lit_list {
	bool drawable;                               /* else there is none, so far or at all */
	GLuint buffer;                               /* kept for the next list */
	size_t first[NEED_COUNT], count[NEED_COUNT]; /* indices */
};

/** Of a light that stays as it is, with all that casts, which triangles nothing is in front of:
 * some are looked at in each frame, and drawn without look-ups from then on. Zero is empty. */
struct lit_parts {
	enum {
		LIT_UNSEEN,
		LIT_SEEN,
		LIT_GATHERED, /* what casts is, for the search */
		LIT_SEARCHED,
		LIT_DONE
	} state;
	struct lit_list *lists; /* of objects; owned */
	size_t list_count, list_capacity;
	/* What the search works with, until it is done: */
	struct lit_search search;
	size_t object, triangle; /* to go on with */
	size_t fin;
	size_t needy, found; /* of the object's triangles that need look-ups, those that do not */
	size_t visits;       /* of shapes, for the object */
	uint8_t *needs;      /* enum need of the object's triangles; owned */
	uint8_t *averted;    /* of its vertices; owned */
	uint32_t *indices;   /* sorted; owned */
	size_t need_capacity, averted_capacity, index_capacity;
};

void lit_parts_finish(struct lit_parts *parts, struct gl *gl);

/** What has been found is of a light as it is no more. */
void lit_parts_forget(struct lit_parts *parts);

/** What it is found from: of one light, as its technique has drawn it. */
struct lit_request {
	const struct sm_scene *scene;
	const struct light_frame *frame;
	const struct technique *technique; /* that has texels_around */
	void *state;
	const struct need_map *needs;
	uint32_t map_size;
};

/** To be called once a frame: goes on by some triangles, or starts anew. Fails (MACHINE) for want
 * of memory. */
bool lit_parts_find_more(struct lit_parts *parts, struct gpu *gpu,
	const struct lit_request *request, struct sm_error *error);

/** Of the scene's object of that index; NULL: none. */
const struct lit_list *lit_parts_list(const struct lit_parts *parts, size_t object);

/** Of the processor's memory. */
size_t lit_parts_bytes(const struct lit_parts *parts);

#endif
