/* Flattening: moves the vertices of a sheet so that its triangles keep their shapes as well as they can. */
#ifndef ATLAS_RELAX_H
#define ATLAS_RELAX_H

#include "atlas/charts/sheets.h"

/* Storage for sheets of up to `capacity` vertices; all zeros at first. */
typedef struct {
    double (*residual)[2], (*move)[2], (*search)[2], (*image)[2], *diagonal;
    size_t capacity;
} sp_relaxer;

/* `rounds` rounds of as-rigid-as-possible flattening, in each of which `inner` steps of conjugate gradients. False when
 * memory runs out. */
bool sp_relax(sp_relaxer *relaxer, const sp_sheets *sheets, sp_sheet *sheet, int rounds, int inner);
void sp_relaxer_destroy(sp_relaxer *relaxer);

#endif
