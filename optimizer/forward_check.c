#include "forward_check.h"

#include <math.h>

/* On the search's patches, 20,000 at most, two million jets come within half a point of the inverse evaluation on
 * vessels of a thousand faces, in a second or two. Fewer come within a point, and are enough where they agree much
 * better than they have to. Where neither agrees and four times as many still change what is hit, as where patches just
 * have the dose that they need, or either nearly agrees, more are flown. Their number is part of the answer. */
static const uint64_t jets_flown[] = {500000, 2000000, 8000000};
#define PATCHES_MOST 20000.0
#define SHARE_LEAST 0.25 /* of the jets */
#define MUCH_BETTER 0.5  /* of the tolerance */
#define FAR 2            /* of these, beyond which what changes little is no chance */
#define TOLERANCE_LEAST 0.005
#define SECONDS 1

/* What hits alone cover: jets know nothing of film. */
static double hit_share(const sp_coverage *coverage)
{
    return coverage->area > 0 ? (coverage->covered_area - coverage->film.area) / coverage->area : 0;
}

/* As many on each patch, so fewer where there are few. */
static uint64_t jets_for(const sp_evaluator *evaluator, uint64_t jets)
{
    double share = fmax(SHARE_LEAST, (double)sp_evaluator_patches(evaluator)->count / PATCHES_MOST);
    return (uint64_t)ceil((double)jets * fmin(share, 1));
}

static void compare(const sp_evaluator *evaluator, const sp_coverage *inverse, const sp_coverage *forward,
                    uint64_t jets, sp_forward_check *check)
{
    double hit = hit_share(forward), difference = hit - hit_share(inverse);
    double tolerance = fmax(TOLERANCE_LEAST, sp_evaluator_fidelity(evaluator)->accuracy);
    *check = (sp_forward_check){.computed = true,
                                .texels = sp_evaluator_patches(evaluator)->count,
                                .jets = jets,
                                .coverage = hit,
                                .difference = difference,
                                .tolerance = tolerance,
                                .agrees = fabs(difference) <= tolerance};
}

/* Whether jets have said enough: they agree, or are far from it and more would change little. `before`: what a quarter
 * of them said; NAN: these are the first. */
static bool have_said(const sp_forward_check *check, double before)
{
    double settled = MUCH_BETTER * check->tolerance;
    return fabs(check->difference) <= settled || (check->agrees && !isnan(before)) ||
           (fabs(check->difference) > FAR * check->tolerance && fabs(check->difference - before) <= settled);
}

/* True where there is no time for four times the jets that took so many seconds: what these few say against the
 * proposal is not held against it. */
static bool is_late(sp_deadline *deadline, double seconds, sp_forward_check *check)
{
    if (4 * seconds <= sp_deadline_left(deadline))
        return false;
    if (!check->agrees) {
        *check = (sp_forward_check){0};
        sp_deadline_cut(deadline, "forward check");
    }
    return true;
}

bool sp_check_forward(const sp_evaluator *evaluator, const sp_layout *layout, sp_deadline *deadline,
                      sp_forward_check *check, sp_error *error)
{
    *check = (sp_forward_check){0};
    if (!layout->count)
        return true;
    if (!sp_deadline_has_time(deadline, "forward check", 0) || sp_deadline_left(deadline) < SECONDS) {
        sp_deadline_cut(deadline, "forward check");
        return true;
    }
    sp_error failure = {0};
    sp_coverage *inverse = sp_evaluate_inverse(evaluator, layout, &failure), *forward = NULL;
    const size_t steps = sizeof jets_flown / sizeof *jets_flown;
    for (size_t i = 0; inverse && i < steps; i++) {
        uint64_t jets = jets_for(evaluator, jets_flown[i]);
        double start = sp_deadline_elapsed(deadline);
        sp_coverage_destroy(forward);
        forward = sp_evaluate_forward(evaluator, layout, 0, jets, &failure);
        if (!forward) {
            *check = (sp_forward_check){0};
            break;
        }
        double before = i ? check->difference : NAN;
        compare(evaluator, inverse, forward, jets, check);
        bool more = i + 1 < steps && !have_said(check, before);
        if (!more || is_late(deadline, sp_deadline_elapsed(deadline) - start, check))
            break;
    }
    bool checked = forward != NULL;
    sp_coverage_destroy(inverse);
    sp_coverage_destroy(forward);
    if (checked || failure.kind == SP_ERROR_INTERRUPTED)
        return true;
    if (error)
        *error = failure;
    return false;
}
