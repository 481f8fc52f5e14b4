#include "refine/saving.h"

#include "search/exchange.h"

#define FLOW_TRIALS 7     /* measurements to find how far the flow can be turned down */
#define NEAR 0.006        /* of the target: what may be missing for a layout to be near it */
#define LEEWAY 0.03       /* more outlay that such a layout may take */
#define ANNEALED_MOST 4   /* such layouts that are annealed, those of most outlay */
#define ROUNDS 3          /* of all of that */
#define SAVING 2e-3       /* less outlay, for another round */
#define MISSING_MOST 0.03 /* of the target: more, refinement is not expected to make up for */

bool sp_save_flow(sp_refining *refining, const sp_partial *full)
{
    const sp_search *search = refining->search;
    sp_front *front = refining->front;
    double high = full->flow, low = search->kept_flow;
    for (size_t i = 0; i < full->count; i++)
        low += sp_least_flow(search, &full->items[i]);
    if (!(low < high * (1 - 1e-6)))
        return true;
    sp_sights *sights = &refining->local_search.sights[0]; /* liquid flies alike at every flow */
    bool done = true;
    sp_sights_forget(sights);
    for (int trial = 0; done && trial < FLOW_TRIALS && sp_deadline_goes_on(refining->deadline, "refine", 1); trial++) {
        sp_partial partial;
        sp_front_point point;
        double middle = 0.5 * (low + high);
        done = sp_partial_copy(search, full, &partial, refining->error);
        if (!done)
            break;
        sp_turn_down(search, &partial, middle);
        done = sp_partial_look(sights, &partial, refining->error) &&
               sp_front_measure(front, search, &partial, &point, refining->error);
        sp_partial_free(&partial);
        if (done && point.area >= front->target)
            high = middle;
        else
            low = middle;
    }
    return done;
}

/* Makes up for what a layout is missing, if that may be: by continuation, and by annealing on another core. */
static bool make_up(sp_refining *refining, const sp_partial *partial, double budget)
{
    const sp_front *front = refining->front;
    double missing = front->target - front->bias - partial->covered;
    if (missing > MISSING_MOST * front->target || !sp_deadline_goes_on(refining->deadline, "refine", 0))
        return true;
    sp_trials trials = {0};
    bool done = sp_try_also(refining, &trials, partial, budget, SP_TRIAL_CONTINUATION) &&
                sp_try_also(refining, &trials, partial, budget, SP_TRIAL_ANNEALING) &&
                sp_trials_carry_out(refining, &trials);
    sp_trials_free(&trials);
    return done;
}

/* Less water by the share given: exchange within it, then refine to make up for what is missing. *saved says whether
 * the best layout got better. */
static bool save_share(sp_refining *refining, sp_pool_gains *gains, double share, bool *saved)
{
    sp_front *front = refining->front;
    sp_front_point before = front->measured;
    double budget = front->best.outlay * (1 - share);
    sp_partial reduced;
    bool found;
    *saved = false;
    if (!sp_reduce(refining->search, gains, &front->best, budget, front->target - front->bias, refining->deadline,
                   &reduced, &found, refining->error))
        return false;
    if (!found)
        return true;
    bool done = sp_front_measure(front, refining->search, &reduced, NULL, refining->error) &&
                make_up(refining, &reduced, budget);
    sp_partial_free(&reduced);
    *saved = done && !sp_point_same(&before, &front->measured);
    return done;
}

bool sp_save_water(sp_refining *refining)
{
    static const double shares[] = {0.06, 0.03};
    sp_pool_gains gains;
    if (!sp_pool_gains_create(refining->search, refining->pool, &gains, refining->error))
        return false;
    bool done = true;
    for (size_t i = 0; done && i < sizeof shares / sizeof *shares;) {
        bool saved = false;
        if (!refining->front->best.count || !sp_deadline_goes_on(refining->deadline, "refine", 0))
            break;
        done = save_share(refining, &gains, shares[i], &saved);
        i += !saved;
    }
    sp_pool_gains_free(&gains);
    return done;
}

bool sp_is_near_target(const sp_front *front, size_t i)
{
    const sp_front_point *point = &front->by_water.entries[i].point;
    return point->outlay < front->best.outlay * (1 - SP_GAIN_LEAST) && point->area < front->target &&
           point->area >= front->target * (1 - NEAR);
}

double sp_near_budget(const sp_front *front, size_t i)
{
    return fmin(front->by_water.entries[i].point.outlay * (1 + LEEWAY), front->best.outlay);
}

static bool anneal_near(sp_refining *refining)
{
    const sp_front *front = refining->front;
    sp_trials trials = {0};
    bool done = true;
    size_t near = 0;
    for (size_t i = front->by_water.count; done && i-- > 0 && near < ANNEALED_MOST;) {
        if (!sp_is_near_target(front, i))
            continue;
        near++;
        done = sp_try_annealed(refining, &trials, &front->by_water.entries[i].partial, sp_near_budget(front, i));
    }
    done = done && sp_trials_carry_out(refining, &trials);
    sp_trials_free(&trials);
    return done;
}

bool sp_reach_target(sp_refining *refining)
{
    double before = INFINITY;
    const sp_partial *best = &refining->front->best;
    for (int round = 0; round < ROUNDS && best->outlay < before * (1 - SAVING); round++) {
        before = best->outlay;
        if (!anneal_near(refining))
            return false;
    }
    return true;
}
