/* Where triangles lie on the pages of the atlas, encoded to the last bit in few: each corner as what it is off from
 * where its triangle, turned into the page at the edge that it was reached over, has it. */
#ifndef REPORT_VIEWER_UNFOLDED_H
#define REPORT_VIEWER_UNFOLDED_H

#include "triangle_order.h"

#include <sprayplan/evaluator.h>

/* Charts on which nothing is cleaned are rounded to parts of a pixel: nobody asks where on them. */
#define SP_UNFOLDED_PARTS 16

/* False where memory runs out. */
bool sp_unfolded_encode(const sp_evaluator *evaluator, const sp_triangle_order *walk, sp_coder *coder);

#endif
