/* SPDX-License-Identifier: MIT */
#ifndef LOAD_MODEL_H
#define LOAD_MODEL_H

#include "base/error.h"
#include "load/animation.h"
#include <stddef.h>

/** Sides of a picture go up to this, in texels; the limit of sm_scene_add_image(). */
enum { MODEL_IMAGE_MAX = 16384 };

struct model_image {
	uint32_t width, height;
	const uint8_t *rgba; /**< [height][width][4], sRGB, first row at v = 0 */
};

struct model_light {
	struct sm_light_desc desc; /**< NaN in radius, angle: not said */
	bool aimed;                /**< false: shines all around, target and angle mean nothing */
	bool physical;             /**< intensity is radiant: reaches a point at distance d as
					intensity / (fade[0] + fade[1] d + fade[2] d^2) */
	float fade[3];
	uint32_t node; /**< of the rig, that it goes with */
};

/** Something that went wrong without spoiling the model, such as a missing picture. */
struct model_note {
	const char *text;
	const struct model_note *next; /**< may be NULL */
};

/**
 * What a file or a generator gives: parts of a scene in a space of their own, y up.
 *
 * A model is its own memory: it stands at the start of a mapping that everything it points to was
 * cut from, and is freed as a whole. The mapping is shared with forked children, so that a child
 * can fill a model for its parent.
 */
struct model {
	size_t used; /**< bytes of the mapping */
	struct sm_mesh_desc *meshes;
	size_t mesh_count;
	struct model_image *images;
	size_t image_count;
	struct sm_object_desc *objects; /**< their mesh and image index the arrays above */
	size_t object_count;
	struct model_light *lights;
	size_t light_count;
	struct rig rig;
	bool has_camera;
	struct sm_camera camera; /**< near and far are 0 */
	uint32_t camera_node;    /**< of the rig, that it goes with */
	uint32_t width, height;  /**< of the picture that suits the camera; 0: any */
	float ground_size;       /**< side of the square at y = 0 that it stands on; 0: none */
	const struct model_note *notes;
	struct sm_error error; /**< a child's; empty text: none */
};

/** An empty model, or NULL. Destroy with model_destroy(). */
struct model *model_create(struct sm_error *error);
void model_destroy(struct model *model);

/** count elements of size bytes, zero, aligned for any type; NULL when the model would become
 *  larger than its mapping (1 GiB, on 64-bit machines). */
void *model_alloc(struct model *model, size_t count, size_t size);
/** A copy of text, or NULL as model_alloc(). */
char *model_string(struct model *model, const char *text);
/** Adds a note; it is lost when there is no room. */
void model_note(struct model *model, const char *format, ...) PRINTF_LIKE(2, 3);

/** Room for so many meshes and objects, both empty before. */
bool model_reserve(struct model *model, size_t meshes, size_t objects);

/** Scaled, then turned about x, y and z in this order (degrees), then moved; column-major. */
void model_transform(const float position[3], const float rotation[3], const float scale[3],
	float transform[16]);

/** How a model is put into a scene. */
struct model_placement {
	const char *name; /**< of its objects; those of a model with several are NAME/PART */
	float transform[16];
	float color[3]; /**< replaces base colours; NaN: they stay */
	bool casts, receives;
};

/** An object of a placed model to world space. pose: of the model's rig; NULL: at rest. */
void model_object_transform(const struct model *model, const struct pose *pose,
	const struct model_placement *placement, size_t object, float transform[16]);

/** Grows a box in world space, min then max, around the triangles of a placed model; exactly, so
 *  that what stands on the box's floor touches it. pose: as above. */
void model_grow_box(const struct model *model, const struct pose *pose,
	const struct model_placement *placement, bool casters_only, float box[2][3]);

/** Adds meshes, images and objects of a model, at rest, to a scene, in the model's order. */
bool model_place(const struct model *model, const struct model_placement *placement,
	struct sm_scene *scene, struct sm_error *error);

#endif
