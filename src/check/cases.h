/* SPDX-License-Identifier: MIT */
#ifndef CHECK_CASES_H
#define CHECK_CASES_H

#include "check/case.h"

/** All cases there are, whatever the driver: what it lacks is skipped when it is run. Notes lack of
 *  memory in the list. */
void check_cases_build(struct check_list *list);

/* What that is made of, beside gl_cases.h. */

void check_context_cases(struct check_list *list); /**< contexts and renderers, made often */
void check_repeat_cases(struct check_list *list);  /**< a frame drawn again */
void check_picture_cases(struct check_list *list); /**< pictures, against their models */
void check_exact_cases(struct check_list *list);   /**< pictures that have the same bits */

#endif
