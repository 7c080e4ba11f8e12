/* SPDX-License-Identifier: MIT */
#include "fixed/scene.h"

void fixed_scene_finish(struct fixed_scene *scene)
{
	fixed_blockers_finish(&scene->casters);
	fixed_blockers_finish(&scene->receivers_only);
	fixed_fins_finish(&scene->fins);
	fixed_receivers_finish(&scene->receivers);
	*scene = (struct fixed_scene){0};
}
