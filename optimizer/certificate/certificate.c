#include "certificate/certificate.h"

#include "bound/tuples.h"
#include "certificate/aim_bound.h"
#include "certificate/pose_pricer.h"
#include "certificate/problem.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#define ROUNDS_EXPLORING 4    /* of looking at some of the poses first */
#define EXPLORING_MOST 0.2    /* of the time left, for those */
#define ROUNDS_FIRST 2        /* of pricing all poses, at the proposal's water */
#define ROUNDS_WATER 1        /* at a water that may be too little for the proposal's coverage */
#define TRIALS_WATER 2        /* such waters */
#define STEP_WATER 0.4        /* of the way to the proposal's water, for the first of them */
#define WORK_LEAST 3e9        /* at the front's points, in words of sp_tuples */
#define WORK_EACH 1.5e4       /* the same, besides, for every candidate */
#define WORK_BEGIN 3e3        /* that a solve and a pricing of all take, for every candidate */
#define WORK_LOOK 4e2         /* that it takes to find the candidates of a point, the same */
#define WORK_POINT_LEAST 3e8  /* that a point may take at first */
#define WORK_POINT 2e3        /* the same, besides, for every candidate */
#define WORK_STEP 5           /* times what a target took the next one is likely to take */
#define CANDIDATES_FIRST 800  /* that layouts are made of one by one, at first */
#define CANDIDATES_STEP 4     /* times as many then */
#define CANDIDATES 12800      /* most that come into question for it */
#define WATER_NEAR 1.25       /* times less water is so near that the same multipliers say something */
#define WATER_LIKE 1.1        /* the same, and need not be priced for again */
#define ROUNDS_STRENGTHENED 3 /* at least, so that the inequalities have settled */
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
#define STEP_RAISED 0.1 /* of the way to the proposal's water, that the least is sought to be raised by at first */
#define STEP_LEAST 0.02 /* and at last */
#define LESS 1e-9       /* of an area, that is as much */
/* of all: */
#define OPEN_WIDE 0.04        /* gap of a point, above which groups of texels see enough of it */
#define ITERATIONS_COARSE 400 /* on these */
#define ITERATIONS_FINE 50    /* after them */
#define OPEN_LEAST 1e-3       /* gap of a point of the front that is worth a turn */

/* A layout of the front, or the proposal. */
typedef struct {
    size_t water;  /* units that it may take */
    double found;  /* m² that a layout found with no more water covers */
    bool had_turn; /* in this pass */
} point;

/* What may be done, in words of sp_tuples: in all, and one by one at a point; and for it pricings of all, and
 * candidates that its layouts are made of. */
typedef struct {
    double work, each;
    size_t rounds, candidates;
} effort;

typedef struct {
    sp_problem problem;
    sp_deadline *deadline;
    sp_bound bound;
    size_t point_count;
    point *points;
    double done; /* how far it all is, 0 to 1 */
} certifying;

static void certifying_free(certifying *c)
{
    free(c->points);
    sp_bound_free(&c->bound);
    sp_problem_free(&c->problem);
}

/* False once cancelled or out of time, which leaves the proposal as good as it is. */
static bool goes_on(void *user)
{
    const certifying *c = user;
    bool on = sp_deadline_has_time(c->deadline, "certificate", c->done);
    if (!on)
        sp_deadline_cut(c->deadline, "certificate");
    return on;
}

/* The most that a layout found with so much water covers, as counted here. */
static double found_within(const certifying *c, size_t water)
{
    double most = c->problem.cover.base;
    for (size_t i = 0; i <= c->problem.front->by_water.count; i++)
        if (sp_problem_budget(&c->problem, sp_front_partial(c->problem.front, i)->outlay) <= water)
            most = fmax(most, sp_partial_counted(c->problem.search, sp_front_partial(c->problem.front, i)));
    return most;
}

static bool prepare(certifying *c, sp_error *error)
{
    sp_problem *problem = &c->problem;
    problem->cover.goes_on = goes_on;
    problem->cover.user = c;
    c->point_count = problem->front->by_water.count + 1;
    c->points = calloc(c->point_count, sizeof *c->points);
    if (!c->points)
        return sp_fail_memory(error);
    for (size_t i = 0; i < c->point_count; i++) {
        c->points[i].water = sp_problem_budget(problem, sp_front_partial(problem->front, i)->outlay);
        c->points[i].found = found_within(c, c->points[i].water);
    }
    return sp_bound_create(&problem->cover, &problem->pricer, &c->bound, error) &&
           sp_rows_append(&c->bound.rows, &problem->nozzles, error);
}

static bool has_time(certifying *c, double done)
{
    c->done = done;
    return goes_on(c);
}

/* Lowers the bound at this water. `done`: how far the certificate is. */
static bool lower(certifying *c, size_t water, size_t rounds, double done, sp_error *error)
{
    for (size_t round = 0; round < rounds && has_time(c, done); round++) {
        if (!sp_bound_lower(&c->bound, water, error))
            return false;
        if (c->bound.closed && round >= ROUNDS_STRENGTHENED)
            break;
    }
    return true;
}

/* The least water for what the proposal covers. Bounds are lowered between where they first allow it and the proposal,
 * at `most`, the nearer to the former the more trials have yielded nothing. */
static bool lower_water(certifying *c, double area, size_t most, size_t trials, size_t rounds, sp_error *error)
{
    double step = STEP_WATER;
    for (size_t trial = 0; trial < trials; trial++) {
        size_t water = sp_bound_water(&c->bound, area);
        if (!water || water >= most)
            return true;
        if (!lower(c, water + (size_t)(step * (double)(most - water)), rounds,
                   0.3 + 0.3 * (double)trial / (double)trials, error))
            return false;
        if (sp_bound_water(&c->bound, area) == water)
            step *= 0.5;
    }
    return true;
}

/* What of the bound at a point nothing found comes up to. */
static double open_at(const certifying *c, size_t i)
{
    return fmax(0, 1 - c->points[i].found / c->bound.by_water[c->points[i].water]);
}

/* True of a point of as much water as another, or so little less that multipliers for that one do. */
static bool is_like(const certifying *c, size_t i, size_t other, double times)
{
    double water = (double)c->points[i].water, most = (double)c->points[other].water;
    return water <= most && most < times * water;
}

/* The point whose like, it among them, have most open together, for their water squared, that had no turn: the fewer
 * nozzles, the more a turn says. point_count where none has any. */
static size_t next_point(const certifying *c)
{
    size_t found = c->point_count;
    double most = 0;
    for (size_t i = 0; i < c->point_count; i++) {
        double open = 0;
        if (!c->points[i].water || c->points[i].had_turn || open_at(c, i) <= OPEN_LEAST)
            continue;
        for (size_t k = 0; k < c->point_count; k++)
            if (is_like(c, k, i, WATER_NEAR) && !c->points[k].had_turn && open_at(c, k) > OPEN_LEAST)
                open += open_at(c, k) / pow((double)c->points[k].water, 2);
        if (open > most) {
            found = i;
            most = open;
        }
    }
    return found;
}

/* Prices all candidates for so much water, `open` of whose bound nothing found comes up to. Where that is wide
 * multipliers are sought on groups of texels first: these get further in as much time, but do not see what a narrow gap
 * is about. */
static bool price_for(certifying *c, size_t water, double open, size_t rounds, sp_error *error)
{
    size_t iterations = c->bound.iterations;
    bool done = true;
    if (open > OPEN_WIDE) {
        c->bound.coarse = ITERATIONS_COARSE;
        c->bound.iterations = ITERATIONS_FINE;
    }
    for (size_t round = 0; done && round < rounds && has_time(c, c->done); round++)
        done = sp_bound_lower(&c->bound, water, error);
    c->bound.coarse = 0;
    c->bound.iterations = iterations;
    return done;
}

/* Lowers all bounds up to so much water. */
static void note_bound(certifying *c, size_t water, double bound)
{
    for (size_t w = 0; w <= water; w++)
        c->bound.by_water[w] = fmin(c->bound.by_water[w], bound);
    sp_bound_settle(&c->bound);
}

/* Looks at the layouts of so much water one by one, by the multipliers that the bound was last proved with, for those
 * that cover more than `found`, as long as the bound is more than `least` (share) above it: for the lowest targets that
 * a few candidates come up to, then more, while there is work left. */
static bool look_at(certifying *c, size_t water, double found, double least, effort most, double *work, sp_error *error)
{
    const double *bound = &c->bound.by_water[water];
    const sp_tuple_task task = {
        water, found, *bound, most.candidates, &c->bound.dual.multipliers, sp_pose_pricing_last(c->problem.pricing)};
    sp_tuple_answer answer = {.complete = true, .bound = *bound};
    sp_tuples *tuples = sp_tuples_create(&c->problem.cover, &c->problem.list, &task, error);
    bool done = tuples != NULL, better = false;
    *work += WORK_LOOK * (double)c->problem.list.count;
    for (size_t count = CANDIDATES_FIRST;
         done && answer.complete && !better && *bound > found * (1 + least) && count <= most.candidates &&
         most.each > WORK_STEP * answer.work && has_time(c, c->done);
         count *= CANDIDATES_STEP) {
        double target = sp_tuples_target(tuples, count);
        answer.work = 0;
        if (!(target < *bound))
            continue;
        done = sp_tuples_bound(tuples, target, most.each, &answer, error);
        *work += answer.work;
        most.each -= answer.work;
        if (done && answer.complete)
            note_bound(c, water, answer.bound);
        /* one that was found is the best there is, or one covers more than what was found */
        better = answer.bound > target || target <= found;
    }
    sp_tuples_destroy(tuples);
    return done;
}

/* A turn of a point and of those that are like it. */
static bool take_turn(certifying *c, size_t i, effort most, double *work, sp_error *error)
{
    const point *own = &c->points[i];
    *work += WORK_BEGIN * (double)(most.rounds * c->problem.list.count);
    if (!price_for(c, own->water, open_at(c, i), most.rounds, error))
        return false;
    for (size_t k = 0; k < c->point_count && c->bound.complete; k++) {
        point *like = &c->points[k];
        if (!like->water || like->had_turn || !is_like(c, k, i, WATER_NEAR))
            continue;
        like->had_turn = is_like(c, k, i, WATER_LIKE);
        if (open_at(c, k) > OPEN_LEAST && !look_at(c, like->water, like->found, OPEN_LEAST, most, work, error))
            return false;
    }
    c->points[i].had_turn = true;
    return true;
}

/* The points of the front in turn. */
static bool lower_front(certifying *c, effort most, sp_error *error)
{
    double work = 0;
    for (size_t i = 0; i < c->point_count; i++)
        c->points[i].had_turn = false;
    for (size_t i; (i = next_point(c)) < c->point_count && work < most.work;)
        if (!has_time(c, 0.6 + 0.4 * fmin(1, work / most.work)))
            return true;
        else if (!take_turn(c, i, most, &work, error))
            return false;
    return true;
}

/* Raises the water below which nothing covers what the proposal does, step by step. */
static bool raise_water(certifying *c, double area, size_t most, effort effort, sp_error *error)
{
    double work = 0, step = STEP_RAISED;
    for (size_t water; step > STEP_LEAST && work < effort.work && has_time(c, c->done);) {
        water = sp_bound_water(&c->bound, area);
        if (!water || water >= most)
            return true;
        size_t higher = water + (size_t)ceil(step * (double)(most - water));
        work += WORK_BEGIN * (double)(effort.rounds * c->problem.list.count);
        if (!price_for(c, higher, 0, effort.rounds, error) ||
            (c->bound.complete && c->bound.by_water[higher] >= area &&
             !look_at(c, higher, area * (1 - LESS), 0, effort, &work, error)))
            return false;
        step *= sp_bound_water(&c->bound, area) > higher ? 1 : 0.5;
    }
    return true;
}

/* What a point may take at first. */
static double work_at_point(const certifying *c)
{
    return WORK_POINT_LEAST + WORK_POINT * (double)c->problem.list.count;
}

/* The bounds at the proposal once more, more carefully, then the front's. */
static bool prove(certifying *c, size_t water, double area, sp_error *error)
{
    size_t iterations = c->bound.iterations;
    double tolerance = c->bound.tolerance;
    c->bound.iterations = ITERATIONS_PROVING;
    c->bound.tolerance = TOLERANCE_PROVING;
    bool done = lower(c, water, ROUNDS_PROVING, 0.5, error) &&
                lower_water(c, area, water, ROUNDS_PROVING, ROUNDS_WATER_PROVING, error);
    c->bound.iterations = iterations;
    c->bound.tolerance = tolerance;
    effort most = {WORK_PROVING, WORK_MORE * work_at_point(c), ROUNDS_POINT, CANDIDATES_PROVING};
    for (int pass = 0; done && pass < PASSES_PROVING; pass++, most.each *= WORK_MORE)
        done = lower_front(c, most, error) && raise_water(c, area, water, most, error);
    return done;
}

/* What is proved without being asked for more: the proposal's water, one nozzle's, less water, then the front. */
static bool lower_all(certifying *c, size_t water, double area, sp_error *error)
{
    double left = sp_deadline_left(c->deadline), candidates = (double)c->problem.list.count;
    const effort most = {WORK_LEAST + WORK_EACH * candidates, work_at_point(c), 1, CANDIDATES};
    for (size_t round = 0; round < ROUNDS_EXPLORING && has_time(c, 0.02 * (double)round); round++)
        if (sp_deadline_left(c->deadline) < left * (1 - EXPLORING_MOST))
            break;
        else if (!sp_bound_explore(&c->bound, water, error))
            return false;
    return sp_bound_lower(&c->bound, water, error) && sp_bound_lower_single(&c->bound, error) &&
           lower(c, water, ROUNDS_FIRST - 1, 0.1, error) &&
           lower_water(c, area, water, TRIALS_WATER, ROUNDS_WATER, error) && lower_front(c, most, error);
}

/* Notes the bounds of the candidates. */
static void conclude(const certifying *c, sp_front *front, sp_certificate *certificate)
{
    double whole = 0, counted = sp_partial_counted(c->problem.search, &front->best);
    /* added up as what is counted is: all of it is no more than the whole, to the last bit */
    for (size_t p = 0; p < c->problem.search->patch_count; p++)
        whole += (double)c->problem.search->area[p];
    whole *= c->problem.search->all;
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
static bool certify(certifying *c, sp_front *front, sp_certificate *certificate, sp_error *error)
{
    size_t water = sp_problem_budget(&c->problem, front->best.outlay);
    double area = sp_partial_counted(c->problem.search, &front->best);
    if (!lower_all(c, water, area, error))
        return false;
    if (!c->bound.proofs)
        return true;
    conclude(c, front, certificate);
    const sp_aim_task task = {c->problem.search, c->deadline,      &c->problem.cover,
                              &c->problem.units, c->problem.need,  c->problem.ports,
                              &c->bound.rows,    c->problem.costs, c->problem.cost_count};
    /* film has no discs of aims: what runs down depends on all that hits above; and footprints are of single poses */
    bool aims = !c->problem.search->runoffs && !c->problem.search->footprints;
    if (aims && !sp_aim_bound(&task, front, certificate, error))
        return false;
    if (!c->problem.search->options->prove)
        return true;
    bool done = prove(c, water, area, error);
    conclude(c, front, certificate);
    return done;
}

bool sp_certify(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_certificate *certificate,
                sp_error *error)
{
    certifying c = {.deadline = deadline};
    bool possible;
    *certificate = (sp_certificate){0};
    for (size_t i = 0; i < front->by_water.count; i++)
        front->by_water.entries[i].point.counted = front->by_water.entries[i].point.bound =
            front->by_water.entries[i].point.every_aim_bound = NAN;
    if (deadline->cancelled || !front->found)
        return true;
    bool done = sp_problem_create(search, front, &c.problem, &possible, error) &&
                (!possible || (prepare(&c, error) && certify(&c, front, certificate, error)));
    certifying_free(&c);
    return done;
}
