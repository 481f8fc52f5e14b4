#include "certificate/every_aim.h"

#include "certificate/aim_pricing.h"
#include "certificate/pose_rows.h"

#include <stdlib.h>

#define ROUNDS_FIRST 2 /* of pricing all aims, at the proposal's water */
#define ROUNDS_WATER 2 /* at a water that may be too little for the proposal's coverage */
#define TRIALS_WATER 1 /* such waters */
#define POINTS_MOST 2  /* of the front, that get rounds of their own */
#define ROUNDS_FRONT 2
#define WORTH_LEAST 1e-3 /* of the whole, below which a bound must lie to say something */

typedef struct {
    const sp_aim_task *task;
    sp_front *front;
    sp_cover cover;
    sp_water_units units;
    sp_aim_kinds kinds;
    double *outlays; /* [outlay_count], of all that may be taken, the variants' at every cost first */
    size_t outlay_count;
    uint32_t *weight;   /* [tiers] */
    uint32_t **tier_of; /* [mounts x kinds][steps] */
    uint32_t *none;     /* [mounts x variants], for the poses' pricing, which is not asked */
    sp_pose_pricing *poses;
    sp_aim_pricing *pricing;
    sp_pricer pricer;
    sp_bound bound;
} aiming;

static void aiming_free(aiming *a)
{
    sp_bound_free(&a->bound);
    sp_aim_pricing_destroy(a->pricing);
    sp_pose_pricing_destroy(a->poses);
    for (size_t i = 0; a->tier_of && i < a->task->search->options->mount_count * a->kinds.count; i++)
        free(a->tier_of[i]);
    free(a->tier_of);
    free(a->none);
    free(a->weight);
    free(a->outlays);
    sp_aim_kinds_free(&a->kinds);
}

static void list_at(aiming *a, double flow)
{
    for (size_t c = 0; c < a->task->cost_count; c++)
        a->outlays[a->outlay_count++] = flow + a->task->costs[c];
}

static bool list_outlays(aiming *a, sp_error *error)
{
    const sp_candidates *candidates = a->task->search->candidates;
    size_t count = candidates->variant_count * a->task->cost_count;
    for (size_t i = 0; i <= a->front->by_water.count; i++)
        count += sp_front_partial(a->front, i)->count;
    for (size_t k = 0; k < a->kinds.count; k++)
        count += a->kinds.items[k].step_count * a->task->cost_count;
    a->outlays = malloc((count + 1) * sizeof *a->outlays);
    a->weight = malloc((count + 1) * sizeof *a->weight);
    if (!a->outlays || !a->weight)
        return sp_fail_memory(error);
    for (size_t k = 0; k < candidates->variant_count; k++)
        list_at(a, candidates->variants[k].flow);
    for (size_t i = 0; i <= a->front->by_water.count; i++)
        for (size_t n = 0; n < sp_front_partial(a->front, i)->count; n++)
            a->outlays[a->outlay_count++] = sp_placed_outlay(a->task->search, &sp_front_partial(a->front, i)->items[n]);
    for (size_t k = 0; k < a->kinds.count; k++)
        for (size_t step = 0; step < a->kinds.items[k].step_count; step++)
            list_at(a, a->kinds.items[k].edge[step]);
    return true;
}

/* False where nothing can be placed, or too many nozzles at a time. */
static bool set_limits(aiming *a)
{
    const sp_search *search = a->task->search;
    size_t limit = search->options->max_nozzles;
    double most = 0, least = INFINITY;
    for (size_t i = 0; i < a->outlay_count; i++)
        least = fmin(least, a->outlays[i]);
    for (size_t i = 0; i <= a->front->by_water.count; i++)
        most = fmax(most, sp_front_partial(a->front, i)->outlay - search->kept_flow);
    if (!(most >= least))
        return false;
    a->cover.nozzles = (size_t)fmin(floor(most / least * (1 + 1e-9)), 1e6);
    if (limit && limit - search->kept_count < a->cover.nozzles)
        a->cover.nozzles = limit - search->kept_count;
    if (a->cover.nozzles > SP_NOZZLES_MOST)
        return false;
    a->units = sp_water_units_create(a->outlays, search->candidates->variant_count * a->task->cost_count, least,
                                     a->cover.nozzles, most);
    a->cover.water = sp_water_budget(&a->units, most);
    return true;
}

static uint32_t tier_of_weight(aiming *a, uint32_t weight)
{
    uint32_t tier = 0;
    while (tier < a->cover.tier_count && a->weight[tier] != weight)
        tier++;
    if (tier == a->cover.tier_count)
        a->weight[a->cover.tier_count++] = weight;
    return tier;
}

static bool set_tiers(aiming *a, sp_error *error)
{
    a->cover.tier_count = 0;
    a->cover.weight = a->weight;
    const sp_search *search = a->task->search;
    size_t mounts = search->options->mount_count, kinds = a->kinds.count;
    a->tier_of = calloc(mounts * kinds + 1, sizeof *a->tier_of);
    a->none = calloc(mounts * search->candidates->variant_count + 1, sizeof *a->none);
    if (!a->tier_of || !a->none)
        return sp_fail_memory(error);
    for (size_t i = 0; i < a->outlay_count; i++)
        tier_of_weight(a, sp_water_weight(&a->units, a->outlays[i]));
    for (size_t i = 0; i < mounts * kinds; i++) {
        const sp_aim_kind *kind = &a->kinds.items[i % kinds];
        a->tier_of[i] = malloc(kind->step_count * sizeof **a->tier_of);
        if (!a->tier_of[i])
            return sp_fail_memory(error);
        for (size_t step = 0; step < kind->step_count; step++) {
            double outlay = sp_outlay_at(search, (uint32_t)(i / kinds), kind->edge[step]);
            a->tier_of[i][step] = tier_of_weight(a, sp_water_weight(&a->units, outlay));
        }
    }
    return true;
}

/* The layouts' own nozzles, and where water is counted alike the candidates that made good layouts. */
static bool add_rows(aiming *a, sp_error *error)
{
    const sp_rows *rows = a->task->rows;
    for (size_t i = 0; i <= a->front->by_water.count; i++)
        for (size_t n = 0; n < sp_front_partial(a->front, i)->count; n++) {
            const sp_placed *placed = &sp_front_partial(a->front, i)->items[n];
            uint32_t tier = tier_of_weight(a, sp_water_weight(&a->units, sp_placed_outlay(a->task->search, placed)));
            if (!sp_pose_pricing_found(a->poses, placed, tier, &a->bound.rows, error))
                return false;
        }
    for (size_t c = 0; c < rows->count && a->units.unit == a->task->units->unit; c++) {
        size_t first = rows->start[c];
        uint32_t tier = tier_of_weight(a, a->task->cover->weight[rows->tier[c]]);
        if (rows->key[c] != SP_OWN_KEY &&
            !sp_rows_add(&a->bound.rows, rows->key[c], rows->port[c], tier, rows->texel + first, rows->share + first,
                         rows->start[c + 1] - first, error))
            return false;
    }
    return true;
}

static bool prepare(aiming *a, sp_error *error)
{
    const sp_aim_task *task = a->task;
    if (!set_tiers(a, error))
        return false;
    a->poses = sp_pose_pricing_create(task->search, &a->cover, a->none, task->need, NULL, task->ports, error);
    if (!a->poses)
        return false;
    a->pricing = sp_aim_pricing_create(task->search, &a->cover, &a->kinds, (const uint32_t *const *)a->tier_of,
                                       task->ports, a->poses, error);
    if (!a->pricing)
        return false;
    a->pricer = sp_aim_pricer(a->pricing);
    return sp_bound_create(&a->cover, &a->pricer, &a->bound, error) && add_rows(a, error);
}

static size_t budget_of(const aiming *a, double outlay)
{
    size_t budget = sp_water_budget(&a->units, outlay - a->task->search->kept_flow);
    return budget < a->cover.water ? budget : a->cover.water;
}

static bool lower(aiming *a, size_t water, size_t rounds, sp_error *error)
{
    sp_aim_pricing_seek(a->pricing, water);
    for (size_t round = 0; round < rounds && sp_cover_goes_on(&a->cover); round++)
        if (!sp_bound_lower(&a->bound, water, error))
            return false;
    return true;
}

/* The least water for what the proposal covers. */
static bool lower_water(aiming *a, double area, sp_error *error)
{
    for (size_t trial = 0; trial < TRIALS_WATER; trial++) {
        size_t water = sp_bound_water(&a->bound, area);
        if (!water || water > a->cover.water)
            return true;
        if (!lower(a, water, ROUNDS_WATER, error))
            return false;
        if (sp_bound_water(&a->bound, area) == water)
            return true;
    }
    return true;
}

/* The point of the front with the widest gap that has not had its turn; front->by_water.count where none is left. */
static size_t widest(const aiming *a, const bool *had)
{
    size_t found = a->front->by_water.count;
    double most = 0;
    for (size_t i = 0; i < a->front->by_water.count; i++) {
        const sp_front_point *point = &a->front->by_water.entries[i].point;
        double open = 1 - point->counted / a->bound.by_water[budget_of(a, point->outlay)];
        if (!had[i] && open > most) {
            found = i;
            most = open;
        }
    }
    return found;
}

static bool lower_front(aiming *a, sp_error *error)
{
    bool *had = calloc(a->front->by_water.count + 1, sizeof *had), done = had != NULL;
    if (!had)
        return sp_fail_memory(error);
    for (size_t turn = 0; done && turn < POINTS_MOST; turn++) {
        size_t i = widest(a, had);
        if (i == a->front->by_water.count)
            break;
        had[i] = true;
        done = lower(a, budget_of(a, a->front->by_water.entries[i].point.outlay), ROUNDS_FRONT, error);
    }
    free(had);
    return done;
}

/* Mounting points that were traced, not in ports that kept nozzles take. */
static size_t count_places(const sp_search *search)
{
    size_t count = 0;
    for (uint32_t i = 0; i < search->sites->count; i++) {
        bool known = false;
        for (size_t s = 0; s < search->candidates->launch_count; s++)
            known |= sp_visibility_known(search->visibility, i, s);
        count += known && !search->port_taken[search->sites->items[i].mount];
    }
    return count;
}

/* What is proved, where it says more than that there is no more than all. */
static void conclude(const aiming *a, sp_front *front, sp_certificate *certificate)
{
    double whole = certificate->whole, counted = certificate->counted;
    size_t water = sp_bound_water(&a->bound, counted);
    double area = fmin(whole, a->bound.by_water[budget_of(a, front->best.outlay)]);
    bool says = area < whole * (1 - WORTH_LEAST);
    for (size_t i = 0; i < front->by_water.count; i++) {
        sp_front_point *point = &front->by_water.entries[i].point;
        point->every_aim_bound = fmin(whole, a->bound.by_water[budget_of(a, point->outlay)]);
        says = says || point->every_aim_bound < whole * (1 - WORTH_LEAST);
    }
    if (!says)
        return;
    certificate->every_aim.computed = true;
    certificate->every_aim.places = count_places(a->task->search);
    certificate->every_aim.area_bound = area;
    certificate->every_aim.water_bound =
        fmin(front->best.outlay, a->task->search->kept_flow + sp_water_least(&a->units, water));
    certificate->every_aim.gap = (area - counted) / area;
}

bool sp_every_aim(const sp_aim_task *task, sp_front *front, sp_certificate *certificate, sp_error *error)
{
    aiming a = {.task = task, .front = front, .cover = *task->cover};
    a.cover.sums = NULL; /* flows between the candidates' come to others */
    for (size_t i = 0; i < front->by_water.count; i++)
        front->by_water.entries[i].point.every_aim_bound = NAN;
    if (!sp_deadline_stage(task->deadline, "certificate", error))
        return false;
    bool done = sp_aim_kinds_create(task->search, &a.kinds, error) && list_outlays(&a, error);
    if (done && set_limits(&a)) {
        done = prepare(&a, error) && lower(&a, budget_of(&a, front->best.outlay), ROUNDS_FIRST, error) &&
               lower_water(&a, certificate->counted, error) && lower_front(&a, error);
        if (done && a.bound.proofs)
            conclude(&a, front, certificate);
    }
    aiming_free(&a);
    return done && sp_deadline_stage(task->deadline, "every aim", error);
}
