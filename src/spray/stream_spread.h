/* Where the liquid of solid streams runs down from: they spread on the wall first. */
#ifndef SPRAY_STREAM_SPREAD_H
#define SPRAY_STREAM_SPREAD_H

#include "spray/state/state.h"

/* One thread's memory for laying discs on cells. */
typedef struct {
    const sp_patches *cells; /* borrowed */
    uint32_t *queue;         /* [cells] */
    uint64_t *seen;          /* [cells], the last disc that each was looked at for */
    double *share;           /* [cells], by queue, m² */
    uint64_t laid;           /* discs so far */
} sp_stream_spread;

/* `cells` of all wet sides. Freed in any case. */
bool sp_stream_spread_create(const sp_patches *cells, sp_stream_spread *discs, sp_error *error);
void sp_stream_spread_free(sp_stream_spread *discs);
/* Adds to `arriving` (m³/s, [cells]) what a solid stream of this flow (m³/s) brings, of which `hits` (m³/s, [cells])
 * arrive on each cell: as much on every m² of a disc about each place that it hits, as far as that is wall. */
void sp_stream_spread_add(sp_stream_spread *discs, const sp_fluid *liquid, double flow, const double *hits,
                          double *arriving);

#endif
