#include "film/shares.h"

#include "atlas/order.h"

#include <stdlib.h>

struct sp_film {
    size_t count;      /* of cells */
    uint32_t *of;      /* [cells], see sp_film_basins */
    double *per_metre; /* [cells], 1/m, of what stands for itself or a pool */
    size_t step_count;
    uint32_t *steps; /* [step_count], the cells that stand for themselves or a pool, falling by rank */
    size_t *start;   /* [step_count + 1], of to and share */
    uint32_t *to;    /* as in sp_film_share */
    double *share;   /* of what runs there; a step's come to 1 */
    size_t pool_count;
    sp_film_pool *pools;
};

/* The steps in the order in which liquid comes down them, each with its shares. */
static bool line_up(sp_film *film, const sp_film_shares *shares, const sp_film_order *order)
{
    uint64_t *keys = malloc((shares->count + 1) * sizeof *keys);
    uint32_t *by_rank = malloc((shares->count + 1) * sizeof *by_rank);
    bool done = keys && by_rank;
    for (size_t i = 0; done && i < shares->count; i++)
        keys[i] = film->count - order->rank[shares->items[i].from];
    done = done && sp_order_by_key(keys, shares->count, by_rank);
    for (size_t i = 0, end; done && i < shares->count; i = end) {
        uint32_t from = shares->items[by_rank[i]].from;
        for (end = i; end < shares->count && shares->items[by_rank[end]].from == from; end++) {
            film->to[end] = shares->items[by_rank[end]].to;
            film->share[end] = shares->items[by_rank[end]].width;
        }
        double width = 0;
        for (size_t k = i; k < end; k++)
            width += film->share[k];
        for (size_t k = i; k < end; k++)
            film->share[k] /= width;
        film->steps[film->step_count++] = from;
        film->start[film->step_count] = end;
        /* what stands is not what runs by: it counts as nothing */
        film->per_metre[from] = film->to[i] == SP_FILM_HELD ? 0 : 1 / shares->width[from];
    }
    free(keys);
    free(by_rank);
    return done;
}

/* Pools and where they stand. */
static bool list_pools(sp_film *film, const sp_film_surface *surface, const sp_film_basins *basins,
                       const sp_film_shares *shares)
{
    uint32_t *pool_of = malloc((film->count + 1) * sizeof *pool_of);
    if (!pool_of)
        return false;
    for (uint32_t i = 0; i < film->count; i++)
        if (basins->pooled[i] && basins->of[i] == i) {
            film->pools[film->pool_count] = (sp_film_pool){.lowest = i, .drains = true};
            pool_of[i] = (uint32_t)film->pool_count++;
        }
    for (uint32_t i = 0; i < film->count; i++) {
        if (!basins->pooled[i])
            continue;
        sp_film_pool *pool = &film->pools[pool_of[basins->of[i]]];
        const sp_vec3 *point = surface->cells->point;
        pool->area += surface->cells->area[i];
        if (sp_dot(point[i], surface->down) > sp_dot(point[pool->lowest], surface->down))
            pool->lowest = i;
    }
    for (size_t i = 0; i < shares->count; i++)
        if (shares->items[i].to == SP_FILM_HELD && basins->pooled[shares->items[i].from])
            film->pools[pool_of[shares->items[i].from]].drains = false;
    free(pool_of);
    return true;
}

static bool assemble(sp_film *film, const sp_film_surface *surface, sp_film_basins *basins, const sp_film_order *order,
                     const sp_film_shares *shares)
{
    size_t room = film->count + 1;
    film->per_metre = calloc(room, sizeof *film->per_metre);
    film->steps = malloc(room * sizeof *film->steps);
    film->start = calloc(room, sizeof *film->start);
    film->to = malloc((shares->count + 1) * sizeof *film->to);
    film->share = malloc((shares->count + 1) * sizeof *film->share);
    film->pools = malloc(room * sizeof *film->pools);
    bool done = film->per_metre && film->steps && film->start && film->to && film->share && film->pools &&
                line_up(film, shares, order) && list_pools(film, surface, basins, shares);
    film->of = basins->of;
    basins->of = NULL;
    return done;
}

sp_film *sp_film_create(const sp_film_surface *surface, sp_error *error)
{
    sp_film *film = calloc(1, sizeof *film);
    sp_film_links links = {0};
    sp_film_order order = {0};
    sp_film_basins basins = {0};
    sp_film_shares shares = {0};
    uint32_t *ends = NULL;
    bool done = film && sp_film_links_create(surface, &links, error) &&
                (ends = sp_film_ends_find(surface, &links, error)) &&
                sp_film_order_create(surface, &links, ends, &order, error) &&
                sp_film_basins_create(surface, &links, ends, &order, &basins, error) &&
                sp_film_shares_create(surface, &links, ends, &order, &basins, &shares, error);
    if (done) {
        film->count = links.count;
        done = assemble(film, surface, &basins, &order, &shares);
    }
    sp_film_links_free(&links);
    sp_film_order_free(&order);
    sp_film_basins_free(&basins);
    sp_film_shares_free(&shares);
    free(ends);
    if (done)
        return film;
    sp_film_destroy(film);
    return sp_fail_memory(error);
}

void sp_film_destroy(sp_film *film)
{
    if (!film)
        return;
    free(film->of);
    free(film->per_metre);
    free(film->steps);
    free(film->start);
    free(film->to);
    free(film->share);
    free(film->pools);
    free(film);
}

static void end(sp_film_ends *ends, uint32_t to, double flow)
{
    *(to == SP_FILM_LEFT ? &ends->left : to == SP_FILM_HELD ? &ends->held : &ends->astray) += flow;
}

bool sp_film_run(const sp_film *film, const double *arriving, double *per_width, sp_film_ends *ends, sp_error *error)
{
    double *flow = calloc(film->count + 1, sizeof *flow);
    sp_film_ends found = {0};
    if (!flow)
        return sp_fail_memory(error);
    for (size_t i = 0; i < film->count; i++)
        flow[film->of[i]] += arriving[i];
    for (size_t s = 0; s < film->step_count; s++) {
        double own = flow[film->steps[s]];
        for (size_t k = film->start[s]; k < film->start[s + 1]; k++)
            if (sp_film_is_cell(film->to[k]))
                flow[film->to[k]] += film->share[k] * own;
            else
                end(&found, film->to[k], film->share[k] * own);
    }
    for (size_t i = 0; i < film->count; i++)
        per_width[i] = flow[film->of[i]] * film->per_metre[film->of[i]];
    if (ends)
        *ends = found;
    free(flow);
    return true;
}

bool sp_film_adjoint(const sp_film *film, const double *weight, double *worth, sp_error *error)
{
    double *own = calloc(film->count + 1, sizeof *own);
    if (!own)
        return sp_fail_memory(error);
    for (size_t i = 0; i < film->count; i++)
        own[film->of[i]] += weight[i] * film->per_metre[film->of[i]];
    for (size_t s = film->step_count; s-- > 0;)
        for (size_t k = film->start[s]; k < film->start[s + 1]; k++)
            if (sp_film_is_cell(film->to[k]))
                own[film->steps[s]] += film->share[k] * own[film->to[k]];
    for (size_t i = 0; i < film->count; i++)
        worth[i] = own[film->of[i]];
    free(own);
    return true;
}

const sp_film_pool *sp_film_pools(const sp_film *film, size_t *count)
{
    *count = film->pool_count;
    return film->pools;
}
