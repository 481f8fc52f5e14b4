/* Cutting a region of the surface open, so that it can be laid flat. */
#ifndef ATLAS_CUT_H
#define ATLAS_CUT_H

#include "atlas/charts/sheets.h"

typedef struct {
    uint8_t *glued;     /* [3 triangle_count] */
    uint32_t *degree;   /* [vertex_count] */
    uint32_t *incident; /* [vertex_count] */
    uint32_t *waiting;  /* [triangle_count] */
} sp_cutter;

/* False when memory runs out. */
bool sp_cutter_create(sp_cutter *cutter, const sp_mesh *mesh);
void sp_cutter_destroy(sp_cutter *cutter);

/* Makes a sheet without positions of the triangles that are connected with `seed` inside its region, cut so that it is
 * a disc: along a tree of edges without loose ends. `region` [triangle_count]. False when memory runs out; else the
 * caller owns the sheet. */
bool sp_cut_open(sp_cutter *cutter, const sp_sheets *sheets, const uint32_t *region, uint32_t seed, sp_sheet *sheet);

/* Makes a sheet without positions of the `count` triangles in `list`, which hang together across the half-edges that
 * are `glued` [3 triangle_count]; sets their numbers in sheets->local. False when memory runs out. */
bool sp_cut_out(const uint8_t *glued, const sp_sheets *sheets, const uint32_t *list, size_t count, sp_sheet *sheet);

/* Adds a sheet for each part of sheet `number` that hangs together inside a region, laid as it was; nothing is left of
 * that sheet itself. `region` [triangle_count]. False when memory runs out. */
bool sp_cut_apart(sp_cutter *cutter, sp_sheets *sheets, uint32_t number, const uint32_t *region);

/* Closes the cuts that end inside of sheet `number`, as far as from a vertex that is bent sharply; their lips become
 * one at the mean of their places; `closed` says whether there were any. False when memory runs out. */
bool sp_close_ends(sp_sheets *sheets, uint32_t number, bool *closed);

#endif
