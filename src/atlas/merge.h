/* Fewer, larger charts. */
#ifndef ATLAS_MERGE_H
#define ATLAS_MERGE_H

#include "atlas/relax.h"

/* Joins neighbouring sheets as long as the joined ones settle. */
bool sp_merge(sp_sheets *sheets, double extent, sp_relaxer *relaxer, sp_error *error);

#endif
