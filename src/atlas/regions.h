/* Regions of the surface that face roughly one way, from which charts begin. */
#ifndef ATLAS_REGIONS_H
#define ATLAS_REGIONS_H

#include <sprayplan/mesh.h>

/* region [triangle_count] becomes the region of each triangle, numbered from 0 to `count` - 1, each connected over the
 * half-edges in `twin` [3 triangle_count]. False when memory runs out. */
bool sp_regions_grow(const sp_mesh *mesh, const uint32_t *twin, uint32_t *region, size_t *count, sp_error *error);

#endif
