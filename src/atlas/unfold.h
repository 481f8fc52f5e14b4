/* Growth of one chart after another by isometric unfolding. */
#ifndef ATLAS_UNFOLD_H
#define ATLAS_UNFOLD_H

#include <sprayplan/atlas.h>

/* Grows charts until every triangle lies in one. `twin` [3 triangle_count] is the half-edge across each half-edge, or
 * SP_NONE at open, non-manifold and flipped edges. Fills charts->chart, ->flat and ->chart_count. */
bool sp_unfold(sp_charts *charts, const sp_mesh *mesh, const uint32_t *twin, sp_error *error);

#endif
