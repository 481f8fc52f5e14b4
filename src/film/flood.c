#include "film/flood.h"

#include "mesh/min_max.h"
#include "mesh/key_sort.h"
#include "mesh/disjoint_sets.h"
#include "mesh/heap.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LEVEL 1e-9  /* of the height of all: cells nearer to each other than this are level */
#define DEEP 0.05   /* the same: deeper hollows are not filled */
#define PATIENCE 2  /* texels that the flood rises while a cell waits */
#define LAG 0.5     /* texels that the flood rises before it goes over a free edge */
#define SLIGHT 1e-3 /* of a border's length: what runs over it by less across the flow decides nothing */

/* How liquid runs between a cell and another beside it. */
enum { NONE, TO, FROM };

#define NO_CREST UINT32_MAX
#define HIGHEST 2e9 /* of heights as numbers, whose keys have room for 31 bits */

/* How far the flood has come with a cell. */
enum { DRY, REACHED, LATE, RANKED };

typedef struct {
    const sp_film_surface *surface;
    const sp_film_links *links;
    const uint32_t *ends;
    double low, step;   /* m: where heights count from, and the height of 1 */
    uint32_t *height;   /* [cells], above the lowest, in steps: 1 / LEVEL at most */
    uint32_t *level;    /* [cells], the same, that liquid has to rise to */
    uint32_t *fed;      /* [cells], one of the cells that end there, SP_NONE for none */
    uint32_t *fed_too;  /* [cells], the next one that ends where this one does */
    uint32_t *hollow;   /* [cells], disjoint sets */
    uint8_t *way;       /* [links] */
    uint32_t *waits;    /* [cells], for how many that it runs to and that have no rank yet */
    uint8_t *state;     /* [cells] */
    uint32_t *crest;    /* [cells], the lowest free edge that leads to the sheet's other side; NO_CREST */
    sp_heap heap, late; /* level, whether still, cell; those that wait for others have come into the second */
    sp_film_order *order;
} flood;

static double height_of(const sp_film_surface *surface, uint32_t cell)
{
    return -sp_dot(surface->cells->point[cell], surface->down);
}

/* All cells in the order of their keys, which are freed; NULL where memory ran out, or had for the keys. */
static uint32_t *list_by_keys(uint64_t *keys, size_t count)
{
    uint32_t *rising = malloc((count + 1) * sizeof *rising);
    bool done = keys && rising && (count == 0 || sp_order_by_key(keys, count, rising));
    free(keys);
    if (done)
        return rising;
    free(rising);
    return NULL;
}

/* All cells by height, the lowest first, with keys that hold a double's digits. */
static uint32_t *list_by_height(const flood *own, double low, double high)
{
    size_t count = own->links->count;
    uint64_t *keys = malloc((count + 1) * sizeof *keys);
    for (uint32_t i = 0; keys && i < count; i++)
        keys[i] = (uint64_t)((height_of(own->surface, i) - low) / (high - low) * 0x1p60);
    return list_by_keys(keys, count);
}

/* Heights as numbers, the same for all within a step of the lowest of them: what differs by round-off is level. To
 * round each by itself would part a level that lies where numbers change. */
static bool measure_heights(flood *own)
{
    size_t count = own->links->count;
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        low = sp_lesser(low, height_of(own->surface, i));
        high = sp_greater(high, height_of(own->surface, i));
        own->height[i] = 0;
    }
    own->low = low;
    own->step = LEVEL * (high - low);
    if (!(own->step > 0))
        return true;
    uint32_t *rising = list_by_height(own, low, high);
    bool done = rising;
    double lowest = low;
    for (size_t i = 0; done && i < count; i++) {
        double height = height_of(own->surface, rising[i]);
        if (height > lowest + own->step)
            lowest = height;
        own->height[rising[i]] = (uint32_t)((lowest - low) / own->step);
    }
    free(rising);
    return done;
}

/* The height, as a number, of the free edge that a link leads over. */
static uint32_t crest_of(const flood *own, const sp_film_link *link)
{
    return own->step > 0 ? (uint32_t)fmin(HIGHEST, fmax(0, (link->crest - own->low) / own->step)) : 0;
}

static void find_crests(flood *own)
{
    const sp_film_links *links = own->links;
    for (uint32_t i = 0; i < links->count; i++) {
        own->crest[i] = NO_CREST;
        for (size_t k = links->start[i]; k < links->start[i + 1]; k++) {
            uint32_t crest = sp_film_is_over_rim(&links->links[k]) ? crest_of(own, &links->links[k]) : NO_CREST;
            own->crest[i] = crest < own->crest[i] ? crest : own->crest[i];
        }
    }
}

/* Turns the ends round: which cells end at each. */
static void list_fed(flood *own)
{
    for (size_t i = 0; i < own->links->count; i++)
        own->fed[i] = own->fed_too[i] = SP_NONE;
    for (uint32_t i = (uint32_t)own->links->count; i-- > 0;)
        if (sp_film_is_cell(own->ends[i])) {
            own->fed_too[i] = own->fed[own->ends[i]];
            own->fed[own->ends[i]] = i;
        }
}

/* True where liquid runs over a border in one direction: out of either cell into the edge of a valley, but from the
 * lower one no farther. */
static bool leads(double across, double back, double length, uint32_t from, uint32_t to)
{
    return across > SLIGHT * length && (!(back > SLIGHT * length) || to < from);
}

static uint8_t way_over(const flood *own, uint32_t cell, size_t k)
{
    const sp_film_link *link = &own->links->links[k];
    uint32_t other = own->links->to[k], here = own->height[cell], there = own->height[other];
    if (!own->links->drips[cell] && leads(link->across, link->into, link->length, here, there))
        return TO;
    return !own->links->drips[other] && leads(link->into, link->across, link->length, there, here) ? FROM : NONE;
}

/* Tells which links lead to and from which cells. */
static void direct(flood *own)
{
    for (uint32_t i = 0; i < own->links->count; i++)
        for (size_t k = own->links->start[i]; k < own->links->start[i + 1]; k++)
            own->way[k] = way_over(own, i, k);
}

static void count_waits(flood *own)
{
    const sp_film_links *links = own->links;
    for (uint32_t i = 0; i < links->count; i++) {
        own->waits[i] = 0;
        for (size_t k = links->start[i]; k < links->start[i + 1]; k++)
            own->waits[i] += own->way[k] == TO;
    }
}

/* True where liquid stands on the cell, or lies on a flat. */
static bool is_still(const flood *own, uint32_t cell)
{
    const sp_film_links *links = own->links;
    bool still = true;
    for (size_t k = links->start[cell]; still && k < links->start[cell + 1]; k++)
        still = own->way[k] != TO;
    return still || own->order->sunk[cell];
}

/* Of cells at one level those that run on come first: a pool among them runs over to all of these. */
static uint64_t key_of(const flood *own, uint32_t cell)
{
    assert(own->level[cell] >> 31 == 0);
    return (uint64_t)own->level[cell] << 33 | (uint64_t)is_still(own, cell) << 32 | cell;
}

/* How high liquid has to stand to run over that link, a free edge, to a cell. */
static uint32_t level_over(const flood *own, uint32_t to, size_t link)
{
    uint32_t crest = crest_of(own, &own->links->links[link]);
    return own->order->sunk[to] && own->level[to] > crest ? own->level[to] : crest;
}

static void take(flood *own, uint32_t cell, uint32_t from, uint32_t level)
{
    own->state[cell] = REACHED;
    own->order->parent[cell] = from;
    bool sunk = own->order->sunk[cell] = level > own->height[cell];
    own->level[cell] = sunk ? level : own->height[cell];
}

static bool reach(flood *own, uint32_t cell, uint32_t from, uint32_t level)
{
    if (own->state[cell] != DRY)
        return true;
    take(own, cell, from, level);
    return sp_heap_push(&own->heap, key_of(own, cell));
}

/* Over a free edge to the other side of a sheet, a little later than its height says: by then what the edges beside it
 * lead to has its rank, though its points lie higher, and other ways there, which may be lower, have been found. */
static bool reach_over(flood *own, uint32_t cell, size_t k)
{
    uint32_t other = own->links->to[k];
    if (own->state[other] != DRY)
        return true;
    uint64_t turn = level_over(own, cell, k);
    if (own->step > 0)
        turn = (uint64_t)fmin(HIGHEST, (double)turn + LAG * own->surface->cells->length[other] / own->step);
    return sp_heap_push(&own->heap, turn << 33 | (uint64_t)1 << 32 | other);
}

/* Of a cell that no other way led to before its turn: over the lowest of its edges that the flood has come to. */
static void come_over(flood *own, uint32_t cell)
{
    const sp_film_links *links = own->links;
    uint32_t from = SP_NONE, least = UINT32_MAX;
    for (size_t k = links->start[cell]; k < links->start[cell + 1]; k++) {
        const sp_film_link *link = &links->links[k];
        uint32_t other = links->to[k], level = sp_film_is_over_rim(link) ? level_over(own, other, k) : UINT32_MAX;
        if (own->state[other] == RANKED && level < least) {
            from = other;
            least = level;
        }
    }
    assert(from != SP_NONE);
    take(own, cell, from, least);
}

/* True where the flood came to the cell over a free edge. */
static bool has_come_over(const flood *own, uint32_t cell)
{
    const sp_film_links *links = own->links;
    bool over = false;
    for (size_t k = links->start[cell]; own->crest[cell] != NO_CREST && k < links->start[cell + 1]; k++)
        over = over || (sp_film_is_over_rim(&links->links[k]) && links->to[k] == own->order->parent[cell]);
    return over;
}

/* True where all that the cell runs to has its rank and lies in no hollow: then it lies in none, whatever its point. */
static bool runs_on(const flood *own, uint32_t cell)
{
    const sp_film_links *links = own->links;
    bool any = false;
    for (size_t k = links->start[cell]; k < links->start[cell + 1]; k++) {
        if (own->way[k] != TO)
            continue;
        if (own->state[links->to[k]] != RANKED || own->order->sunk[links->to[k]])
            return false;
        any = true;
    }
    return any;
}

/* Behind a free edge liquid stands as high as in what the cell runs to; less than the edge where it leaves elsewhere.
 */
static void sink_behind(flood *own, uint32_t cell)
{
    const sp_film_links *links = own->links;
    uint32_t level = own->height[cell];
    bool known = false;
    for (size_t k = links->start[cell]; k < links->start[cell + 1]; k++) {
        uint32_t other = links->to[k];
        if (own->way[k] != TO || own->state[other] != RANKED)
            continue;
        known = true;
        if (own->order->sunk[other] && own->level[other] > level)
            level = own->level[other];
    }
    if (!known)
        return; /* it is the first of them */
    own->level[cell] = level;
    own->order->sunk[cell] = level > own->height[cell];
}

/* Gives the cell its rank, and goes on to those beside it: what has waited for it alone waits no more. */
static bool settle(flood *own, uint32_t cell, uint32_t *rank)
{
    const sp_film_links *links = own->links;
    own->state[cell] = RANKED;
    own->order->rank[cell] = (*rank)++;
    if (has_come_over(own, cell))
        sink_behind(own, cell);
    if (own->order->sunk[cell] && runs_on(own, cell)) {
        own->order->sunk[cell] = false;
        own->level[cell] = own->height[cell];
    }
    own->order->over[cell] = own->level[cell] + 1 >= own->crest[cell]; /* 1 is round-off */
    bool done = true;
    for (size_t k = links->start[cell]; done && k < links->start[cell + 1]; k++) {
        uint32_t other = links->to[k];
        assert(own->way[k] != FROM || own->waits[other] > 0);
        bool ready = own->way[k] == FROM && --own->waits[other] == 0;
        if (own->state[other] == LATE && ready)
            done = sp_heap_push(&own->heap, key_of(own, other));
        else if (!links->drips[other])
            done = sp_film_is_over_rim(&links->links[k]) ? reach_over(own, cell, k)
                                                         : reach(own, other, cell, own->level[cell]);
    }
    for (uint32_t fed = own->fed[cell]; done && fed != SP_NONE; fed = own->fed_too[fed])
        done = reach(own, fed, cell, own->level[cell]);
    return done;
}

/* True where it is the turn of a cell that waits: only heights that cells have within themselves are waited for. */
static bool is_late(const flood *own)
{
    if (!own->late.count || !own->heap.count)
        return own->late.count;
    uint64_t key = own->late.keys[0];
    double waited = own->step * ((double)(own->heap.keys[0] >> 33) - (double)(key >> 33));
    return waited > PATIENCE * own->surface->cells->length[(uint32_t)key];
}

/* Empties the heaps. A cell takes its turn when all that it runs to have had theirs; where these wait for it in turn,
 * or lie in a hollow beneath it, by height. */
static bool spread(flood *own, uint32_t *rank)
{
    while (own->heap.count || own->late.count) {
        bool late = is_late(own);
        uint64_t key = sp_heap_pop(late ? &own->late : &own->heap);
        uint32_t cell = (uint32_t)key;
        if (own->state[cell] == DRY)
            come_over(own, cell);
        else if (key >> 33 != own->level[cell])
            continue; /* another way led there */
        bool waits = !late && own->waits[cell] > 0;
        if (waits)
            own->state[cell] = LATE;
        if (waits ? !sp_heap_push(&own->late, key_of(own, cell))
                  : own->state[cell] != RANKED && !settle(own, cell, rank))
            return false;
    }
    return true;
}

/* All cells, the lowest first; NULL where memory ran out. */
static uint32_t *list_rising(const flood *own)
{
    size_t count = own->links->count;
    uint64_t *keys = malloc((count + 1) * sizeof *keys);
    for (size_t i = 0; keys && i < count; i++)
        keys[i] = own->height[i];
    return list_by_keys(keys, count);
}

/* Liquid stands at the lowest cell of what has no end. */
static bool hold_rest(flood *own, uint32_t rank)
{
    if (rank == own->links->count)
        return true;
    uint32_t *rising = list_rising(own);
    bool done = rising;
    for (size_t i = 0; done && i < own->links->count; i++) {
        uint32_t lowest = rising[i];
        if (own->state[lowest] != DRY)
            continue;
        own->order->held[lowest] = true;
        done = reach(own, lowest, SP_NONE, own->height[lowest]) && spread(own, &rank);
    }
    free(rising);
    assert(!done || rank == own->links->count); /* every cell has its own */
    return done;
}

/* From all ends and from where liquid stands, then from the lowest of what none of these drains. */
static bool fill(flood *own)
{
    size_t count = own->links->count;
    uint32_t rank = 0;
    memset(own->state, DRY, count);
    count_waits(own);
    for (uint32_t i = 0; i < count; i++)
        if ((own->order->held[i] || own->ends[i] == SP_FILM_LEFT || own->ends[i] == SP_FILM_ASTRAY) &&
            !reach(own, i, SP_NONE, own->height[i]))
            return false;
    return spread(own, &rank) && hold_rest(own, rank);
}

/* True where so much liquid would stand on a cell. */
static bool is_deep(const flood *own, uint32_t cell)
{
    return own->order->sunk[cell] && own->level[cell] - own->height[cell] > DEEP / LEVEL;
}

static void join_hollows(flood *own)
{
    const sp_film_links *links = own->links;
    const bool *sunk = own->order->sunk;
    for (uint32_t i = 0; i < links->count; i++)
        own->hollow[i] = i;
    for (uint32_t i = 0; i < links->count; i++)
        for (size_t k = links->start[i]; sunk[i] && k < links->start[i + 1]; k++)
            if (sunk[links->to[k]] && !sp_film_is_over_rim(&links->links[k]))
                sp_set_join(own->hollow, i, links->to[k]);
}

/* Marks the lowest cell of every hollow that is too deep to be filled; *any is false where there is none. */
static bool drain_deep(flood *own, bool *any)
{
    *any = false;
    for (uint32_t i = 0; i < own->links->count; i++)
        *any = *any || is_deep(own, i);
    if (!*any)
        return true;
    uint32_t *rising = list_rising(own);
    uint8_t *drained = own->state; /* by set; how far the flood came is not asked for any more */
    memset(drained, 0, own->links->count);
    join_hollows(own);
    for (size_t i = 0; rising && i < own->links->count; i++) {
        uint32_t cell = rising[i], hollow = sp_set_root(own->hollow, cell);
        if (drained[hollow] || !is_deep(own, cell))
            continue;
        drained[hollow] = true;
        own->order->held[cell] = true;
    }
    free(rising);
    return rising;
}

static bool allocate(flood *own, sp_film_order *order, size_t room)
{
    *order = (sp_film_order){.rank = malloc(room * sizeof *order->rank),
                             .parent = malloc(room * sizeof *order->parent),
                             .sunk = calloc(room, sizeof *order->sunk),
                             .held = calloc(room, sizeof *order->held),
                             .over = calloc(room, sizeof *order->over)};
    own->height = malloc(room * sizeof *own->height);
    own->level = malloc(room * sizeof *own->level);
    own->fed = malloc(room * sizeof *own->fed);
    own->fed_too = malloc(room * sizeof *own->fed_too);
    own->hollow = malloc(room * sizeof *own->hollow);
    own->way = malloc(own->links->start[own->links->count] + 1);
    own->waits = malloc(room * sizeof *own->waits);
    own->state = malloc(room * sizeof *own->state);
    own->crest = malloc(room * sizeof *own->crest);
    return order->rank && order->parent && order->sunk && order->held && order->over && own->height && own->level &&
           own->fed && own->fed_too && own->hollow && own->way && own->waits && own->state && own->crest;
}

static void flood_free(flood *own)
{
    free(own->height);
    free(own->level);
    free(own->fed);
    free(own->fed_too);
    free(own->hollow);
    free(own->way);
    free(own->waits);
    free(own->state);
    free(own->crest);
    free(own->heap.keys);
    free(own->late.keys);
}

bool sp_film_order_create(const sp_film_surface *surface, const sp_film_links *links, const uint32_t *ends,
                          sp_film_order *order, sp_error *error)
{
    flood own = {.surface = surface, .links = links, .ends = ends, .order = order};
    bool done = allocate(&own, order, links->count + 1), again = done;
    done = done && measure_heights(&own);
    if (done) {
        find_crests(&own);
        list_fed(&own);
        direct(&own);
    }
    while (done && again) /* each turn holds what the one before found nested in it */
        done = fill(&own) && drain_deep(&own, &again);
    flood_free(&own);
    if (done)
        return true;
    sp_film_order_free(order);
    return sp_fail_memory(error);
}

void sp_film_order_free(sp_film_order *order)
{
    free(order->rank);
    free(order->parent);
    free(order->sunk);
    free(order->held);
    free(order->over);
    *order = (sp_film_order){0};
}
