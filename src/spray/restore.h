/* An evaluator from what another one found, so that nothing is unfolded and no line of sight is cast again. */
#ifndef SPRAY_RESTORE_H
#define SPRAY_RESTORE_H

#include "spray/wet/arrays.h"

/* Takes the atlas, of which chart, chart_page, chart_texel, uv, page_edge and the counts of triangles, charts and pages
 * are given and the rest is made, and the wet sides, as sp_wet_restore makes them. Inverse and without film or goods
 * that move, nothing left to auto, or it fails. On the same uv its patches are those of the evaluator that the parts
 * come from, in the same order. */
sp_evaluator *sp_evaluator_restore(const sp_setup *setup, sp_atlas *atlas, sp_wet *wet, sp_error *error);
/* Whether all of an evaluator that coverage depends on can be restored. */
bool sp_evaluator_is_simple(const sp_evaluator *evaluator);
/* As sp_wet_arrays_create. */
bool sp_evaluator_wet_arrays(const sp_evaluator *evaluator, sp_wet_arrays *arrays, sp_error *error);

#endif
