/* SPDX-License-Identifier: MIT */
#include "strip.h"
#include "parts.h"

const struct strip_profile strip_level = {{{0.997f, 0}, {1, 0}}, 2};
const struct strip_profile strip_bent = {{{0.996f, -0.003f}, {0.9985f, 0}, {1, 0}}, 3};
const struct strip_profile strip_falling = {{{0.998f, 0.0005f}, {1, 0}}, 2};

void strip_add(struct sm_scene *scene, const struct strip_profile *profile)
{
	static const struct pose turned = {{1, 1, 1}, 17, {0, 0, 0}};
	static const float slope[][3] = {
		{0.7f, 0.3f, -1}, {0.72f, 0.3f, 1}, {1.05f, -0.05f, -1}, {1.07f, -0.05f, 1}};
	static const uint32_t indices[] = {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5};
	float strip[6][3];
	for (uint32_t i = 0; i < 2 * profile->count; i++) {
		strip[i][0] = profile->at[i / 2][0];
		strip[i][1] = profile->at[i / 2][1];
		strip[i][2] = i % 2 == 0 ? -1 : 1;
	}
	size_t index_count = 6 * (profile->count - 1);
	parts_add_object(scene,
		parts_add_mesh(scene, strip, 2 * profile->count, indices, index_count), PART_BOTH,
		&turned);
	parts_add_object(scene, parts_add_mesh(scene, slope, 4, indices, 6), PART_BOTH, &turned);
	parts_add_light(scene,
		&(struct sm_light_desc){
			.type = SM_LIGHT_DIRECTIONAL, .position = {0, 5, 0}, .radius = 0.005f});
}

struct sm_camera strip_camera(float z)
{
	const float c = 0.956305f, s = 0.292372f; /* of 17 degrees */
	return (struct sm_camera){.eye = {s * z, 0.5f, c * z},
		.target = {c + s * z, 0, c * z - s},
		.up = {0, 1, 0},
		.fov = 1.5f};
}
