/* Triangles of an atlas that lie over each other. */
#ifndef ATLAS_OVERLAP_H
#define ATLAS_OVERLAP_H

#include <sprayplan/atlas.h>

typedef struct {
    size_t count;      /* pairs of triangles of one chart that overlap on their page */
    uint32_t triangle; /* the second of the first pair found, SP_NONE where there is none */
    size_t tests;      /* pairs of edges and of triangles that were looked at */
} sp_overlaps;

/* Looks through each chart; what lies on another chart shares a pixel with it. Needs chart and uv. Stops after the
 * chart in which `most` are found. A chart without overlaps takes time about linear in its triangles, however they are
 * shaped. Returns false when memory runs out. */
bool sp_find_overlaps(const sp_atlas *atlas, const sp_mesh *mesh, size_t most, sp_overlaps *found, sp_error *error);

#endif
