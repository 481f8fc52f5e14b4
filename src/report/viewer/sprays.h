/* A nozzle's sprays as lines: rims of its patterns, and ways that a few of its jets fly. */
#ifndef REPORT_VIEWER_SPRAYS_H
#define REPORT_VIEWER_SPRAYS_H

#include "packed.h"

#include <jansson.h>
#include <sprayplan/evaluator.h>

/* Places in parts of `span` (m) off the nozzle, whose 32767 is all of it, as signed shorts: of each pattern where it is
 * and its rim, axis by axis. Then how many jets of each pattern follow, a byte each; of each leg of theirs the walls
 * that were met before, plus 128 where a jet begins; and axis by axis where the legs end, and how far (up) the control
 * points of their curves lie over the middle of their ends (spray/paths.h). Adds to `object` "span", "sprays" and
 * "legs", how many there are. */
bool sp_viewer_sprays(const sp_evaluator *evaluator, const sp_nozzle *nozzle, json_t *object, sp_packed *packed,
                      sp_error *error);

#endif
