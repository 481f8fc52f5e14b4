/* Cuts: triangles that others cross or touch, cut into cells each of which lies in one space, or in one contact. */
#ifndef SPRAY_CUTS_H
#define SPRAY_CUTS_H

#include "spray/wet/shells.h"
#include "spray/wet/stretches.h"

#define SP_CONTACT 1e-6 /* of the geometry's diagonal: surfaces nearer than this to each other touch */

typedef struct {
    double contact; /* m: what is nearer than this touches */
    uint32_t *root; /* [triangle_count], a cut, or a cell with SP_CELL; SP_NONE where the triangle is whole */
    size_t cut_count;
    sp_cut *cuts;
    size_t cell_count;
    uint32_t *cell_triangle;        /* [cell_count] */
    uint32_t *cover_start, *covers; /* triangles that lie in the plane of triangle t, some of it covered: covers
                                       [cover_start[t], cover_start[t + 1]), ascending */
} sp_cuts;

/* Of the setup's mesh, which its caps cut too. */
bool sp_cuts_create(sp_cuts *cuts, const sp_setup *setup, const sp_shells *shells, double contact, sp_error *error);
/* Accepts what was never created, if it is all zeros. */
void sp_cuts_destroy(sp_cuts *cuts);

/* cells.c: the cell that holds a point of a triangle that has cells. *near is set where a cut is nearer than the
 * contact. */
uint32_t sp_cuts_cell(const sp_cuts *cuts, uint32_t triangle, double u, double v, bool *near);

/* A convex part of a triangle, as weights of its second and third corner. */
#define SP_PIECE_POINTS 64
typedef struct {
    int count;
    double at[SP_PIECE_POINTS][2];
} sp_triangle_piece;

/* The part of a convex piece on one side of a cut: where it is above 0 (`way` 1) or below (-1). cells.c. */
void sp_piece_clip(const sp_triangle_piece *piece, const sp_cut *cut, int way, sp_triangle_piece *part);
/* Calls `visit` with every part of a piece that lies in one cell, for all cells that have some of it. A part of very
 * many corners comes as several. */
typedef void sp_cell_visitor(void *user, uint32_t cell, const sp_triangle_piece *part);
void sp_cuts_split(const sp_cuts *cuts, uint32_t triangle, const sp_triangle_piece *piece, sp_cell_visitor *visit,
                   void *user);

#endif
