#include "certificate/pose_pricing.h"

#include "ranking/ranking.h"
#include "ranks/gather.h"

#include "scoring/footprints.h"
#include "scoring/scoring.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define UPWARDS (1 + 1e-4) /* more than a sweep's sum may lie off, see sweep.h */
#define SLACK 1e-6         /* more than single precision puts an edge, or a flux over its threshold, wrong */
#define SURELY (1 + 1e-5f) /* flux over threshold, from which a cell covers its part and brings others nothing */
#define HARDLY (1 - 1e-5f) /* the same, up to which it does not cover */
#define SWEPT_MORE 1e-5f   /* more than single precision puts a swept share, or flux, wrong */
#define PART_MORE 5e-5f    /* more than single precision puts a share at an edge wrong */
#define ROWS_AT_A_TIME 300
#define TOLD_LEAST 0.75 /* of what a pose must be worth to matter: below, an upper bound is enough to be shut out */
#define STRIDE 7        /* poses from one that is looked at to the next, where not all are; fans have 8 rolls */

/* The pose of highest price of a site and variant. */
typedef struct {
    sp_pose pose;
    double price;
} best;

/* One thread's own. */
typedef struct {
    float *worth; /* [2 x (arrivals of a view + 2 SP_LANES)], price that it brings to a variant */
    float total[SP_BINS];
    sp_cull cull;
    sp_desk *desk;
    const sp_multipliers *multipliers; /* of now */
    sp_field_sweeper fields;           /* of which `worth` holds the arrays */
    float *field;                      /* [field_count] */
    uint32_t *texels;                  /* [2 patch_count], of the row of a field or footprint */
    float *shares;
} scratch;

struct sp_pose_pricing {
    const sp_search *search;
    const sp_cover *cover;
    const uint32_t *tier_of;
    const float *need, *film_need;
    const size_t *ports;
    const sp_pose_order *order; /* NULL until a list is asked for */
    float *last;                /* [order->list.count], see sp_pose_pricing_last */
    best *bests;                /* [sites x variants] */
    int threads;
    scratch *scratches; /* [threads] */
    float upwards;      /* more than a share may lie off */
    bool bent;          /* flights are, so that two arcs may come to a cell */
};

static bool allocate(sp_pose_pricing *pricing)
{
    const sp_search *search = pricing->search;
    size_t texels = 2 * search->patch_count + 1, room = search->visibility->largest + 2 * SP_LANES;
    pricing->bests = calloc(search->sites->count + 1, search->candidates->variant_count * sizeof *pricing->bests);
    pricing->scratches = calloc((size_t)pricing->threads, sizeof *pricing->scratches);
    if (!pricing->bests || !pricing->scratches)
        return false;
    for (int i = 0; i < pricing->threads; i++) {
        scratch *own = &pricing->scratches[i];
        own->worth = calloc(2 * room, sizeof *own->worth);
        own->fields = (sp_field_sweeper){.cull = &own->cull,
                                         .more = SWEPT_MORE,
                                         .share = own->worth,
                                         .counts = own->worth + room,
                                         .runs = malloc(SP_BINS * sizeof *own->fields.runs)};
        own->field = malloc(texels * sizeof *own->field);
        own->texels = malloc(texels * sizeof *own->texels);
        own->shares = malloc(texels * sizeof *own->shares);
        if (!own->worth || !own->fields.runs || !own->field || !own->texels || !own->shares)
            return false;
    }
    return true;
}

static uint32_t tier_at(const sp_pose_pricing *pricing, uint32_t site, uint32_t variant)
{
    return pricing
        ->tier_of[pricing->search->sites->items[site].mount * pricing->search->candidates->variant_count + variant];
}

static bool any_bent(const sp_search *search)
{
    for (size_t i = 0; i < search->candidates->launch_count; i++)
        if (sp_length(sp_evaluator_gravity(search->coarse, &search->candidates->launches[i])) > 0)
            return true;
    return false;
}

sp_pose_pricing *sp_pose_pricing_create(const sp_search *search, const sp_cover *cover, const uint32_t *tier_of,
                                        const float *need, const float *film_need, const size_t *ports, sp_error *error)
{
    sp_pose_pricing *pricing = malloc(sizeof *pricing);
    if (!pricing)
        return sp_fail_memory(error);
    *pricing = (sp_pose_pricing){.search = search,
                                 .cover = cover,
                                 .tier_of = tier_of,
                                 .need = need,
                                 .film_need = film_need,
                                 .ports = ports,
                                 .upwards = (float)(1 + sp_field_margin(search->kept_count + cover->nozzles)),
                                 .bent = any_bent(search),
                                 .threads = sp_sweeper_threads(search)};
    if (allocate(pricing))
        return pricing;
    sp_pose_pricing_destroy(pricing);
    return sp_fail_memory(error);
}

void sp_pose_pricing_destroy(sp_pose_pricing *pricing)
{
    if (!pricing)
        return;
    for (int i = 0; pricing->scratches && i < pricing->threads; i++) {
        free(pricing->scratches[i].worth);
        free(pricing->scratches[i].fields.runs);
        free(pricing->scratches[i].field);
        free(pricing->scratches[i].texels);
        free(pricing->scratches[i].shares);
    }
    free(pricing->bests);
    free(pricing->last);
    free(pricing->scratches);
    free(pricing);
}

/* The share of what a texel needs that a flux brings, rounded upwards. */
static inline float share_of(const sp_pose_pricing *pricing, uint32_t texel, float flux, bool twice)
{
    float ratio = flux / pricing->need[texel] * pricing->upwards;
    if (ratio >= 1)
        return 1;
    if (!(ratio > 0))
        return 0;
    /* two arcs of one nozzle add up, even where one nozzle alone must do */
    return pricing->search->single && !twice ? 0 : ratio;
}

void sp_pose_pricing_worth(const sp_pose_pricing *pricing, const sp_view *view, float least, float most,
                           const sp_multipliers *u, float *worth, float *total)
{
    for (uint32_t i = 0; i < view->count; i++) {
        uint32_t t = view->patch[i];
        float part = sp_view_part(view, i), flux = most * view->transfer[i];
        bool cell = part < 1, covers = cell && least * view->transfer[i] > SURELY;
        /* cells of one arc fall short together where each of them does */
        bool several = cell ? pricing->bent || flux > HARDLY : view->twice && view->twice[i];
        worth[i] = 0;
        if (!(pricing->need[t] > 0))
            continue;
        float share = covers ? fminf(part * pricing->upwards, 1)
                             : share_of(pricing, t, cell ? part * fminf(flux, SURELY) : flux, several);
        worth[i] = u->plain[t] * share;
        if (!u->inequalities || !(u->strengthened[t] > 0 && share > 0))
            continue;
        /* the strengthened share of two arcs together may be more than the sum of theirs, but never more than 1; what
         * cells cover by themselves is not strengthened */
        float strong = covers    ? share
                       : cell    ? sp_strengthen_portion(u->inequalities, u->kind[t], share)
                       : several ? 1
                                 : sp_strengthen(u->inequalities, u->kind[t], share);
        worth[i] += u->strengthened[t] * strong;
    }
    pricing->search->sweeps->total(view, worth, total);
}

/* The share of what a texel needs that a film brings, rounded upwards. */
static inline float film_share_of(const sp_pose_pricing *pricing, uint32_t texel, float film)
{
    return fminf(1, film / pricing->film_need[texel] * pricing->upwards);
}

/* Adds what a print brings to a row of `count` entries; returns how many it has then. A texel is covered by what hits
 * it, or by its film, never by both together, so that where many nozzles suffice one way, the greater of either way's
 * shares come to 1 as well. Where a spray ends, what it covers by itself and what suffices together with others' are
 * two entries: inequalities make of them what they make of each. */
static inline size_t write_print(const sp_pose_pricing *pricing, const sp_print *print, uint32_t *texels, float *shares,
                                 size_t count)
{
    uint32_t t = print->patch;
    if (!(pricing->need[t] > 0))
        return count;
    float hits = print->hit > 0 ? share_of(pricing, t, print->hit, false) : 0,
          runs = print->film > 0 ? film_share_of(pricing, t, print->film) : 0;
    float both[] = {print->edge > 0 ? fmaxf(-print->edge - PART_MORE, -1) : 0, fmaxf(hits, runs)};
    for (int i = 0; i < 2; i++)
        if (both[i] != 0) {
            texels[count] = t;
            shares[count++] = both[i];
        }
    return count;
}

/* Writes a field as a row; returns how many entries it has. */
static size_t write_row(const sp_pose_pricing *pricing, const float *field, uint32_t *texels, float *shares)
{
    size_t count = 0, patches = pricing->search->patch_count;
    for (uint32_t t = 0; t < patches; t++) {
        float hit = field[t], film = pricing->film_need ? field[patches + t] : 0;
        sp_print print = {t, hit > 0 ? hit : 0, hit < 0 ? -hit : 0, film};
        if (hit != 0 || film > 0)
            count = write_print(pricing, &print, texels, shares, count);
    }
    return count;
}

/* The same of a footprint. */
static size_t write_footprint(const sp_pose_pricing *pricing, const sp_footprint *footprint, uint32_t *texels,
                              float *shares)
{
    size_t count = 0;
    for (size_t i = 0; i < footprint->count; i++)
        count = write_print(pricing, &footprint->prints[i], texels, shares, count);
    return count;
}

/* What a pose, or a nozzle that is still there, brings of its own footprint. */
static size_t write_pose(const sp_pose_pricing *pricing, sp_pose pose, uint32_t *texels, float *shares)
{
    return write_footprint(pricing, sp_footprints_look(pricing->search->footprints, pose), texels, shares);
}

bool sp_pose_pricing_row(const sp_pose_pricing *pricing, const float *field, uint64_t key, size_t port, uint32_t tier,
                         sp_rows *rows, sp_error *error)
{
    const scratch *own = &pricing->scratches[omp_get_thread_num()];
    size_t count = write_row(pricing, field, own->texels, own->shares);
    return sp_rows_add(rows, key, port, tier, own->texels, own->shares, count, error);
}

/* The same of a pose that no sweep knows. */
static bool add_footprint(const sp_pose_pricing *pricing, sp_pose pose, uint64_t key, size_t port, uint32_t tier,
                          sp_rows *rows, sp_error *error)
{
    const scratch *own = &pricing->scratches[omp_get_thread_num()];
    size_t count = write_pose(pricing, pose, own->texels, own->shares);
    return sp_rows_add(rows, key, port, tier, own->texels, own->shares, count, error);
}

bool sp_pose_pricing_found(const sp_pose_pricing *pricing, const sp_placed *placed, uint32_t tier, sp_rows *rows,
                           sp_error *error)
{
    size_t port = pricing->ports[placed->site.mount];
    return sp_type_is_uniform(placed->nozzle.type)
               ? sp_pose_pricing_row(pricing, placed->field, SP_OWN_KEY, port, tier, rows, error)
               : add_footprint(pricing, placed->pose, SP_OWN_KEY, port, tier, rows, error);
}

/* The field of a pose that sweeps know, rounded upwards, into the thread's own. */
static void sweep_pose(const sp_pose_pricing *pricing, scratch *own, sp_pose pose)
{
    const sp_search *search = pricing->search;
    const sp_variant *variant = &search->candidates->variants[pose.variant];
    sp_vec3 up = sp_evaluator_setup(search->coarse)->up;
    sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, up);
    sp_frame frame = sp_nozzle_frame(nozzle.axis, nozzle.roll, up);
    sp_desk *desk = NULL;
    own->fields.view = sp_visibility_look(search->visibility, pose.site, variant->launch, &desk);
    memset(own->field, 0, search->field_count * sizeof *own->field);
    if (own->fields.view->start) {
        sp_region region = sp_region_create(&variant->spray, &frame, sp_variant_strength(search, variant), SLACK);
        sp_cull_create(&search->visibility->bins, own->fields.view, &variant->spray, SP_COUNT_SHARE, &own->cull);
        sp_field_sweep(search, &own->fields, variant, &region, own->field);
    }
    sp_visibility_leave(search->visibility, &desk);
}

bool sp_pose_pricing_add(const sp_pose_pricing *pricing, sp_pose pose, sp_rows *rows, sp_error *error)
{
    const sp_search *search = pricing->search;
    scratch *own = &pricing->scratches[omp_get_thread_num()];
    size_t key = sp_pose_order_position(pricing->order, pose),
           port = pricing->ports[search->sites->items[pose.site].mount];
    uint32_t tier = tier_at(pricing, pose.site, pose.variant);
    if (!sp_type_is_uniform(search->candidates->variants[pose.variant].type))
        return add_footprint(pricing, pose, key, port, tier, rows, error);
    sweep_pose(pricing, own, pose);
    return sp_pose_pricing_row(pricing, own->field, key, port, tier, rows, error);
}

/* What each arrival of a view brings to a variant; returns the variant's region about the site's axis. */
static sp_region prepare_worth(const sp_pose_pricing *pricing, scratch *own, const sp_view *view,
                               const sp_variant *variant, const sp_frame *frame, const sp_multipliers *u)
{
    double strength = sp_variant_strength(pricing->search, variant);
    own->multipliers = u;
    own->fields.view = view;
    if (!sp_type_is_uniform(variant->type))
        return (sp_region){.count = SP_COUNT_SHARE};
    if (!pricing->film_need)
        sp_pose_pricing_worth(pricing, view, (float)strength, (float)strength, u, own->worth, own->total);
    sp_cull_create(&pricing->search->visibility->bins, view, &variant->spray, SP_COUNT_SHARE, &own->cull);
    return sp_region_create(&variant->spray, frame, strength, SLACK);
}

/* The price of the row in hand, of `count` entries. */
static double row_price(const scratch *own, size_t count)
{
    size_t start[] = {0, count};
    sp_rows row = {.count = 1, .start = start, .texel = own->texels, .share = own->shares};
    return sp_rows_price(&row, 0, own->multipliers) * UPWARDS;
}

/* The price of the pose's own row: what runs down comes from everywhere above, which no bin knows. */
static double field_price_of(const sp_pose_pricing *pricing, const scratch *own, const sp_variant *variant,
                             const sp_region *region)
{
    sp_field_sweep(pricing->search, &own->fields, variant, region, own->field);
    return row_price(own, write_row(pricing, own->field, own->texels, own->shares));
}

/* The pose's price, rounded upwards, by more where it is less than `least`. */
static double price_of(const sp_pose_pricing *pricing, const scratch *own, const sp_view *view, sp_pose pose,
                       sp_region *region, double least)
{
    const sp_search *search = pricing->search;
    sp_vec3 up = sp_evaluator_setup(search->coarse)->up;
    sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, up);
    sp_frame frame = sp_nozzle_frame(nozzle.axis, nozzle.roll, up);
    const sp_weight weight = {own->worth, own->total};
    double price;
    if (!sp_type_is_uniform(nozzle.type))
        return row_price(own, write_pose(pricing, pose, own->texels, own->shares));
    sp_region_turn(region, &frame);
    if (pricing->film_need)
        return field_price_of(pricing, own, &search->candidates->variants[pose.variant], region);
    search->sweeps->sum(&search->visibility->bins, &own->cull, region, view, &weight, 1, least / UPWARDS, &price);
    return price * UPWARDS;
}

/* What a site's pose of a variant must be worth to matter: more than is on offer, or than is needed. */
static double least_of(const sp_pose_pricing *pricing, size_t port, size_t tier, const double *needed,
                       const sp_offers *offers)
{
    double offered =
        port == SP_NO_PORT ? offers->free[tier * offers->most] : offers->port[port * offers->tier_count + tier];
    return pricing->cover->weight[tier] > pricing->cover->water ? INFINITY : fmin(offered, needed[tier]);
}

/* What no pose of a variant at a site can be worth more than. */
static double all_bins(const scratch *own)
{
    double sum = 0;
    for (size_t b = 0; b < SP_BINS; b++)
        sum += (double)own->total[b];
    return sum * UPWARDS;
}

/* Prices all poses of a variant at a site, or every `stride`th, another one at the next site. The highest price, where
 * one is more than `least`; `needed`: to raise the bound. */
static best price_variant(sp_pose_pricing *pricing, scratch *own, const sp_view *view, uint32_t site, uint32_t k,
                          sp_region *region, size_t stride, double least, double needed)
{
    const sp_candidates *candidates = pricing->search->candidates;
    const sp_variant *variant = &candidates->variants[k];
    size_t axes = sp_candidates_axes(candidates, pricing->search->sites->items[site].mount, k)->count;
    best found = {.price = 0};
    double all = pricing->film_need || !sp_type_is_uniform(variant->type) ? INFINITY : all_bins(own);
    double told = stride == 1 ? TOLD_LEAST * needed : INFINITY; /* below it no price need be exact to be told */
    for (uint32_t a = 0; a < axes; a++)
        for (uint32_t r = 0; r < variant->roll_count; r++) {
            sp_pose pose = {site, k, a, r};
            if ((site + a * variant->roll_count + r) % stride)
                continue;
            double matters = fmin(told, fmax(found.price, least));
            double price = all < matters ? all : price_of(pricing, own, view, pose, region, matters);
            if (stride == 1)
                pricing->last[sp_pose_order_position(pricing->order, pose)] = nextafterf((float)price, INFINITY);
            if (price > fmax(found.price, least))
                found = (best){pose, price};
        }
    return found;
}

/* The best pose of every variant at a site, of those that matter. */
static void price_site(sp_pose_pricing *pricing, scratch *own, uint32_t site, const sp_multipliers *u,
                       const double *needed, size_t stride, const sp_offers *offers)
{
    const sp_candidates *candidates = pricing->search->candidates;
    uint32_t mount = pricing->search->sites->items[site].mount;
    sp_vec3 up = sp_evaluator_setup(pricing->search->coarse)->up;
    sp_frame frame = sp_nozzle_frame(pricing->search->sites->items[site].axis, 0, up);
    for (uint32_t k = 0; k < candidates->variant_count; k++) {
        const sp_variant *variant = &candidates->variants[k];
        best *found = &pricing->bests[site * candidates->variant_count + k];
        uint32_t tier = tier_at(pricing, site, k);
        double least = least_of(pricing, pricing->ports[mount], tier, needed, offers);
        *found = (best){.price = 0};
        if (!sp_candidates_axes(candidates, mount, k)->count || !isfinite(least) || pricing->search->port_taken[mount])
            continue;
        const sp_view *view = sp_visibility_look(pricing->search->visibility, site, variant->launch, &own->desk);
        if (!view->start && sp_type_is_uniform(variant->type))
            continue;
        sp_region region = prepare_worth(pricing, own, view, variant, &frame, u);
        *found = price_variant(pricing, own, view, site, k, &region, stride, least, needed[tier]);
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
        double need = needed[tier_at(pricing, pose.site, pose.variant)], price = pricing->bests[i].price;
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

/* Found nozzles, those that are alive; alive NULL: all. */
static void price_found(const sp_pose_order *order, const sp_multipliers *u, const uint8_t *alive, float *price)
{
    for (size_t i = 0; i < order->block_count; i++) {
        const sp_pose_block *found = &order->blocks[i];
        for (size_t at = found->start; found->variant == SP_NONE && at < found[1].start; at++) {
            size_t row = order->own_order[found->site + at - found->start];
            price[at] = !alive || alive[at] ? nextafterf((float)sp_rows_price(order->own, row, u), INFINITY) : 0;
        }
    }
}

static sp_ranks *ranks_of(const sp_pose_pricing *pricing)
{
    return pricing->search->options->run.ranks;
}

/* The others' prices of the blocks of their sites, where `price` is not NULL, and where `bests` is set the best of
 * these. */
static bool share_prices(sp_pose_pricing *pricing, float *price, bool bests, sp_error *error)
{
    const sp_pose_order *order = pricing->order;
    size_t variants = pricing->search->candidates->variant_count, cells = pricing->search->sites->count * variants;
    sp_told told = {0};
    sp_heard heard;
    for (size_t i = 0; sp_ranks_count(ranks_of(pricing)) > 1 && i < cells; i++) {
        if (!sp_ranks_mine(ranks_of(pricing), i / variants))
            continue;
        const sp_pose_block *block = order->block_of[i] == SIZE_MAX ? NULL : &order->blocks[order->block_of[i]];
        if (price && block)
            sp_tell(&told, price + block->start, (block[1].start - block->start) * sizeof *price);
        if (bests)
            sp_tell(&told, &pricing->bests[i], sizeof pricing->bests[i]);
    }
    if (!sp_ranks_gather(ranks_of(pricing), "prices", &told, &heard, error))
        return false;
    for (size_t i = 0; i < cells; i++) {
        size_t rank = sp_ranks_owner(ranks_of(pricing), i / variants);
        if (sp_ranks_mine(ranks_of(pricing), i / variants))
            continue;
        const sp_pose_block *block = order->block_of[i] == SIZE_MAX ? NULL : &order->blocks[order->block_of[i]];
        if (price && block)
            sp_hear(&heard, rank, price + block->start, (block[1].start - block->start) * sizeof *price);
        if (bests)
            sp_hear(&heard, rank, &pricing->bests[i], sizeof pricing->bests[i]);
    }
    sp_heard_free(&heard);
    return true;
}

/* The prices of each rank's sites, see price_site. */
static void price_sites(sp_pose_pricing *pricing, const sp_multipliers *u, const double *needed, size_t stride,
                        const sp_offers *offers)
{
    size_t sites = pricing->search->sites->count;
    sp_ranks_part(ranks_of(pricing));
#pragma omp parallel for num_threads(pricing->threads) schedule(dynamic, 1)
    for (size_t i = 0; i < sites; i++)
        if (sp_ranks_mine(ranks_of(pricing), i) && sp_cover_goes_on(pricing->cover))
            price_site(pricing, &pricing->scratches[omp_get_thread_num()], (uint32_t)i, u, needed, stride, offers);
    sp_ranks_rejoin(ranks_of(pricing));
    for (int i = 0; i < pricing->threads; i++)
        sp_visibility_leave(pricing->search->visibility, &pricing->scratches[i].desk);
}

static bool price_poses(void *user, const sp_multipliers *u, const double *needed, bool all, sp_offers *offers,
                        sp_rows *rows, sp_error *error)
{
    sp_pose_pricing *pricing = user;
    const sp_search *search = pricing->search;
    size_t variants = search->candidates->variant_count, sites = search->sites->count;
    memset(pricing->last, 0, pricing->order->list.count * sizeof *pricing->last);
    price_found(pricing->order, u, NULL, pricing->last);
    price_sites(pricing, u, needed, all ? 1 : STRIDE, offers);
    if (!share_prices(pricing, all ? pricing->last : NULL, true, error))
        return false;
    if (!sp_cover_goes_on(pricing->cover))
        return true;
    for (size_t i = 0; i < sites * variants; i++)
        if (pricing->bests[i].price > 0)
            sp_offers_add(offers, pricing->ports[search->sites->items[i / variants].mount],
                          tier_at(pricing, (uint32_t)(i / variants), (uint32_t)(i % variants)),
                          pricing->bests[i].price);
    return hand_out(pricing, needed, rows, error);
}

/* The poses of a block that are alive. */
static void price_block(sp_pose_pricing *pricing, scratch *own, size_t block, const sp_multipliers *u,
                        const uint8_t *alive, float *price)
{
    const sp_search *search = pricing->search;
    const sp_pose_block *poses = &pricing->order->blocks[block];
    size_t end = poses[1].start;
    const sp_variant *variant = &search->candidates->variants[poses->variant];
    sp_frame frame = sp_nozzle_frame(search->sites->items[poses->site].axis, 0, sp_evaluator_setup(search->coarse)->up);
    memset(price + poses->start, 0, (end - poses->start) * sizeof *price);
    if (!memchr(alive + poses->start, 1, end - poses->start))
        return;
    const sp_view *view = sp_visibility_look(search->visibility, poses->site, variant->launch, &own->desk);
    if (!view->start && sp_type_is_uniform(variant->type))
        return;
    sp_region region = prepare_worth(pricing, own, view, variant, &frame, u);
    for (size_t i = poses->start; i < end; i++)
        if (alive[i])
            price[i] = nextafterf(
                (float)price_of(pricing, own, view, sp_pose_order_at(pricing->order, block, i), &region, 0), INFINITY);
}

static bool price_list(void *user, const sp_multipliers *u, const uint8_t *alive, float *price, sp_error *error)
{
    sp_pose_pricing *pricing = user;
    const sp_pose_order *order = pricing->order;
    size_t variants = pricing->search->candidates->variant_count, sites = pricing->search->sites->count;
    sp_ranks_part(ranks_of(pricing));
#pragma omp parallel for num_threads(pricing->threads) schedule(dynamic, 1)
    for (size_t site = 0; site < sites; site++)
        for (size_t k = 0; k < variants && sp_ranks_mine(ranks_of(pricing), site) && sp_cover_goes_on(pricing->cover);
             k++)
            if (order->block_of[site * variants + k] != SIZE_MAX)
                price_block(pricing, &pricing->scratches[omp_get_thread_num()], order->block_of[site * variants + k], u,
                            alive, price);
    for (int i = 0; i < pricing->threads; i++)
        sp_visibility_leave(pricing->search->visibility, &pricing->scratches[i].desk);
    sp_ranks_rejoin(ranks_of(pricing));
    price_found(order, u, alive, price);
    return share_prices(pricing, price, false, error);
}

static bool row_of_list(void *user, size_t position, sp_rows *rows, sp_error *error)
{
    const sp_pose_pricing *pricing = user;
    const sp_pose_order *order = pricing->order;
    size_t block = sp_pose_order_block(order, position);
    if (order->blocks[block].variant != SP_NONE)
        return sp_pose_pricing_add(pricing, sp_pose_order_at(order, block, position), rows, error);
    const sp_rows *own = order->own;
    size_t row = order->own_order[order->blocks[block].site + position - order->blocks[block].start];
    return sp_rows_add(rows, position, own->port[row], own->tier[row], own->texel + own->start[row],
                       own->share + own->start[row], own->start[row + 1] - own->start[row], error);
}

bool sp_pose_list(sp_pose_pricing *pricing, const sp_pose_order *order, sp_candidate_list *list, sp_error *error)
{
    *list = order->list;
    list->user = pricing;
    list->price = price_list;
    list->row = row_of_list;
    list->threads = pricing->threads;
    pricing->order = order;
    pricing->last = calloc(order->list.count + 1, sizeof *pricing->last);
    return pricing->last || sp_fail_memory(error);
}

const float *sp_pose_pricing_last(const sp_pose_pricing *pricing)
{
    return pricing->last;
}

sp_pricer sp_pose_pricer(sp_pose_pricing *pricing)
{
    return (sp_pricer){pricing, price_poses};
}
