/* Regions of the surface that face roughly one way, from which charts begin. */
#ifndef ATLAS_REGIONS_H
#define ATLAS_REGIONS_H

#include <sprayplan/mesh.h>

/* region [triangle_count] becomes the region of each triangle, numbered from 0 to `count` - 1, each connected over the
 * half-edges in `twin` [3 triangle_count]. False when memory runs out. */
bool sp_regions_grow(const sp_mesh *mesh, const uint32_t *twin, uint32_t *region, size_t *count, sp_error *error);

/* Gives triangles that stick out of their region into another to that one, where that makes the border shorter: of
 * those in `list` [count], or where that is NULL of the first `count`; only to
 * regions from number `first` on. */
void sp_regions_straighten(const sp_mesh *mesh, const uint32_t *twin, const uint32_t *list, size_t count,
                           uint32_t first, uint32_t *region);

#endif
