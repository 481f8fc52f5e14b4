/* Triangles without area that OpenCASCADE makes. */
#ifndef MESH_CAD_MEND_H
#define MESH_CAD_MEND_H

#include <sprayplan/mesh.h>

/* A triangle whose corners lie on one line is left out of a mesh, which opens the edges of its neighbours: its middle
 * corner lies on the far neighbour's edge. That neighbour is split there, and takes its place as two. Triangles with
 * two equal corners, as at the poles of a sphere, open nothing and are dropped. Surface and corners stay. Takes the
 * mesh and returns it, or another; adds to *mended how many there were. NULL stays NULL, also where memory runs out. */
sp_mesh *sp_cad_mend(sp_mesh *mesh, size_t *mended, sp_error *error);

#endif
