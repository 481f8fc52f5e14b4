#include "attainable/moving_goods.h"

#include "attainable/patch_at.h"
#include "scoring/scoring.h"
#include "spray/criterion.h"

#include <omp.h>
#include <stdlib.h>

#define SHARE 0.1 /* of the time left, at most: it explains what is dry and finds no nozzle */

static sp_reason reason_of(const sp_criterion *criterion, const sp_arrival *arrival)
{
    if (arrival->passes)
        return SP_REASON_FLUX;
    return sp_is_fast_enough(criterion, arrival->speed) ? SP_REASON_SLANTED : SP_REASON_SLOW;
}

/* What a view comes to: the nearest of all, whichever thread came first. */
static bool look(const sp_search *search, const sp_site *site, size_t launch, sp_reason *nearest, sp_error *error)
{
    double half_angle = sp_visibility_needed(search->options, search->candidates, site, launch);
    if (half_angle < 0)
        return true;
    sp_reach *reach = sp_evaluator_reach(search->coarse, site->position, search->candidates->launches[launch],
                                         site->axis, half_angle, error);
    if (!reach)
        return false;
#pragma omp critical(sp_passing)
    for (size_t i = 0; i < reach->count; i++) {
        const sp_arrival *arrival = &reach->arrivals[i];
        sp_reason reason = reason_of(&sp_evaluator_setup(search->coarse)->criterion, arrival);
        nearest[arrival->patch] = reason > nearest[arrival->patch] ? reason : nearest[arrival->patch];
    }
    sp_reach_destroy(reach);
    return true;
}

/* *whole: there was time for all of them. */
static bool look_from_all(const sp_search *search, sp_deadline *deadline, sp_reason *nearest, bool *whole,
                          sp_error *error)
{
    size_t launches = search->candidates->launch_count;
    sp_error failure = {0};
    bool late = !sp_deadline_goes_on(deadline, "attainable", 1);
#pragma omp parallel for num_threads(sp_scorer_threads(search)) schedule(dynamic, 1) reduction(|| : late)
    for (size_t i = 0; i < search->sites->count * launches; i++) {
        sp_error own = {0};
        late = late || !sp_deadline_goes_on(deadline, "attainable", 1);
        if (!late && !look(search, &search->sites->items[i / launches], i % launches, nearest, &own))
#pragma omp critical(sp_passing)
            failure = own;
    }
    *whole = !late;
    return failure.kind == SP_OK || sp_fail(error, failure.kind, NULL, 0, 0, "%s", failure.message);
}

bool sp_moving_goods_reasons(const sp_evaluator *fine, const sp_search *search, sp_deadline *deadline,
                             sp_reason *reasons, bool *whole, sp_error *error)
{
    size_t patches = sp_evaluator_patches(fine)->count, left = 0;
    double share = deadline->share;
    *whole = true;
    for (size_t p = 0; p < patches; p++)
        left += reasons[p] != SP_REASON_ATTAINABLE;
    if (!left)
        return true;
    sp_reason *nearest = malloc((search->patch_count + 1) * sizeof *nearest);
    for (size_t p = 0; nearest && p < search->patch_count; p++)
        nearest[p] = SP_REASON_NO_LINE;
    sp_deadline_lend(deadline, SHARE);
    bool done = nearest ? look_from_all(search, deadline, nearest, whole, error) : sp_fail_memory(error) != NULL;
    sp_deadline_allow(deadline, share);
    for (size_t p = 0; done && *whole && p < patches; p++) {
        uint32_t patch = reasons[p] == SP_REASON_ATTAINABLE ? SP_NONE : sp_coarse_patch(fine, search->coarse, p);
        if (patch != SP_NONE)
            reasons[p] = nearest[patch];
    }
    free(nearest);
    return done;
}
