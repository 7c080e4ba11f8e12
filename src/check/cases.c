/* SPDX-License-Identifier: MIT */
#include "check/cases.h"
#include "check/gl_cases.h"

void check_cases_build(struct check_list *list)
{
	gl_format_cases(list);
	gl_integer_cases(list);
	gl_depth_cases(list);
	gl_shader_cases(list);
	gl_texture_cases(list);
	gl_shadow_cases(list);
	gl_raster_cases(list);
	check_context_cases(list);
	check_repeat_cases(list);
	check_exact_cases(list);
	check_picture_cases(list);
}
