/* Where a mesh's vertices are, told to the last bit in few: as whole numbers of the file that they were read from, each
 * as what it is off from where the triangles before let it be expected. */
#ifndef REPORT_VIEWER_PLACES_H
#define REPORT_VIEWER_PLACES_H

#include "packed.h"

#include <sprayplan/mesh.h>

/* value = number / parts * unit. A number has no more than so many digits to `base`, and zeros behind them. What that
 * misses is a difference of bits. */
typedef struct {
    double parts, unit, base;
    int digits;
} sp_places_told;

/* Adds the arrays that surface.js reads with the triangles. False where memory runs out. */
bool sp_places_pack(const sp_mesh *mesh, sp_packed *packed, sp_places_told *told);

#endif
