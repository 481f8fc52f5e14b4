#include "refine/hurry.h"

#include "ranking/ranking.h"
#include "refine/more_water.h"
#include "refine/other_layouts.h"
#include "refine/saving.h"

#include <stdlib.h>

#define RUNGS 12          /* amounts of water for which other layouts are looked for in a hurry */
#define RUNG 0.95         /* of each, the next */
#define RUNG_FIRST 1.4    /* of what the first layout takes, which does not reach the target */
#define RUNGS_TRIED 4     /* of the layouts found for these, that are refined */
#define PROMISING 0.012   /* of the target: what may be missing for that */
#define CLOSE 0.004       /* the same for the last local search */
#define CLOSEST 2         /* layouts so close that have it at a time */
#define MISSING_COST 15.0 /* share of the water that makes up for what is missing, per share of the target */
#define WALKS 6           /* from the closest */
#define SAVED_LEAST 0.005 /* of the best layout's water, by what is to be better */
#define LEEWAY 0.03       /* more water that a layout close to the target may take */

static bool aims_at_target(const sp_front *front)
{
    return front->objective != SP_OBJECTIVE_MAX_COVERAGE;
}

/* Trials of other layouts for ever less water, from a little more than the best layout takes where that does not reach
 * the target; where as much as possible is to be covered, for what it takes and for more. */
static bool ask_rungs(sp_refining *refining, sp_trials *trials)
{
    const sp_front *front = refining->front;
    double outlay = front->best.outlay;
    if (!aims_at_target(front))
        return sp_ask_other(refining, trials, outlay) && sp_ask_more(refining, trials);
    outlay *= front->measured.area >= front->target ? 1 : RUNG_FIRST;
    for (int i = 0; i < RUNGS; i++, outlay *= RUNG)
        if (!sp_ask_other(refining, trials, outlay))
            return false;
    return true;
}

/* The water that a layout may take once it is refined to reach the target. */
static double outlay_at_target(const sp_front *front, double outlay, double area)
{
    return outlay * (1 + MISSING_COST * fmax(0, 1 - area / front->target));
}

/* How late a layout is to be tried. */
static double lateness(const sp_front *front, const sp_partial *other)
{
    if (!aims_at_target(front))
        return -other->covered;
    bool promising = other->covered >= front->target * (1 - PROMISING);
    return promising ? outlay_at_target(front, other->outlay, other->covered) : INFINITY;
}

/* Keeps those few that promise to reach the target with least water, or where as much as possible is to be covered,
 * most; all where there are no more. */
static bool keep_promising(const sp_refining *refining, sp_trials *trials)
{
    const sp_front *front = refining->front;
    size_t count = trials->count;
    sp_ranked *ranked = malloc((count + 1) * sizeof *ranked);
    bool *kept = calloc(count + 1, sizeof *kept);
    bool done = (ranked && kept) || sp_fail_memory(refining->error);
    for (size_t i = 0; done && i < count; i++)
        ranked[i] = (sp_ranked){lateness(front, &trials->items[i].other), i};
    if (done) {
        sp_rank_rising(ranked, count);
        for (size_t k = 0; k < count && k < RUNGS_TRIED; k++)
            kept[ranked[k].at] = true;
        sp_trials_keep(trials, kept);
    }
    free(ranked);
    free(kept);
    return done;
}

/* The layouts of the front that are close to the target or reach it, and that which covers most, by the water they may
 * take there; malloc'd, the caller frees. NULL when memory runs out. */
static sp_ranked *rank_close(const sp_front *front, size_t *count)
{
    const sp_front_list *list = &front->by_water;
    sp_ranked *ranked = malloc((list->count + 1) * sizeof *ranked);
    *count = 0;
    for (size_t i = 0; ranked && i < list->count; i++) {
        const sp_front_point *point = &list->entries[i].point;
        bool close = aims_at_target(front) && point->area >= front->target * (1 - CLOSE);
        if (close || i + 1 == list->count)
            ranked[(*count)++] = (sp_ranked){outlay_at_target(front, point->outlay, point->area), i};
    }
    if (ranked)
        sp_rank_rising(ranked, *count);
    return ranked;
}

/* Anneals the closest layouts, by turns. */
static bool anneal_closest(sp_refining *refining)
{
    sp_trials trials = {0};
    size_t count;
    sp_ranked *ranked = rank_close(refining->front, &count);
    bool done = ranked || sp_fail_memory(refining->error);
    size_t turns = count < CLOSEST ? count : CLOSEST;
    for (size_t k = 0; done && turns && k < WALKS; k++) {
        const sp_front_entry *entry = &refining->front->by_water.entries[ranked[k % turns].at];
        done = sp_try_also(refining, &trials, &entry->partial, entry->point.outlay * (1 + LEEWAY), SP_TRIAL_ANNEALING);
    }
    free(ranked);
    done = done && sp_trials_carry_out(refining, &trials);
    sp_trials_free(&trials);
    return done;
}

/* Trials of the closest layouts for the water that they may take at the target, if that is less than the best's. */
static bool try_closest(sp_refining *refining, sp_trials *trials)
{
    const sp_front *front = refining->front;
    bool saves = sp_front_saves(front);
    double most = saves ? front->measured.outlay * (1 - SAVED_LEAST) : INFINITY;
    size_t count;
    sp_ranked *ranked = rank_close(front, &count);
    bool done = ranked || sp_fail_memory(refining->error);
    for (size_t k = count < CLOSEST ? count : CLOSEST; done && k-- > 0;) {
        const sp_front_entry *entry = &front->by_water.entries[ranked[k].at];
        double outlay = aims_at_target(front) ? ranked[k].merit : entry->point.outlay;
        done = sp_try_also(refining, trials, &entry->partial, fmin(outlay, most), SP_TRIAL_BY_TURNS);
    }
    free(ranked);
    return done;
}

/* The closest layouts on the final patches, where there is time: to see them there takes long by itself. */
static bool sharpen_closest(sp_refining *refining)
{
    sp_front *front = refining->front;
    sp_trials trials = {0};
    if (!sp_deadline_goes_on(refining->deadline, "refine", 1))
        return true;
    bool done = try_closest(refining, &trials) &&
                sp_sharpen(&refining->local_search, trials.items, trials.count, refining->error);
    for (size_t i = 0; done && i < trials.count; i++) {
        sp_front_point point;
        done = sp_front_measure(front, refining->search, &trials.items[i].partial, &point, refining->error);
        if (done && aims_at_target(front) && point.area >= front->target)
            done = sp_save_flow(refining, &trials.items[i].partial);
    }
    sp_trials_free(&trials);
    return done;
}

/* At first without annealing, so that there soon is something. */
bool sp_refine_hurried(sp_refining *refining)
{
    const sp_front *front = refining->front;
    bool gained = true;
    for (int pass = 0; gained && sp_deadline_goes_on(refining->deadline, "refine", 0); pass++) {
        sp_front_point before = front->measured;
        sp_trials trials = {0};
        bool done = ask_rungs(refining, &trials) && sp_find_others(refining, &trials) &&
                    keep_promising(refining, &trials) && sp_trials_carry_out(refining, &trials);
        sp_trials_free(&trials);
        if (!done || (pass && !anneal_closest(refining)) || !sharpen_closest(refining))
            return false;
        gained = pass == 0 || !sp_point_same(&before, &front->measured);
    }
    bool saves = sp_front_saves(front);
    return !saves || (sp_save_water(refining) && sharpen_closest(refining));
}
