/* SPDX-License-Identifier: MIT */
#include "gles/probe.h"
#include "gles/target.h"
#include <stdio.h>

static GLenum format_of(enum cap cap)
{
	switch (cap) {
	case CAP_MIN_RG32F:
	case CAP_RENDER_RG32F:
		return GL_RG32F;
	case CAP_MIN_RGB10_A2:
		return GL_RGB10_A2;
	default:
		return GL_RG16F;
	}
}

static void probe(struct gpu *gpu, enum cap cap)
{
	struct target target;
	bool complete =
		target_init(&target, &gpu->gl, 1, format_of(cap), GL_COLOR_ATTACHMENT0, NULL);
	target_finish(&target, &gpu->gl);
	caps_note(&gpu->caps, cap, complete, "a target of it is %s",
		complete ? "complete" : "incomplete");
}

bool gpu_has(struct gpu *gpu, enum cap cap)
{
	const struct cap_finding *finding = &gpu->caps.found[cap];
	if (!finding->known && !caps_rule_out(&gpu->caps, cap))
		probe(gpu, cap);
	return finding->there;
}

void probe_describe(struct gpu *gpu, sm_fact fact, void *data)
{
	for (enum cap cap = 0; cap < CAP_COUNT; cap++) {
		char key[64], value[128];
		bool there = gpu_has(gpu, cap);
		snprintf(key, sizeof(key), "cap %s", cap_name(cap));
		snprintf(value, sizeof(value), "%s: %s", there ? "yes" : "no",
			gpu->caps.found[cap].why);
		fact(data, key, value);
	}
}
