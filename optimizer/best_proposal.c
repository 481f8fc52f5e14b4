/* The best of several proposals. */
#include "scoring/partial.h"

/* -1, 0 or 1: less, equal but for round-off, more. */
static int order(double a, double b, double tie)
{
    return a < b - tie ? -1 : a > b + tie;
}

static bool is_better(const sp_proposal *a, const sp_proposal *b)
{
    const sp_coverage *x = a->coverage, *y = b->coverage;
    bool a_reaches = x->covered_area >= a->asked_area, b_reaches = y->covered_area >= b->asked_area;
    int coverage = order(x->fraction, y->fraction, SP_TIE);
    int outlay = order(a->outlay, b->outlay, SP_ROUNDING * b->outlay);
    double other = y->fraction * a->outlay;
    int ratio = order(x->fraction * b->outlay, other, SP_TIE * other), merit = -outlay;
    if (a_reaches != b_reaches)
        return a_reaches;
    if (!a_reaches || a->objective == SP_OBJECTIVE_MAX_COVERAGE)
        merit = coverage;
    else if (a->objective == SP_OBJECTIVE_AREA_PER_WATER)
        merit = ratio;
    merit = merit ? merit : -outlay;
    return (merit ? merit : coverage) > 0;
}

size_t sp_place_best(const sp_proposal *const *proposals, size_t count)
{
    size_t best = 0;
    for (size_t i = 1; i < count; i++)
        best = is_better(proposals[i], proposals[best]) ? i : best;
    return best;
}
