#include "certificate/pose_price.h"
#include "certificate/pose_rows.h"
#include "bound/rounding.h"

#define SURELY (1 + 1e-5f) /* flux over threshold, from which a cell covers its part and brings others nothing */
#define HARDLY (1 - 1e-5f) /* the same, up to which it does not cover */

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
                             : sp_pose_share(pricing, t, cell ? part * fminf(flux, SURELY) : flux, several);
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
    pricing->search->kernels->total(view, worth, total);
}

sp_region sp_pose_prepare(const sp_pose_pricing *pricing, sp_pose_scratch *own, const sp_view *view,
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
    return sp_region_create(&variant->spray, frame, strength, SP_POSE_SLACK);
}

/* The price of the row in hand, of `count` entries. */
static double row_price(const sp_pose_scratch *own, size_t count)
{
    size_t start[] = {0, count};
    sp_rows row = {.count = 1, .start = start, .texel = own->texels, .share = own->shares};
    return sp_rows_price(&row, 0, own->multipliers) * SP_UPWARDS_SUM;
}

/* The price of the pose's own row: what runs down comes from everywhere above, which no bin knows. */
static double field_price_of(const sp_pose_pricing *pricing, const sp_pose_scratch *own, const sp_variant *variant,
                             const sp_region *region)
{
    sp_field_region(pricing->search, &own->fields, variant, region, own->field);
    return row_price(own, sp_pose_write_field(pricing, own->field, own->texels, own->shares));
}

double sp_pose_price(const sp_pose_pricing *pricing, const sp_pose_scratch *own, const sp_view *view, sp_pose pose,
                     sp_region *region, double least)
{
    const sp_search *search = pricing->search;
    sp_vec3 up = sp_evaluator_setup(search->coarse)->up;
    sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, up);
    sp_frame frame = sp_nozzle_frame(nozzle.axis, nozzle.roll, up);
    const sp_weight weight = {own->worth, own->total};
    double price;
    if (!sp_type_is_uniform(nozzle.type))
        return row_price(own, sp_pose_write(pricing, pose, own->texels, own->shares));
    sp_outline_turn(&region->outline, &frame);
    if (pricing->film_need)
        return field_price_of(pricing, own, &search->candidates->variants[pose.variant], region);
    search->kernels->sum(&search->visibility->bins, &own->cull, region, view, &weight, 1, least / SP_UPWARDS_SUM,
                         &price);
    return price * SP_UPWARDS_SUM;
}

double sp_pose_price_most(const sp_pose_scratch *own)
{
    double sum = 0;
    for (size_t b = 0; b < SP_BINS; b++)
        sum += (double)own->total[b];
    return sum * SP_UPWARDS_SUM;
}
