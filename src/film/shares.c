#include "film/shares.h"

#include "mesh/grow.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

typedef struct {
    const sp_film_surface *surface;
    const sp_film_links *links;
    const uint32_t *ends;
    const sp_film_order *order;
    const sp_film_basins *basins;
    sp_film_shares *shares;
    bool *shared; /* [cells], has a share already */
} sharing;

static bool add(sharing *own, uint32_t from, uint32_t to, double width)
{
    sp_film_shares *shares = own->shares;
    assert(width > 0 && own->basins->of[from] == from);
    assert(!sp_film_is_cell(to) || own->order->rank[to] < own->order->rank[from]); /* nothing runs in a circle */
    if (!sp_grow(&shares->items, &shares->capacity, shares->count + 1, sizeof *shares->items))
        return false;
    shares->items[shares->count++] = (sp_film_share){from, to, width};
    own->shared[from] = true;
    return true;
}

/* To a cell, as far as liquid goes there, or to an end. */
static bool share(sharing *own, uint32_t from, uint32_t to, double width)
{
    if (!(width > 0) || to == SP_NONE || to == SP_FILM_SHUT)
        return true;
    if (sp_film_is_cell(to)) {
        to = own->basins->of[to];
        if (own->order->rank[to] >= own->order->rank[from])
            return true;
    }
    return add(own, from, to, width);
}

/* Over the borders in proportion to the flow across them; all off a ceiling that does not hold its film. */
static bool share_wall(sharing *own, uint32_t cell)
{
    const sp_film_links *links = own->links;
    double *width = &own->shares->width[cell];
    bool drips = links->drips[cell], done = true;
    for (size_t k = links->start[cell]; done && k < links->start[cell + 1]; k++) {
        const sp_film_link *link = &links->links[k];
        if (!(link->across > 0))
            continue;
        *width += link->across;
        done = drips || share(own, cell, links->to[k], link->across);
    }
    *width += fmax(0, links->end_across[cell]);
    if (!(*width > 0))
        *width = own->surface->cells->length[cell];
    return done && share(own, cell, own->ends[cell], drips ? *width : links->end_across[cell]);
}

/* What one cell of a pool has of its rim. */
static bool share_rim(sharing *own, uint32_t cell)
{
    const sp_film_links *links = own->links;
    uint32_t pool = own->basins->of[cell];
    size_t before = own->shares->count;
    bool done = true;
    for (size_t k = links->start[cell]; done && k < links->start[cell + 1]; k++)
        done = own->basins->of[links->to[k]] == pool ||
               (sp_film_is_over_rim(&links->links[k]) && !own->order->over[cell]) ||
               share(own, pool, links->to[k], links->links[k].length);
    done = done && share(own, pool, own->ends[cell], links->end_length[cell]);
    for (size_t i = before; i < own->shares->count; i++)
        own->shares->width[pool] += own->shares->items[i].width;
    return done;
}

/* What has no other way goes where the flood came from. */
static bool share_rest(sharing *own, uint32_t cell)
{
    uint32_t parent = own->order->parent[cell];
    double *width = &own->shares->width[cell];
    if (!(*width > 0))
        *width = own->surface->cells->length[cell];
    return add(own, cell, parent == SP_NONE ? SP_FILM_HELD : own->basins->of[parent], *width);
}

/* Liquid stands where the flood began for want of an end: no share of it leaves there. */
static bool share_all(sharing *own, const bool *stands)
{
    const uint32_t *of = own->basins->of;
    for (uint32_t i = 0; i < own->links->count; i++) {
        bool done = stands[of[i]] || (own->basins->pooled[i] ? share_rim(own, i) : share_wall(own, i));
        if (!done)
            return false;
    }
    for (uint32_t i = 0; i < own->links->count; i++)
        if (of[i] == i && !own->shared[i] && !share_rest(own, i))
            return false;
    return true;
}

bool sp_film_shares_create(const sp_film_surface *surface, const sp_film_links *links, const uint32_t *ends,
                           const sp_film_order *order, const sp_film_basins *basins, sp_film_shares *shares,
                           sp_error *error)
{
    size_t room = links->count + 1;
    *shares = (sp_film_shares){.width = calloc(room, sizeof *shares->width)};
    sharing own = {surface, links, ends, order, basins, shares, calloc(room, sizeof *own.shared)};
    bool *stands = calloc(room, sizeof *stands);
    bool done = shares->width && own.shared && stands;
    for (size_t i = 0; done && i < links->count; i++)
        if (order->held[i])
            stands[basins->of[i]] = true;
    done = done && share_all(&own, stands);
    free(own.shared);
    free(stands);
    if (done)
        return true;
    sp_film_shares_free(shares);
    return sp_fail_memory(error);
}

void sp_film_shares_free(sp_film_shares *shares)
{
    free(shares->items);
    free(shares->width);
    *shares = (sp_film_shares){0};
}
