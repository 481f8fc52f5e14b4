/* The surface to the last bit, and what an evaluation needs to know of it besides: for pages that evaluate layouts
 * themselves (src/live). Takes the place of the rounded surface that pages draw otherwise. */
#ifndef REPORT_VIEWER_EXACT_H
#define REPORT_VIEWER_EXACT_H

#include "coder.h"
#include "report/surface.h"

#include <jansson.h>

/* Tells what exact.js reads. Returns its JSON, NULL on error. */
json_t *sp_viewer_exact(const sp_evaluator *evaluator, const sp_drawn_surface *surface, sp_coder *coder,
                        sp_error *error);

#endif
