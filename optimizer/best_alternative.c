/* The best of several proposals. */
#include "scoring/partial.h"

/* -1, 0 or 1: less, equal but for round-off, more. */
static int order(double a, double b, double tie)
{
    return a < b - tie ? -1 : a > b + tie;
}

/* What is held against each other. */
typedef struct {
    const sp_coverage *coverage;
    double outlay;
    bool reaches; /* covers what was asked for */
} rival;

static rival rival_of(const sp_proposal *proposal)
{
    return (rival){proposal->coverage, proposal->outlay, proposal->coverage->covered_area >= proposal->asked_area};
}

static bool is_better(sp_objective objective, rival a, rival b)
{
    double x = a.coverage->fraction, y = b.coverage->fraction;
    int coverage = order(x, y, SP_TIE);
    int outlay = order(a.outlay, b.outlay, SP_ROUNDING * b.outlay);
    int ratio = order(x * b.outlay, y * a.outlay, SP_TIE * y * a.outlay), merit = -outlay;
    if (a.reaches != b.reaches)
        return a.reaches;
    if (objective == SP_OBJECTIVE_MAX_COVERAGE)
        merit = coverage;
    else if (!a.reaches)
        merit = order(x, y, SP_COVERAGE_TOLD);
    else if (objective == SP_OBJECTIVE_AREA_PER_WATER)
        merit = ratio;
    merit = merit ? merit : -outlay;
    return (merit ? merit : coverage) > 0;
}

/* Whether proposal i is better than proposal k. */
static bool beats(const sp_proposal *const *proposals, size_t i, size_t k)
{
    return is_better(proposals[i]->objective, rival_of(proposals[i]), rival_of(proposals[k]));
}

size_t sp_place_best(const sp_proposal *const *proposals, size_t count)
{
    size_t most = 0;
    for (size_t i = 1; i < count; i++)
        most = proposals[i]->coverage->fraction > proposals[most]->coverage->fraction + SP_TIE ? i : most;
    /* what covers a little less is held against the one that covers most, so that no chain of them leads far below */
    size_t best = most;
    for (size_t i = 0; i < count; i++)
        best = beats(proposals, i, best) && !beats(proposals, most, i) ? i : best;
    return best;
}

bool sp_place_is_beaten(const sp_proposal *proposal, const sp_coverage *coverage, double outlay)
{
    rival other = {coverage, outlay, coverage->covered_area >= proposal->asked_area};
    return is_better(proposal->objective, other, rival_of(proposal));
}
