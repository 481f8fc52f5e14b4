#include "film/pools.h"

#include "mesh/disjoint_sets.h"

#include <assert.h>
#include <stdlib.h>

/* True where something of what runs on the cell leaves it to where liquid goes from there. */
static bool runs_off(const sp_film_links *links, const uint32_t *ends, const sp_film_order *order, uint32_t cell)
{
    for (size_t k = links->start[cell]; k < links->start[cell + 1]; k++)
        if (links->links[k].across > 0 && order->rank[links->to[k]] < order->rank[cell])
            return true;
    uint32_t end = ends[cell];
    return links->end_across[cell] > 0 &&
           (sp_film_is_cell(end) ? order->rank[end] < order->rank[cell] : end == SP_FILM_LEFT || end == SP_FILM_ASTRAY);
}

static bool fills(const sp_film_surface *surface, const sp_film_links *links, const uint32_t *ends,
                  const sp_film_order *order, uint32_t cell)
{
    if (order->sunk[cell])
        return true;
    return sp_dot(surface->cells->normal[cell], surface->down) < 0 && !runs_off(links, ends, order, cell);
}

bool sp_film_basins_create(const sp_film_surface *surface, const sp_film_links *links, const uint32_t *ends,
                           const sp_film_order *order, sp_film_basins *basins, sp_error *error)
{
    size_t count = links->count;
    uint32_t *sets = malloc((count + 1) * sizeof *sets), *first = malloc((count + 1) * sizeof *first);
    *basins = (sp_film_basins){malloc((count + 1) * sizeof *basins->of), malloc(count + 1)};
    bool done = sets && first && basins->of && basins->pooled;
    for (uint32_t i = 0; done && i < count; i++) {
        sets[i] = first[i] = i;
        basins->pooled[i] = !links->drips[i] && fills(surface, links, ends, order, i);
    }
    for (uint32_t i = 0; done && i < count; i++)
        for (size_t k = links->start[i]; basins->pooled[i] && k < links->start[i + 1]; k++)
            if (basins->pooled[links->to[k]] && !sp_film_is_over_rim(&links->links[k]))
                sp_set_join(sets, i, links->to[k]);
    for (uint32_t i = 0; done && i < count; i++) {
        uint32_t *lowest = &first[sp_set_root(sets, i)];
        *lowest = order->rank[i] < order->rank[*lowest] ? i : *lowest;
    }
    for (uint32_t i = 0; done && i < count; i++)
        basins->of[i] = first[sp_set_root(sets, i)];
    for (uint32_t i = 0; done && i < count; i++)
        assert(order->rank[basins->of[i]] <= order->rank[i] && basins->of[basins->of[i]] == basins->of[i]);
    free(sets);
    free(first);
    if (done)
        return true;
    sp_film_basins_free(basins);
    return sp_fail_memory(error);
}

void sp_film_basins_free(sp_film_basins *basins)
{
    free(basins->of);
    free(basins->pooled);
    *basins = (sp_film_basins){0};
}
