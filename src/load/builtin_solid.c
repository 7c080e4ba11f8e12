/* SPDX-License-Identifier: MIT */
#include "load/builtin_scene.h"
#include "load/solid.h"
#include <cglm/cglm.h>

static const float middle[3] = {0, .5f, 0};

struct sm_object_desc *builtin_cube(struct model *model)
{
	static const float half_axes[3][3] = {{.5f, 0, 0}, {0, .5f, 0}, {0, 0, .5f}};
	return solid_box(model, middle, half_axes);
}

static float half(const void *data, const float direction[3])
{
	(void)data;
	(void)direction;
	return .5f;
}

struct sm_object_desc *builtin_sphere(struct model *model)
{
	return solid_icosphere(model, middle, 4, half, NULL);
}

struct sm_object_desc *builtin_icosahedron(struct model *model)
{
	return solid_icosphere(model, middle, 0, half, NULL);
}

struct sm_object_desc *builtin_pillar(struct model *model)
{
	static const struct solid_point profile[] = {{0, 0, 0, -1}, {.5f, 0, 0, -1}, {.5f, 0, 1, 0},
		{.5f, 1, 1, 0}, {.5f, 1, 0, 1}, {0, 1, 0, 1}};
	return solid_lathe(model, profile, 6, 64);
}

struct sm_object_desc *builtin_cone(struct model *model)
{
	/* The side runs from (.5, 0) to (0, 1): its normal is (2, 1) / sqrt(5). */
	static const float nr = .894427f, ny = .447214f;
	const struct solid_point profile[] = {
		{0, 0, 0, -1}, {.5f, 0, 0, -1}, {.5f, 0, nr, ny}, {0, 1, nr, ny}};
	return solid_lathe(model, profile, 4, 64);
}

struct sm_object_desc *builtin_torus(struct model *model)
{
	enum { BANDS = 24 };
	const float tube = .15f, ring = .5f - tube;
	struct solid_point profile[2 * BANDS];
	for (int i = 0; i < 2 * BANDS; i++) {
		float angle = 2 * GLM_PIf * (float)((i + 1) / 2 % BANDS) / BANDS;
		float c = cosf(angle), s = sinf(angle);
		profile[i] = (struct solid_point){ring + tube * c, tube + tube * s, c, s};
	}
	return solid_lathe(model, profile, 2 * BANDS, 40);
}

/** Belly and neck of the vase: its radius is .28 + .15 sin(5.5 y + .2), and smooth with it. */
static struct solid_point vase_wall(float y)
{
	float slope = .825f * cosf(5.5f * y + .2f);
	float length = sqrtf(1 + slope * slope);
	return (struct solid_point){
		.28f + .15f * sinf(5.5f * y + .2f), y, 1 / length, -slope / length};
}

struct sm_object_desc *builtin_vase(struct model *model)
{
	enum { BANDS = 12, CAPS = 2 };
	struct solid_point profile[2 * (BANDS + CAPS)];
	/* Each once: a compiler's own sine may differ from the library's in the last bit, and the
	 * parts would not meet. */
	struct solid_point wall[BANDS + 1];
	for (int i = 0; i <= BANDS; i++)
		wall[i] = vase_wall((float)i / BANDS);
	struct solid_point *point = profile;
	*point++ = (struct solid_point){0, 0, 0, -1};
	*point++ = (struct solid_point){wall[0].radius, 0, 0, -1};
	for (int i = 0; i < BANDS; i++) {
		*point++ = wall[i];
		*point++ = wall[i + 1];
	}
	*point++ = (struct solid_point){wall[BANDS].radius, 1, 0, 1};
	*point++ = (struct solid_point){0, 1, 0, 1};
	return solid_lathe(model, profile, 2 * (BANDS + CAPS), 48);
}
