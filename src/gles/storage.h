/* SPDX-License-Identifier: MIT */
#ifndef GLES_STORAGE_H
#define GLES_STORAGE_H

#include "base/error.h"
#include <GLES3/gl3.h>

/** What a texture or buffer is for. */
enum storage_owner {
	STORAGE_SHADOW_MAPS,
	STORAGE_PLAIN_DEPTHS,
	STORAGE_RECEIVER_MAPS,
	STORAGE_SMOOTHIES,
	STORAGE_SMOOTHIE_DEPTHS,
	STORAGE_MOMENTS,
	STORAGE_BLUR,
	STORAGE_LAYERS,
	STORAGE_LAYER_DEPTHS,
	STORAGE_POINTS,
	STORAGE_CELLS,
	STORAGE_RECEIVERS,
	STORAGE_FOUND,
	STORAGE_ACCUMULATOR,
	STORAGE_EXACT_CASTERS,
	STORAGE_EXACT_RECEIVERS,
	STORAGE_EXACT_NEAREST,
	STORAGE_EXACT_LEAST,
	STORAGE_EXACT_SEEN,
	STORAGE_PROBES,
	STORAGE_TARGETS_END, /* all before are drawn into */
	STORAGE_PRIMITIVES = STORAGE_TARGETS_END,
	STORAGE_EDGE_LISTS,
	STORAGE_FINS,
	STORAGE_QUADS,
	STORAGE_TABLES,
	STORAGE_SURFACES,
	STORAGE_CASTERS,
	STORAGE_IMAGES,
	STORAGE_OWNERS
};

const char *storage_owner_name(enum storage_owner owner);

enum storage_kind { STORAGE_BUFFER, STORAGE_TEXTURE };

/** One texture or buffer. */
struct storage {
	GLuint name; /* 0: none */
	enum storage_kind kind;
	enum storage_owner owner;
	uint32_t light; /* that it serves alone; SM_NONE: none */
	uint64_t bytes;
};

/** All textures and buffers there are: a hash table. Zero is empty. */
struct storages {
	struct storage *slots; /* owned */
	size_t count, capacity;
};

/** So that add() succeeds once more. False: out of memory. */
bool storages_reserve(struct storages *storages);
void storages_add(struct storages *storages, const struct storage *storage);
/** One that was added, until the next add() or remove(). */
struct storage *storages_find(const struct storages *storages, GLuint name, enum storage_kind kind);
void storages_remove(struct storages *storages, GLuint name, enum storage_kind kind);
void storages_finish(struct storages *storages);

/** Of one owner's for one light, or for none (SM_NONE). */
uint64_t storages_bytes(const struct storages *storages, enum storage_owner owner, uint32_t light);

/** Of all that is drawn into. */
uint64_t storages_targets(const struct storages *storages);

/** Of a texture of that many levels, one layer. */
uint64_t texture_bytes(GLenum internal_format, GLsizei width, GLsizei height, GLsizei levels);

#endif
