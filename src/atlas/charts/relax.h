/* Flattening: moves the vertices of a sheet so that its triangles keep their shapes as well as they can. */
#ifndef ATLAS_RELAX_H
#define ATLAS_RELAX_H

#include "atlas/charts/sheets.h"

/* A place, or a vector: both coordinates are reckoned with at once. */
typedef double sp_plane __attribute__((vector_size(16)));

/* A triangle in its plane, as sp_sheets has it, beside its edges' weights. */
typedef struct {
    double shape[3], weight[3];
} sp_relaxed_triangle;

/* Storage for sheets of up to `capacity` vertices and `triangle_capacity` triangles; all zeros at first. */
typedef struct {
    sp_plane *residual, *move, *search, *image;
    double *diagonal;
    sp_relaxed_triangle *triangles;
    size_t capacity, triangle_capacity;
} sp_relaxer;

/* `rounds` rounds of as-rigid-as-possible flattening, in each of which `inner` steps of conjugate gradients. False when
 * memory runs out. */
bool sp_relax(sp_relaxer *relaxer, const sp_sheets *sheets, sp_sheet *sheet, int rounds, int inner);
void sp_relaxer_destroy(sp_relaxer *relaxer);

#endif
