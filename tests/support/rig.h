/* SPDX-License-Identifier: MIT */
#ifndef SUPPORT_RIG_H
#define SUPPORT_RIG_H

#include <smoothie.h>

/** What a test that draws starts with: its own context, a renderer, and a scene to fill. */
struct rig {
	struct platform *platform;
	struct sm_renderer *renderer;
	struct sm_scene *scene; /* empty; no ambient light, black background */
	unsigned int problems;  /* errors that library or driver logged */
	char problem[500];      /* the first of them */
};

/** cmocka fixtures, *state being the rig. The teardown fails the test if an error was logged. */
int rig_setup(void **state);
int rig_teardown(void **state);
#define rig_test(test) cmocka_unit_test_setup_teardown(test, rig_setup, rig_teardown)

/** Makes the rig's renderer anew; one that cannot be made fails the test. */
void rig_use_driver(struct rig *rig, const struct sm_driver_options *options);
/** The same with one path forced; skips the test where the driver cannot. */
void rig_use_path(struct rig *rig, const char *path);

/** Has each frame drawn in full, as if nothing had been drawn before; what surfaces need not look
 * up they do not. */
void rig_skip_nothing(struct rig *rig);

/** Whether the context is one that the technique can be drawn in: "vsm" takes a target of floats. A
 *  line says so if it is not. */
bool rig_can_draw(const char *technique);

/** The functions of smoothie.h, failing the test with their error's text. */
void rig_set_shadows(struct rig *rig, const struct sm_shadow_options *options);
void rig_draw(struct rig *rig, const struct sm_scene *scene, const struct sm_view *view);

#endif
