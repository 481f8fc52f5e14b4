/* Two sheets made into one along a shared boundary. */
#ifndef ATLAS_JOIN_H
#define ATLAS_JOIN_H

#include "atlas/charts/shared_boundaries.h"

/* How sheet `b` must be turned and moved so that its side of a shared boundary lies on that of sheet `a`. */
typedef struct {
    double cosine, sine, from[2], to[2]; /* p -> rotate(p - from) + to */
    double gap;                          /* m, root mean square over the shared boundary, that is left */
} sp_fit;

/* The shared boundary is one of sheet `a`, as sp_shared_boundaries_find lists it. */
sp_fit sp_join_fit(const sp_sheets *sheets, const sp_shared_boundary *shared);
/* A new sheet of both, `a` first; a's and b's vertices on the shared boundary become one at the mean of their places.
 * False when memory runs out. The sheets stay as they are. */
bool sp_join(const sp_sheets *sheets, const sp_shared_boundary *shared, const sp_fit *fit, sp_sheet *joined);

#endif
