#include "certificate/certificate.h"

#include "bound/branch.h"
#include "certificate/aim_bound.h"
#include "certificate/problem.h"

#include <math.h>
#include <stdlib.h>

#define ROUNDS_EXPLORING 4 /* of looking at some of the poses first */
#define EXPLORING_MOST 0.2 /* of the time left, for those */
#define ROUNDS_FIRST 2     /* of pricing all poses, at the proposal's water */
#define ROUNDS_WATER 1     /* at a water that may be too little for the proposal's coverage */
#define TRIALS_WATER 2     /* such waters */
#define STEP_WATER 0.4     /* of the way to the proposal's water, for the first of them */
#define WORK_LEAST 3e5     /* of branch and bound at the front's points, see sp_tree */
#define WORK_EACH 6        /* the same, besides, in pricings of all candidates */
#define WORK_PROVING 1e10  /* with --prove, where no time limit ends it */
#define WATER_LIKE 1.7     /* times more or less water still counts as about as much */
#define WATER_SAME 1.1     /* the same, and need not be priced for again */
#define WATER_NEAR 1.2     /* the same, of prices that are good for both */
#define WORK_FIRST 1.5     /* of a point, in pricings of all candidates */
#define ALIVE_FEW 0.5      /* of all candidates: fewer are alive than it takes to price all again */
#define WORK_PAST 1.0      /* what a point has taken counts so much, beside what its next step takes */
#define ROUNDS_LIFTED 3    /* at least, so that the lifts have settled */
#define ROUNDS_PROVING 2   /* with --prove, at the proposal's water, and trials of water */
#define ROUNDS_WATER_PROVING 1
#define ITERATIONS_PROVING 500
#define TOLERANCE_PROVING 2e-5
#define OPEN_WIDE 0.04        /* gap of a point, above which groups of texels see enough of it */
#define ITERATIONS_COARSE 400 /* on these */
#define ITERATIONS_FINE 50    /* after them */
#define OPEN_LEAST 1e-3       /* gap of a point of the front that is worth a turn */

typedef struct {
    sp_problem problem;
    sp_watch *watch;
    sp_bound bound;
    sp_branching branching;
    sp_tree *trees; /* [front->by_water.count + 1], by points, then the proposal's; empty where it takes no water */
    bool *begun;    /* the same, whether all candidates were priced for it */
    double *found;  /* the same, m² that a layout found with no more water covers */
    double done;    /* how far it all is, 0 to 1 */
} certifying;

static void certifying_free(certifying *c)
{
    for (size_t i = 0; c->trees && i <= c->problem.front->by_water.count; i++)
        sp_tree_free(&c->trees[i]);
    free(c->trees);
    free(c->found);
    free(c->begun);
    sp_branching_free(&c->branching);
    sp_bound_free(&c->bound);
    sp_problem_free(&c->problem);
}

/* False once cancelled or out of time, which leaves the proposal as good as it is. */
static bool goes_on(void *user)
{
    const certifying *c = user;
    return sp_watch_has_time(c->watch, "certificate", c->done);
}

/* The most that a layout found with so much water covers, as counted here. */
static double found_within(const certifying *c, size_t water)
{
    double most = c->problem.cover.base;
    for (size_t i = 0; i <= c->problem.front->by_water.count; i++)
        if (sp_problem_budget(&c->problem, sp_front_draft(c->problem.front, i)->outlay) <= water)
            most = fmax(most, sp_draft_counted(c->problem.search, sp_front_draft(c->problem.front, i)));
    return most;
}

/* One for every point of the front and the proposal, where water for a nozzle is. */
static bool plant_trees(certifying *c, sp_error *error)
{
    for (size_t i = 0; i <= c->problem.front->by_water.count; i++) {
        size_t water = sp_problem_budget(&c->problem, sp_front_draft(c->problem.front, i)->outlay);
        c->found[i] = found_within(c, water);
        if (water && !sp_tree_create(&c->branching, water, c->bound.by_water[water], c->found[i], &c->trees[i], error))
            return false;
    }
    return true;
}

static bool prepare(certifying *c, sp_error *error)
{
    sp_problem *problem = &c->problem;
    size_t count = problem->front->by_water.count + 1;
    problem->cover.goes_on = goes_on;
    problem->cover.user = c;
    c->trees = calloc(count, sizeof *c->trees);
    c->found = malloc(count * sizeof *c->found);
    c->begun = calloc(count, sizeof *c->begun);
    if (!c->trees || !c->found || !c->begun)
        return sp_fail_memory(error);
    return sp_bound_create(&problem->cover, &problem->pricer, &c->bound, error) &&
           sp_rows_append(&c->bound.rows, &problem->nozzles, error) &&
           sp_branching_create(&problem->cover, &problem->line, &c->branching, error) && plant_trees(c, error);
}

static bool has_time(certifying *c, double done)
{
    c->done = done;
    return goes_on(c);
}

/* Tells the trees of the prices that the bound was last proved with, those of about as much water: to others they say
 * little. */
static bool tell_trees(certifying *c, size_t water, sp_error *error)
{
    for (size_t i = 0; i <= c->problem.front->by_water.count && c->bound.complete; i++)
        if ((double)c->trees[i].water * WATER_LIKE > (double)water &&
            (double)c->trees[i].water < WATER_LIKE * (double)water &&
            !sp_tree_hear(&c->branching, &c->trees[i], &c->bound.dual.price, sp_pose_prices_last(c->problem.prices),
                          error))
            return false;
    return true;
}

/* Lowers the bound at this water. `done`: how far the certificate is. */
static bool lower(certifying *c, size_t water, size_t rounds, double done, sp_error *error)
{
    for (size_t round = 0; round < rounds && has_time(c, done); round++) {
        if (!sp_bound_lower(&c->bound, water, error) || !tell_trees(c, water, error))
            return false;
        if (c->bound.closed && round >= ROUNDS_LIFTED)
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

/* A point whose tree has not yet heard of prices that leave little alive is best begun with a pricing of all. */
static bool begins_anew(const certifying *c, size_t i)
{
    const sp_tree *tree = &c->trees[i];
    return !c->begun[i] && !(tree->next_work > 0 && tree->next_work < ALIVE_FEW * (double)c->problem.line.count);
}

/* What of the bound at a point nothing found comes up to. */
static double open_at(const certifying *c, size_t i)
{
    return fmax(0,
                1 - c->found[i] /
                        c->bound.by_water[sp_problem_budget(&c->problem, sp_front_draft(c->problem.front, i)->outlay)]);
}

/* The same of all points of about as much water, which prices for one of them are good for. */
static double open_about(const certifying *c, size_t i)
{
    double open = 0, water = (double)c->trees[i].water;
    for (size_t k = 0; k <= c->problem.front->by_water.count; k++) {
        double other = (double)c->trees[k].water;
        open += other < WATER_NEAR * water && water < WATER_NEAR * other ? open_at(c, k) : 0;
    }
    return open;
}

/* Of the front's points and the proposal the one whose turn it is: the wider its gap and the less work
 * it takes and took, the sooner; front->by_water.count + 1 where none is left open. */
static size_t next_point(const certifying *c)
{
    size_t found = c->problem.front->by_water.count + 1;
    double most = 0;
    for (size_t i = 0; i <= c->problem.front->by_water.count; i++) {
        const sp_tree *tree = &c->trees[i];
        double open = open_at(c, i), score;
        if (begins_anew(c, i))
            score = open_about(c, i) / (WORK_FIRST * (double)c->problem.line.count + WORK_PAST * tree->work);
        else
            score = open / (tree->next_work + WORK_PAST * tree->work);
        if (!sp_tree_closed(tree) && open > OPEN_LEAST && score > most) {
            found = i;
            most = score;
        }
    }
    return found;
}

/* Prices all candidates, which all trees hear of. Where the gap is wide prices are sought on groups of texels first:
 * these get further in as much time, but do not see what a narrow gap is about. */
static bool begin_tree(certifying *c, size_t i, sp_error *error)
{
    size_t water = sp_problem_budget(&c->problem, sp_front_draft(c->problem.front, i)->outlay),
           iterations = c->bound.iterations;
    for (size_t k = 0; k <= c->problem.front->by_water.count; k++) {
        double other = (double)c->trees[k].water;
        c->begun[k] |= other < WATER_SAME * (double)water && (double)water < WATER_SAME * other;
    }
    c->trees[i].work += WORK_FIRST * (double)c->problem.line.count;
    if (open_at(c, i) > OPEN_WIDE) {
        c->bound.coarse = ITERATIONS_COARSE;
        c->bound.iterations = ITERATIONS_FINE;
    }
    bool done = sp_bound_lower(&c->bound, water, error);
    c->bound.coarse = 0;
    c->bound.iterations = iterations;
    return done && tell_trees(c, water, error) && sp_branching_take(&c->branching, &c->bound.rows, error);
}

/* A turn at a point: after the first each is a step of its tree, which lowers all bounds up to its water. */
static bool grow_tree(certifying *c, size_t i, sp_error *error)
{
    sp_tree *tree = &c->trees[i];
    if (begins_anew(c, i))
        return begin_tree(c, i, error);
    if (!sp_tree_step(&c->branching, tree, error))
        return false;
    double bound = sp_tree_bound(tree);
    for (size_t w = 0; w <= tree->water; w++)
        c->bound.by_water[w] = fmin(c->bound.by_water[w], bound);
    sp_bound_settle(&c->bound);
    return true;
}

/* Branch and bound at the points of the front in turn. */
static bool lower_front(certifying *c, double work, sp_error *error)
{
    if (!sp_branching_take(&c->branching, &c->bound.rows, error))
        return false;
    for (double done = 0; done < work;) {
        size_t i = next_point(c);
        if (i > c->problem.front->by_water.count || !has_time(c, 0.6 + 0.4 * done / work))
            break;
        double before = c->trees[i].work;
        if (!grow_tree(c, i, error))
            return false;
        done += c->trees[i].work - before;
    }
    return true;
}

/* The bounds at the proposal once more, more carefully, then branch and bound. */
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
    return done && lower_front(c, WORK_PROVING, error);
}

/* What is proved without being asked for more: the proposal's water, one nozzle's, less water, then the front. */
static bool lower_all(certifying *c, size_t water, double area, sp_error *error)
{
    double left = sp_watch_left(c->watch);
    for (size_t round = 0; round < ROUNDS_EXPLORING && has_time(c, 0.02 * (double)round); round++)
        if (sp_watch_left(c->watch) < left * (1 - EXPLORING_MOST))
            break;
        else if (!sp_bound_explore(&c->bound, water, error))
            return false;
    return sp_bound_lower(&c->bound, water, error) && tell_trees(c, water, error) &&
           sp_bound_lower_single(&c->bound, error) && tell_trees(c, c->bound.lightest, error) &&
           lower(c, water, ROUNDS_FIRST - 1, 0.1, error) &&
           lower_water(c, area, water, TRIALS_WATER, ROUNDS_WATER, error) &&
           lower_front(c, WORK_LEAST + WORK_EACH * (double)c->problem.line.count, error);
}

/* Notes the bounds of the candidates. */
static void conclude(const certifying *c, sp_front *front, sp_certificate *certificate)
{
    double whole = 0, counted = sp_draft_counted(c->problem.search, &front->best);
    /* added up as what is counted is: all of it is no more than the whole, to the last bit */
    for (size_t p = 0; p < c->problem.search->patch_count; p++)
        whole += (double)c->problem.search->area[p];
    whole *= c->problem.search->all;
    for (size_t i = 0; i < front->by_water.count; i++) {
        sp_front_point *point = &front->by_water.entries[i].point;
        point->counted = sp_draft_counted(c->problem.search, &front->by_water.entries[i].draft);
        point->bound = fmin(whole, c->bound.by_water[sp_problem_budget(&c->problem, point->outlay)]);
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
    certificate->gap = certificate->area_bound > 0 ? (certificate->area_bound - counted) / certificate->area_bound : 0;
}

/* All bounds, as far as time allows; nothing is noted where it did not allow the first. Goes on proving after what is
 * bounded whichever way nozzles are aimed, which a proof that is not closed in time would leave none for. */
static bool certify(certifying *c, sp_front *front, sp_certificate *certificate, sp_error *error)
{
    size_t water = sp_problem_budget(&c->problem, front->best.outlay);
    double area = sp_draft_counted(c->problem.search, &front->best);
    if (!lower_all(c, water, area, error))
        return false;
    if (!c->bound.proofs)
        return true;
    conclude(c, front, certificate);
    const sp_aim_task task = {c->problem.search, c->watch,         &c->problem.cover,
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

bool sp_certify(const sp_search *search, sp_watch *watch, sp_front *front, sp_certificate *certificate, sp_error *error)
{
    certifying c = {.watch = watch};
    bool possible;
    *certificate = (sp_certificate){0};
    for (size_t i = 0; i < front->by_water.count; i++)
        front->by_water.entries[i].point.counted = front->by_water.entries[i].point.bound =
            front->by_water.entries[i].point.every_aim_bound = NAN;
    if (watch->cancelled || !front->found)
        return true;
    bool done = sp_problem_create(search, front, &c.problem, &possible, error) &&
                (!possible || (prepare(&c, error) && certify(&c, front, certificate, error)));
    certifying_free(&c);
    return done;
}
