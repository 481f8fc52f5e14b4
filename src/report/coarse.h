/* A drawn surface of fewer triangles, for pictures that would grow too large. */
#ifndef REPORT_COARSE_H
#define REPORT_COARSE_H

#include "surface.h"

/* Leaves no more than `most` triangles: what of a part lies in one cell of a grid comes to lie at one vertex of the
 * mesh, the nearest to its middle, and triangles of which that leaves an edge or a point go (vertex clustering:
 * Rossignac and Borrel, Modeling in Computer Graphics, 1993, pp. 455-465, here of the finest grid that serves). Every
 * chart keeps corners of its own there, so that a triangle shows texels of its own chart, no farther off than the cell
 * is wide. *cell is that diagonal in m, 0 where all triangles stay. The same for every number of threads. */
bool sp_drawn_surface_coarsen(sp_drawn_surface *surface, const sp_evaluator *evaluator, size_t most, double *cell,
                              sp_error *error);

#endif
