/* From assembled triangles to a mesh. */
#ifndef MESH_WELD_H
#define MESH_WELD_H

#include "mesh/build.h"

/* Welds equal points and keeps degenerate triangles out. Takes over the names; the rest of `build` stays the caller's. */
sp_mesh *mesh_weld(mesh_build *build, sp_error *error);

#endif
