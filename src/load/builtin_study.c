/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "load/builtin_scene.h"
#include "load/solid.h"
#include <cglm/cglm.h>
#include <stdlib.h>

/* The scenes were laid out with z up: x right, y away, z up. */
static void from_z_up(float x, float y, float z, float point[3])
{
	glm_vec3_copy((vec3){x, z, -y}, point);
}

static const float steel[3] = {.17f, .31f, .47f};
static const float clay[3] = {.56f, .22f, .12f};
static const float straw[3] = {.67f, .48f, .17f};
static const float moss[3] = {.25f, .38f, .16f};
static const float plum[3] = {.37f, .16f, .30f};
static const float chalk[3] = {.70f, .67f, .60f};

static bool paint(struct sm_object_desc *object, const char *name, const float color[3])
{
	if (object == NULL)
		return false;
	object->name = name;
	glm_vec3_copy((float *)color, object->base_color);
	return true;
}

/** Adds what the study scenes share to their geometry. */
static bool finish_study(struct model *model, const float eye[3], const float target[3])
{
	model->has_camera = true;
	model->camera = (struct sm_camera){.up = {0, 1, 0}, .fov = 40};
	glm_vec3_copy((float *)eye, model->camera.eye);
	glm_vec3_copy((float *)target, model->camera.target);
	model->width = model->height = 512;
	model->ground_size = 60;
	return builtin_add_light(model, &(struct sm_light_desc){
						.name = "key",
						.position = {1.5f, 5.6f, 1.2f},
						.target = {0, .2f, 0},
						.radius = .171945f, /* .03 of the distance */
						.angle = 44,
						.softness = .2f,
						.color = {1, 1, 1},
						.intensity = 1,
					});
}

bool builtin_cylinder(struct model *model)
{
	const float radius = .45f, bottom = -.02f, top = bottom + 1.8f;
	const struct solid_point profile[] = {
		{0, bottom, 0, -1},
		{radius, bottom, 0, -1},
		{radius, bottom, 1, 0},
		{radius, top, 1, 0},
		{radius, top, 0, 1},
		{0, top, 0, 1},
	};
	return model_reserve(model, 1, 1) &&
	       paint(solid_lathe(model, profile, 6, 64), "cylinder", clay) &&
	       finish_study(model, (vec3){-3.2f, 3.6f, 4.2f}, (vec3){-.35f, .4f, -.4f});
}

/** Box with a centre and half sizes along x, y, z (z up), turned about its vertical axis. */
static struct sm_object_desc *turned_box(
	struct model *model, const float center[3], const float half[3], float turn)
{
	float c = cosf(turn), s = sinf(turn);
	vec3 middle, axes[3];
	from_z_up(center[0], center[1], center[2], middle);
	from_z_up(half[0] * c, half[0] * s, 0, axes[0]);
	from_z_up(-half[1] * s, half[1] * c, 0, axes[1]);
	from_z_up(0, 0, half[2], axes[2]);
	return solid_box(model, middle, axes);
}

bool builtin_boxes(struct model *model)
{
	static const struct {
		float center[3], half[3], turn;
		const float *color;
	} boxes[] = {
		{{.15f, -.1f, 1.9f}, {.5f, .35f, .12f}, .35f, straw},
		{{-.35f, .25f, .75f}, {.7f, .5f, .15f}, -.25f, steel},
		{{.9f, .5f, 1.2f}, {.25f, .45f, .1f}, .7f, clay},
	};
	bool ok = model_reserve(model, 3, 3);
	for (int i = 0; ok && i < 3; i++)
		ok = paint(turned_box(model, boxes[i].center, boxes[i].half, boxes[i].turn), "box",
			boxes[i].color);
	return ok && finish_study(model, (vec3){-2.6f, 4.2f, 4.4f}, (vec3){-.2f, .4f, -.3f});
}

bool builtin_fence(struct model *model)
{
	enum { POSTS = 14, RAILS = 3 };
	static const float post[3] = {.03f, .03f, .71f}, rail[3] = {1.4f, .02f, .03f};
	bool ok = model_reserve(model, POSTS + RAILS, POSTS + RAILS);
	for (int i = 0; ok && i < POSTS; i++) {
		const float center[3] = {-1.3f + .2f * (float)i, 0, .69f};
		ok = paint(turned_box(model, center, post, 0), "post", straw);
	}
	for (int i = 0; ok && i < RAILS; i++) {
		const float center[3] = {0, 0, .3f + .45f * (float)i};
		ok = paint(turned_box(model, center, rail, 0), "rail", straw);
	}
	return ok && finish_study(model, (vec3){-2.2f, 3.6f, 4.2f}, (vec3){-.35f, .2f, -.2f});
}

/** (2,3) torus knot: twice about the axis, three times about the tube. */
static void knot_curve(float t, float point[3])
{
	const float scale = .36f;
	float reach = scale * (cosf(3 * t) + 2);
	from_z_up(reach * cosf(2 * t), reach * sinf(2 * t), -scale * sinf(3 * t), point);
}

static bool knot_of(struct model *model, uint32_t segments, uint32_t sides)
{
	return model_reserve(model, 1, 1) &&
	       paint(solid_tube(model, (vec3){0, 1.2f, 0}, knot_curve, .15f, segments, sides),
		       "knot", steel) &&
	       finish_study(model, (vec3){-2.2f, 3.6f, 4.2f}, (vec3){-.2f, .4f, -.2f});
}

bool builtin_knot(struct model *model)
{
	return knot_of(model, 256, 24);
}

bool builtin_sized_knot(struct model *model, uint32_t triangles)
{
	/* 2 a quad, in the proportions of the above. */
	float quads = (float)triangles / 2;
	float sides = fmaxf(3, roundf(sqrtf(quads * 24 / 256)));
	return knot_of(model, (uint32_t)fmaxf(3, roundf(quads / sides)), (uint32_t)sides);
}

/** xorshift32 (Marsaglia 2003, "Xorshift RNGs"); its upper 24 bits as a number in [0, 1). */
static float next_random(uint32_t *state)
{
	*state ^= *state << 13;
	*state ^= *state >> 17;
	*state ^= *state << 5;
	return (float)(*state >> 8) / 16777216;
}

enum { SPIKES = 40 };

/* In double: the exponent magnifies the rounding of directions 60 times. */
static float urchin_radius(const void *data, const float direction[3])
{
	const double(*spikes)[3] = data;
	double radius = .5;
	for (int i = 0; i < SPIKES; i++) {
		double cosine = 0;
		for (int k = 0; k < 3; k++)
			cosine += (double)direction[k] * spikes[i][k];
		radius += .5 * exp(-60 * (1 - cosine));
	}
	return (float)radius;
}

static void place_spikes(double spikes[SPIKES][3])
{
	const double golden_angle = 2.399963; /* spreads the azimuths evenly */
	uint32_t random = 7;
	for (int i = 0; i < SPIKES; i++) {
		double z = 1 - 2 * (i + .5) / SPIKES, level = sqrt(1 - z * z);
		double azimuth = golden_angle * i + .4 * (double)next_random(&random);
		spikes[i][0] = level * cos(azimuth);
		spikes[i][1] = z;
		spikes[i][2] = -level * sin(azimuth);
	}
}

static bool finish_urchin(struct model *model, struct sm_object_desc *object)
{
	return paint(object, "urchin", plum) &&
	       finish_study(model, (vec3){-2.2f, 3.6f, 4.2f}, (vec3){-.2f, .5f, -.2f});
}

bool builtin_urchin(struct model *model)
{
	double spikes[SPIKES][3];
	vec3 center;
	place_spikes(spikes);
	from_z_up(.1f, -.1f, 1.1f, center);
	return model_reserve(model, 1, 1) &&
	       finish_urchin(model, solid_icosphere(model, center, 5, urchin_radius, spikes));
}

bool builtin_sized_urchin(struct model *model, uint32_t triangles)
{
	double spikes[SPIKES][3];
	vec3 center;
	place_spikes(spikes);
	from_z_up(.1f, -.1f, 1.1f, center);
	uint32_t splits = (uint32_t)roundf(sqrtf((float)triangles / 8));
	return model_reserve(model, 1, 1) &&
	       finish_urchin(model, solid_octasphere(model, center, splits, urchin_radius, spikes));
}

static void random_vector(uint32_t *random, vec3 vector)
{
	for (int i = 0; i < 3; i++)
		vector[i] = next_random(random) - .5f;
}

/** A thin slab, anywhere in a block about (0, 0, 1.3), turned any way. */
static struct solid_box_desc random_slab(uint32_t *random, float scale)
{
	struct solid_box_desc box;
	vec3 center, first, second, axes[3];
	random_vector(random, center);
	random_vector(random, first);
	random_vector(random, second);
	glm_vec3_normalize_to(first, axes[0]);
	glm_vec3_crossn(axes[0], second, axes[1]);
	glm_vec3_cross(axes[0], axes[1], axes[2]);
	glm_vec3_scale(axes[0], .12f * (.4f + next_random(random)), axes[0]);
	glm_vec3_scale(axes[1], .12f * (.4f + next_random(random)), axes[1]);
	glm_vec3_scale(axes[2], .018f, axes[2]);
	for (int i = 0; i < 3; i++) {
		from_z_up(axes[i][0], axes[i][1], axes[i][2], box.half_axes[i]);
		glm_vec3_scale(box.half_axes[i], scale, box.half_axes[i]);
	}
	from_z_up(2.4f * center[0], 2 * center[1], 1.3f + 2 * center[2], box.center);
	return box;
}

enum { SLABS = 160 };

static bool finish_debris(struct model *model)
{
	return finish_study(model, (vec3){-2.2f, 3.6f, 4.2f}, (vec3){-.35f, .2f, -.2f});
}

bool builtin_debris(struct model *model)
{
	static const float *const colors[] = {clay, straw, chalk, steel, moss};
	uint32_t random = 11;
	bool ok = model_reserve(model, SLABS, SLABS);
	for (int i = 0; ok && i < SLABS; i++) {
		struct solid_box_desc slab = random_slab(&random, 1);
		ok = paint(solid_boxes(model, &slab, 1), "slab", colors[i % 5]);
	}
	return ok && finish_debris(model);
}

bool builtin_sized_debris(struct model *model, uint32_t triangles)
{
	uint32_t random = 11, count = (triangles + 6) / 12;
	/* As dense as the above. */
	float scale = cbrtf((float)SLABS / (float)count);
	struct solid_box_desc *slabs = array_alloc(count, sizeof(*slabs));
	if (slabs == NULL)
		return false;
	for (uint32_t i = 0; i < count; i++)
		slabs[i] = random_slab(&random, scale);
	bool ok = model_reserve(model, 1, 1) &&
		  paint(solid_boxes(model, slabs, count), "slabs", clay) && finish_debris(model);
	free(slabs);
	return ok;
}
