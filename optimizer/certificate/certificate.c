#include "certificate/certificate.h"

#include "certificate/every_aim.h"
#include "certificate/exhaustive_bound.h"
#include "certificate/front_bounds.h"
#include "certificate/least_water.h"

#include <assert.h>
#include <math.h>

#define ROUNDS_EXPLORING 4   /* of looking at some of the poses first */
#define EXPLORING_MOST 0.2   /* of the time left, for those */
#define ROUNDS_FIRST 2       /* of pricing all poses, at the proposal's water */
#define ROUNDS_WATER 1       /* at a water that may be too little for the proposal's coverage */
#define TRIALS_WATER 2       /* such waters */
#define WORK_LEAST 3e9       /* at the front's points, in words of sp_tuples */
#define WORK_EACH 2.4e4      /* the same, besides, for every candidate */
#define WORK_POINT_LEAST 3e8 /* that a point may take at first */
#define WORK_POINT 2e3       /* the same, besides, for every candidate */
#define CANDIDATES 12800     /* most that come into question for it */
/* with --prove: */
#define ROUNDS_PROVING 2 /* at the proposal's water, and trials of water */
#define ROUNDS_WATER_PROVING 1
#define ITERATIONS_PROVING 500
#define TOLERANCE_PROVING 2e-5
#define WORK_PROVING 2e12 /* of a pass over the front, or of raising the least water, where no time limit ends it */
#define PASSES_PROVING 2
#define WORK_MORE 8              /* times as much for a point as in the pass before */
#define ROUNDS_POINT 3           /* for a point */
#define CANDIDATES_PROVING 51200 /* most that come into question for it */
#define LESS 1e-9                /* of an area, that is as much */

/* What a point may take at first. */
static double work_at_point(const sp_certifying *c)
{
    return WORK_POINT_LEAST + WORK_POINT * (double)c->problem.list.count;
}

/* The bounds at the proposal once more, more carefully, then the front's. */
static bool prove(sp_certifying *c, size_t water, double area, sp_error *error)
{
    size_t iterations = c->bound.iterations;
    double tolerance = c->bound.tolerance;
    c->bound.iterations = ITERATIONS_PROVING;
    c->bound.tolerance = TOLERANCE_PROVING;
    bool done = sp_lower_bound_in_time(c, water, ROUNDS_PROVING, 0.5, error) &&
                sp_lower_water(c, area, water, ROUNDS_PROVING, ROUNDS_WATER_PROVING, error);
    c->bound.iterations = iterations;
    c->bound.tolerance = tolerance;
    sp_effort most = {WORK_PROVING, WORK_MORE * work_at_point(c), ROUNDS_POINT, CANDIDATES_PROVING};
    for (int pass = 0; done && pass < PASSES_PROVING; pass++, most.each *= WORK_MORE)
        done = sp_lower_front(c, most, error) && sp_raise_water(c, area, water, most, error);
    return done;
}

/* What one nozzle covers at most, and prices of their own could not lower. */
static bool lower_single(sp_certifying *c, sp_error *error)
{
    size_t lightest = c->bound.lightest;
    return sp_bound_lower_single(&c->bound, error) &&
           (lightest > c->problem.cover.water ||
            sp_proved_waters_note(&c->proved_waters, (double)lightest, c->bound.by_water[lightest]) ||
            sp_fail_memory(error));
}

/* What is proved without being asked for more: the proposal's water, one nozzle's, less water, then the front. */
static bool lower_all(sp_certifying *c, size_t water, double area, sp_error *error)
{
    double left = sp_deadline_left(c->deadline), candidates = (double)c->problem.list.count;
    const sp_effort most = {WORK_LEAST + WORK_EACH * candidates, work_at_point(c), 1, CANDIDATES};
    for (size_t round = 0; round < ROUNDS_EXPLORING && sp_certifying_has_time(c, 0.02 * (double)round); round++)
        if (sp_deadline_left(c->deadline) < left * (1 - EXPLORING_MOST))
            break;
        else if (!sp_bound_explore(&c->bound, water, error))
            return false;
    return sp_lower_bound_in_time(c, water, 1, 0.1, error) && lower_single(c, error) &&
           sp_lower_bound_in_time(c, water, ROUNDS_FIRST - 1, 0.1, error) &&
           sp_lower_water(c, area, water, TRIALS_WATER, ROUNDS_WATER, error) && sp_lower_front(c, most, error) &&
           sp_lower_gaps(c, error);
}

/* Notes the bounds of the candidates. The whole is what a coverage is a share of: by the areas that the search holds in
 * single precision it comes out up to 2^-24 larger, and bounds as shares of that would lie below the coverages that
 * they bound. What is counted is added up as the whole is, and so is no more than that to the last bit. */
static void conclude(const sp_certifying *c, sp_front *front, sp_certificate *certificate)
{
    double whole = c->problem.search->all, counted = sp_partial_counted(c->problem.search, &front->best);
    for (size_t i = 0; i < front->by_water.count; i++) {
        sp_front_point *point = &front->by_water.entries[i].point;
        point->counted = sp_partial_counted(c->problem.search, &front->by_water.entries[i].partial);
        point->bound = fmin(whole, c->bound.by_water[sp_problem_budget(&c->problem, point->outlay)]);
        assert(point->counted <= point->bound * (1 + LESS));
    }
    size_t water = sp_bound_water(&c->bound, counted);
    certificate->computed = true;
    certificate->texels = c->problem.search->patch_count;
    certificate->candidates = sp_problem_poses(&c->problem);
    certificate->own = c->problem.own;
    certificate->whole = whole;
    certificate->counted = counted;
    certificate->area_bound = fmin(whole, c->bound.by_water[sp_problem_budget(&c->problem, front->best.outlay)]);
    certificate->water_bound =
        fmin(front->best.outlay, c->problem.search->kept_flow + sp_water_least(&c->problem.units, water));
    assert(counted <= certificate->area_bound * (1 + LESS) && certificate->water_bound >= 0);
    certificate->gap = certificate->area_bound > 0 ? (certificate->area_bound - counted) / certificate->area_bound : 0;
}

/* All bounds, as far as time allows; nothing is noted where it did not allow the first. Goes on proving after what is
 * bounded whichever way nozzles are aimed, which a proof that is not closed in time would leave none for. */
static bool certify(sp_certifying *c, sp_front *front, sp_certificate *certificate, sp_error *error)
{
    size_t water = sp_problem_budget(&c->problem, front->best.outlay);
    double area = sp_partial_counted(c->problem.search, &front->best);
    bool known;
    if (!sp_exhaustive_bound(c, &known, error) || (!known && !lower_all(c, water, area, error)))
        return false;
    certificate->every_layout = known;
    if (!c->bound.proofs)
        return true;
    conclude(c, front, certificate);
    const sp_aim_task task = {c->problem.search, c->deadline,      &c->problem.cover,
                              &c->problem.units, c->problem.need,  c->problem.ports,
                              &c->bound.rows,    c->problem.costs, c->problem.cost_count};
    /* film has no discs of aims: what runs down depends on all that hits above; and footprints are of single poses */
    bool aims = !c->problem.search->runoffs && !c->problem.search->footprints;
    if (aims && !sp_every_aim(&task, front, certificate, error))
        return false;
    if (known || !c->problem.search->options->prove)
        return true;
    bool done = prove(c, water, area, error);
    conclude(c, front, certificate);
    return done;
}

bool sp_certify(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_certificate *certificate,
                sp_error *error)
{
    sp_certifying c = {.deadline = deadline};
    bool possible;
    *certificate = (sp_certificate){0};
    for (size_t i = 0; i < front->by_water.count; i++)
        front->by_water.entries[i].point.counted = front->by_water.entries[i].point.bound =
            front->by_water.entries[i].point.every_aim_bound = NAN;
    if (deadline->cancelled)
        sp_deadline_cut(deadline, "certificate");
    if (deadline->cancelled || !front->found)
        return true;
    bool done = sp_problem_create(search, front, &c.problem, &possible, error) &&
                (!possible || (sp_certifying_prepare(&c, error) && certify(&c, front, certificate, error)));
    sp_certifying_free(&c);
    return done;
}
