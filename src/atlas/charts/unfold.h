/* The first layout of a sheet. */
#ifndef ATLAS_UNFOLD_H
#define ATLAS_UNFOLD_H

#include "atlas/charts/sheets.h"

/* Sets the positions of sheet `number` by averaged isometric unfolding from its first triangle: exact to round-off
 * where the sheet is developable. False when memory runs out. */
bool sp_unfold(sp_sheets *sheets, uint32_t number);

#endif
