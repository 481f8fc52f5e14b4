/* Turning sheets so that their bounding boxes waste little. */
#ifndef ATLAS_ORIENT_H
#define ATLAS_ORIENT_H

#include "atlas/charts/sheets.h"

/* Of the boxes that hold the sheet, no side longer than `extent`, the one of least area: its directions along
 * (cosine, sine) and a quarter turn further. */
typedef struct {
    double cosine, sine, width, height;
    bool fits;   /* false: there is no such box, and nothing else is set */
    bool memory; /* false: it ran out */
} sp_least_box;

sp_least_box sp_find_least_box(const sp_sheet *sheet, double extent);
/* Turns the sheet so that the box lies along the axes, its long side along x. */
void sp_turn_sheet(sp_sheet *sheet, const sp_least_box *box);

#endif
