#include "certificate/aim_pricing.h"

#include "certificate/pose_price.h"
#include "certificate/pose_rows.h"
#include "bound/rounding.h"
#include "nozzle/strength.h"
#include "ranks/messages.h"
#include "scoring/scoring.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define CLOSE 1.01    /* a cell's bound over the best known aim's price, that is not worth a split */
#define CELLS_EACH 20 /* for each candidate, that one pricing looks at, about, and more where these are few */
#define CELLS_MORE 10000
#define CELLS_MOST 80000
#define ROWS_AT_A_TIME 200
#define CULLS 16                      /* kept by each thread */
#define KEY_FIRST (UINT64_C(1) << 62) /* of rows for aims, which have no number */

typedef struct {
    bool used;
    sp_count count;
    sp_spray spray;
    sp_cull cull;
} kept_cull;

/* One thread's own. */
typedef struct {
    sp_view_buffer *buffer;
    const sp_view *view;
    float *worth; /* [largest view + SP_LANES] */
    float total[SP_BINS];
    kept_cull *culls; /* [CULLS], of the view */
    size_t next_cull;
} scratch;

typedef struct {
    sp_aim_cell cell;
    double middle; /* price of its middle; 0: of no use */
    double excess; /* its bound over what it may be; 0: not above it */
    size_t group;  /* scratch of loops */
} entry;

typedef struct {
    size_t count, capacity;
    entry *items;
} cell_list;

/* A cell's middle that is worth more than needed. */
typedef struct {
    sp_aim_cell cell;
    double excess; /* price over what is needed; 0: none */
} aim;

struct sp_aim_pricing {
    const sp_search *search;
    const sp_cover *cover;
    const sp_aim_kinds *kinds;
    const uint32_t *const *tier_of;
    const size_t *ports;
    const sp_pose_pricing *poses;
    int threads;
    scratch *scratches; /* [threads] */
    aim *best;          /* [sites x kinds] */
    double *known;      /* [ports + 1][tiers], the best price known, the last place being all that is no port */
    float *field;       /* [texels] */
    size_t water;       /* that a bound is sought for */
    sp_knapsack knapsack;
    double *fair; /* [tiers], worth of a nozzle that does not raise the bound; INFINITY: it takes too much */
    cell_list open, next;
    size_t looked_at; /* cells, by this pricing */
    size_t enough;    /* of these */
    uint64_t keys;    /* given out so far */
};

static bool scratch_create(const sp_search *search, scratch *own)
{
    own->worth = calloc(search->visibility->largest + SP_LANES, sizeof *own->worth);
    own->culls = calloc(CULLS, sizeof *own->culls);
    return own->worth && own->culls;
}

sp_aim_pricing *sp_aim_pricing_create(const sp_search *search, const sp_cover *cover, const sp_aim_kinds *kinds,
                                      const uint32_t *const *tier_of, const size_t *ports, const sp_pose_pricing *poses,
                                      sp_error *error)
{
    sp_aim_pricing *pricing = malloc(sizeof *pricing);
    if (!pricing)
        return sp_fail_memory(error);
    *pricing = (sp_aim_pricing){.search = search,
                                .cover = cover,
                                .kinds = kinds,
                                .tier_of = tier_of,
                                .ports = ports,
                                .poses = poses,
                                .threads = sp_scorer_threads(search),
                                .water = cover->water};
    pricing->scratches = calloc((size_t)pricing->threads, sizeof *pricing->scratches);
    pricing->best = calloc(search->sites->count + 1, kinds->count * sizeof *pricing->best);
    pricing->known = calloc((cover->port_count + 1) * cover->tier_count, sizeof *pricing->known);
    pricing->field = malloc((search->patch_count + 1) * sizeof *pricing->field);
    pricing->fair = malloc((cover->tier_count + 1) * sizeof *pricing->fair);
    size_t enough = CELLS_MORE + CELLS_EACH * search->candidates->pose_start[search->sites->count];
    pricing->enough = enough < CELLS_MOST ? enough : CELLS_MOST;
    bool done = (pricing->scratches && pricing->best && pricing->known && pricing->field && pricing->fair) ||
                sp_fail_memory(error);
    done = done && sp_knapsack_create(cover->nozzles, cover->water, &pricing->knapsack, error);
    for (int i = 0; done && i < pricing->threads; i++)
        done = scratch_create(search, &pricing->scratches[i]) || sp_fail_memory(error);
    if (done)
        return pricing;
    sp_aim_pricing_destroy(pricing);
    return NULL;
}

void sp_aim_pricing_destroy(sp_aim_pricing *pricing)
{
    if (!pricing)
        return;
    for (int i = 0; pricing->scratches && i < pricing->threads; i++) {
        free(pricing->scratches[i].worth);
        free(pricing->scratches[i].culls);
    }
    free(pricing->scratches);
    free(pricing->best);
    free(pricing->known);
    free(pricing->field);
    sp_knapsack_free(&pricing->knapsack);
    free(pricing->fair);
    free(pricing->open.items);
    free(pricing->next.items);
    free(pricing);
}

void sp_aim_pricing_seek(sp_aim_pricing *pricing, size_t water)
{
    pricing->water = water;
}

static bool append(cell_list *cells, const sp_aim_cell *cell)
{
    if (cells->count == cells->capacity) {
        size_t capacity = cells->capacity ? 2 * cells->capacity : 1024;
        entry *items = realloc(cells->items, capacity * sizeof *items);
        if (!items)
            return false;
        cells->items = items;
        cells->capacity = capacity;
    }
    cells->items[cells->count++] = (entry){.cell = *cell};
    return true;
}

static double tilt_of(const sp_aim_pricing *pricing, uint32_t site)
{
    return pricing->search->options->mounts[pricing->search->sites->items[site].mount].tilt;
}

static uint32_t tier_of(const sp_aim_pricing *pricing, const sp_aim_cell *cell)
{
    size_t mount = pricing->search->sites->items[cell->site].mount;
    return pricing->tier_of[mount * pricing->kinds->count + cell->kind][cell->step];
}

/* The best price known of the cell's port, or of all other mounting points, and tier. */
static double *known_of(const sp_aim_pricing *pricing, const sp_aim_cell *cell)
{
    size_t port = pricing->ports[pricing->search->sites->items[cell->site].mount];
    size_t place = port == SP_NO_PORT ? pricing->cover->port_count : port;
    return &pricing->known[place * pricing->cover->tier_count + tier_of(pricing, cell)];
}

/* The most flux over threshold per transfer of a view of a cell's aims, and the least. */
static double strength_of(const sp_aim_pricing *pricing, const sp_aim_cell *cell)
{
    double plenty = pricing->search->plenty;
    return sp_strength(sp_aim_cell_intensity(cell, &pricing->kinds->items[cell->kind]), 1, plenty);
}
static double least_strength_of(const sp_aim_pricing *pricing, const sp_aim_cell *cell)
{
    double plenty = pricing->search->plenty;
    return sp_strength(sp_aim_cell_intensity_least(cell, &pricing->kinds->items[cell->kind]), 1, plenty);
}

/* Whether two cells need the same worths of arrivals. */
static bool alike(const sp_aim_cell *a, const sp_aim_cell *b)
{
    return a->site == b->site && a->kind == b->kind && a->step == b->step && a->angle_low == b->angle_low &&
           a->angle_high == b->angle_high;
}

static const sp_cull *cull_of(scratch *own, const sp_bins *bins, const sp_spray *spray, sp_count count)
{
    for (size_t i = 0; i < CULLS; i++)
        if (own->culls[i].used && own->culls[i].count == count && sp_spray_is_same(&own->culls[i].spray, spray))
            return &own->culls[i].cull;
    kept_cull *kept = &own->culls[own->next_cull++ % CULLS];
    kept->used = true;
    kept->spray = *spray;
    kept->count = count;
    sp_cull_create(bins, own->view, spray, count, &kept->cull);
    return &kept->cull;
}

/* The sum over all that aims sprayed as `cell` about `disc` may have a share of; counted by shares, over these. */
static double reach_price(const sp_aim_pricing *pricing, scratch *own, const sp_aim_cell *cell, sp_aim_disc disc,
                          sp_count count)
{
    const sp_search *search = pricing->search;
    sp_spray spray = sp_aim_cell_spray(cell, &pricing->kinds->items[cell->kind], disc.radius);
    sp_frame frame = sp_aim_cell_frame(cell, &disc, sp_evaluator_setup(search->coarse)->up);
    sp_region region = sp_region_create(&spray, &frame, strength_of(pricing, cell), 0);
    region.count = count;
    region.outline.narrowest = (float)(2 * sin(0.25 * cell->angle_low));
    const sp_bins *bins = &search->visibility->bins;
    const sp_weight weight = {own->worth, own->total};
    double price;
    search->kernels->sum(bins, cull_of(own, bins, &spray, count), &region, own->view, &weight, 1, 0, &price);
    return price * SP_UPWARDS_SUM;
}

/* Turns to what a cell's aims bring at most; false where nothing is seen. */
static bool turn_to(const sp_aim_pricing *pricing, scratch *own, const sp_aim_cell *cell, const sp_multipliers *u)
{
    const sp_search *search = pricing->search;
    const sp_aim_kind *kind = &pricing->kinds->items[cell->kind];
    for (size_t i = 0; i < CULLS; i++)
        own->culls[i].used = false;
    own->view = sp_visibility_look(search->visibility, cell->site, kind->launch, &own->buffer);
    if (!own->view->start)
        return false;
    sp_pose_pricing_worth(pricing->poses, own->view, (float)least_strength_of(pricing, cell),
                          (float)strength_of(pricing, cell), u, own->worth, own->total);
    return true;
}

/* Bounds of cells that are alike, and the prices of the middles of those that may matter. */
static void price_alike(const sp_aim_pricing *pricing, scratch *own, entry *entries, size_t count,
                        const sp_multipliers *u)
{
    const sp_site *site = &pricing->search->sites->items[entries[0].cell.site];
    double tilt = tilt_of(pricing, entries[0].cell.site);
    bool sees = turn_to(pricing, own, &entries[0].cell, u);
    for (size_t i = 0; i < count; i++) {
        sp_aim_cell *cell = &entries[i].cell;
        sp_aim_disc disc = sp_aim_cell_disc(cell, site, tilt);
        /* nor more than the cell that it is a piece of */
        cell->upper = sees ? fmin(cell->upper, reach_price(pricing, own, cell, disc, SP_COUNT_GENEROUS)) : 0;
        entries[i].middle = 0;
        if (cell->upper <= fmin(*known_of(pricing, cell), pricing->fair[tier_of(pricing, cell)]) ||
            sp_dot(disc.axis, site->axis) < cos(tilt) - 1e-12)
            continue;
        sp_aim_cell middle = sp_aim_cell_middle(cell, &pricing->kinds->items[cell->kind]);
        entries[i].middle = reach_price(pricing, own, &middle, (sp_aim_disc){disc.axis, 0}, SP_COUNT_SHARE);
    }
}

static sp_ranks *ranks_of(const sp_aim_pricing *pricing)
{
    return pricing->search->options->run.ranks;
}

/* The others' bounds, and the prices of middles. */
static bool share_open(sp_aim_pricing *pricing, sp_error *error)
{
    cell_list *open = &pricing->open;
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    for (size_t i = 0; sp_ranks_count(ranks_of(pricing)) > 1 && i < open->count; i++)
        if (sp_ranks_mine(ranks_of(pricing), open->items[i].cell.site)) {
            sp_pack(&outgoing, &open->items[i].cell.upper, sizeof(double));
            sp_pack(&outgoing, &open->items[i].middle, sizeof(double));
        }
    if (!sp_ranks_gather(ranks_of(pricing), "aims", &outgoing, &gathered, error))
        return false;
    for (size_t i = 0; i < open->count; i++) {
        entry *cell = &open->items[i];
        if (sp_ranks_mine(ranks_of(pricing), cell->cell.site))
            continue;
        sp_unpack(&gathered, sp_ranks_owner(ranks_of(pricing), cell->cell.site), &cell->cell.upper, sizeof(double));
        sp_unpack(&gathered, sp_ranks_owner(ranks_of(pricing), cell->cell.site), &cell->middle, sizeof(double));
    }
    sp_gathered_free(&gathered);
    return true;
}

/* All open cells, each rank those of its own sites. */
static bool price_open(sp_aim_pricing *pricing, const sp_multipliers *u, sp_error *error)
{
    cell_list *open = &pricing->open;
    size_t groups = 0;
    sp_ranks_part(ranks_of(pricing));
    for (size_t i = 0; i < open->count; i++)
        if (!i || !alike(&open->items[i - 1].cell, &open->items[i].cell))
            open->items[groups++].group = i;
#pragma omp parallel for num_threads(pricing->threads) schedule(dynamic, 1)
    for (size_t g = 0; g < groups; g++) {
        size_t first = open->items[g].group, end = g + 1 < groups ? open->items[g + 1].group : open->count;
        if (sp_ranks_mine(ranks_of(pricing), open->items[first].cell.site) && sp_cover_goes_on(pricing->cover))
            price_alike(pricing, &pricing->scratches[omp_get_thread_num()], &open->items[first], end - first, u);
    }
    for (int i = 0; i < pricing->threads; i++)
        sp_visibility_release(pricing->search->visibility, &pricing->scratches[i].buffer);
    pricing->looked_at += open->count;
    sp_ranks_rejoin(ranks_of(pricing));
    return share_open(pricing, error);
}

/* Remembers the middles: as what is known, and as what may be handed out. */
static void note_middles(sp_aim_pricing *pricing)
{
    for (size_t i = 0; i < pricing->open.count; i++) {
        const entry *found = &pricing->open.items[i];
        const sp_aim_cell *cell = &found->cell;
        double *known = known_of(pricing, cell), need = pricing->fair[tier_of(pricing, cell)];
        *known = fmax(*known, found->middle);
        aim *best = &pricing->best[cell->site * pricing->kinds->count + cell->kind];
        double excess = need > 0 ? found->middle / need : found->middle * 1e30;
        if (found->middle > need && excess > best->excess)
            *best = (aim){*cell, excess};
    }
}

/* What a cell's bound may be without mattering more than what is known anyway. */
static double harmless(const sp_aim_pricing *pricing, const sp_aim_cell *cell)
{
    return fmax(CLOSE * *known_of(pricing, cell), pricing->fair[tier_of(pricing, cell)]);
}

static int by_excess(const void *a, const void *b)
{
    const entry *p = a, *q = b;
    if (p->excess != q->excess)
        return p->excess > q->excess ? -1 : 1;
    return (p->group > q->group) - (p->group < q->group);
}

static int by_likeness(const void *a, const void *b)
{
    const sp_aim_cell *p = &((const entry *)a)->cell, *q = &((const entry *)b)->cell;
    const uint32_t left[] = {p->site, p->kind, p->step}, right[] = {q->site, q->kind, q->step};
    for (size_t i = 0; i < 3; i++)
        if (left[i] != right[i])
            return left[i] < right[i] ? -1 : 1;
    const double l[] = {p->angle_low, p->angle_high, p->level, p->u, p->v, p->roll};
    const double r[] = {q->angle_low, q->angle_high, q->level, q->u, q->v, q->roll};
    for (size_t i = 0; i < 6; i++)
        if (l[i] != r[i])
            return l[i] < r[i] ? -1 : 1;
    return 0;
}

/* Splits the open cells that matter, the highest first, as long as there is work left to spend; offers the others. */
static bool split_open(sp_aim_pricing *pricing, sp_offers *offers)
{
    cell_list *open = &pricing->open, *next = &pricing->next;
    next->count = 0;
    for (size_t i = 0; i < open->count; i++) {
        entry *own = &open->items[i];
        double limit = harmless(pricing, &own->cell);
        own->group = i;
        own->excess = own->cell.upper > limit ? own->cell.upper / limit : 0;
    }
    qsort(open->items, open->count, sizeof *open->items, by_excess);
    for (size_t i = 0; i < open->count; i++) {
        const sp_aim_cell *cell = &open->items[i].cell;
        const sp_aim_kind *kind = &pricing->kinds->items[cell->kind];
        const sp_site *site = &pricing->search->sites->items[cell->site];
        double tilt = tilt_of(pricing, cell->site);
        sp_aim_cell children[SP_AIM_CHILDREN];
        size_t count = 0;
        if (open->items[i].excess > 0 && pricing->looked_at + next->count < pricing->enough &&
            sp_aim_cell_splits(cell, kind, site, tilt))
            count = sp_aim_cell_split(cell, kind, site, tilt, children);
        else
            sp_offers_add(offers, pricing->ports[site->mount], tier_of(pricing, cell), cell->upper);
        for (size_t k = 0; k < count; k++)
            if (!append(next, &children[k]))
                return false;
    }
    cell_list before = *open;
    *open = *next;
    *next = before;
    if (open->count > 1)
        qsort(open->items, open->count, sizeof *open->items, by_likeness);
    return true;
}

/* All aims at all mounting points, in as few cells as can be. */
static bool open_all(sp_aim_pricing *pricing)
{
    const sp_search *search = pricing->search;
    pricing->open.count = pricing->looked_at = 0;
    for (uint32_t site = 0; site < search->sites->count; site++)
        for (uint32_t k = 0; k < pricing->kinds->count; k++) {
            const sp_aim_kind *kind = &pricing->kinds->items[k];
            uint32_t mount = search->sites->items[site].mount;
            pricing->best[site * pricing->kinds->count + k] = (aim){0};
            if (search->port_taken[mount] || !sp_candidates_axes(search->candidates, mount, kind->variant)->count)
                continue;
            for (uint32_t step = 0; step < kind->step_count; step++) {
                sp_aim_cell whole = sp_aim_cell_whole(kind, site, k, step);
                if (pricing->cover->weight[tier_of(pricing, &whole)] <= pricing->cover->water &&
                    !append(&pricing->open, &whole))
                    return false;
            }
        }
    return true;
}

/* What the rows at hand are worth is known. Where every nozzle is worth no more than its part of the water that a bound
 * is sought for, measured by the best choice of rows, no choice of them is worth more than that. */
static void read_offers(sp_aim_pricing *pricing, const sp_offers *offers)
{
    const sp_cover *cover = pricing->cover;
    size_t tiers = cover->tier_count, ports = cover->port_count, nozzles = cover->nozzles, water = pricing->water;
    sp_knapsack_fill(&pricing->knapsack, offers, water);
    double most = sp_knapsack_value(&pricing->knapsack, nozzles, water);
    for (size_t k = 0; k < tiers; k++) {
        for (size_t p = 0; p < ports; p++)
            pricing->known[p * tiers + k] = offers->port[p * tiers + k];
        pricing->known[ports * tiers + k] = offers->free[k * offers->most];
        pricing->fair[k] = cover->weight[k] > water ? INFINITY : most * (double)cover->weight[k] / (double)water;
    }
}

/* The row of an aim: a cell's middle. */
static bool hand_out_one(sp_aim_pricing *pricing, const sp_aim_cell *cell, sp_rows *rows, sp_error *error)
{
    const sp_search *search = pricing->search;
    const sp_aim_kind *kind = &pricing->kinds->items[cell->kind];
    const sp_site *site = &search->sites->items[cell->site];
    sp_aim_cell middle = sp_aim_cell_middle(cell, kind);
    sp_aim_disc disc = {sp_aim_cell_disc(cell, site, tilt_of(pricing, cell->site)).axis, 0};
    sp_posed_spray posed = {.spray = sp_aim_cell_spray(&middle, kind, 0),
                            .frame = sp_aim_cell_frame(&middle, &disc, sp_evaluator_setup(search->coarse)->up),
                            .strength = strength_of(pricing, cell)};
    sp_view_buffer *buffer = NULL;
    const sp_view *view = sp_visibility_look(search->visibility, cell->site, kind->launch, &buffer);
    sp_field_view(search, view, &posed, pricing->field);
    sp_visibility_release(search->visibility, &buffer);
    return sp_pose_pricing_row(pricing->poses, pricing->field, KEY_FIRST + pricing->keys++, pricing->ports[site->mount],
                               tier_of(pricing, cell), rows, error);
}

static int by_merit(const void *a, const void *b)
{
    const aim *p = a, *q = b;
    if (p->excess != q->excess)
        return p->excess > q->excess ? -1 : 1;
    return by_likeness(&(entry){.cell = p->cell}, &(entry){.cell = q->cell});
}

/* Offers all, whatever is needed or idle: what matters is asked of all aims together, and little is spent on what does
 * not. */
static bool price_aims(void *user, const sp_pricing_task *task, sp_offers *offers, sp_rows *rows, sp_error *error)
{
    sp_aim_pricing *pricing = user;
    size_t bests = pricing->search->sites->count * pricing->kinds->count;
    if (!open_all(pricing))
        return sp_fail_memory(error);
    read_offers(pricing, offers);
    while (pricing->open.count) {
        if (!price_open(pricing, task->u, error))
            return false;
        if (!sp_cover_goes_on(pricing->cover))
            return true;
        note_middles(pricing);
        if (!split_open(pricing, offers))
            return sp_fail_memory(error);
    }
    qsort(pricing->best, bests, sizeof *pricing->best, by_merit);
    bool done = true;
    for (size_t i = 0; done && i < bests && i < ROWS_AT_A_TIME && pricing->best[i].excess > 0; i++)
        done = hand_out_one(pricing, &pricing->best[i].cell, rows, error);
    return done;
}

sp_pricer sp_aim_pricer(sp_aim_pricing *pricing)
{
    return (sp_pricer){pricing, .price = price_aims};
}

double sp_aim_pricing_upper(sp_aim_pricing *pricing, const sp_aim_cell *cell, const sp_multipliers *u)
{
    const sp_site *site = &pricing->search->sites->items[cell->site];
    scratch *own = &pricing->scratches[0];
    double upper = 0;
    if (turn_to(pricing, own, cell, u))
        upper = reach_price(pricing, own, cell, sp_aim_cell_disc(cell, site, tilt_of(pricing, cell->site)),
                            SP_COUNT_GENEROUS);
    sp_visibility_release(pricing->search->visibility, &own->buffer);
    return upper;
}
