/* Where two sheets lie side by side on the surface. */
#ifndef ATLAS_SHARED_BOUNDARIES_H
#define ATLAS_SHARED_BOUNDARIES_H

#include "atlas/charts/sheets.h"

/* A shared boundary is an unbroken row of edges that two sheets share, with no vertex between them that is bent too
 * much: `count` boundary half-edges of one sheet from `first` on, each followed by the next around its boundary, all
 * with twins in sheet `other`. */
typedef struct {
    uint32_t other, first, count;
    double length; /* m */
} sp_shared_boundary;

typedef struct {
    sp_shared_boundary *items;
    size_t count, capacity;
    uint32_t *loop; /* scratch: one boundary */
    size_t loop_capacity;
    uint8_t *seen;    /* scratch: [3 triangle_count], zeros between calls */
    double perimeter; /* of the sheet, m */
    sp_bend most;
} sp_shared_boundaries;

/* False when memory runs out. */
bool sp_shared_boundaries_create(sp_shared_boundaries *boundaries, const sp_mesh *mesh);
void sp_shared_boundaries_destroy(sp_shared_boundaries *boundaries);
/* Lists the longest shared boundary of sheet `number` with each of its neighbours, by their numbers; vertices inside of
 * a shared boundary are bent by at most `most`. False when memory runs out. */
bool sp_shared_boundaries_find(sp_shared_boundaries *boundaries, const sp_sheets *sheets, uint32_t number,
                               sp_bend most);

#endif
