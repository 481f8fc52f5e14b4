/* Charts, with the sizes from which a coarse mesh helps to make them left to the caller. */
#ifndef ATLAS_CHARTS_H
#define ATLAS_CHARTS_H

#include <sprayplan/atlas.h>

/* sp_charts_create, but meshes of more than `large` triangles are charted by way of one of about `coarse` (> 0): so
 * that what happens to large meshes can be seen on small ones. */
sp_charts *sp_charts_by_levels(const sp_mesh *mesh, double extent, size_t large, size_t coarse, sp_error *error);

#endif
