/* Fewer, larger charts. */
#ifndef ATLAS_MERGE_H
#define ATLAS_MERGE_H

#include "atlas/charts/relax.h"

/* Joins neighbouring sheets as long as the joined ones settle, of two that were there one at least being new: sheet
 * `first_new` or one after it. */
bool sp_merge(sp_sheets *sheets, size_t first_new, double extent, sp_relaxer *relaxer, sp_error *error);

#endif
