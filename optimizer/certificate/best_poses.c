#include "certificate/best_poses.h"
#include "certificate/pose_list.h"
#include "certificate/pose_price.h"
#include "certificate/pose_rows.h"
#include "ranking/ranking.h"
#include "ranks/messages.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define ROWS_AT_A_TIME 300
#define TOLD_LEAST 0.5 /* of what a pose must be worth to matter: below, an upper bound is enough to be shut out */
#define STRIDE 7       /* poses from one that is looked at to the next, where not all are; fans have 8 rolls */

/* What a site's pose of a variant must be worth to matter: more than is on offer and than is idle, or than is needed.
 */
static double least_of(const sp_pose_pricing *pricing, size_t port, size_t tier, const sp_pricing_task *task,
                       const sp_offers *offers)
{
    double offered =
        port == SP_NO_PORT ? offers->free[tier * offers->most] : offers->port[port * offers->tier_count + tier];
    return pricing->cover->weight[tier] > pricing->cover->water
               ? INFINITY
               : fmin(fmax(offered, task->idle[tier]), task->needed[tier]);
}

/* Prices all poses of a variant at a site, or every `stride`th, another one at the next site. The highest price, where
 * one is more than `least`; `needed`: to raise the bound. */
static sp_pose_best price_variant(sp_pose_pricing *pricing, sp_pose_scratch *own, const sp_view *view, uint32_t site,
                                  uint32_t k, sp_region *region, size_t stride, double least, double needed)
{
    const sp_candidates *candidates = pricing->search->candidates;
    const sp_variant *variant = &candidates->variants[k];
    size_t axes = sp_candidates_axes(candidates, pricing->search->sites->items[site].mount, k)->count;
    sp_pose_best found = {.price = 0};
    double all = pricing->film_need || !sp_type_is_uniform(variant->type) ? INFINITY : sp_pose_price_most(own);
    double told = stride == 1 ? TOLD_LEAST * needed : INFINITY; /* below it no price need be exact to be told */
    for (uint32_t a = 0; a < axes; a++)
        for (uint32_t r = 0; r < variant->roll_count; r++) {
            sp_pose pose = {site, k, a, r};
            if ((site + a * variant->roll_count + r) % stride)
                continue;
            double matters = fmin(told, fmax(found.price, least));
            double price = all < matters ? all : sp_pose_price(pricing, own, view, pose, region, matters);
            if (stride == 1)
                pricing->last[sp_pose_order_position(pricing->order, pose)] = nextafterf((float)price, INFINITY);
            if (price > fmax(found.price, least))
                found = (sp_pose_best){pose, price};
        }
    return found;
}

/* The best pose of every variant at a site, of those that matter. */
static void price_site(sp_pose_pricing *pricing, sp_pose_scratch *own, uint32_t site, const sp_pricing_task *task,
                       const sp_offers *offers)
{
    const sp_candidates *candidates = pricing->search->candidates;
    uint32_t mount = pricing->search->sites->items[site].mount;
    sp_vec3 up = sp_evaluator_setup(pricing->search->coarse)->up;
    sp_frame frame = sp_nozzle_frame(pricing->search->sites->items[site].axis, 0, up);
    for (uint32_t k = 0; k < candidates->variant_count; k++) {
        const sp_variant *variant = &candidates->variants[k];
        sp_pose_best *found = &pricing->bests[site * candidates->variant_count + k];
        uint32_t tier = sp_pose_tier(pricing, site, k);
        double least = least_of(pricing, pricing->ports[mount], tier, task, offers);
        *found = (sp_pose_best){.price = 0};
        if (!sp_candidates_axes(candidates, mount, k)->count || !isfinite(least) ||
            pricing->search->port_taken[mount] || !sp_search_knows(pricing->search, site, k))
            continue;
        const sp_view *view = sp_visibility_look(pricing->search->visibility, site, variant->launch, &own->buffer);
        if (!view->start && sp_type_is_uniform(variant->type))
            continue;
        sp_region region = sp_pose_prepare(pricing, own, view, variant, &frame, task->u);
        *found = price_variant(pricing, own, view, site, k, &region, task->all ? 1 : STRIDE, least, task->needed[tier]);
    }
}

/* Appends the best of the bests that are worth more than needed. */
static bool hand_out(const sp_pose_pricing *pricing, const double *needed, sp_rows *rows, sp_error *error)
{
    size_t count = pricing->search->sites->count * pricing->search->candidates->variant_count, found = 0,
           had = rows->count;
    sp_ranked *entries = malloc((count + 1) * sizeof *entries);
    uint64_t *keys = sp_rows_keys(rows);
    bool done = entries && keys;
    if (!done)
        sp_fail_memory(error);
    for (size_t i = 0; done && i < count; i++) {
        sp_pose pose = pricing->bests[i].pose;
        double need = needed[sp_pose_tier(pricing, pose.site, pose.variant)], price = pricing->bests[i].price;
        if (price > need)
            entries[found++] = (sp_ranked){need > 0 ? price / need : price * 1e30, i};
    }
    if (done)
        sp_rank_falling(entries, found);
    for (size_t i = 0, given = 0; done && i < found && given < ROWS_AT_A_TIME; i++) {
        sp_pose pose = pricing->bests[entries[i].at].pose;
        uint64_t key = sp_pose_order_position(pricing->order, pose);
        if (sp_keys_hold(keys, had, key))
            continue;
        done = sp_pose_pricing_add(pricing, pose, rows, error);
        given++;
    }
    free(entries);
    free(keys);
    return done;
}

/* The prices of each rank's sites, see price_site. */
static void price_sites(sp_pose_pricing *pricing, const sp_pricing_task *task, const sp_offers *offers)
{
    size_t sites = pricing->search->sites->count;
    sp_ranks_part(sp_pose_ranks(pricing));
#pragma omp parallel for num_threads(pricing->threads) schedule(dynamic, 1)
    for (size_t i = 0; i < sites; i++)
        if (sp_ranks_mine(sp_pose_ranks(pricing), i) && sp_cover_goes_on(pricing->cover))
            price_site(pricing, &pricing->scratches[omp_get_thread_num()], (uint32_t)i, task, offers);
    sp_ranks_rejoin(sp_pose_ranks(pricing));
    for (int i = 0; i < pricing->threads; i++)
        sp_visibility_release(pricing->search->visibility, &pricing->scratches[i].buffer);
}

static bool price_poses(void *user, const sp_pricing_task *task, sp_offers *offers, sp_rows *rows, sp_error *error)
{
    sp_pose_pricing *pricing = user;
    const sp_search *search = pricing->search;
    size_t variants = search->candidates->variant_count, sites = search->sites->count;
    memset(pricing->last, 0, pricing->order->list.count * sizeof *pricing->last);
    sp_pose_price_found(pricing->order, task->u, NULL, pricing->last);
    price_sites(pricing, task, offers);
    if (!sp_pose_share_prices(pricing, task->all ? pricing->last : NULL, true, error))
        return false;
    if (!sp_cover_goes_on(pricing->cover))
        return true;
    for (size_t i = 0; i < sites * variants; i++)
        if (pricing->bests[i].price > 0)
            sp_offers_add(offers, pricing->ports[search->sites->items[i / variants].mount],
                          sp_pose_tier(pricing, (uint32_t)(i / variants), (uint32_t)(i % variants)),
                          pricing->bests[i].price);
    return !task->extend || hand_out(pricing, task->needed, rows, error);
}

sp_pricer sp_best_poses(sp_pose_pricing *pricing)
{
    return (sp_pricer){pricing, .leaves_idle = true, .price = price_poses};
}

const float *sp_pose_pricing_last(const sp_pose_pricing *pricing)
{
    return pricing->last;
}
