/* SPDX-License-Identifier: MIT */
#include "gles/storage.h"
#include "base/array.h"
#include <assert.h>
#include <stdlib.h>

#define CAPACITY_MIN 64 /* a power of two */

const char *storage_owner_name(enum storage_owner owner)
{
	static const char *const names[STORAGE_OWNERS] = {
		[STORAGE_SHADOW_MAPS] = "shadow maps",
		[STORAGE_PLAIN_DEPTHS] = "plain depths of shadow maps",
		[STORAGE_RECEIVER_MAPS] = "receiver maps",
		[STORAGE_SMOOTHIES] = "smoothie buffers",
		[STORAGE_SMOOTHIE_DEPTHS] = "depths of smoothie buffers",
		[STORAGE_MOMENTS] = "moments",
		[STORAGE_BLUR] = "half-blurred moments",
		[STORAGE_LAYERS] = "layers",
		[STORAGE_LAYER_DEPTHS] = "depths of layers",
		[STORAGE_POINTS] = "points of the view",
		[STORAGE_CELLS] = "cells of the view",
		[STORAGE_RECEIVERS] = "receivers of the view",
		[STORAGE_FOUND] = "visibility of the view",
		[STORAGE_ACCUMULATOR] = "accumulator",
		[STORAGE_EXACT_CASTERS] = "integers: shadow map",
		[STORAGE_EXACT_RECEIVERS] = "integers: receiver map",
		[STORAGE_EXACT_NEAREST] = "integers: depths of smoothies",
		[STORAGE_EXACT_LEAST] = "integers: alphas of smoothies",
		[STORAGE_EXACT_SEEN] = "integers: visibility of the view",
		[STORAGE_PROBES] = "probes",
		[STORAGE_PRIMITIVES] = "integers: primitives",
		[STORAGE_EDGE_LISTS] = "edge lists",
		[STORAGE_FINS] = "fins",
		[STORAGE_QUADS] = "indices of quads",
		[STORAGE_TABLES] = "tables",
		[STORAGE_SURFACES] = "meshes as drawn",
		[STORAGE_CASTERS] = "casters",
		[STORAGE_IMAGES] = "images",
	};
	return names[owner];
}

/* Names are numbers in a row with most drivers: so are their slots. */
static size_t home(const struct storages *storages, GLuint name, enum storage_kind kind)
{
	return (2 * (size_t)name + (size_t)kind) & (storages->capacity - 1);
}

static size_t next(const struct storages *storages, size_t slot)
{
	return (slot + 1) & (storages->capacity - 1);
}

void storages_add(struct storages *storages, const struct storage *storage)
{
	assert(storage->name != 0 && storages->count < storages->capacity);
	size_t slot = home(storages, storage->name, storage->kind);
	while (storages->slots[slot].name != 0)
		slot = next(storages, slot);
	storages->slots[slot] = *storage;
	storages->count++;
}

bool storages_reserve(struct storages *storages)
{
	/* Never more than half full, so that a search ends soon. */
	if (2 * (storages->count + 1) <= storages->capacity)
		return true;
	struct storages grown = {
		.capacity = storages->capacity > 0 ? 2 * storages->capacity : CAPACITY_MIN};
	grown.slots = array_zalloc(grown.capacity, sizeof(*grown.slots));
	if (grown.slots == NULL)
		return false;
	for (size_t i = 0; i < storages->capacity; i++)
		if (storages->slots[i].name != 0)
			storages_add(&grown, &storages->slots[i]);
	free(storages->slots);
	*storages = grown;
	return true;
}

struct storage *storages_find(const struct storages *storages, GLuint name, enum storage_kind kind)
{
	size_t slot = home(storages, name, kind);
	while (storages->slots[slot].name != name || storages->slots[slot].kind != kind) {
		assert(storages->slots[slot].name != 0);
		slot = next(storages, slot);
	}
	return &storages->slots[slot];
}

void storages_remove(struct storages *storages, GLuint name, enum storage_kind kind)
{
	struct storage *slots = storages->slots;
	size_t mask = storages->capacity - 1;
	size_t gap = (size_t)(storages_find(storages, name, kind) - slots);
	/* What follows moves up, unless that would be before its home. */
	for (size_t i = next(storages, gap); slots[i].name != 0; i = next(storages, i)) {
		size_t at = home(storages, slots[i].name, slots[i].kind);
		if (((i - at) & mask) < ((i - gap) & mask))
			continue;
		slots[gap] = slots[i];
		gap = i;
	}
	slots[gap] = (struct storage){0};
	storages->count--;
}

void storages_finish(struct storages *storages)
{
	free(storages->slots);
	*storages = (struct storages){0};
}

uint64_t storages_bytes(const struct storages *storages, enum storage_owner owner, uint32_t light)
{
	uint64_t bytes = 0;
	for (size_t i = 0; i < storages->capacity; i++) {
		const struct storage *storage = &storages->slots[i];
		if (storage->name != 0 && storage->owner == owner && storage->light == light)
			bytes += storage->bytes;
	}
	return bytes;
}

uint64_t storages_targets(const struct storages *storages)
{
	uint64_t bytes = 0;
	for (size_t i = 0; i < storages->capacity; i++)
		if (storages->slots[i].owner < STORAGE_TARGETS_END)
			bytes += storages->slots[i].bytes;
	return bytes;
}

static uint64_t texel_bytes(GLenum internal_format)
{
	switch (internal_format) {
	case GL_R8:
		return 1;
	case GL_R16F:
	case GL_R16UI:
		return 2;
	case GL_RGBA16F:
	case GL_RG32F:
	case GL_RG32UI:
		return 8;
	case GL_RGBA32F:
	case GL_RGBA32I:
	case GL_RGBA32UI:
		return 16;
	default:
		return 4;
	}
}

uint64_t texture_bytes(GLenum internal_format, GLsizei width, GLsizei height, GLsizei levels)
{
	uint64_t texels = 0;
	for (GLsizei i = 0; i < levels; i++) {
		texels += (uint64_t)width * (uint64_t)height;
		width = width > 1 ? width / 2 : 1;
		height = height > 1 ? height / 2 : 1;
	}
	return texel_bytes(internal_format) * texels;
}
