/* SPDX-License-Identifier: MIT */
#ifndef REF_CONTENT_ID_H
#define REF_CONTENT_ID_H

#include "ref/reference.h"

/** What content is known by: a hash of 128 bits (FNV-1a: draft-eastlake-fnv), most significant word
 *  first. */
struct content_id {
	uint64_t words[2];
};

struct content_id content_id_of_bytes(const void *bytes, size_t size);

/** Of all that a reference follows from, with what the request leaves open filled in; of the scene,
 *  what rays can meet. */
struct content_id content_id_of_request(const struct reference_request *request);

#endif
