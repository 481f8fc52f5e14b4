/* Across which edges the surface goes on. */
#ifndef MESH_ADJACENT_H
#define MESH_ADJACENT_H

#include "mesh/half_edge.h"

/* Half-edges as sp_half_edges_create makes them; but where three to eight triangles meet, as where a sheet stands on a
 * wall, those two after two that go on in each other most smoothly, with less than a right angle between their normals,
 * have each other as opposite. The kind of edge stays as it is. A matter of the mesh alone, not of its pose or size. */
bool sp_adjacent_create(const sp_mesh *mesh, sp_half_edges *edges, sp_error *error);

#endif
