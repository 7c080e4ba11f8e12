/* SPDX-License-Identifier: MIT */
#ifndef CHECK_GL_CASES_H
#define CHECK_GL_CASES_H

#include "check/case.h"

/* Small cases of what the renderer takes for granted of a driver; each adds its own to a list. */

void gl_format_cases(struct check_list *list);  /**< colour targets: rounding, MIN, filters */
void gl_integer_cases(struct check_list *list); /**< targets of integers */
void gl_depth_cases(struct check_list *list);   /**< depth targets and tests */
void gl_shader_cases(struct check_list *list);  /**< arithmetic and precision */
void gl_texture_cases(struct check_list *list); /**< look-ups */
void gl_shadow_cases(struct check_list *list);  /**< comparing look-ups */
void gl_raster_cases(struct check_list *list);  /**< clipping, coverage, interpolation */

#endif
