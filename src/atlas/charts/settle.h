/* Brings a sheet that has been roughly laid to lie as a chart must, where that is possible. */
#ifndef ATLAS_SETTLE_H
#define ATLAS_SETTLE_H

#include "atlas/charts/judge.h"
#include "atlas/charts/relax.h"

/* Flattens sheet `number` as far as it must be; a sheet that lies without strain is left as it is, but for lips of cuts
 * that meet, which are closed. Sets its `strain` and `kept`. SP_SHEET_FITS: strain, extent and overlap are all right.
 */
sp_verdict sp_settle(sp_sheets *sheets, uint32_t number, double extent, sp_relaxer *relaxer);

#endif
