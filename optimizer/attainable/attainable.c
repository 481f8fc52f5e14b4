#include "attainable/attainable.h"

#include "attainable/reflected.h"
#include "attainable/moving_goods.h"
#include "attainable/by_fields.h"
#include "scoring/footprints.h"
#include "scoring/mount_capacity.h"
#include "spray/criterion.h"

#include <omp.h>
#include <stdlib.h>

#define CHUNK 256          /* patches a thread does in a row: neighbours are reached from the same sites */
#define BATCH (64 * CHUNK) /* between two looks at the clock, which all ranks take whatever threads each has */

typedef struct {
    const sp_evaluator *fine;
    const sp_search *search;
    const sp_scope *scopes; /* [variants] */
    const double *kept;     /* [patches], counted flux of the kept nozzles */
    size_t nozzles_left;
    double water_left; /* m³/s */
} sp_reckoning;

/* Flux per flow and transfer (1/sr) in a direction that lies `away` (rad) from the mount's axis, at best over the axes
 * within the tilt and the angles allowed; 0: not at all. */
static double best_intensity(const sp_variant *variant, const sp_scope *scope, double away, double tilt)
{
    /* polar angles about the nozzle's axis that the direction can be brought to */
    double least = fmax(0, away - tilt), most = fmin(M_PI, away + tilt);
    const sp_nozzle_type *type = variant->type;
    if (!sp_type_is_uniform(type)) /* somewhere in it: what it brings there its footprints tell */
        return least <= variant->reach;
    double angle = fmax(scope->angle_low, sp_type_angle_reaching(type, least));
    if (angle > scope->angle_high * (1 + 1e-12)) {
        if (least > variant->reach)
            return 0;
        angle = type->angle;
    }
    sp_spray spray = sp_spray_create(type, angle);
    return most < spray.low ? 0 : 1 / spray.solid_angle;
}

/* Adds what one arrival offers; true where something got better. */
static bool offer(const sp_reckoning *reckoning, const sp_site *site, size_t launch, sp_vec3 direction, double transfer,
                  double area, sp_place_offers *offers)
{
    const sp_search *search = reckoning->search;
    const sp_mount *mount = &search->options->mounts[site->mount];
    double away = acos(fmin(1, fmax(-1, sp_dot(direction, site->axis))));
    size_t place = sp_mount_capacity(mount) == 1 ? site->mount : search->options->mount_count;
    bool better = false;
    for (size_t k = 0; k < search->candidates->variant_count; k++) {
        const sp_variant *variant = &search->candidates->variants[k];
        const sp_scope *scope = &reckoning->scopes[k];
        if (variant->launch != launch || !sp_type_is_uniform(variant->type) ||
            !sp_candidates_axes(search->candidates, site->mount, k)->count || scope->flow_low > reckoning->water_left)
            continue;
        /* a jet narrower than the patch is spread over it */
        double ratio = fmin(best_intensity(variant, scope, away, mount->tilt) * transfer, 1 / area);
        if (ratio <= 0)
            continue;
        sp_offer new = {ratio, scope->flow_low, fmin(scope->flow_high, reckoning->water_left)};
        better |= sp_place_offers_take(offers, place, new);
    }
    return better;
}

static bool enough(const sp_reckoning *reckoning, const sp_place_offers *offers, size_t patch)
{
    const sp_search *search = reckoning->search;
    if (!reckoning->nozzles_left)
        return false;
    if (search->threshold <= 0)
        return true;
    if (search->single) {
        for (size_t i = 0; i < offers->count; i++)
            if (offers->strongest[i].ratio * offers->strongest[i].high >= search->threshold)
                return true;
        return false;
    }
    double need = search->threshold - reckoning->kept[patch];
    return sp_place_offers_suffice(offers, reckoning->nozzles_left, reckoning->water_left, need);
}

/* How near one flight brings the patch if its way is free; NO_LINE where it comes from behind. Its transfer where it
 * passes. */
static sp_reason judge(const sp_reckoning *reckoning, const sp_flight *flight, size_t patch, double *transfer)
{
    const sp_patches *patches = sp_evaluator_patches(reckoning->fine);
    const sp_criterion *criterion = &sp_evaluator_setup(reckoning->fine)->criterion;
    double against = -sp_dot(flight->velocity, patches->normal[patch]);
    if (patches->side[patch] == SP_SIDE_BOTH)
        against = fabs(against);
    if (!(against > 0))
        return SP_REASON_NO_LINE;
    if (!sp_is_fast_enough(criterion, sp_length(flight->velocity)))
        return SP_REASON_SLOW;
    if (!sp_is_steep_enough(criterion, sp_incidence(flight->velocity, patches->normal[patch], against)))
        return SP_REASON_SLANTED;
    *transfer = against / flight->spread;
    return SP_REASON_FLUX;
}

/* Whether any variant of this launch can be aimed so. */
static bool aimable(const sp_reckoning *reckoning, const sp_site *site, size_t launch, sp_vec3 direction)
{
    const sp_search *search = reckoning->search;
    double away = acos(fmin(1, fmax(-1, sp_dot(direction, site->axis))));
    for (size_t k = 0; k < search->candidates->variant_count; k++)
        if (search->candidates->variants[k].launch == launch &&
            sp_candidates_axes(search->candidates, site->mount, k)->count &&
            best_intensity(&search->candidates->variants[k], &reckoning->scopes[k], away,
                           search->options->mounts[site->mount].tilt) > 0)
            return true;
    return false;
}

/* What one site offers to a patch; true where something got better. *reason rises to how near it is brought. */
static bool site_offers(const sp_reckoning *reckoning, const sp_site *site, size_t patch, sp_place_offers *offers,
                        sp_reason *reason)
{
    const sp_search *search = reckoning->search;
    const sp_patches *patches = sp_evaluator_patches(reckoning->fine);
    bool better = false;
    if (search->options->mounts[site->mount].kind == SP_MOUNT_PORT && search->port_taken[site->mount])
        return false;
    for (size_t s = 0; s < search->candidates->launch_count; s++) {
        sp_launch launch = search->candidates->launches[s];
        double transfer = 0;
        sp_flight flights[2];
        int count = sp_launch_flights(&launch, site->position, patches->point[patch],
                                      sp_evaluator_gravity(reckoning->fine, &launch), flights);
        for (int f = 0; f < count; f++) {
            if (!aimable(reckoning, site, s, flights[f].direction))
                continue;
            sp_reason near = judge(reckoning, &flights[f], patch, &transfer);
            if ((near < SP_REASON_FLUX && near <= *reason) ||
                !sp_evaluator_flight_free(reckoning->fine, site->position, launch, &flights[f], (uint32_t)patch))
                continue;
            *reason = near > *reason ? near : *reason;
            if (near == SP_REASON_FLUX)
                better |= offer(reckoning, site, s, flights[f].direction, transfer, patches->area[patch], offers);
        }
    }
    return better;
}

/* Asks the sites in turn, the one that served the last patch first. */
static sp_reason patch_reason(const sp_reckoning *reckoning, size_t patch, sp_place_offers *offers, size_t *hint)
{
    size_t sites = reckoning->search->sites->count;
    sp_reason reason = SP_REASON_NO_LINE;
    for (size_t i = 0; i < offers->count; i++)
        offers->strongest[i] = offers->thriftiest[i] = (sp_offer){0};
    for (size_t i = 0; i < sites; i++) {
        size_t site = (*hint + i) % sites;
        if (site_offers(reckoning, &reckoning->search->sites->items[site], patch, offers, &reason) &&
            enough(reckoning, offers, patch)) {
            *hint = site;
            return SP_REASON_ATTAINABLE;
        }
    }
    return reason;
}

static bool reckon(const sp_reckoning *reckoning, sp_deadline *deadline, sp_reason *reasons, sp_error *error)
{
    size_t patches = sp_evaluator_patches(reckoning->fine)->count;
    size_t places = reckoning->search->options->mount_count + 1;
    int threads = sp_threads(&reckoning->search->options->run);
    sp_offer *offers = malloc((size_t)threads * 2 * places * sizeof *offers);
    if (!offers)
        return sp_fail_memory(error);
    for (size_t first = 0; first < patches; first += BATCH) {
        /* a time limit does not stop this: without the target the search would not know when to end */
        if (!sp_deadline_goes_on(deadline, "attainable", (double)first / (double)patches) && deadline->cancelled)
            break;
        size_t end = first + BATCH < patches ? first + BATCH : patches;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
        for (size_t chunk = first; chunk < end; chunk += CHUNK) {
            sp_offer *mine = &offers[(size_t)omp_get_thread_num() * 2 * places];
            sp_place_offers own = {mine, mine + places, places};
            size_t hint = 0;
            for (size_t p = chunk; p < chunk + CHUNK && p < end; p++)
                if (reasons[p] != SP_REASON_ATTAINABLE)
                    reasons[p] = patch_reason(reckoning, p, &own, &hint);
        }
    }
    free(offers);
    return true;
}

static sp_scope *scopes_create(const sp_search *search, const sp_setup *setup)
{
    sp_scope *scopes = malloc(search->candidates->variant_count * sizeof *scopes);
    for (size_t k = 0; scopes && k < search->candidates->variant_count; k++) {
        const sp_variant *variant = &search->candidates->variants[k];
        sp_angle_range(search->options, variant->type, &scopes[k].angle_low, &scopes[k].angle_high);
        sp_flow_range(search->options, setup, variant->type, variant->pressure, &scopes[k].flow_low,
                      &scopes[k].flow_high);
    }
    return scopes;
}

/* What was left out of fields and footprints would bring is not known; where no line leads footprints would not either,
 * film might. */
static void doubt(const sp_search *search, bool whole, size_t patches, sp_reason *reasons)
{
    bool all = !whole && sp_evaluator_setup(search->coarse)->criterion.film > 0;
    for (size_t p = 0; !(whole && sp_footprints_whole(search->footprints)) && p < patches; p++)
        if (reasons[p] == SP_REASON_FLUX || (all && reasons[p] != SP_REASON_ATTAINABLE))
            reasons[p] = SP_REASON_UNKNOWN;
}

/* Where what walls throw back counts, it may cover whatever any liquid gets to, and what first impacts are too few,
 * too slow or too slanted for. */
static void allow_thrown_back(size_t patches, sp_reason *reasons)
{
    for (size_t p = 0; p < patches; p++)
        if (reasons[p] != SP_REASON_NO_LINE && reasons[p] != SP_REASON_UNKNOWN)
            reasons[p] = SP_REASON_ATTAINABLE;
}

/* By fields what closed forms do not show, and why not where that is more to ask. */
static bool ask_fields(const sp_reckoning *reckoning, sp_deadline *deadline, sp_reason *reasons, sp_error *error)
{
    const sp_evaluator *fine = reckoning->fine;
    const sp_search *search = reckoning->search;
    bool moves = sp_evaluator_setup(fine)->sweep.speed > 0, whole, explained = true;
    if (!sp_attain_by_fields(fine, search, reckoning->scopes, deadline, reasons, &whole, error))
        return false;
    /* without the fields it is not known what is dry */
    if (moves && whole && !sp_moving_goods_reasons(fine, search, deadline, reasons, &explained, error))
        return false;
    if (!moves && !sp_bounces(fine, search, deadline, reasons, error))
        return false;
    if (!whole || !explained)
        sp_deadline_cut(deadline, "attainable");
    doubt(search, whole, sp_evaluator_patches(fine)->count, reasons);
    return true;
}

/* Whether more time might find more: what was asked of the search's patches is as good as these and as what was traced
 * on them. */
static bool is_hurried(const sp_evaluator *fine, const sp_search *search, const sp_reason *reasons)
{
    bool asked = sp_evaluator_setup(fine)->sweep.speed > 0 || search->footprints || search->runoffs ||
                 sp_evaluator_counts_thrown_back(fine);
    bool whole = !search->visibility->hurried && sp_footprints_whole(search->footprints);
    for (size_t p = 0; asked && !whole && p < sp_evaluator_patches(fine)->count; p++)
        if (reasons[p] != SP_REASON_ATTAINABLE)
            return true;
    return false;
}

bool sp_attainable(const sp_evaluator *fine, const sp_search *search, sp_deadline *deadline, sp_reason *reasons,
                   sp_error *error)
{
    const sp_place_options *options = search->options;
    sp_reckoning reckoning = {.fine = fine,
                              .search = search,
                              .water_left = options->max_water - search->kept_flow,
                              .nozzles_left = !options->max_nozzles ? SIZE_MAX
                                              : options->max_nozzles > search->kept_count
                                                  ? options->max_nozzles - search->kept_count
                                                  : 0};
    sp_layout *layout = sp_layout_create(search->kept, search->kept_count, error);
    sp_coverage *kept = layout ? sp_evaluate_inverse(fine, layout, error) : NULL;
    sp_scope *scopes = scopes_create(search, sp_evaluator_setup(fine));
    bool done = kept != NULL;
    if (done && !scopes)
        done = sp_fail_memory(error);
    if (done) {
        reckoning.scopes = scopes;
        reckoning.kept = kept->deposits.even;
        for (size_t p = 0; p < kept->deposits.count; p++)
            reasons[p] = kept->deposits.covered[p] ? SP_REASON_ATTAINABLE : SP_REASON_UNKNOWN;
        bool moves = sp_evaluator_setup(fine)->sweep.speed > 0;
        done = (moves || reckon(&reckoning, deadline, reasons, error)) &&
               (deadline->cancelled || ask_fields(&reckoning, deadline, reasons, error));
        if (sp_evaluator_counts_thrown_back(fine))
            allow_thrown_back(sp_evaluator_patches(fine)->count, reasons);
        if (is_hurried(fine, search, reasons))
            sp_deadline_cut(deadline, "attainable");
    }
    free(scopes);
    sp_coverage_destroy(kept);
    sp_layout_destroy(layout);
    return done;
}
