/* Halving of what cannot be laid flat. */
#ifndef ATLAS_SPLIT_H
#define ATLAS_SPLIT_H

#include "atlas/sheets.h"

/* Puts the triangles of a sheet on either side of its middle, as it lies, into regions `below` and `above`: neither is
 * empty. The sheet has at least two. `region` [triangle_count of the mesh]. */
void sp_split(const sp_sheet *sheet, uint32_t *region, uint32_t below, uint32_t above);

#endif
