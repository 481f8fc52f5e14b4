/* Charts of a coarse mesh carried over to the fine one. */
#ifndef ATLAS_PROLONG_H
#define ATLAS_PROLONG_H

#include "atlas/charts/coarsen.h"
#include "atlas/charts/sheets.h"

/* Makes a sheet of `fine` for every sheet of `rough`, which is of coarse->mesh, of the same form, cut where that is
 * cut, but for borders that are made straighter. Its vertices lie where the coarse triangles that they belong to have
 * been laid. `fine` has no sheets yet. False when memory runs out. */
bool sp_prolong_sheets(const sp_coarse *coarse, const sp_sheets *rough, sp_sheets *fine);

#endif
