/* Boxes of the accelerator's leaves, for pages without an evaluator that has them itself. */
#ifndef REPORT_VIEWER_BOXES_H
#define REPORT_VIEWER_BOXES_H

#include "packed.h"

#include <jansson.h>
#include <sprayplan/evaluator.h>

/* Adds to `object` "leaves": how many, "count", and what 0 and 65535 of their coordinates mean, "low" and "high" (m);
 * then packs them, as shorts: the low x of all, low y, low z, and high x, y and z. They hold what they hold rounded
 * outwards. Nothing of a tracer that has none, nor of more than anybody can tell apart. */
bool sp_viewer_boxes(const sp_evaluator *evaluator, json_t *object, sp_packed *packed, sp_error *error);

#endif
