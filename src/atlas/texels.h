/* The steps that make an atlas, each filling its own part of it. Each returns false with an error. */
#ifndef ATLAS_TEXELS_H
#define ATLAS_TEXELS_H

#include "atlas/clip.h"

#include <sprayplan/atlas.h>

/* texels.c: cuts every triangle by the texels: texels, areas, fragments and each triangle's own texels. Needs uv. */
bool sp_atlas_cut(sp_atlas *atlas, const sp_mesh *mesh, sp_error *error);
/* neighbours.c: which texels touch. Needs the texels. */
bool sp_atlas_connect(sp_atlas *atlas, const sp_mesh *mesh, sp_error *error);

/* A triangle moved to the texel where its box begins, which loses nothing, and the texels that it may reach from there.
 */
typedef struct {
    double corner[3][2];
    uint32_t x, y;          /* the texel */
    uint32_t columns, rows; /* at least 1 */
} sp_local_triangle;
sp_local_triangle sp_local(const double uv[3][2]);

#endif
