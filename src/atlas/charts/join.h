/* Two sheets made into one along a run. */
#ifndef ATLAS_JOIN_H
#define ATLAS_JOIN_H

#include "atlas/charts/runs.h"

/* How sheet `b` must be turned and moved so that its side of a run lies on that of sheet `a`. */
typedef struct {
    double cosine, sine, from[2], to[2]; /* p -> rotate(p - from) + to */
    double gap;                          /* m, root mean square over the run, that is left */
} sp_fit;

/* The run is one of sheet `a`, as sp_runs_find lists it. */
sp_fit sp_join_fit(const sp_sheets *sheets, const sp_run *run);
/* A new sheet of both, `a` first; a's and b's vertices on the run become one at the mean of their places. False when
 * memory runs out. The sheets stay as they are. */
bool sp_join(const sp_sheets *sheets, const sp_run *run, const sp_fit *fit, sp_sheet *joined);

#endif
