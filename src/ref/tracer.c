/* SPDX-License-Identifier: MIT */
#include "ref/tracer.h"
#include "base/array.h"
#include "base/error.h"
#include "ref/vector.h"
#include "scene/scene.h"
#include <float.h>
#include <stdlib.h>

/* As many rays as AVX2 takes at once. */
#define PACKET 8

/* An object with its triangles in the tracer's space. */
struct body {
	const float (*vertices)[3]; /* Embree's */
	const uint32_t *indices;    /* the mesh's */
	bool receives, single_sided;
	bool mirrored; /* faces the side from which its corners are seen clockwise */
};

struct shadow_context {
	struct RTCIntersectContext embree; /* first, as Embree hands on a pointer to it */
	const struct surface *surface;
};

struct sight_context {
	struct RTCIntersectContext embree;
	const double *direction;
};

static void to_world(const struct object *object, const float local[3], double world[3])
{
	for (int i = 0; i < 3; i++) {
		world[i] = object->transform[3][i];
		for (int k = 0; k < 3; k++)
			world[i] += (double)object->transform[k][i] * local[k];
	}
}

static bool is_mirrored(const struct object *object)
{
	double columns[3][3], cross[3];
	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++)
			columns[k][i] = object->transform[k][i];
	vector_cross(columns[0], columns[1], cross);
	return vector_dot(cross, columns[2]) < 0.0;
}

/* Middle and scale of the tracer's space. */
static void fit(struct tracer *tracer, const struct sm_scene *scene)
{
	double min[3] = {DBL_MAX, DBL_MAX, DBL_MAX}, max[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct mesh *mesh = &scene->meshes[scene->objects[i].mesh];
		for (size_t v = 0; v < mesh->vertex_count; v++) {
			double world[3];
			to_world(&scene->objects[i], mesh->positions[v], world);
			for (int axis = 0; axis < 3; axis++) {
				min[axis] = fmin(min[axis], world[axis]);
				max[axis] = fmax(max[axis], world[axis]);
			}
		}
	}
	double half = 0.0;
	for (int axis = 0; axis < 3 && scene->object_count > 0; axis++) {
		tracer->middle[axis] = min[axis] / 2.0 + max[axis] / 2.0;
		half = fmax(half, max[axis] / 2.0 - min[axis] / 2.0);
	}
	int exponent = 0;
	/* Without an extent any scale will do. */
	if (half > 0.0)
		frexp(half, &exponent);
	tracer->scale = ldexp(1.0, -exponent);
}

static void place(const struct tracer *tracer, const double world[3], double point[3])
{
	vector_subtract(world, tracer->middle, point);
	vector_scale(point, tracer->scale);
}

void tracer_place(const struct tracer *tracer, const float world[3], double point[3])
{
	place(tracer, (double[3]){world[0], world[1], world[2]}, point);
}

static void triangle_corners(const struct body *body, unsigned int triangle, double corners[3][3])
{
	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++)
			corners[k][i] =
				body->vertices[body->indices[3 * (size_t)triangle + (size_t)k]][i];
}

/* Not of unit length. */
static void triangle_normal(const double corners[3][3], double normal[3])
{
	double u[3], v[3];
	vector_subtract(corners[1], corners[0], u);
	vector_subtract(corners[2], corners[0], v);
	vector_cross(u, v, normal);
}

/* RTCHitN_primID() of the headers is C++; they describe the arrays of a hit of N rays. */
static unsigned int hit_triangle(const struct RTCFilterFunctionNArguments *args, unsigned int ray)
{
	const unsigned int *words = (const unsigned int *)(const void *)args->hit;
	return words[5 * args->N + ray];
}

/* Lets sight through the backs of single-sided objects. */
static void skip_back(const struct RTCFilterFunctionNArguments *args)
{
	const struct body *body = args->geometryUserPtr;
	const struct sight_context *context = (const struct sight_context *)args->context;
	double corners[3][3], normal[3];
	triangle_corners(body, hit_triangle(args, 0), corners);
	triangle_normal((const double(*)[3])corners, normal);
	double along = vector_dot(normal, context->direction);
	if (body->mirrored ? along < 0.0 : along > 0.0)
		args->valid[0] = 0;
}

/*
 * Whether a triangle has nothing above the plane of a surface, and so cannot hide what is all above
 * it. It is then the surface's own, one in the same plane, or around a convex edge, and was hit for
 * Embree's rounding alone. Coordinates are rounded to 2^-24 of themselves, both those of the
 * corners and of the triangle that gave the surface; twice that, and twice again to be sure.
 */
static bool is_below(const struct surface *surface, const struct body *body, unsigned int triangle)
{
	double corners[3][3];
	double reach = vector_largest(surface->point);
	triangle_corners(body, triangle, corners);
	for (int k = 0; k < 3; k++) {
		double arm[3];
		vector_subtract(corners[k], surface->point, arm);
		double rounding = (vector_largest(corners[k]) + reach) * 0x1p-22;
		if (vector_dot(surface->normal, arm) > rounding)
			return false;
	}
	return true;
}

static void skip_below(const struct RTCFilterFunctionNArguments *args)
{
	const struct shadow_context *context = (const struct shadow_context *)args->context;
	for (unsigned int i = 0; i < args->N; i++)
		if (args->valid[i] &&
			is_below(context->surface, args->geometryUserPtr, hit_triangle(args, i)))
			args->valid[i] = 0;
}

static void place_vertices(const struct tracer *tracer, const struct object *object,
	const struct mesh *mesh, float (*vertices)[3])
{
	for (size_t v = 0; v < mesh->vertex_count; v++) {
		double point[3];
		to_world(object, mesh->positions[v], point);
		place(tracer, point, point);
		for (int i = 0; i < 3; i++)
			vertices[v][i] = (float)point[i];
	}
}

/* Leaves failures to Embree's error. */
static void add_body(struct tracer *tracer, unsigned int index, const struct object *object,
	const struct mesh *mesh)
{
	struct body *body = &tracer->bodies[index];
	RTCGeometry geometry = rtcNewGeometry(tracer->device, RTC_GEOMETRY_TYPE_TRIANGLE);
	float(*vertices)[3] = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
		RTC_FORMAT_FLOAT3, sizeof(*vertices), mesh->vertex_count);
	rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
		mesh->indices, 0, 3 * sizeof(*mesh->indices), mesh->index_count / 3);
	if (vertices == NULL)
		goto out;
	place_vertices(tracer, object, mesh, vertices);
	*body = (struct body){
		.vertices = (const float(*)[3])vertices,
		.indices = mesh->indices,
		.receives = object->receives,
		.single_sided = object->single_sided,
		.mirrored = is_mirrored(object),
	};
	rtcSetGeometryUserData(geometry, body);
	rtcSetGeometryOccludedFilterFunction(geometry, skip_below);
	if (body->single_sided)
		rtcSetGeometryIntersectFilterFunction(geometry, skip_back);
	rtcCommitGeometry(geometry);
	rtcAttachGeometryByID(tracer->seen, geometry, index);
	if (object->casts)
		rtcAttachGeometryByID(tracer->casters, geometry, index);
out:
	rtcReleaseGeometry(geometry);
}

static RTCScene new_scene(RTCDevice device)
{
	RTCScene scene = rtcNewScene(device);
	/* Without it rays pass between two triangles at the edge they share. */
	rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
	return scene;
}

static const char *problem_of(RTCDevice device)
{
	switch (rtcGetDeviceError(device)) {
	case RTC_ERROR_NONE:
		return NULL;
	case RTC_ERROR_OUT_OF_MEMORY:
		return "out of memory";
	case RTC_ERROR_UNSUPPORTED_CPU:
		return "this processor is not supported";
	default:
		return "it cannot be set up";
	}
}

bool tracer_init(struct tracer *tracer, const struct sm_scene *scene, struct sm_error *error)
{
	const char *problem = NULL;
	*tracer = (struct tracer){.device = rtcNewDevice(NULL)};
	if (tracer->device == NULL) {
		problem = problem_of(NULL);
		goto fail;
	}
	tracer->bodies = array_zalloc(scene->object_count, sizeof(*tracer->bodies));
	if (tracer->bodies == NULL) {
		tracer_finish(tracer);
		return error_no_memory(error);
	}
	fit(tracer, scene);
	tracer->seen = new_scene(tracer->device);
	tracer->casters = new_scene(tracer->device);
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		add_body(tracer, (unsigned int)i, object, &scene->meshes[object->mesh]);
	}
	rtcCommitScene(tracer->seen);
	rtcCommitScene(tracer->casters);
	problem = problem_of(tracer->device);
	if (problem == NULL)
		return true;
fail:
	tracer_finish(tracer);
	return error_set(error, SM_ERROR_MACHINE, "reference: Embree: %s",
		problem != NULL ? problem : "it cannot be set up");
}

void tracer_finish(struct tracer *tracer)
{
	if (tracer->seen != NULL)
		rtcReleaseScene(tracer->seen);
	if (tracer->casters != NULL)
		rtcReleaseScene(tracer->casters);
	if (tracer->device != NULL)
		rtcReleaseDevice(tracer->device);
	free(tracer->bodies);
	*tracer = (struct tracer){0};
}

/* Distance along sight at which a sphere around the scene begins: from far away, the digits of a
 * ray's origin are of no use to the scene. */
static double distance_of_scene(const struct sight *sight)
{
	const double radius = 1.75; /* above sqrt 3 */
	return fmax(sight->near, -vector_dot(sight->origin, sight->direction) - radius);
}

static bool nearest_hit(const struct tracer *tracer, const struct sight *sight, unsigned int *id,
	unsigned int *triangle)
{
	struct sight_context context = {.direction = sight->direction};
	double start = distance_of_scene(sight), origin[3];
	vector_add(sight->origin, start, sight->direction, origin);
	struct RTCRayHit ray = {
		.ray = {.org_x = (float)origin[0],
			.org_y = (float)origin[1],
			.org_z = (float)origin[2],
			.dir_x = (float)sight->direction[0],
			.dir_y = (float)sight->direction[1],
			.dir_z = (float)sight->direction[2],
			.tfar = (float)(sight->far - start),
			.mask = UINT32_MAX},
		.hit = {.geomID = RTC_INVALID_GEOMETRY_ID},
	};
	rtcInitIntersectContext(&context.embree);
	rtcIntersect1(tracer->seen, &context.embree, &ray);
	*id = ray.hit.geomID;
	*triangle = ray.hit.primID;
	return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

bool tracer_see(const struct tracer *tracer, const struct sight *sight, struct surface *surface)
{
	unsigned int id, triangle;
	if (!nearest_hit(tracer, sight, &id, &triangle))
		return false;
	const struct body *body = &tracer->bodies[id];
	double corners[3][3], arm[3];
	triangle_corners(body, triangle, corners);
	triangle_normal((const double(*)[3])corners, surface->normal);
	if (!vector_normalise(surface->normal))
		return false;
	/* A triangle seen from its edge alone is not seen. */
	double along = vector_dot(surface->normal, sight->direction);
	if (along == 0.0)
		return false;
	if (along > 0.0)
		vector_scale(surface->normal, -1.0);
	vector_subtract(corners[0], sight->origin, arm);
	double distance = vector_dot(surface->normal, arm) / -fabs(along);
	vector_add(sight->origin, distance, sight->direction, surface->point);
	surface->receives = body->receives;
	return true;
}

static void aim(struct RTCRay8 *ray, const float origin[3], const struct fan *fan, const float *x,
	const float *y, uint32_t count)
{
	for (uint32_t i = 0; i < count; i++) {
		ray->org_x[i] = origin[0];
		ray->org_y[i] = origin[1];
		ray->org_z[i] = origin[2];
		ray->tnear[i] = 0.0f;
		ray->dir_x[i] = (float)(fan->axis[0] + x[i] * fan->u[0] + y[i] * fan->v[0]);
		ray->dir_y[i] = (float)(fan->axis[1] + x[i] * fan->u[1] + y[i] * fan->v[1]);
		ray->dir_z[i] = (float)(fan->axis[2] + x[i] * fan->u[2] + y[i] * fan->v[2]);
		ray->time[i] = 0.0f;
		ray->tfar[i] = (float)fan->end;
		ray->mask[i] = UINT32_MAX;
		ray->flags[i] = 0;
	}
}

uint32_t tracer_count_free(const struct tracer *tracer, const struct surface *surface,
	const struct fan *fan, const float *x, const float *y, uint32_t count)
{
	struct shadow_context context = {.surface = surface};
	/* Within rounding; below the surface, most rays would hit it and take is_below(). */
	double above = vector_largest(surface->point) * 0x1p-22, start[3];
	vector_add(surface->point, above, surface->normal, start);
	const float origin[3] = {(float)start[0], (float)start[1], (float)start[2]};
	uint32_t unblocked = 0;
	rtcInitIntersectContext(&context.embree);
	context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
	for (uint32_t first = 0; first < count; first += PACKET) {
		uint32_t rays = count - first < PACKET ? count - first : PACKET;
		_Alignas(32) int valid[PACKET] = {0};
		struct RTCRay8 ray;
		for (uint32_t i = 0; i < rays; i++)
			valid[i] = -1;
		aim(&ray, origin, fan, x + first, y + first, rays);
		rtcOccluded8(valid, tracer->casters, &context.embree, &ray);
		/* Embree marks what is blocked by an end of -infinity. */
		for (uint32_t i = 0; i < rays; i++)
			unblocked += ray.tfar[i] >= 0.0f;
	}
	return unblocked;
}
