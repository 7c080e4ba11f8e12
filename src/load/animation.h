/* SPDX-License-Identifier: MIT */
#ifndef LOAD_ANIMATION_H
#define LOAD_ANIMATION_H

#include <cglm/cglm.h>
#include <smoothie.h>

/** Values at times. Between two keys a value changes evenly, before the first and after the last it
 *  stays; of keys at one time the last counts. */
struct track {
	size_t count;        /**< at least 1 */
	const float *times;  /**< [count], seconds, not falling, finite */
	const float *values; /**< [count][width], finite */
};

/** How a node moves in its parent: scaled, then turned, then moved. */
struct channel {
	uint32_t node;
	struct track position; /**< width 3 */
	struct track rotation; /**< width 4: unit quaternions x y z w; the shorter way is taken */
	struct track scale;    /**< width 3 */
};

/** How much a shape shows of each of its targets. */
struct blend {
	uint32_t shape;
	struct track weights; /**< width: the shape's target_count */
};

struct clip {
	const char *name;
	double duration; /**< seconds, then it starts again; 0: one pose */
	struct channel *channels;
	struct blend *blends;
	size_t channel_count, blend_count;
};

struct rig_node {
	uint32_t parent; /**< an earlier node, or SM_NONE */
	float local[16]; /**< at rest, to the parent's space; column-major */
};

/** What a target adds to a mesh at full weight. */
struct morph_target {
	const float *positions; /**< [vertex_count][3] */
	const float *normals;   /**< likewise; NULL: nothing */
};

struct bone {
	uint32_t node;
	float offset[16]; /**< from the mesh's space to the node's when the two were bound */
};

struct influence {
	uint32_t bone; /**< of the shape */
	float weight;  /**< those of a vertex add up to 1 */
};

/** A mesh whose vertices move. First the targets are added, then bones take the vertices along;
 *  one without a bone goes with the object's node. */
struct shape {
	uint32_t object; /**< the only one with that mesh */
	uint32_t mesh;
	struct morph_target *targets;
	const float *weights; /**< [target_count], at rest */
	size_t target_count;
	struct bone *bones;
	size_t bone_count;
	const uint32_t *first; /**< [vertex_count + 1]: where a vertex' influences start; NULL: none
				    has any */
	const struct influence *influences;
};

/** What of a model moves. All arrays belong to the model. */
struct rig {
	struct rig_node *nodes;
	size_t node_count;      /**< 0: nothing moves */
	uint32_t *object_nodes; /**< [object_count] */
	size_t object_count;
	struct shape *shapes;
	size_t shape_count;
	struct clip *clips;
	size_t clip_count;
};

/** False: the matrix has no inverse in numbers. They may be the same. */
bool matrix_invert(mat4 matrix, mat4 inverse);

/** From the space of a node, at rest, to the model's; the model's own where it has no rig. */
void rig_node_rest(const struct rig *rig, uint32_t node, mat4 transform);

/** Vertices of a shape's mesh; owned. */
struct posed_vertices {
	float *positions; /**< [vertex_count][3] */
	float *normals;   /**< likewise, of any length; NULL: the mesh has none */
};

/** Where everything of a rig is at one time. */
struct pose {
	float (*transforms)[16];       /**< [object_count], to the model's space; owned */
	struct posed_vertices *shapes; /**< [shape_count], in the object's space; owned */
	float (*nodes)[16];            /**< [node_count], to the model's space; owned */
	/* Working memory; owned. */
	float (*bones)[12]; /* rows of 3 x 4 matrices, of the shape with most */
	float *weights;     /* of the shape with most targets */
};

/** Room for poses of the rig; meshes: as they are at rest. Finish it also when this fails, for want
 *  of memory. */
bool pose_init(struct pose *pose, const struct rig *rig, const struct sm_mesh_desc *meshes,
	struct sm_error *error);
/** Fine on a zeroed one. */
void pose_finish(struct pose *pose, const struct rig *rig);

/** Fills a pose with what the clip, or for NULL the rest, has at a time, which is finite: equal
 *  times give equal bits, and so do times that are the clip's duration apart, but for rounding. */
void pose_find(struct pose *pose, const struct rig *rig, const struct sm_mesh_desc *meshes,
	const struct clip *clip, double seconds);

#endif
