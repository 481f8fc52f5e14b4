#include "forward_check.h"

#include <math.h>

/* On the search's patches, 20,000 at most, so many jets come within half a point of the inverse evaluation on vessels
 * of a thousand faces, in a second or two. Their number is part of the answer. */
#define JETS 2000000
#define TELLS 0.005
#define SECONDS 1

static void compare(const sp_evaluator *evaluator, const sp_coverage *inverse, const sp_coverage *forward,
                    sp_forward_check *check)
{
    double difference = forward->fraction - inverse->fraction;
    double tolerance = fmax(TELLS, sp_evaluator_fidelity(evaluator)->accuracy);
    *check = (sp_forward_check){.computed = true,
                                .texels = sp_evaluator_patches(evaluator)->count,
                                .jets = JETS,
                                .coverage = forward->fraction,
                                .difference = difference,
                                .tolerance = tolerance,
                                .agrees = fabs(difference) <= tolerance};
}

bool sp_check_forward(const sp_evaluator *evaluator, const sp_layout *layout, sp_watch *watch, sp_forward_check *check,
                      sp_error *error)
{
    *check = (sp_forward_check){0};
    if (!sp_watch_has_time(watch, "forward check", 0) || sp_watch_left(watch) < SECONDS)
        return true;
    sp_error failure = {0};
    sp_coverage *inverse = sp_evaluate_inverse(evaluator, layout, &failure);
    sp_coverage *forward = inverse ? sp_evaluate_forward(evaluator, layout, JETS, &failure) : NULL;
    if (forward)
        compare(evaluator, inverse, forward, check);
    sp_coverage_destroy(inverse);
    sp_coverage_destroy(forward);
    if (forward || failure.kind == SP_ERROR_INTERRUPTED)
        return true;
    if (error)
        *error = failure;
    return false;
}
