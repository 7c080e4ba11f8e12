/* SPDX-License-Identifier: MIT */
#ifndef LOAD_IMPORT_H
#define LOAD_IMPORT_H

#include "load/model.h"
#include "load/plan.h"

/**
 * Reads a model file into an empty model: triangles in their rest pose and what moves them, base
 * colours, base colour pictures, lights, and the first camera.
 *
 * Reading happens in a forked child with a limit of time (8 s, and 1 s for each MiB of the file)
 * and of memory: assimp 5.2 crashes, loops or runs out of memory on some damaged files.
 *
 * up: the axis that points up in the file. PLAN_UP_AUTO: z in STL, 3MF, AMF and DXF files; z in a
 * 3DS file that states its mesh version first, as 3D Studio writes it; y elsewhere, or what the
 * file itself says.
 *
 * Fails (INPUT) with "path: cause" if there is nothing to draw.
 */
bool import_model(const char *path, enum plan_up up, struct model *model, struct sm_error *error);

#endif
