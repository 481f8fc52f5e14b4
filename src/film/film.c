#include "film/film.h"

#include "film/drips.h"
#include "film/shares.h"

#include "mesh/counting_sort.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* What flows on a cell, or in a pool, has a slot each, in the order in which liquid comes down them, then what ends in
 * each way. A slot draws from those before it: to hand on instead would wait for what was just written. */
struct sp_film {
    size_t count;      /* of cells */
    uint32_t *slot;    /* [cells], of the cell or the pool that it is in */
    size_t steps;      /* slots but the ends' */
    double *per_metre; /* [steps], 1/m */
    size_t *start;     /* [steps + ENDS + 1], of from and share: always even, so that two at a time need no question */
    uint32_t *from;    /* slots */
    double *share;     /* of what runs there; those from a step come to 1 */
    size_t pool_count;
    sp_film_pool *pools;
};

enum { LEFT, HELD, ASTRAY, ENDS };

/* Shares on their way into slots. */
typedef struct {
    const sp_film_shares *shares;
    uint32_t *by_rank; /* [shares], numbers of the shares in the order of where they come from */
    uint32_t *step_of; /* [cells], of those that stand for themselves or a pool */
} sorting;

static uint32_t target(const sp_film *film, const sorting *s, uint32_t to)
{
    uint32_t end = to == SP_FILM_LEFT ? LEFT : to == SP_FILM_HELD ? HELD : ASTRAY;
    return sp_film_is_cell(to) ? s->step_of[to] : (uint32_t)film->steps + end;
}

/* Numbers the steps, and sets what each is wide. */
static void number_steps(sp_film *film, const sorting *s, const sp_film_basins *basins)
{
    const sp_film_share *items = s->shares->items;
    for (size_t i = 0; i < s->shares->count; i++) {
        const sp_film_share *share = &items[s->by_rank[i]];
        if (i && items[s->by_rank[i - 1]].from == share->from)
            continue;
        s->step_of[share->from] = (uint32_t)film->steps;
        /* what stands is not what runs by: it counts as nothing */
        film->per_metre[film->steps++] = share->to == SP_FILM_HELD ? 0 : 1 / s->shares->width[share->from];
    }
    for (size_t i = 0; i < film->count; i++)
        film->slot[i] = s->step_of[basins->of[i]];
}

/* Every slot's sources, by falling rank. */
static void draw_links(sp_film *film, const sorting *s)
{
    const sp_film_share *items = s->shares->items;
    size_t slots = film->steps + ENDS, *start = film->start;
    for (size_t i = 0; i < s->shares->count; i++)
        start[target(film, s, items[i].to) + 1]++;
    for (size_t k = 0; k < slots; k++)
        start[k + 1] = start[k] + (start[k + 1] + 1) / 2 * 2;
    for (size_t i = 0; i < start[slots]; i++)
        film->share[i] = film->from[i] = 0;
    for (size_t i = 0, end; i < s->shares->count; i = end) {
        uint32_t from = items[s->by_rank[i]].from;
        double width = 0;
        for (end = i; end < s->shares->count && items[s->by_rank[end]].from == from; end++)
            width += items[s->by_rank[end]].width;
        assert(width > 0);
        for (size_t k = i; k < end; k++) {
            /* liquid comes to later slots alone */
            assert(s->step_of[from] < target(film, s, items[s->by_rank[k]].to));
            size_t at = start[target(film, s, items[s->by_rank[k]].to)]++;
            film->from[at] = s->step_of[from];
            film->share[at] = items[s->by_rank[k]].width / width;
        }
    }
}

/* Starts that filling has moved to where each slot's sources end, an odd number of them without its spare. */
static void put_back(sp_film *film)
{
    size_t first = 0;
    for (size_t k = 0; k <= film->steps + ENDS; k++) {
        size_t end = (film->start[k] + 1) / 2 * 2;
        assert(first <= end);
        film->start[k] = first;
        first = end;
    }
}

static bool line_up(sp_film *film, const sp_film_shares *shares, const sp_film_basins *basins,
                    const sp_film_order *order, sp_error *error)
{
    uint32_t *keys = malloc((shares->count + 1) * sizeof *keys);
    sorting s = {shares, malloc((shares->count + 1) * sizeof(uint32_t)), calloc(film->count + 1, sizeof(uint32_t))};
    bool done = keys && s.by_rank && s.step_of;
    for (uint32_t i = 0; done && i < shares->count; i++) {
        s.by_rank[i] = i;
        keys[i] = (uint32_t)film->count - 1 - order->rank[shares->items[i].from];
    }
    done = done && sp_counting_sort(s.by_rank, shares->count, keys, film->count, error);
    if (done) {
        number_steps(film, &s, basins);
        draw_links(film, &s);
        put_back(film);
    }
    free(keys);
    free(s.by_rank);
    free(s.step_of);
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

static bool assemble(sp_film *film, const sp_film_surface *surface, const sp_film_basins *basins,
                     const sp_film_order *order, const sp_film_shares *shares, sp_error *error)
{
    size_t room = film->count + ENDS + 1, links = shares->count + room;
    film->slot = malloc(room * sizeof *film->slot);
    film->per_metre = malloc(room * sizeof *film->per_metre);
    film->start = calloc(room, sizeof *film->start);
    film->from = malloc(links * sizeof *film->from);
    film->share = malloc(links * sizeof *film->share);
    film->pools = malloc(room * sizeof *film->pools);
    return film->slot && film->per_metre && film->start && film->from && film->share && film->pools &&
           line_up(film, shares, basins, order, error) && list_pools(film, surface, basins, shares);
}

sp_film *sp_film_create(const sp_film_surface *surface, sp_error *error)
{
    sp_film *film = calloc(1, sizeof *film);
    sp_film_links links = {0};
    sp_film_order order = {0};
    sp_film_basins basins = {0};
    sp_film_shares shares = {0};
    uint32_t *ends = NULL;
    assert(fabs(sp_length(surface->down) - 1) < 1e-6);
    bool done = film && sp_film_links_create(surface, &links, error) && sp_film_drips_find(surface, &links, error) &&
                (ends = sp_film_ends_find(surface, &links, error)) &&
                sp_film_order_create(surface, &links, ends, &order, error) &&
                sp_film_basins_create(surface, &links, ends, &order, &basins, error) &&
                sp_film_shares_create(surface, &links, ends, &order, &basins, &shares, error);
    if (done) {
        film->count = links.count;
        done = assemble(film, surface, &basins, &order, &shares, error);
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
    free(film->slot);
    free(film->per_metre);
    free(film->start);
    free(film->from);
    free(film->share);
    free(film->pools);
    free(film);
}

size_t sp_film_flows(const sp_film *film)
{
    return film->steps + ENDS;
}

void sp_film_run_in(const sp_film *film, const double *arriving, double *flow, double *per_width, sp_film_ends *ends)
{
    memset(flow, 0, sp_film_flows(film) * sizeof *flow);
    for (size_t i = 0; i < film->count; i++)
        flow[film->slot[i]] += arriving[i];
    for (size_t s = 0; s < film->steps + ENDS; s++) {
        double sum = flow[s];
        for (size_t k = film->start[s]; k < film->start[s + 1]; k += 2) {
            sum += film->share[k] * flow[film->from[k]];
            sum += film->share[k + 1] * flow[film->from[k + 1]];
        }
        flow[s] = sum;
    }
    for (size_t i = 0; i < film->count; i++)
        per_width[i] = flow[film->slot[i]] * film->per_metre[film->slot[i]];
    if (ends)
        *ends = (sp_film_ends){
            .left = flow[film->steps + LEFT], .astray = flow[film->steps + ASTRAY], .held = flow[film->steps + HELD]};
}

bool sp_film_run(const sp_film *film, const double *arriving, double *per_width, sp_film_ends *ends, sp_error *error)
{
    double *flow = malloc(sp_film_flows(film) * sizeof *flow);
    if (!flow)
        return sp_fail_memory(error);
    sp_film_run_in(film, arriving, flow, per_width, ends);
    free(flow);
    return true;
}

bool sp_film_adjoint(const sp_film *film, const double *weight, double *worth, sp_error *error)
{
    double *own = calloc(sp_film_flows(film), sizeof *own);
    if (!own)
        return sp_fail_memory(error);
    for (size_t i = 0; i < film->count; i++)
        own[film->slot[i]] += weight[i] * film->per_metre[film->slot[i]];
    for (size_t s = film->steps; s-- > 0;)
        for (size_t k = film->start[s]; k < film->start[s + 1]; k++)
            own[film->from[k]] += film->share[k] * own[s];
    for (size_t i = 0; i < film->count; i++)
        worth[i] = own[film->slot[i]];
    free(own);
    return true;
}

const sp_film_pool *sp_film_pools(const sp_film *film, size_t *count)
{
    *count = film->pool_count;
    return film->pools;
}
