/* The sheets of a mesh, from none to charts. */
#ifndef ATLAS_MAKING_H
#define ATLAS_MAKING_H

#include "atlas/charts/cut.h"
#include "atlas/charts/relax.h"
#include "atlas/charts/sheets.h"

/* All zeros but for `sheets` and `extent` at first. */
typedef struct {
    sp_sheets sheets;
    double extent; /* m, the longest that a chart may be */
    sp_cutter cutter;
    sp_relaxer relaxer;
    uint32_t *region; /* [triangle_count], of which a sheet is cut; NULL before they are prepared */
    size_t regions;
} sp_making;

void sp_making_destroy(sp_making *making);
/* Room for regions, of which there are none yet. False when memory runs out. */
bool sp_prepare_regions(sp_making *making);
/* Makes a sheet of every part of a region that has none, and halves those parts that cannot be settled, until every
 * triangle is in a sheet. False when memory runs out. */
bool sp_make_sheets(sp_making *making);
/* Grows regions, and lays and merges sheets of the whole mesh. */
bool sp_make_all(sp_making *making, sp_error *error);

#endif
