/* SPDX-License-Identifier: MIT */
#ifndef CHECK_REPORT_PAGE_H
#define CHECK_REPORT_PAGE_H

#include "check/report.h"

/* Parts of report.html. */

/** Whether a case has a section of its own: it did not just pass or was skipped. */
bool page_has_case(const struct check_result *result);
/** The section of the case that is index-th in the run, which has the id "case-INDEX". */
void page_print_case(const struct check_report *report, size_t index, FILE *file);
/** A status in its colour. */
void page_print_status(enum check_status status, FILE *file);
/** The class of a status: how good it is. */
const char *page_class(enum check_status status);

#endif
