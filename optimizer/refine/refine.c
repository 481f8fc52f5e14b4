#include "refine/refine.h"

#include "scoring/prepare.h"
#include "refine/hurry.h"
#include "refine/more_water.h"
#include "refine/other_layouts.h"
#include "refine/saving.h"

#include <stdlib.h>

#define SAVINGS 3    /* amounts of water below the best layout's for which others are looked for */
#define SAVING 0.015 /* each by so much less */
#define BETWEEN 0.05 /* less water than a layout of the front, for another */
#define APART 0.02   /* share by which waters must differ for that */
#define NEAR_MOST 5  /* layouts that all but reach the target, and are sharpened with the best */

#define SHARP_ROUNDS 3    /* of the last local search */
#define SHARP_SAVING 2e-3 /* less water, for another round */

static bool on_water_front(const sp_front *front, const sp_front_point *point)
{
    for (size_t i = 0; i < front->by_water.count; i++)
        if (front->by_water.entries[i].point.outlay == point->outlay &&
            front->by_water.entries[i].point.area == point->area)
            return true;
    return false;
}

/* Those that cover most with fewer nozzles than the best has and take more water than others that cover as much. */
static bool try_fewest(sp_refining *refining, sp_trials *trials)
{
    const sp_front *front = refining->front;
    for (size_t i = 0; i < front->by_number.count; i++) {
        const sp_front_entry *entry = &front->by_number.entries[i];
        if (entry->partial.count && entry->partial.count < front->best.count && !on_water_front(front, &entry->point) &&
            !sp_try_also(refining, trials, &entry->partial, entry->point.outlay, SP_TRIAL_BY_TURNS))
            return false;
    }
    return true;
}

/* Trials of other layouts for the water of every layout of the front, `between` also for a little less, where the front
 * has none, and for that of the scene's own layout, with which the proposal will be compared. The layouts are still to
 * be found. */
static bool ask_others(sp_refining *refining, sp_trials *trials, bool between)
{
    const sp_front *front = refining->front;
    double own = sp_own_outlay(refining->search);
    for (size_t i = 0; i < front->by_water.count; i++) {
        double outlay = front->by_water.entries[i].point.outlay, less = outlay * (1 - BETWEEN);
        if (!sp_front_counts(front, i))
            continue;
        if (between && front->by_water.entries[i].partial.count > 1 &&
            less > front->by_water.entries[i - 1].point.outlay * (1 + APART) && !sp_ask_other(refining, trials, less))
            return false;
        if (!sp_ask_other(refining, trials, outlay))
            return false;
    }
    return own <= 0 || sp_ask_other(refining, trials, own);
}

/* The same for a little less water than the best layout takes. */
static bool ask_savings(sp_refining *refining, sp_trials *trials)
{
    for (int i = 1; i <= SAVINGS; i++)
        if (!sp_ask_other(refining, trials, refining->front->best.outlay * (1 - SAVING * i)))
            return false;
    return true;
}

static bool is_better(const sp_trial *trial)
{
    return trial->other.covered > trial->partial.covered * (1 + SP_GAIN_LEAST);
}

/* Where the other layout covers no more than what a trial holds, that is tried: one of the two comes as far as both. */
static void choose_others(sp_trials *trials)
{
    for (size_t i = 0; i < trials->count; i++)
        if (trials->items[i].kind == SP_TRIAL_OTHER && !is_better(&trials->items[i]))
            trials->items[i].kind = SP_TRIAL_BY_TURNS;
}

/* Drops the trials whose other layout covers no more than what they hold, which has been tried before. */
static bool drop_others(sp_refining *refining, sp_trials *trials)
{
    bool *kept = calloc(trials->count + 1, sizeof *kept);
    if (!kept)
        return sp_fail_memory(refining->error);
    for (size_t i = 0; i < trials->count; i++)
        kept[i] = is_better(&trials->items[i]);
    sp_trials_keep(trials, kept);
    free(kept);
    return true;
}

/* Every layout of the front, or another in its place, and between. */
static bool search_front_locally(sp_refining *refining)
{
    sp_trials trials = {0};
    bool done = ask_others(refining, &trials, true) && sp_ask_more(refining, &trials) &&
                sp_find_others_and_runners_up(refining, &trials);
    if (done)
        choose_others(&trials);
    done = done && try_fewest(refining, &trials) && sp_try_turned_up(refining, &trials) &&
           sp_trials_carry_out(refining, &trials);
    sp_trials_free(&trials);
    return done;
}

/* What the layouts of the front have in common, they give to one another. */
static bool recombine_front(sp_refining *refining)
{
    sp_trials trials = {0};
    bool done = ask_others(refining, &trials, false) && ask_savings(refining, &trials) &&
                sp_ask_more(refining, &trials) && sp_find_others(refining, &trials) && drop_others(refining, &trials) &&
                sp_try_turned_up(refining, &trials) && sp_trials_carry_out(refining, &trials);
    sp_trials_free(&trials);
    return done;
}

/* The best once more, and layouts that all but reach the target with less water, on the final patches; those may take a
 * little more, if it is less than the best's. */
static bool sharpen(sp_refining *refining, bool saves, bool near)
{
    sp_front *front = refining->front;
    sp_trials trials = {0};
    if (!sp_deadline_goes_on(refining->deadline, "refine", 1))
        return true;
    bool done = sp_try_also(refining, &trials, &front->best, sp_best_budget(refining), SP_TRIAL_BY_TURNS);
    for (size_t i = 0; near && done && i < front->by_water.count && trials.count <= NEAR_MOST; i++)
        if (sp_is_near_target(front, i))
            done = sp_try_also(refining, &trials, &front->by_water.entries[i].partial, sp_near_budget(front, i),
                               SP_TRIAL_BY_TURNS);
    sp_front_point *points = NULL;
    done = done && sp_sharpen(&refining->local_search, trials.items, trials.count, refining->error) &&
           (points = sp_trials_measure_ahead(refining, &trials, false));
    for (size_t i = 0; done && i < trials.count; i++) {
        done = sp_front_note(front, refining->search, &trials.items[i].partial, &points[i], refining->error);
        if (done && saves && points[i].area >= front->target)
            done = sp_save_flow(refining, &trials.items[i].partial);
    }
    free(points);
    sp_trials_free(&trials);
    return done;
}

/* Until that saves no more water. */
static bool sharpen_often(sp_refining *refining, bool saves)
{
    double before = INFINITY;
    const sp_partial *best = &refining->front->best;
    for (int round = 0; round < SHARP_ROUNDS && best->outlay < before * (1 - SHARP_SAVING); round++) {
        before = best->outlay;
        if (!sharpen(refining, saves, saves && round == 0))
            return false;
    }
    return true;
}

static bool refine_all(sp_refining *refining)
{
    const sp_front *front = refining->front;
    if (!search_front_locally(refining))
        return false;
    bool saves = sp_front_saves(front);
    return recombine_front(refining) && (!saves || sp_save_water(refining)) && recombine_front(refining) &&
           (saves ? sp_reach_target(refining) : sp_cover_more(refining)) && sharpen_often(refining, saves);
}

bool sp_refine_asked(const sp_refine *refine)
{
    return refine->position != 0 || refine->axis != 0 || refine->roll || refine->angle != 0 || refine->flow != 0;
}

typedef bool (*refine_step)(sp_refining *refining);

static bool run(const sp_search *search, const sp_pool *pool, sp_deadline *deadline, sp_front *front, refine_step step,
                sp_error *error)
{
    if (!sp_refine_asked(&search->options->refine) || !sp_deadline_goes_on(deadline, "refine", 0))
        return true;
    sp_refining refining = {.search = search, .pool = pool, .deadline = deadline, .front = front, .error = error};
    if (!sp_local_search_create(search, pool, front->fine, deadline, &refining.local_search, error))
        return false;
    bool done = step(&refining);
    sp_local_search_free(&refining.local_search);
    return done;
}

bool sp_refine_first(const sp_search *search, const sp_pool *pool, sp_deadline *deadline, sp_front *front,
                     sp_error *error)
{
    return run(search, pool, deadline, front, sp_refine_hurried, error);
}

bool sp_refine_best(const sp_search *search, const sp_pool *pool, sp_deadline *deadline, sp_front *front,
                    sp_error *error)
{
    return run(search, pool, deadline, front, refine_all, error);
}
