#include "certificate/bound_at_water.h"

#include "bound/tuples.h"
#include "certificate/best_poses.h"

#include <math.h>
#include <stdlib.h>

#define WORK_BEGIN 3e3        /* that a solve and a pricing of all take, for every candidate */
#define WORK_LOOK 4e2         /* that it takes to find the candidates of a point, the same */
#define WORK_STEP 5           /* times what a target took the next one is likely to take */
#define CANDIDATES_FIRST 800  /* that layouts are made of one by one, at first */
#define CANDIDATES_STEP 4     /* times as many then */
#define ROUNDS_STRENGTHENED 3 /* at least, so that the inequalities have settled */
#define OPEN_WIDE 0.04        /* gap of a point, above which groups of texels see enough of it */
#define ITERATIONS_COARSE 400 /* on these */
#define ITERATIONS_FINE 50    /* after them */

void sp_certifying_free(sp_certifying *c)
{
    free(c->points);
    sp_proved_waters_free(&c->proved_waters);
    sp_bound_free(&c->bound);
    sp_problem_free(&c->problem);
}

static bool goes_on(void *user)
{
    const sp_certifying *c = user;
    bool on = sp_deadline_has_time(c->deadline, "certificate", c->done);
    if (!on)
        sp_deadline_cut(c->deadline, "certificate");
    return on;
}

/* The most that a layout found with so much water covers, as counted here. */
static double found_within(const sp_certifying *c, size_t water)
{
    double most = c->problem.cover.base;
    for (size_t i = 0; i <= c->problem.front->by_water.count; i++)
        if (sp_problem_budget(&c->problem, sp_front_partial(c->problem.front, i)->outlay) <= water)
            most = fmax(most, sp_partial_counted(c->problem.search, sp_front_partial(c->problem.front, i)));
    return most;
}

bool sp_certifying_prepare(sp_certifying *c, sp_error *error)
{
    sp_problem *problem = &c->problem;
    problem->cover.goes_on = goes_on;
    problem->cover.user = c;
    c->point_count = problem->front->by_water.count + 1;
    c->points = calloc(c->point_count, sizeof *c->points);
    if (!c->points || !sp_proved_waters_note(&c->proved_waters, 0, problem->cover.base))
        return sp_fail_memory(error);
    for (size_t i = 0; i < c->point_count; i++) {
        c->points[i].water = sp_problem_budget(problem, sp_front_partial(problem->front, i)->outlay);
        c->points[i].found = found_within(c, c->points[i].water);
    }
    return sp_bound_create(&problem->cover, &problem->pricer, &c->bound, error) &&
           sp_rows_append(&c->bound.rows, &problem->nozzles, error);
}

bool sp_certifying_has_time(sp_certifying *c, double done)
{
    c->done = done;
    return goes_on(c);
}

double sp_pricing_work(const sp_certifying *c, size_t rounds)
{
    return WORK_BEGIN * (double)(rounds * c->problem.list.count);
}

bool sp_lower_bound(sp_certifying *c, size_t water, size_t rounds, sp_error *error)
{
    for (size_t round = 0; round < rounds && goes_on(c); round++) {
        if (!sp_bound_lower(&c->bound, water, error))
            return false;
        if (c->bound.complete && !sp_proved_waters_note(&c->proved_waters, (double)water, c->bound.proved))
            return sp_fail_memory(error);
        if (c->bound.closed && round >= ROUNDS_STRENGTHENED)
            break;
    }
    return true;
}

bool sp_lower_bound_in_time(sp_certifying *c, size_t water, size_t rounds, double done, sp_error *error)
{
    return !sp_certifying_has_time(c, done) || sp_lower_bound(c, water, rounds, error);
}

bool sp_lower_open_bound(sp_certifying *c, size_t water, double open, size_t rounds, sp_error *error)
{
    size_t iterations = c->bound.iterations;
    if (open > OPEN_WIDE) {
        c->bound.coarse = ITERATIONS_COARSE;
        c->bound.iterations = ITERATIONS_FINE;
    }
    bool done = sp_lower_bound(c, water, rounds, error);
    c->bound.coarse = 0;
    c->bound.iterations = iterations;
    return done;
}

/* Lowers all bounds up to so much water. */
static void note_bound(sp_certifying *c, size_t water, double bound)
{
    for (size_t w = 0; w <= water; w++)
        c->bound.by_water[w] = fmin(c->bound.by_water[w], bound);
    sp_bound_settle(&c->bound);
}

bool sp_look_at_layouts(sp_certifying *c, size_t water, double found, double least, sp_effort most, double *work,
                        sp_error *error)
{
    const double *bound = &c->bound.by_water[water];
    const sp_tuple_task task = {
        water, found, *bound, most.candidates, &c->bound.dual.multipliers, sp_pose_pricing_last(c->problem.pricing)};
    sp_tuple_answer answer = {.complete = true, .bound = *bound};
    sp_tuples *tuples = sp_tuples_create(&c->problem.cover, &c->problem.list, &task, error);
    bool done = tuples != NULL, better = false;
    *work += WORK_LOOK * (double)c->problem.list.count;
    for (size_t count = CANDIDATES_FIRST; done && answer.complete && !better && *bound > found * (1 + least) &&
                                          count <= most.candidates && most.each > WORK_STEP * answer.work && goes_on(c);
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
