#include "certificate/exhaustive_bound.h"

#include "scoring/scoring.h"
#include "search/exhaustive.h"

#include <math.h>

#define UPWARDS (1 + 1e-11) /* more than sums of areas in another order can lie apart */

/* Whether all nozzles of the front stand as a candidate that is looked at does: refinement has moved none, nor was it
 * found by another placement alone. */
static bool holds_candidates(const sp_search *search, const sp_front *front)
{
    bool unmoved = true;
    for (size_t i = 0; i <= front->by_water.count; i++) {
        const sp_partial *partial = sp_front_partial(front, i);
        for (size_t k = 0; k < partial->count; k++) {
            const sp_placed *placed = &partial->items[k];
            unmoved = unmoved && sp_placed_is_candidate(placed) &&
                      sp_search_knows(search, placed->pose.site, placed->pose.variant);
        }
    }
    return unmoved;
}

/* What was found so far within so much water is counted in single precision, which may favour it. */
static double found_within(const sp_certifying *c, size_t water)
{
    double most = 0;
    for (size_t i = 0; i < c->point_count; i++)
        if (c->points[i].water <= water)
            most = fmax(most, c->points[i].found);
    return most;
}

static void lower_all(sp_certifying *c, const sp_exhaustive *every)
{
    double most = c->problem.cover.base;
    size_t next = 0;
    for (size_t water = 0; water <= c->problem.cover.water; water++) {
        for (; next < every->count && sp_problem_budget(&c->problem, every->records[next].outlay) <= water; next++)
            most = fmax(most, every->records[next].area);
        double bound = UPWARDS * fmax(most, found_within(c, water));
        c->bound.by_water[water] = fmin(c->bound.by_water[water], bound);
    }
    c->bound.proofs++;
}

bool sp_exhaustive_bound(sp_certifying *c, bool *known, sp_error *error)
{
    const sp_search *search = c->problem.search;
    sp_exhaustive every = {.count = 0};
    *known = false;
    if (!holds_candidates(search, c->problem.front))
        return true;
    /* bounds are of outlay: what takes more than max_water is among the bounded */
    const sp_exhaustive_limits limits = {.outlay = search->outlay_most * (1 + SP_ROUNDING), .water = INFINITY};
    bool done = sp_exhaustive_create(search, search->coarse, limits, c->deadline, "certificate", &every, error);
    *known = done && every.count && every.whole;
    if (*known)
        lower_all(c, &every);
    sp_exhaustive_free(&every);
    return done;
}
