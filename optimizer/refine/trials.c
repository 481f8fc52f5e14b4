#include "refine/trials.h"

#include "mesh/grow.h"

#include <stdlib.h>

#define ANNEALINGS 4 /* of a layout */
/* Of so many trials SP_STARTS are refined by continuation: compass finds as much where there is little to forget. */
#define TURNS 4

static void trial_free(sp_trial *trial)
{
    sp_partial_free(&trial->partial);
    sp_partial_free(&trial->other);
}

void sp_trials_keep(sp_trials *trials, const bool *kept)
{
    size_t count = 0;
    for (size_t i = 0; i < trials->count; i++)
        if (kept[i])
            trials->items[count++] = trials->items[i];
        else
            trial_free(&trials->items[i]);
    trials->count = count;
}

void sp_trials_free(sp_trials *trials)
{
    for (size_t i = 0; i < trials->count; i++)
        trial_free(&trials->items[i]);
    free(trials->items);
    *trials = (sp_trials){0};
}

bool sp_try_also(sp_refining *refining, sp_trials *trials, const sp_partial *partial, double budget, sp_trial_kind kind)
{
    if (!sp_grow(&trials->items, &trials->capacity, trials->count + 1, sizeof *trials->items))
        return sp_fail_memory(refining->error);
    sp_trial *trial = &trials->items[trials->count];
    *trial = (sp_trial){.kind = kind, .seed = ++refining->seeds, .budget = fmin(budget, refining->search->outlay_most)};
    trial->turn = trial->seed % TURNS < SP_STARTS ? trial->seed % TURNS : SP_STARTS;
    if (!sp_partial_copy(refining->search, partial, &trial->partial, refining->error))
        return false;
    trials->count++;
    return true;
}

bool sp_try_annealed(sp_refining *refining, sp_trials *trials, const sp_partial *partial, double budget)
{
    bool done = true;
    for (int i = 0; done && i < ANNEALINGS; i++)
        done = sp_try_also(refining, trials, partial, budget, SP_TRIAL_ANNEALING);
    return done;
}

/* Whether it covers more than any other of as many nozzles, fewer than the best has. */
static bool is_best_of_its_number(const sp_front *front, const sp_partial *partial)
{
    bool best = partial->count < front->best.count;
    for (size_t i = 0; best && i < front->by_number.count; i++) {
        const sp_partial *other = &front->by_number.entries[i].partial;
        best = other->count != partial->count || other->covered < partial->covered;
    }
    return best;
}

/* Whether the final patches may see the layout on the front: none of no more water covers clearly more on the search's,
 * or none of no more nozzles. */
static bool may_count(const sp_front *front, const sp_partial *partial)
{
    if (is_best_of_its_number(front, partial))
        return true;
    for (size_t i = 0; i < front->by_water.count && front->by_water.entries[i].point.outlay <= partial->outlay; i++)
        if (front->by_water.entries[i].partial.covered > partial->covered * (1 + SP_MISJUDGED))
            return false;
    return true;
}

bool sp_ask_other(sp_refining *refining, sp_trials *trials, double outlay)
{
    const sp_front *front = refining->front;
    size_t i = 0;
    while (i + 1 < front->by_water.count && front->by_water.entries[i + 1].point.outlay <= outlay * (1 + SP_ROUNDING))
        i++;
    return sp_try_also(refining, trials, &front->by_water.entries[i].partial, outlay, SP_TRIAL_OTHER);
}

sp_front_point *sp_trials_measure_ahead(sp_refining *refining, const sp_trials *trials, bool better)
{
    sp_front *front = refining->front;
    const sp_partial **partials = calloc(trials->count + 1, sizeof *partials);
    sp_front_point *points = malloc((trials->count + 1) * sizeof *points);
    bool done = (partials && points) || sp_fail_memory(refining->error);
    for (size_t i = 0; done && i < trials->count; i++)
        if (!better || (trials->items[i].better && may_count(front, &trials->items[i].partial)))
            partials[i] = &trials->items[i].partial;
    done = done && sp_front_measure_ahead(front, refining->search, partials, trials->count, points, refining->error);
    free(partials);
    if (done)
        return points;
    free(points);
    return NULL;
}

bool sp_trials_carry_out(sp_refining *refining, sp_trials *trials)
{
    const sp_search *search = refining->search;
    sp_front_point *points = NULL;
    bool done = sp_local_search_run(&refining->local_search, trials->items, trials->count, refining->error) &&
                (points = sp_trials_measure_ahead(refining, trials, true));
    for (size_t i = 0; done && i < trials->count; i++) {
        const sp_trial *trial = &trials->items[i];
        if (trial->better && may_count(refining->front, &trial->partial))
            done = sp_front_note(refining->front, search, &trial->partial, &points[i], refining->error);
    }
    free(points);
    return done;
}
