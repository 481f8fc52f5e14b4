#include "certificate/problem.h"

#include "certificate/pose_list.h"
#include "certificate/best_poses.h"
#include "certificate/pose_rows.h"
#include "scoring/mount_capacity.h"
#include "scoring/scoring.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ROUNDED 0x1p-22 /* more of a texel than single precision puts its area, and what of it is covered, wrong by */

static double least_of(const double *values, size_t count)
{
    double least = INFINITY;
    for (size_t i = 0; i < count; i++)
        least = fmin(least, values[i]);
    return least;
}

double *sp_list_costs(const sp_place_options *options, size_t *count)
{
    double *costs = malloc((options->mount_count + 1) * sizeof *costs);
    *count = 0;
    for (size_t m = 0; costs && m < options->mount_count; m++) {
        size_t at = 0;
        while (at < *count && costs[at] != options->mounts[m].cost)
            at++;
        costs[at] = options->mounts[m].cost;
        *count += at == *count;
    }
    return costs;
}

static bool list_outlays(sp_problem *p, sp_error *error)
{
    const sp_candidates *candidates = p->search->candidates;
    p->costs = sp_list_costs(p->search->options, &p->cost_count);
    for (size_t i = 0; i <= p->front->by_water.count; i++)
        p->own += sp_front_partial(p->front, i)->count;
    p->outlays = malloc((p->cost_count * candidates->variant_count + p->own + 1) * sizeof *p->outlays);
    if (!p->costs || !p->outlays)
        return sp_fail_memory(error);
    size_t count = 0;
    for (size_t c = 0; c < p->cost_count; c++)
        for (size_t k = 0; k < candidates->variant_count; k++)
            p->outlays[count++] = candidates->variants[k].flow + p->costs[c];
    for (size_t i = 0; i <= p->front->by_water.count; i++)
        for (size_t n = 0; n < sp_front_partial(p->front, i)->count; n++)
            p->outlays[count++] = sp_placed_outlay(p->search, &sp_front_partial(p->front, i)->items[n]);
    return true;
}

static uint32_t tier_for(sp_problem *p, double outlay)
{
    uint32_t weight = sp_water_weight(&p->units, outlay), tier = 0;
    while (tier < p->cover.tier_count && p->weight[tier] != weight)
        tier++;
    if (tier == p->cover.tier_count)
        p->weight[p->cover.tier_count++] = weight;
    return tier;
}

/* Water of the layouts, in units, and number; false where nothing can be placed, or too many nozzles at a time. */
static bool set_limits(sp_problem *p)
{
    const sp_search *search = p->search;
    size_t listed = p->cost_count * search->candidates->variant_count, limit = search->options->max_nozzles;
    double most = 0, least = least_of(p->outlays, listed + p->own);
    for (size_t i = 0; i <= p->front->by_water.count; i++)
        most = fmax(most, sp_front_partial(p->front, i)->outlay - search->kept_flow);
    if (!(most >= least) || (limit && limit <= search->kept_count))
        return false;
    p->cover.nozzles = (size_t)fmin(floor(most / least * (1 + 1e-9)), 1e6);
    if (limit && limit - search->kept_count < p->cover.nozzles)
        p->cover.nozzles = limit - search->kept_count;
    if (p->cover.nozzles > SP_NOZZLES_MOST)
        return false;
    p->units = sp_water_units_create(p->outlays, listed, least, p->cover.nozzles, most);
    p->cover.water = sp_water_budget(&p->units, most);
    return true;
}

static bool set_tiers(sp_problem *p, sp_error *error)
{
    const sp_search *search = p->search;
    size_t variants = search->candidates->variant_count, mounts = search->options->mount_count;
    p->weight = malloc((p->cost_count * variants + p->own + 1) * sizeof *p->weight);
    p->tier_of = malloc((mounts * variants + 1) * sizeof *p->tier_of);
    p->ports = malloc((mounts + 1) * sizeof *p->ports);
    if (!p->weight || !p->tier_of || !p->ports)
        return sp_fail_memory(error);
    for (size_t i = 0; i < p->cost_count * variants + p->own; i++)
        tier_for(p, p->outlays[i]);
    for (size_t m = 0; m < mounts; m++)
        for (size_t k = 0; k < variants; k++)
            p->tier_of[m * variants + k] =
                tier_for(p, sp_outlay_at(search, (uint32_t)m, search->candidates->variants[k].flow));
    for (size_t m = 0; m < mounts; m++)
        p->ports[m] = sp_mount_capacity(&search->options->mounts[m]) == 1 ? p->cover.port_count++ : SP_NO_PORT;
    return true;
}

/* What every texel still needs besides the kept nozzles, and the part of it that they leave dry. */
static bool set_texels(sp_problem *p, sp_error *error)
{
    const sp_search *search = p->search;
    p->area = malloc((search->patch_count + 1) * sizeof *p->area);
    p->need = malloc((search->patch_count + 1) * sizeof *p->need);
    double margin = sp_field_margin(search->kept_count + p->cover.nozzles);
    p->film_need = search->kept_film ? malloc((search->patch_count + 1) * sizeof *p->film_need) : NULL;
    if (!p->area || !p->need || (search->kept_film && !p->film_need))
        return sp_fail_memory(error);
    for (size_t t = 0; t < search->patch_count; t++) {
        double had = (double)search->kept_hit[t] * (1 + margin);
        double need = had >= 1 ? 0 : search->single ? 1 : 1 - had;
        p->need[t] = need > margin ? (float)need : 0;
        if (p->film_need) {
            double lacks = 1 - (double)search->kept_film[t] * (1 + margin);
            p->film_need[t] = (float)lacks;
            p->need[t] = lacks > margin ? p->need[t] : 0;
        }
        /* of what their edges leave dry, other edges cover as large a part as of all of it */
        double whole = (double)search->area[t] * search->all;
        p->area[t] = p->need[t] > 0 ? (float)whole * search->kept_dry[t] : 0;
        p->cover.base += whole * (1 + ROUNDED) - (double)p->area[t];
    }
    p->cover.texel_count = search->patch_count;
    p->cover.area = p->area;
    p->cover.weight = p->weight;
    p->cover.repeats = true;
    p->cover.whole = !search->kept_film && search->alone;
    p->cover.threads = sp_threads(&search->options->run);
    return true;
}

static bool add_own(sp_problem *p, sp_error *error)
{
    for (size_t i = 0; i <= p->front->by_water.count; i++) {
        const sp_partial *partial = sp_front_partial(p->front, i);
        for (size_t n = 0; n < partial->count; n++) {
            const sp_placed *placed = &partial->items[n];
            uint32_t tier = tier_for(p, sp_placed_outlay(p->search, placed));
            if (!sp_pose_pricing_found(p->pricing, placed, tier, &p->nozzles, error))
                return false;
        }
    }
    return true;
}

size_t sp_problem_poses(const sp_problem *p)
{
    const sp_search *search = p->search;
    size_t count = 0;
    for (size_t i = 0; i < search->sites->count; i++)
        for (size_t k = 0; k < search->candidates->variant_count; k++) {
            uint32_t mount = search->sites->items[i].mount;
            const sp_variant *variant = &search->candidates->variants[k];
            if (!search->port_taken[mount] && sp_search_knows(search, (uint32_t)i, k))
                count += sp_candidates_axes(search->candidates, mount, k)->count * variant->roll_count;
        }
    return count;
}

size_t sp_problem_budget(const sp_problem *p, double outlay)
{
    size_t budget = sp_water_budget(&p->units, outlay - p->search->kept_flow);
    return budget < p->cover.water ? budget : p->cover.water;
}

/* As many candidates of this weight as there is room for. */
static void add_sums(sp_problem *p, uint32_t tier)
{
    for (size_t w = p->weight[tier]; w <= p->cover.water; w++)
        p->sums[w] |= p->sums[w - p->weight[tier]];
}

/* Tiers of the candidates in a port, or of all in none. */
static void mark_tiers(const sp_problem *p, size_t port, bool *marked)
{
    const sp_candidates *candidates = p->search->candidates;
    for (size_t i = 0; i < candidates->mount_count * candidates->variant_count; i++)
        if (p->ports[i / candidates->variant_count] == port && candidates->axes[i].count)
            marked[p->tier_of[i]] = true;
    for (size_t i = 0; i < p->nozzles.count; i++)
        if (p->nozzles.port[i] == port)
            marked[p->nozzles.tier[i]] = true;
}

/* Where a nozzle in one mount costs much more than in another, outlays lie far apart: a layout that takes less than the
 * next takes no more than the last. */
static bool set_sums(sp_problem *p, sp_error *error)
{
    size_t tiers = p->cover.tier_count;
    bool *marked = calloc(tiers + 1, sizeof *marked);
    p->sums = calloc(p->cover.water + 1, sizeof *p->sums);
    if (!marked || !p->sums) {
        free(marked);
        return sp_fail_memory(error);
    }
    p->sums[0] = true;
    mark_tiers(p, SP_NO_PORT, marked);
    for (uint32_t k = 0; k < tiers; k++)
        if (marked[k])
            add_sums(p, k);
    for (size_t port = 0; port < p->cover.port_count; port++) {
        memset(marked, 0, tiers * sizeof *marked);
        mark_tiers(p, port, marked);
        /* one of them: downwards, so that what is read is still without it */
        for (size_t w = p->cover.water + 1; w-- > 0;)
            for (size_t k = 0; k < tiers && !p->sums[w]; k++)
                p->sums[w] = marked[k] && p->weight[k] <= w && p->sums[w - p->weight[k]];
    }
    free(marked);
    p->cover.sums = p->sums;
    return true;
}

static bool prepare(sp_problem *p, sp_error *error)
{
    if (!set_tiers(p, error) || !set_texels(p, error))
        return false;
    p->pricing = sp_pose_pricing_create(p->search, &p->cover, p->tier_of, p->need, p->film_need, p->ports, error);
    if (!p->pricing)
        return false;
    p->pricer = sp_best_poses(p->pricing);
    return add_own(p, error) && (!p->search->costly || set_sums(p, error)) &&
           sp_pose_order_create(p->search, &p->cover, p->tier_of, p->ports, &p->nozzles, &p->order, error) &&
           sp_pose_list(p->pricing, &p->order, &p->list, error);
}

bool sp_problem_create(const sp_search *search, const sp_front *front, sp_problem *problem, bool *possible,
                       sp_error *error)
{
    *problem = (sp_problem){.search = search, .front = front};
    *possible = false;
    if (!list_outlays(problem, error))
        return false;
    *possible = set_limits(problem);
    return !*possible || prepare(problem, error);
}

void sp_problem_free(sp_problem *p)
{
    sp_pose_order_free(&p->order);
    sp_rows_free(&p->nozzles);
    sp_pose_pricing_destroy(p->pricing);
    free(p->area);
    free(p->need);
    free(p->film_need);
    free(p->weight);
    free(p->tier_of);
    free(p->ports);
    free(p->sums);
    free(p->costs);
    free(p->outlays);
}
