/* Whether a sheet may be a chart as it lies. */
#ifndef ATLAS_JUDGE_H
#define ATLAS_JUDGE_H

#include "atlas/charts/sheets.h"

#define SP_STRAIN_BOUND 0.05       /* that a chart must keep but for SP_STRAIN_SHARE of its area */
#define SP_EXACT_STRAIN 1e-10      /* round-off */
#define SP_DEVELOPABLE_STRAIN 1e-4 /* round-off of files */

typedef struct {
    double share;   /* of the area with more strain than the bound */
    double most;    /* largest strain of any triangle */
    size_t flipped; /* triangles not laid clearly anticlockwise */
} sp_strain;

/* max(σ1 - 1, 1 - σ2) of the map of each triangle from the surface to the plane. */
sp_strain sp_measure_strain(const sp_sheets *sheets, const sp_sheet *sheet);

typedef enum { SP_SHEET_FITS, SP_SHEET_UNFIT, SP_SHEET_MEMORY } sp_verdict;

/* Whether some box around the sheet has no side longer than `extent`. Where it has strain, and so may as well be cut,
 * the box must besides be no longer than a square page needs to be, and not mostly empty. */
sp_verdict sp_judge_box(const sp_sheets *sheets, const sp_sheet *sheet, double extent);
/* Whether its triangles, all anticlockwise, lie apart from each other. */
sp_verdict sp_judge_overlap(const sp_sheets *sheets, uint32_t number);

#endif
