/* Cuts the laid triangles by the pixels of the pages. */
#include "atlas/texels/texels.h"
#include "mesh/adjacent.h"

#include <stdlib.h>

static bool add_areas(sp_atlas *atlas, const sp_mesh *mesh)
{
    sp_pieces pieces = {0};
    atlas->texel_area = calloc(atlas->texel_count + 1, sizeof *atlas->texel_area);
    bool done = atlas->texel_area;
    for (uint32_t t = 0; done && t < mesh->triangle_count; t++) {
        done = sp_pieces_of(&pieces, atlas, mesh, t);
        for (size_t i = 0; done && i < pieces.count; i++)
            atlas->texel_area[pieces.items[i].texel] += pieces.items[i].area;
    }
    sp_pieces_free(&pieces);
    return done;
}

bool sp_atlas_cut(sp_atlas *atlas, const sp_mesh *mesh, sp_error *error)
{
    sp_half_edges edges = {0};
    bool done = sp_atlas_find_pixels(atlas, error) && sp_adjacent_create(mesh, &edges, error) &&
                sp_atlas_share_pixels(atlas, mesh, &edges, error) && sp_atlas_find_seams(atlas, mesh, &edges, error);
    sp_half_edges_destroy(&edges);
    return done && (add_areas(atlas, mesh) || sp_fail_memory(error));
}
