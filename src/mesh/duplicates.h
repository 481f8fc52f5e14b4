/* Twins: triangles with the same three corners, whichever comes first and whichever way they turn. */
#ifndef MESH_DUPLICATES_H
#define MESH_DUPLICATES_H

#include <sprayplan/mesh.h>

bool sp_are_duplicates(const sp_mesh *mesh, uint32_t a, uint32_t b);
/* Fills order[triangle_count] with all triangles, those of the same corners side by side, the lowest first. False when
 * memory runs out. */
bool sp_sort_duplicates(const sp_mesh *mesh, uint32_t *order, sp_error *error);

#endif
