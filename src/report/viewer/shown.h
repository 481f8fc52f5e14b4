/* Which designs the viewer shows on one surface. */
#ifndef REPORT_VIEWER_SHOWN_H
#define REPORT_VIEWER_SHOWN_H

#include "report/page.h"

/* The evaluator that stands for a design's: the page's own that evaluates layouts, or else the first, whose geometry,
 * atlas and patches are the same. NULL where the design has none. */
const sp_evaluator *sp_viewer_evaluator(const sp_page *page, size_t design);

#endif
