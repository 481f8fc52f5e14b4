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
#define TOLD_LEAST 0.6 /* of what a pose must be worth to matter: below, an upper bound is enough to be shut out */
#define STRIDE 7       /* poses from one that is looked at to the next, where not all are; fans have 8 rolls */

/* What all sites are priced by. */
typedef struct {
    const sp_multipliers *u;
    const double *needed; /* [tiers], to raise the bound */
    const sp_offers *offers;
    size_t stride; /* every so many poses; 0: those alone that were the best before */
} pricing_round;

/* What a site's pose of a variant must be worth to matter: more than its port has on offer of its tier, or than is
 * needed. Less could raise the value of no knapsack whatever else is offered later: the other would do in its place. */
static double least_of(const pricing_round *round, size_t port, size_t tier)
{
    const sp_offers *offers = round->offers;
    double offered =
        port == SP_NO_PORT ? offers->free[tier * offers->most] : offers->port[port * offers->tier_count + tier];
    return fmin(offered, round->needed[tier]);
}

/* Prices all poses of a variant at a site, or every `stride`th, another one at the next site. The highest price, where
 * one is more than `found` has and than `least`; `needed`: to raise the bound. */
static void price_variant(sp_pose_pricing *pricing, sp_pose_scratch *own, const sp_view *view, sp_region *region,
                          size_t stride, double least, double needed, sp_pose_best *found)
{
    const sp_candidates *candidates = pricing->search->candidates;
    uint32_t site = found->pose.site, k = found->pose.variant;
    const sp_variant *variant = &candidates->variants[k];
    size_t axes = sp_candidates_axes(candidates, pricing->search->sites->items[site].mount, k)->count;
    double all = pricing->film_need || !sp_type_is_uniform(variant->type) ? INFINITY : sp_pose_price_most(own);
    double told = stride == 1 ? TOLD_LEAST * needed : INFINITY; /* below it no price need be exact to be told */
    for (uint32_t a = 0; a < axes; a++)
        for (uint32_t r = 0; r < variant->roll_count; r++) {
            sp_pose pose = {site, k, a, r};
            if ((site + a * variant->roll_count + r) % stride)
                continue;
            double matters = fmin(told, fmax(found->price, least));
            double price = all < matters ? all : sp_pose_price(pricing, own, view, pose, region, matters);
            if (stride == 1)
                pricing->last[sp_pose_order_position(pricing->order, pose)] = nextafterf((float)price, INFINITY);
            if (price > fmax(found->price, least))
                *found = (sp_pose_best){pose, price};
        }
}

/* True where the variant can be at the site, and what it brings there has been looked at. */
static bool is_offered(const sp_pose_pricing *pricing, uint32_t site, uint32_t k)
{
    const sp_search *search = pricing->search;
    uint32_t mount = search->sites->items[site].mount;
    return sp_candidates_axes(search->candidates, mount, k)->count && !search->port_taken[mount] &&
           pricing->cover->weight[sp_pose_tier(pricing, site, k)] <= pricing->cover->water &&
           sp_search_knows(search, site, k);
}

/* The best pose of every variant at a site, of those that matter. */
static void price_site(sp_pose_pricing *pricing, sp_pose_scratch *own, uint32_t site, const pricing_round *round)
{
    const sp_candidates *candidates = pricing->search->candidates;
    size_t port = pricing->ports[pricing->search->sites->items[site].mount];
    sp_vec3 up = sp_evaluator_setup(pricing->search->coarse)->up;
    sp_frame frame = sp_nozzle_frame(pricing->search->sites->items[site].axis, 0, up);
    for (uint32_t k = 0; k < candidates->variant_count; k++) {
        const sp_variant *variant = &candidates->variants[k];
        sp_pose_best *found = &pricing->bests[site * candidates->variant_count + k];
        if ((!round->stride && !(found->price > 0)) || !is_offered(pricing, site, k))
            continue;
        const sp_view *view = sp_visibility_look(pricing->search->visibility, site, variant->launch, &own->buffer);
        if (!view->start && sp_type_is_uniform(variant->type))
            continue;
        sp_region region = sp_pose_prepare(pricing, own, view, variant, &frame, round->u);
        if (!(found->price > 0))
            found->pose = (sp_pose){.site = site, .variant = k};
        if (round->stride) {
            uint32_t tier = sp_pose_tier(pricing, site, k);
            price_variant(pricing, own, view, &region, round->stride, least_of(round, port, tier), round->needed[tier],
                          found);
        } else {
            found->price = sp_pose_price(pricing, own, view, found->pose, &region, 0);
        }
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

/* Each rank prices its own sites; then all know the bests, and of `last` the others' prices. */
static bool price_sites(sp_pose_pricing *pricing, const pricing_round *round, float *last, sp_error *error)
{
    size_t sites = pricing->search->sites->count;
    sp_ranks_part(sp_pose_ranks(pricing));
#pragma omp parallel for num_threads(pricing->threads) schedule(dynamic, 1)
    for (size_t i = 0; i < sites; i++)
        if (sp_ranks_mine(sp_pose_ranks(pricing), i) && sp_cover_goes_on(pricing->cover))
            price_site(pricing, &pricing->scratches[omp_get_thread_num()], (uint32_t)i, round);
    sp_ranks_rejoin(sp_pose_ranks(pricing));
    for (int i = 0; i < pricing->threads; i++)
        sp_visibility_release(pricing->search->visibility, &pricing->scratches[i].buffer);
    return sp_pose_share_prices(pricing, last, true, error);
}

static void offer_bests(const sp_pose_pricing *pricing, sp_offers *offers)
{
    size_t variants = pricing->search->candidates->variant_count, sites = pricing->search->sites->count;
    for (size_t i = 0; i < sites * variants; i++)
        if (pricing->bests[i].price > 0)
            sp_offers_add(offers, pricing->ports[pricing->search->sites->items[i / variants].mount],
                          sp_pose_tier(pricing, (uint32_t)(i / variants), (uint32_t)(i % variants)),
                          pricing->bests[i].price);
}

/* What was best by the last multipliers is good by these, and is priced first: most others are seen to be worth less
 * without a sum. */
static bool price_poses(void *user, const sp_multipliers *u, const double *needed, bool all, sp_offers *offers,
                        sp_rows *rows, sp_error *error)
{
    sp_pose_pricing *pricing = user;
    memset(pricing->last, 0, pricing->order->list.count * sizeof *pricing->last);
    sp_pose_price_found(pricing->order, u, NULL, pricing->last);
    pricing_round round = {u, needed, offers, 0};
    if (!price_sites(pricing, &round, NULL, error))
        return false;
    if (!sp_cover_goes_on(pricing->cover))
        return true;
    offer_bests(pricing, offers);
    round.stride = all ? 1 : STRIDE;
    if (!price_sites(pricing, &round, all ? pricing->last : NULL, error))
        return false;
    if (!sp_cover_goes_on(pricing->cover))
        return true;
    offer_bests(pricing, offers);
    return hand_out(pricing, needed, rows, error);
}

sp_pricer sp_best_poses(sp_pose_pricing *pricing)
{
    return (sp_pricer){pricing, price_poses};
}

const float *sp_pose_pricing_last(const sp_pose_pricing *pricing)
{
    return pricing->last;
}
