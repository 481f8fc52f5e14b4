/* Where the liquid of solid streams runs down from: they spread on the wall first. */
#ifndef SPRAY_DISCS_H
#define SPRAY_DISCS_H

#include "state.h"

/* Adds to `arriving` (m³/s, [patches]) what a layout of one solid stream brings, as much on every m² of a disc about
 * each place that it hits, as far as that is wall. `walls` counts all wet sides. */
bool sp_discs_add(const sp_evaluator *walls, const sp_layout *stream, double *arriving, sp_error *error);

#endif
