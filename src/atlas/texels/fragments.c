/* Which triangles each texel consists of. */
#include "atlas/texels/texels.h"

#include <assert.h>
#include <stdlib.h>

/* Counts the fragments of every texel, or with `items` places them; start[i] is where the next one of texel i goes. */
static bool visit(const sp_atlas *atlas, const sp_mesh *mesh, sp_pieces *pieces, uint32_t *start, sp_fragment *items)
{
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (!sp_pieces_of(pieces, atlas, mesh, t))
            return false;
        for (size_t i = 0; i < pieces->count; i++) {
            uint32_t at = start[pieces->items[i].texel]++;
            if (items)
                items[at] = (sp_fragment){t, pieces->items[i].area};
        }
    }
    return true;
}

bool sp_fragments_create(sp_fragments *fragments, const sp_atlas *atlas, const sp_mesh *mesh, sp_error *error)
{
    *fragments = (sp_fragments){0};
    if (!atlas || !mesh)
        return false;
    sp_pieces pieces = {0};
    uint64_t sum = 0;
    uint32_t *start = fragments->start = calloc(atlas->texel_count + 1, sizeof *start);
    bool done = start && visit(atlas, mesh, &pieces, start, NULL);
    for (size_t i = 0; done && i <= atlas->texel_count; i++) {
        uint32_t count = start[i];
        start[i] = (uint32_t)sum;
        sum += count;
    }
    bool fits = sum < SP_NONE;
    if (done && fits) {
        fragments->items = malloc((sum + 1) * sizeof *fragments->items);
        done = fragments->items && visit(atlas, mesh, &pieces, start, fragments->items);
        assert(!done || !atlas->texel_count || start[atlas->texel_count - 1] == sum);
        for (size_t i = atlas->texel_count; i > 0; i--) /* filling moved each start to the next one's */
            start[i] = start[i - 1];
        start[0] = 0;
    }
    sp_pieces_free(&pieces);
    if (done && fits)
        return true;
    sp_fragments_destroy(fragments);
    if (!done)
        return sp_fail_memory(error);
    return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "a texel of %g m cuts the surface into more than 2^32 pieces",
                   atlas->texel);
}

void sp_fragments_destroy(sp_fragments *fragments)
{
    free(fragments->start);
    free(fragments->items);
    *fragments = (sp_fragments){0};
}
