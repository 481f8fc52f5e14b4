/* Halving of what cannot be laid flat. */
#ifndef ATLAS_SPLIT_H
#define ATLAS_SPLIT_H

#include "atlas/charts/sheets.h"

/* Puts the triangles of a sheet of at least two into regions `below` and `below` + 1, neither of them empty, with a
 * short border between them. `region` [triangle_count of the mesh]. False when memory runs out. */
bool sp_split(const sp_sheets *sheets, const sp_sheet *sheet, uint32_t *region, uint32_t below);

#endif
